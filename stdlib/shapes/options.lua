--- The options of a shape, by its name. No length is beyond what a mesh may reach.
local options = require "clench.options"
local mesh = require "clench.shapes.mesh"

return function(shape, given, places) return options("shapes." .. shape, given, places, mesh.largest) end
