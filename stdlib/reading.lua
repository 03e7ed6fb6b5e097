--- What the command line says of files, as options for the reader of their kind.
local keys = {
  body = {"root", "confine", "strict", "unit"},
  robot = {"root", "confine", "strict", "unit", "folder", "package"},
  world = {"root", "confine", "strict", "unit"},
}

---@param kind string  as clench.file_kind tells it
---@param said table<string, string|boolean>  "" when nothing is said
return function(kind, said)
  local options = {}
  for _, key in ipairs(keys[kind] or {"root", "confine", "strict"}) do options[key] = said[key] ~= "" and said[key] or nil end
  return options
end
