-- stdlib/shapes/skin.lua
--- The closed surface over a stack of rings: bands between neighbors, and end caps. A ring is a list of points; a ring of one point is an apex. All other rings
--- have the same number of corresponding points.
local raise = require "clench.raise"
local vector = require "clench.shapes.vector"
local mesh = require "clench.shapes.mesh"
local polygon = require "clench.shapes.polygon"

local max_vertices = 300000

local function distance2(a, b)
  local d = vector.sub(a, b)
  return vector.dot(d, d)
end

--- Triangles between two rings, each given by its first vertex and count.
local function band(triangles, vertices, a, na, b, nb)
  for i = 0, math.max(na, nb) - 1 do
    local a0, a1 = a + i % na, a + (i + 1) % na
    local b0, b1 = b + i % nb, b + (i + 1) % nb
    if na == 1 then
      triangles[#triangles + 1] = {a0, b1, b0}
    elseif nb == 1 then
      triangles[#triangles + 1] = {a0, a1, b0}
    elseif distance2(vertices[a0], vertices[b1]) <= distance2(vertices[a1], vertices[b0]) * (1 + 1e-9) then
      -- the shorter diagonal, with a bias so that rounding errors do not change the choice
      triangles[#triangles + 1] = {a0, a1, b1}
      triangles[#triangles + 1] = {a0, b1, b0}
    else
      triangles[#triangles + 1] = {a0, a1, b0}
      triangles[#triangles + 1] = {a1, b1, b0}
    end
  end
end

--- Projects a ring along its own normal (Newell's); returns also whether it is counter-clockwise.
local function flatten(ring)
  local normal = {0, 0, 0}
  for i, p in ipairs(ring) do
    normal = vector.add(normal, vector.cross(vector.sub(p, ring[1]), vector.sub(ring[i % #ring + 1], ring[1])))
  end
  local z = vector.unit(normal)
  if not z then return nil end
  local x, y = vector.frame(z)
  local flat = {}
  for i, p in ipairs(ring) do
    local d = vector.sub(p, ring[1])
    flat[i] = {vector.dot(d, x), vector.dot(d, y)}
  end
  return flat
end

--- Caps an end ring; a ring that has shrunk to a line or a point needs no cap.
local function cap(triangles, ring, first, outward, subject)
  local distinct, index = {}, {}
  for i, p in ipairs(ring) do
    if distance2(p, ring[i % #ring + 1]) > 0 then
      distinct[#distinct + 1] = p
      index[#index + 1] = first + i - 1
    end
  end
  if #distinct < 3 then return end
  local flat = flatten(distinct)
  if not flat then raise(subject .. ": expected end rings that bound an area, got one without") end
  for _, t in ipairs(polygon.triangulate(flat, subject .. ": an end ring")) do
    local i, j, k = index[t[1]], index[t[2]], index[t[3]]
    triangles[#triangles + 1] = outward and {i, j, k} or {i, k, j}
  end
end

---@param rings number[][][]
---@param closed boolean  true: the last ring is joined to the first
---@param subject string  for messages
---@return table mesh
return function(rings, closed, subject)
  local vertices, triangles, starts, count = {}, {}, {}, 0
  for _, ring in ipairs(rings) do count = count + #ring end
  if count > max_vertices then raise(("%s: expected at most %d vertices, got %d"):format(subject, max_vertices, count)) end
  for i, ring in ipairs(rings) do
    starts[i] = #vertices + 1
    for _, p in ipairs(ring) do vertices[#vertices + 1] = {p[1], p[2], p[3] or 0} end
  end
  for i = 1, #rings - (closed and 0 or 1) do
    local j = i % #rings + 1
    band(triangles, vertices, starts[i], #rings[i], starts[j], #rings[j])
  end
  if not closed then
    if #rings[1] > 1 then cap(triangles, rings[1], starts[1], false, subject) end
    if #rings[#rings] > 1 then cap(triangles, rings[#rings], starts[#rings], true, subject) end
  end
  return mesh.outward(mesh.weld {vertices = vertices, triangles = triangles}, subject)
end
