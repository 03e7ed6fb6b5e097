-- stdlib/shapes/init.lua
--- Solids as plain meshes {vertices = {{x, y, z}, ...}, triangles = {{i, j, k}, ...}}: indices from 1, metres,
--- counter-clockwise from outside, closed. Each name is loaded when it is first used.
local home = {
  bounds = "measure", volume = "measure", area = "measure", closed = "measure", mass = "measure",
  move = "place", turn = "place", scale = "place", mirror = "place",
}
local names = {"area", "bounds", "box", "capsule", "closed", "cone", "cylinder", "lathe", "loft", "mass", "mirror",
               "move", "outline", "prism", "ring", "rounded_box", "scale", "sphere", "torus", "tube", "turn", "union",
               "volume"}
local known = {}
for _, name in ipairs(names) do known[name] = true end

local function load(shapes, name)
  if not known[name] then
    error(("shapes: there is no '%s', only %s"):format(tostring(name), table.concat(names, ", ")), 2)
  end
  local unit = require("clench.shapes." .. (home[name] or name))
  local value = home[name] and unit[name] or unit
  rawset(shapes, name, value)
  return value
end

--- all names in order, loaded or not, so that tables and consoles can list them
local function list(shapes)
  local i = 0
  return function()
    i = i + 1
    if names[i] then return names[i], shapes[names[i]] end
  end
end

return setmetatable({}, {__index = load, __pairs = list, __name = "clench.shapes"})
