-- stdlib/shapes/tube.lua
local read_options = require "clench.shapes.options"
local arc = require "clench.shapes.arc"
local polygon = require "clench.shapes.polygon"
local skin = require "clench.shapes.skin"
local vector = require "clench.shapes.vector"

--- Unit directions of the path's segments; raises an error if one has no length.
local function directions(o, path, closed)
  local list = {}
  for i = 1, #path - (closed and 0 or 1) do
    list[i] = vector.unit(vector.sub(path[i % #path + 1], path[i]))
    if not list[i] then o:fail("path[%d] must differ from path[%d], got the same point", i % #path + 1, i) end
  end
  return list
end

--- Rotates x by the smallest rotation that maps the unit vector a to b.
local function carry(x, a, b)
  local axis = vector.cross(a, b)
  local sine = vector.norm(axis)
  if sine < 1e-12 then return x end
  return vector.turn(x, vector.scale(axis, 1 / sine), math.atan(sine, vector.dot(a, b)))
end

--- The section's x axis along each segment, with the least twist.
--- source  Bishop (1975), frames that do not turn about the curve
local function section_axes(o, dirs, up)
  local x = vector.frame(dirs[1])
  if up then
    local side = vector.unit(vector.cross(up, dirs[1]))
    if not side then
      o:fail("up must not lie along the path's first segment, got {%.6g, %.6g, %.6g}", up[1], up[2], up[3])
    end
    x = side
  end
  local axes = {x}
  for i = 2, #dirs do axes[i] = carry(axes[i - 1], dirs[i - 1], dirs[i]) end
  return axes
end

--- The section at a point of the path, in the plane that bisects the bend there.
local function mitred(o, section, p, i, dir_in, dir_out, x, angle, radius)
  local normal = vector.unit(vector.add(dir_in, dir_out))
  if not normal then o:fail("path[%d] must not turn straight back, got a bend of 180 degrees", i) end
  local y = vector.cross(dir_in, x)
  local c, s, lean = math.cos(angle), math.sin(angle), vector.dot(dir_in, normal)
  local ring = {}
  for k, q in ipairs(section) do
    local u, v = radius * (c * q[1] - s * q[2]), radius * (s * q[1] + c * q[2])
    local offset = vector.along(vector.scale(x, u), v, y)
    ring[k] = vector.add(p, vector.along(offset, -vector.dot(offset, normal) / lean, dir_in))
  end
  return ring
end

--- Rings that close an end in a dome: half an ellipsoid over the end ring, rising along `dir`.
local function dome(ring, center, dir, height, steps)
  local rings = {}
  for k = 1, steps - 1 do
    local c, s = arc(k, steps)
    local smaller = {}
    for i, p in ipairs(ring) do
      smaller[i] = vector.along(vector.along(center, c, vector.sub(p, center)), s * height, dir)
    end
    rings[k] = smaller
  end
  rings[steps] = {vector.along(center, height, dir)}
  return rings
end

--- Checks that every point of the section moves forward along every segment, since otherwise the tube would fold.
local function check_bends(o, rings, dirs)
  for i, dir in ipairs(dirs) do
    local next_ring = rings[i % #rings + 1]
    for k, p in ipairs(rings[i]) do
      if vector.dot(vector.sub(next_ring[k], p), dir) <= 0 then
        o:fail("the path bends too sharply for the width of the tube, got a fold between path[%d] and path[%d]", i,
               i % #rings + 1)
      end
    end
  end
end

--- One radius per path point, and the section of radius 1, or the given profile with factors 1.
local function read_section(o, count)
  local radius, profile, sides = o:raw "radius", o:raw "profile", o:get "sides"
  if (radius == nil) == (profile == nil) then
    o:fail("expected either radius or profile, got %s", radius and "both" or "neither")
  end
  local radii, section = {}, {}
  if profile then
    section = polygon.simple(o:points("profile", 3, 2), "shapes.tube: profile")
  else
    for k = 1, sides do
      local angle = 2 * math.pi * (k - 1) / sides
      section[k] = {math.cos(angle), math.sin(angle)}
    end
  end
  local list = type(radius) == "table"
  if list and #radius ~= count then
    o:fail("radius must be one number or one for each of %d points, got %d", count, #radius)
  end
  for i = 1, count do
    radii[i] = profile and 1 or list and radius[i] or radius
    if type(radii[i]) ~= "number" or not (radii[i] > 0 and radii[i] <= o.largest) then
      o:expected(list and "radius[" .. i .. "]" or "radius", "a number > 0", radii[i])
    end
  end
  return section, radii
end

--- Sweeps a circle or another section along a path, as for a handle, a cable or a frame.
---@param options table  {path, ...} or by name
---@option path number[][] [m]  points {x, y, z}
---@option radius? number|number[] [m, > 0]  one radius, or one per point
---@option profile? number[][] [m]  points {x, y} of another section, instead of the radius; its y axis points towards `up` at the start
---@option closed? boolean = false  joins the last point to the first
---@option ends? "flat"|"round" = "flat"  form of the ends
---@option up? vec3  direction of the profile's y axis at the start
---@option sides? integer [3 to 1024] = 24  number of segments of a round section
---@option steps? integer [2 to 64] = 6  number of steps of a round end
---@return table mesh
---@effect reads
return function(options)
  local o = read_options("tube", options, {"path"})
  local path, closed = o:points("path", 2, 3), o:get "closed"
  local section, radii = read_section(o, #path)
  local ends, up, steps = o:get "ends", o:point "up", o:get "steps"
  o:done()
  if closed and #path < 3 then o:fail("a closed path must have at least 3 points, got %d", #path) end
  local dirs = directions(o, path, closed)
  local axes = section_axes(o, dirs, up)
  local twist = 0
  if closed then
    -- the twist of a closed path is removed in equal parts
    local x = carry(axes[#axes], dirs[#dirs], dirs[1])
    twist = -math.atan(vector.dot(vector.cross(axes[1], x), dirs[1]), vector.dot(axes[1], x)) / #path
  end
  local rings = {}
  for i, p in ipairs(path) do
    local before = dirs[i - 1] or (closed and dirs[#dirs]) or dirs[1]
    local x = axes[i - 1] or axes[1]
    if i == 1 and closed then x = carry(axes[1], dirs[1], before) end
    rings[i] = mitred(o, section, p, i, before, dirs[i] or before, x, twist * (i - 1), radii[i])
  end
  check_bends(o, rings, dirs)
  if ends == "round" and not closed then
    local widest = 0
    for _, q in ipairs(section) do widest = math.max(widest, math.sqrt(q[1] ^ 2 + q[2] ^ 2)) end
    local stack = {}
    local first = dome(rings[1], path[1], vector.scale(dirs[1], -1), widest * radii[1], steps)
    for i = #first, 1, -1 do stack[#stack + 1] = first[i] end
    for _, ring in ipairs(rings) do stack[#stack + 1] = ring end
    for _, ring in ipairs(dome(rings[#rings], path[#path], dirs[#dirs], widest * radii[#path], steps)) do
      stack[#stack + 1] = ring
    end
    rings = stack
  end
  return skin(rings, closed, "shapes.tube")
end
