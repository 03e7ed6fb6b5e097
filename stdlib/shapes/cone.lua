-- stdlib/shapes/cone.lua
local read_options = require "clench.shapes.options"
local axis = require "clench.shapes.axis"
local revolve = require "clench.shapes.revolve"

--- A cone or a frustum along z, centred on the origin, or with its axis between two points.
---@param options {bottom: number, top?: number, height?: number, from?: number[], to?: number[], segments?: integer}
---  or {bottom, top, height, ...}: radii at both ends, at most one of them 0 (top unless given) [m]
---@return table mesh
return function(options)
  local o = read_options("cone", options, {"bottom", "top", "height"})
  local bottom, top = o:not_negative "bottom", o:not_negative("top", 0)
  local height, place = axis(o, "height")
  local segments = o:count("segments", 48, 3, 4096)
  o:done()
  if bottom == 0 and top == 0 then o:fail "bottom or top must be > 0, got 0 for both" end
  local profile = {{0, 0}}
  if bottom > 0 then profile[#profile + 1] = {bottom, 0} end
  if top > 0 then profile[#profile + 1] = {top, height} end
  profile[#profile + 1] = {0, height}
  return place(revolve(profile, false, segments, "shapes.cone"))
end
