-- stdlib/shapes/init.lua
--- Solids as plain meshes {vertices = {{x, y, z}, ...}, triangles = {{i, j, k}, ...}}: indices from 1, meters,
--- counter-clockwise from outside, closed.
local names = {"area", "bounds", "box", "capsule", "closed", "cone", "cylinder", "lathe", "loft", "mass", "mirror",
               "move", "outline", "prism", "ring", "rounded_box", "scale", "sphere", "torus", "tube", "turn", "union",
               "volume"}

return require "clench.lazy"("shapes", names, {
  bounds = "measure", volume = "measure", area = "measure", closed = "measure", mass = "measure",
  move = "place", turn = "place", scale = "place", mirror = "place",
})
