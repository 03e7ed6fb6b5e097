-- stdlib/shapes/capsule.lua
local read_options = require "clench.shapes.options"
local axis = require "clench.shapes.axis"
local revolve = require "clench.shapes.revolve"

--- A rod with spherical ends along z, centered on the origin, or between the centers of its ends. With two radii it is the hull of two spheres.
---@param options table  {radius, length, ...} or by name
---@option radius number [m, > 0]  radius of the ends
---@option length? number [m, > 0]  distance of the centers of the ends
---@option top? number [m, > 0]  radius of the far end, by default that of the other end
---@option from? vec3 [m]  start of the axis, instead of the length
---@option to? vec3 [m]  end of the axis
---@option segments? integer [4 to 1024] = 32  segments around the axis
---@return table mesh
---@effect reads
return function(options)
  local o = read_options("capsule", options, {"radius", "length"})
  local radius = o:get "radius"
  local top = o:get("top", radius)
  local length, place = axis(o, "length")
  local segments = o:get "segments"
  o:done()
  if math.abs(radius - top) >= length then
    o:fail("the radii must differ by less than the length, %.6g, got %.6g and %.6g", length, radius, top)
  end
  -- latitude at which the common tangent touches both spheres [rad]
  local tangent = math.asin((radius - top) / length)
  local steps = math.max(2, segments // 4)
  local profile = {{0, -radius}}
  for k = 1, steps do
    local angle = -math.pi / 2 + (tangent + math.pi / 2) * k / steps
    profile[#profile + 1] = {radius * math.cos(angle), radius * math.sin(angle)}
  end
  for k = 0, steps - 1 do
    local angle = tangent + (math.pi / 2 - tangent) * k / steps
    profile[#profile + 1] = {top * math.cos(angle), length + top * math.sin(angle)}
  end
  profile[#profile + 1] = {0, length + top}
  local shape = revolve(profile, false, segments, "shapes.capsule")
  shape.round = radius == top or nil
  return place(shape)
end
