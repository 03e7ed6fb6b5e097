-- stdlib/shapes/cylinder.lua
local read_options = require "clench.shapes.options"
local arc = require "clench.shapes.arc"
local axis = require "clench.shapes.axis"
local revolve = require "clench.shapes.revolve"

--- A cylinder along z, centered on the origin, or with its axis between two points.
---@param options table  {radius, height, ...} or by name
---@option radius number [m, > 0]  radius of the cylinder
---@option height? number [m, > 0]  distance of the ends
---@option from? vec3 [m]  start of the axis, instead of the height
---@option to? vec3 [m]  end of the axis
---@option chamfer? number [m, >= 0] = 0  width of the chamfers on each face
---@option rounding? number [m, >= 0] = 0  radius of the rims
---@option segments? integer [3 to 4096] = 48  segments around the axis
---@return table mesh
---@effect reads
return function(options)
  local o = read_options("cylinder", options, {"radius", "height"})
  local radius = o:get "radius"
  local height, place = axis(o, "height")
  local chamfer, rounding = o:get "chamfer", o:get "rounding"
  local segments = o:get "segments"
  o:done()
  if chamfer > 0 and rounding > 0 then o:fail "expected chamfer or rounding, got both" end
  local cut, steps = chamfer + rounding, chamfer > 0 and 1 or rounding > 0 and 4 or 0
  if cut > radius or 2 * cut > height then
    o:fail("%s must be at most the radius and half the height, %.6g, got %.6g", chamfer > 0 and "chamfer" or "rounding",
           math.min(radius, height / 2), cut)
  end
  local profile = {{0, 0}}
  for half = 0, 1 do
    for k = 0, steps do
      local c, s = arc(half == 0 and steps - k or k, math.max(steps, 1))
      if steps == 0 then c, s = 1, 1 end
      local p = {radius - cut + cut * c, half == 0 and cut - cut * s or height - cut + cut * s}
      local last = profile[#profile]
      if p[1] ~= last[1] or p[2] ~= last[2] then profile[#profile + 1] = p end
    end
  end
  if profile[#profile][1] > 0 then profile[#profile + 1] = {0, height} end
  local shape = revolve(profile, false, segments, "shapes.cylinder")
  shape.round = cut == 0 or nil
  return place(shape)
end
