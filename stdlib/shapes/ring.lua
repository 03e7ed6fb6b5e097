-- stdlib/shapes/ring.lua
local read_options = require "clench.shapes.options"

--- Points of a circle in the plane z = 0, counter-clockwise from +x: a section for lofts, an outline for prisms.
---@param options table  {radius, ...} or by name
---@option radius number [m, > 0]  radius of the circle
---@option segments? integer [3 to 4096] = 32  number of points
---@return number[][] points
---@effect reads
return function(options)
  local o = read_options("ring", options, {"radius"})
  local radius, segments = o:get "radius", o:get "segments"
  o:done()
  local points = {}
  for i = 1, segments do
    local angle = 2 * math.pi * (i - 1) / segments
    points[i] = {radius * math.cos(angle), radius * math.sin(angle)}
  end
  return points
end
