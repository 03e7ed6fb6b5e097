-- stdlib/shapes/outline.lua
local within = require "clench.within"
local read_options = require "clench.shapes.options"
local polygon = require "clench.shapes.polygon"

--- Start, end and center of the arc that rounds the corner p; nil if the corner is straight.
local function corner_arc(p, before, after, radius)
  local ux, uy = before[1] - p[1], before[2] - p[2]
  local vx, vy = after[1] - p[1], after[2] - p[2]
  local lu, lv = math.sqrt(ux * ux + uy * uy), math.sqrt(vx * vx + vy * vy)
  ux, uy, vx, vy = ux / lu, uy / lu, vx / lv, vy / lv
  local cosine = math.max(-1, math.min(1, ux * vx + uy * vy))
  if cosine < -1 + 1e-12 then return nil end
  local half = 0.5 * math.acos(cosine)
  local reach, depth = radius / math.tan(half), radius / math.sin(half)
  local bx, by = ux + vx, uy + vy
  local lb = math.sqrt(bx * bx + by * by)
  local center = {p[1] + depth * bx / lb, p[2] + depth * by / lb}
  return center, {p[1] + reach * ux, p[2] + reach * uy}, math.pi - 2 * half, reach, ux * vy - uy * vx
end

--- A simple polygon with rounded corners, counter-clockwise.
---
--- Each corner is {x, y} or {x, y, radius}; `rounding` is the radius of corners without one.
---@param options table  the corners, and by name
---@option rounding? number [m, >= 0] = 0  radius of corners without one
---@option segments? integer [1 to 256] = 6  segments per corner
---@return number[][] points
---@effect reads
return function(options)
  local o = read_options("outline", options)
  local rounding, segments = o:get "rounding", o:get "segments"
  local corners = {}
  for i = 1, #options do
    local p = o:raw(i)
    for k = 1, 3 do
      local x = type(p) == "table" and (p[k] or k == 3 and rounding)
      if not within(x, o.largest) or (k == 3 and x < 0) then
        o:expected("corner " .. i, "{x, y} or {x, y, radius >= 0}", p)
      end
    end
    corners[i] = p
  end
  if #corners < 3 then o:fail("expected at least 3 corners, got %d", #corners) end
  o:done()
  corners = polygon.simple(corners, "shapes.outline: corners")

  local points, n, used = {}, #corners, {}
  for i, p in ipairs(corners) do
    local radius = p[3] or rounding
    local center, start, sweep, reach, side
    if radius > 0 then
      center, start, sweep, reach, side = corner_arc(p, corners[(i - 2) % n + 1], corners[i % n + 1], radius)
    end
    used[i] = center and reach or 0
    if not center then
      points[#points + 1] = {p[1], p[2]}
    else
      -- around a convex corner the arc runs counter-clockwise, around a concave one clockwise
      local direction = side < 0 and 1 or -1
      local x, y = start[1] - center[1], start[2] - center[2]
      for k = 0, segments do
        local angle = direction * sweep * k / segments
        local c, s = math.cos(angle), math.sin(angle)
        points[#points + 1] = {center[1] + c * x - s * y, center[2] + s * x + c * y}
      end
    end
  end
  for i, p in ipairs(corners) do
    local q = corners[i % n + 1]
    local length = math.sqrt((q[1] - p[1]) ^ 2 + (q[2] - p[2]) ^ 2)
    if used[i] + used[i % n + 1] > length * (1 - 1e-9) then
      o:fail("roundings must leave some of each edge, got %.6g and %.6g on an edge of length %.6g", used[i],
             used[i % n + 1], length)
    end
  end
  return points
end
