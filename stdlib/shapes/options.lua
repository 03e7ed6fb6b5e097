--- The options of a shape, by its name. No length is beyond what a mesh may reach.
local options = require "clench.options"

local largest_coordinate = 1e9

return function(shape, given, places) return options("shapes." .. shape, given, places, largest_coordinate) end
