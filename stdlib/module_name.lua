--- The name of a table that is a module, "clench.stats", to recognize functions that are called with a colon; nil for all other values.
---@param value any
---@return string?
return function(value)
  local meta = type(value) == "table" and debug.getmetatable(value)
  local name = meta and rawget(meta, "__name")
  return type(name) == "string" and name:find "^clench%f[.\0]" and name or nil
end
