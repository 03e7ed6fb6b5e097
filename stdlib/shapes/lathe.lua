-- stdlib/shapes/lathe.lua
local read_options = require "clench.shapes.options"
local polygon = require "clench.shapes.polygon"
local revolve = require "clench.shapes.revolve"

--- A solid of revolution: the profile {r, z}, ... swept about the z axis. A profile that starts and ends on the axis (r = 0) bounds a solid body, such as a
--- bottle with its inside; a profile off the axis is a loop, and bounds a ring.
---@param options table  {profile, ...} or by name
---@option profile number[][] [m]  points {r, z}, in either orientation
---@option segments? integer [3 to 4096] = 48  segments around the axis
---@return table mesh
---@effect reads
return function(options)
  local o = read_options("lathe", options, {"profile"})
  local profile, segments = o:points("profile", 3, 2), o:get "segments"
  o:done()
  local on_axis = 0
  for i, p in ipairs(profile) do
    if p[1] < 0 then o:fail("profile[%d] must have a radius >= 0, got %.6g", i, p[1]) end
    if p[1] == 0 then
      on_axis = on_axis + 1
      if i > 1 and i < #profile then
        o:fail("profile[%d] must be off the axis, which only its ends may touch, got radius 0", i)
      end
    end
  end
  if on_axis == 1 then o:fail "profile must have both ends on the axis or none, got one" end
  polygon.simple(profile, "shapes.lathe: profile")
  return revolve(profile, on_axis == 0, segments, "shapes.lathe")
end
