-- stdlib/shapes/torus.lua
local read_options = require "clench.shapes.options"
local revolve = require "clench.shapes.revolve"

--- A torus about the z axis.
---@param options table  {radius, tube, ...} or by name
---@option radius number [m, > 0]  distance of the center of the tube from the axis
---@option tube number [m, > 0]  radius of the tube, smaller than `radius`
---@option segments? integer [3 to 4096] = 48  segments around the axis
---@option sides? integer [3 to 1024] = 24  segments around the tube
---@return table mesh
---@effect reads
return function(options)
  local o = read_options("torus", options, {"radius", "tube"})
  local radius, tube = o:get "radius", o:get "tube"
  local segments, sides = o:get "segments", o:get "sides"
  o:done()
  if tube >= radius then o:fail("tube must be smaller than radius, %.6g, got %.6g", radius, tube) end
  local profile = {}
  for k = 1, sides do
    local angle = 2 * math.pi * (k - 1) / sides
    profile[k] = {radius + tube * math.cos(angle), tube * math.sin(angle)}
  end
  return revolve(profile, true, segments, "shapes.torus")
end
