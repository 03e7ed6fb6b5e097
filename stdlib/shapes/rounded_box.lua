-- stdlib/shapes/rounded_box.lua
local read_options = require "clench.shapes.options"
local arc = require "clench.shapes.arc"
local skin = require "clench.shapes.skin"

--- A rectangle with rounded corners at height z, counter-clockwise; (±hx, ±hy) are the centers of the corners.
local function rectangle(hx, hy, radius, z, segments)
  local points = {}
  for corner = 0, 3 do
    local sx, sy = (corner == 0 or corner == 3) and 1 or -1, corner < 2 and 1 or -1
    for k = 0, segments do
      -- the corner's quarter turn, in increasing angle
      local c, s = arc(sx * sy > 0 and k or segments - k, segments)
      points[#points + 1] = {sx * (hx + radius * c), sy * (hy + radius * s), z}
    end
  end
  return points
end

--- A box with rounded edges and corners, centered on the origin.
---@param options table  {x, y, z, ...} or by name
---@like clench.shapes.box  x, y, z
---@option rounding? number [m, > 0]  radius of the edges, a tenth of the smallest size by default
---@like clench.shapes.box  segments
---@return table mesh
---@effect reads
return function(options)
  local o = read_options("rounded_box", options, {"x", "y", "z"})
  local x, y, z = o:get "x", o:get "y", o:get "z"
  local least = math.min(x, y, z)
  local rounding, segments = o:get("rounding", 0.1 * least), o:get "segments"
  o:done()
  if 2 * rounding > least * (1 + 1e-12) then
    o:fail("rounding must be at most half of the smallest size, %.6g, got %.6g", 0.5 * least, rounding)
  end
  local hx, hy, hz = math.max(0, x / 2 - rounding), math.max(0, y / 2 - rounding), math.max(0, z / 2 - rounding)
  local rings = {}
  for half = -1, 1, 2 do
    for k = 0, segments do
      local c, s = arc(half < 0 and segments - k or k, segments)
      rings[#rings + 1] = rectangle(hx, hy, rounding * c, half * (hz + rounding * s), segments)
    end
  end
  return skin(rings, false, "shapes.rounded_box")
end
