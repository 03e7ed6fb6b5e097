-- stdlib/shapes/torus.lua
local read_options = require "clench.shapes.options"
local revolve = require "clench.shapes.revolve"

--- A torus about the z axis.
---@param options {radius: number, tube: number, segments?: integer, sides?: integer}  or {radius, tube, ...}: from the
---  axis to the tube's centre, and of the tube, smaller [m]; segments about the axis, sides of the tube
---@return table mesh
return function(options)
  local o = read_options("torus", options, {"radius", "tube"})
  local radius, tube = o:positive "radius", o:positive "tube"
  local segments, sides = o:count("segments", 48, 3, 4096), o:count("sides", 24, 3, 1024)
  o:done()
  if tube >= radius then o:fail("tube must be smaller than radius, %.6g, got %.6g", radius, tube) end
  local profile = {}
  for k = 1, sides do
    local angle = 2 * math.pi * (k - 1) / sides
    profile[k] = {radius + tube * math.cos(angle), tube * math.sin(angle)}
  end
  return revolve(profile, true, segments, "shapes.torus")
end
