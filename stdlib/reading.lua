--- Converts options of the command line to options of the reader for a kind of file.
local keys = {
  body = {"root", "confine", "strict", "unit"},
  robot = {"root", "confine", "strict", "unit", "folder", "package"},
  world = {"root", "confine", "strict", "unit"},
}

---@param kind string  of clench.file_kind
---@param said table<string, string|boolean>  "" if not given
return function(kind, said)
  local options = {}
  for _, key in ipairs(keys[kind] or {"root", "confine", "strict"}) do options[key] = said[key] ~= "" and said[key] or nil end
  return options
end
