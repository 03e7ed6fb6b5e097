--- "clench.stats" of that table, as it arrives where a function of it is called with a colon; nil of all else.
---@param value any
---@return string?
return function(value)
  local meta = type(value) == "table" and debug.getmetatable(value)
  local name = meta and rawget(meta, "__name")
  return type(name) == "string" and name:find "^clench%f[.\0]" and name or nil
end
