--- Reads the options of a shape, with error messages for its name. Lengths are limited to the coordinates of meshes.
local options = require "clench.options"
local mesh = require "clench.shapes.mesh"

return function(shape, given, places) return options("shapes." .. shape, given, places, mesh.largest) end
