-- stdlib/shapes/revolve.lua
--- The solid swept by a profile of points {r, z} about the z axis.
local skin = require "clench.shapes.skin"

---@param profile number[][]  r >= 0; r = 0 only at the ends
---@param closed boolean  true: the profile is a loop off the axis
return function(profile, closed, segments, subject)
  local rings = {}
  for i, p in ipairs(profile) do
    local ring = {}
    for k = 0, p[1] == 0 and 0 or segments - 1 do
      local angle = 2 * math.pi * k / segments
      ring[k + 1] = {p[1] * math.cos(angle), p[1] * math.sin(angle), p[2]}
    end
    rings[i] = ring
  end
  return skin(rings, closed, subject)
end
