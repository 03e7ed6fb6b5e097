--- What the command line says of files, as options for the reader of their kind.
local keys = {
  body = {"root", "confine", "unit"},
  robot = {"root", "confine", "unit", "folder", "package"},
  world = {"root", "confine", "unit"},
}

---@param kind string  as clench.file_kind tells it
---@param said table<string, string>  "" when nothing is said
return function(kind, said)
  local options = {}
  for _, key in ipairs(keys[kind] or {"root", "confine"}) do options[key] = said[key] ~= "" and said[key] or nil end
  return options
end
