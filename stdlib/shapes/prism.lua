-- stdlib/shapes/prism.lua
local read_options = require "clench.shapes.options"
local arc = require "clench.shapes.arc"
local polygon = require "clench.shapes.polygon"
local skin = require "clench.shapes.skin"

--- The outline moved inward by `inset`, at height z; raises an error if an edge would vanish.
local function layer(o, outline, inset, z)
  local moved = inset > 0 and polygon.inset(outline, inset) or outline
  local ring = {}
  for i, p in ipairs(moved) do
    local a, b = outline[i], outline[i % #outline + 1]
    local q = moved[i % #moved + 1]
    if (b[1] - a[1]) * (q[1] - p[1]) + (b[2] - a[2]) * (q[2] - p[2]) <= 0 then
      o:fail("the bevel must leave a part of every edge, got %.6g, which removes edge %d", inset, i)
    end
    ring[i] = {p[1], p[2], z}
  end
  if inset > 0 and polygon.crossing(moved) then o:fail("the bevel must leave a simple outline, got %.6g", inset) end
  return ring
end

--- A prism from z = 0 to z = height over a simple polygon, convex or not, with sharp, chamfered or rounded rims.
---@param options table  {outline, height, ...} or by name
---@option outline number[][] [m]  points {x, y}, in either orientation
---@option height number [m, > 0]  distance of the ends
---@option chamfer? number [m, >= 0] = 0  width of the chamfers on each face
---@option rounding? number [m, >= 0] = 0  radius of the rims
---@option segments? integer [1 to 64] = 4  segments per rounding
---@return table mesh
---@effect reads
return function(options)
  local o = read_options("prism", options, {"outline", "height"})
  local outline, height = o:points("outline", 3, 2), o:get "height"
  local chamfer, rounding = o:get "chamfer", o:get "rounding"
  local segments = o:get "segments"
  o:done()
  if chamfer > 0 and rounding > 0 then o:fail "expected chamfer or rounding, got both" end
  outline = polygon.simple(outline, "shapes.prism: outline")
  local bevel, steps = chamfer + rounding, rounding > 0 and segments or 1
  if 2 * bevel >= height then
    o:fail("%s must be less than half the height, %.6g, got %.6g", chamfer > 0 and "chamfer" or "rounding", height / 2,
           bevel)
  end
  if bevel == 0 then return skin({layer(o, outline, 0, 0), layer(o, outline, 0, height)}, false, "shapes.prism") end
  local rings = {}
  for half = 0, 1 do
    for k = 0, steps do
      local c, s = arc(half == 0 and steps - k or k, steps)
      local z = half == 0 and bevel * (1 - s) or height - bevel * (1 - s)
      rings[#rings + 1] = layer(o, outline, bevel * (1 - c), z)
    end
  end
  return skin(rings, false, "shapes.prism")
end
