-- stdlib/shapes/capsule.lua
local read_options = require "clench.shapes.options"
local axis = require "clench.shapes.axis"
local revolve = require "clench.shapes.revolve"

--- A rod with round ends along z, centred on the origin, or between the centres of its ends. With two radii it
--- is the hull of two spheres.
---@param options {radius: number, length?: number, top?: number, from?: number[], to?: number[], segments?: integer}
---  or {radius, length, ...}: length between the centres; top: radius of the far end, else the same [m]
---@return table mesh
return function(options)
  local o = read_options("capsule", options, {"radius", "length"})
  local radius = o:positive "radius"
  local top = o:positive("top", radius)
  local length, place = axis(o, "length")
  local segments = o:count("segments", 32, 4, 1024)
  o:done()
  if math.abs(radius - top) >= length then
    o:fail("the radii must differ by less than the length, %.6g, got %.6g and %.6g", length, radius, top)
  end
  -- the common tangent leaves both spheres at this height above their equators
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
