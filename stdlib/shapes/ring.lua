-- stdlib/shapes/ring.lua
local read_options = require "clench.shapes.options"

--- Points of a circle in the plane z = 0, counter-clockwise from +x: a section for lofts, an outline for prisms.
---@param options {radius: number, segments?: integer}  or {radius, ...} [m]
---@return number[][] points
return function(options)
  local o = read_options("ring", options, {"radius"})
  local radius, segments = o:positive "radius", o:count("segments", 32, 3, 4096)
  o:done()
  local points = {}
  for i = 1, segments do
    local angle = 2 * math.pi * (i - 1) / segments
    points[i] = {radius * math.cos(angle), radius * math.sin(angle)}
  end
  return points
end
