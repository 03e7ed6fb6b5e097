-- stdlib/shapes/cone.lua
local read_options = require "clench.shapes.options"
local axis = require "clench.shapes.axis"
local revolve = require "clench.shapes.revolve"

--- A cone or a frustum along z, centered on the origin, or with its axis between two points.
---@param options table  {bottom, top, height, ...} or by name
---@option bottom number [m, >= 0]  radius at the bottom
---@option top? number [m, >= 0] = 0  radius at the top; at most one of the two is 0
---@option height? number [m, > 0]  distance of the ends
---@option from? vec3 [m]  start of the axis, instead of the height
---@option to? vec3 [m]  end of the axis
---@option segments? integer [3 to 4096] = 48  segments around the axis
---@return table mesh
---@effect reads
return function(options)
  local o = read_options("cone", options, {"bottom", "top", "height"})
  local bottom, top = o:get "bottom", o:get "top"
  local height, place = axis(o, "height")
  local segments = o:get "segments"
  o:done()
  if bottom == 0 and top == 0 then o:fail "bottom or top must be > 0, got 0 for both" end
  local profile = {{0, 0}}
  if bottom > 0 then profile[#profile + 1] = {bottom, 0} end
  if top > 0 then profile[#profile + 1] = {top, height} end
  profile[#profile + 1] = {0, height}
  return place(revolve(profile, false, segments, "shapes.cone"))
end
