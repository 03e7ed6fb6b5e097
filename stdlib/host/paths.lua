--- Search paths of require for modules outside of the folder of the script: those of LUA_PATH and LUA_CPATH, else the defaults of Lua without the current folder.
local function without_current_folder(path)
  local kept = {}
  for template in path:gmatch "[^;]+" do
    if not template:find "^%./" then kept[#kept + 1] = template end
  end
  return table.concat(kept, ";")
end

-- as in Lua: two semicolons are replaced by the default
local function chosen(variable, default)
  local given = os.getenv(variable .. "_5_4") or os.getenv(variable)
  if not given then return default end
  local before, after = given:match "^(.-);;(.*)$"
  if not before then return given end
  return ((before .. ";" .. default .. ";" .. after):gsub("^;", ""):gsub(";$", ""))
end

return function()
  package.path = chosen("LUA_PATH", without_current_folder(package.path))
  package.cpath = chosen("LUA_CPATH", without_current_folder(package.cpath))
end
