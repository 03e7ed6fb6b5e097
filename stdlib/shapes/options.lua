-- stdlib/shapes/options.lua
--- The options of a shape, by its name.
local options = require "clench.options"

return function(shape, given, places) return options("shapes." .. shape, given, places) end
