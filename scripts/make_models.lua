-- scripts/make_models.lua
--- Writes all generated model files; each run gives the same bytes.
---   lua5.4 scripts/make_models.lua          writes them, from the project's root
---   lua5.4 scripts/make_models.lua --check  writes nothing, fails if a file differs from the generated one
---   lua5.4 scripts/make_models.lua barrett  one set only, see scripts/models/sets.lua
package.path = "scripts/?.lua;" .. package.path

--- clench.x.y is stdlib/x/y.lua or stdlib/x/y/init.lua, as in the executable
table.insert(package.searchers, 2, function(name)
  local unit = name:match "^clench%.(.+)$"
  if not unit then return nil end
  local base = "stdlib/" .. unit:gsub("%.", "/")
  for _, path in ipairs {base .. ".lua", base .. "/init.lua"} do
    local file = io.open(path)
    if file then
      file:close()
      return assert(loadfile(path)), path
    end
  end
  return "no unit " .. base
end)

local inventor, sets = require "models.inventor", require "models.sets"

local function read(path)
  local file = io.open(path, "rb")
  local text = file and file:read "a"
  if file then file:close() end
  return text
end

local function write(path, text)
  os.execute("mkdir -p '" .. path:match "^(.*)/" .. "'")
  local file, why = io.open(path, "wb")
  if not file then error("cannot write " .. why .. "; run this in the project's root", 0) end
  file:write(text)
  file:close()
end

local check, only = false, nil
for _, word in ipairs(arg) do
  if word == "--check" then check = true else only = word end
end

local known = {}
for _, set in ipairs(sets) do known[set] = true end
if only and not known[only] then
  print(("there is no set '%s', only %s"):format(only, table.concat(sets, ", ")))
  os.exit(2)
end

local stale = 0
for _, set in ipairs(sets) do
  if not only or only == set then
    for _, entry in ipairs(require("models." .. set)) do
      local path = entry[1]
      local text, triangles = entry.text, 0
      if not text then text, triangles = inventor.text(entry, path) end
      local same = read(path) == text
      if check and not same then stale = stale + 1 end
      if not check and not same then write(path, text) end
      local word = same and "same" or check and "STALE" or "written"
      print(("%-9s %-44s %5d triangles %4d KB"):format(word, path, triangles, #text // 1000))
    end
  end
end
if stale > 0 then
  print(stale .. " stale: run lua5.4 scripts/make_models.lua")
  os.exit(1)
end
