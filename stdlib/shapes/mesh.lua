-- stdlib/shapes/mesh.lua
--- A shape is a plain table {vertices = {{x, y, z}, ...}, triangles = {{i, j, k}, ...}}: indices from 1,
--- meters, counter-clockwise from outside. `round = true`: its connected parts may be tessellations of balls,
--- capsules or cylinders, which the engine recognizes; their contacts follow the formulas of these solids. This unit checks, welds and orients such tables.
local raise = require "clench.raise"
local described = require "clench.described"
local vector = require "clench.shapes.vector"
local within = require "clench.within"
local mesh = {}

--- bound of all coordinates [m]
mesh.largest = 1e9

local function fail(subject, format, ...) raise(subject .. ": " .. format:format(...)) end

local function check_vertex(subject, i, p)
  local expected = ("three numbers of at most %g"):format(mesh.largest)
  if type(p) ~= "table" then fail(subject, "vertex %d must be %s, got %s", i, expected, described(p)) end
  for k = 1, 3 do
    local x = p[k]
    if not within(x, mesh.largest) then
      fail(subject, "vertex %d must be %s, got %s", i, expected, described(x))
    end
  end
end

-- a copy with vertices as lists, for a mesh or a table with vectors among its vertices; else the shape itself
local function with_lists(shape)
  local vectors = clench.type(shape) == "mesh"
  if not vectors and (type(shape) ~= "table" or type(shape.vertices) ~= "table") then return shape end
  local points = shape.vertices
  for i = 1, #points do vectors = vectors or clench.type(points[i]) == "vec3" end
  if not vectors then return shape end
  local vertices = {}
  for i = 1, #points do vertices[i] = vector.list(points[i]) end
  return {vertices = vertices, triangles = shape.triangles, round = type(shape) == "table" and shape.round or nil}
end

--- A shape as a table of lists; meshes of bodies and vertices that are vectors are converted. Raises an error for other values.
function mesh.check(shape, subject)
  shape = with_lists(shape)
  if type(shape) ~= "table" or type(shape.vertices) ~= "table" or type(shape.triangles) ~= "table" then
    fail(subject, "expected a shape {vertices = ..., triangles = ...}, got %s", described(shape))
  end
  for i = 1, #shape.vertices do check_vertex(subject, i, shape.vertices[i]) end
  local count = #shape.vertices
  for i = 1, #shape.triangles do
    local t = shape.triangles[i]
    for k = 1, 3 do
      local got = t
      if type(t) == "table" then got = t[k] end
      -- a string such as '3' would also convert to an integer
      local index = type(got) == "number" and math.tointeger(got)
      if not index or index < 1 or index > count then
        fail(subject, "triangle %d must name vertices 1 to %d, got %s", i, count, described(got))
      end
    end
  end
  if #shape.triangles == 0 then fail(subject, "expected at least one triangle, got none") end
  return shape
end

--- Merges equal points; removes triangles that then have a corner twice, and points without triangles.
function mesh.weld(shape)
  local vertices, triangles, index_of = {}, {}, {}
  local function place(i)
    local p = shape.vertices[i]
    local key = ("%.17g %.17g %.17g"):format(p[1] + 0.0, p[2] + 0.0, p[3] + 0.0)
    if not index_of[key] then
      vertices[#vertices + 1] = p
      index_of[key] = #vertices
    end
    return index_of[key]
  end
  for _, t in ipairs(shape.triangles) do
    local p, q, r = shape.vertices[t[1]], shape.vertices[t[2]], shape.vertices[t[3]]
    local function same(a, b) return a[1] == b[1] and a[2] == b[2] and a[3] == b[3] end
    if not (same(p, q) or same(q, r) or same(r, p)) then
      triangles[#triangles + 1] = {place(t[1]), place(t[2]), place(t[3])}
    end
  end
  return {vertices = vertices, triangles = triangles}
end

--- Six times the signed volume, relative to the first vertex so that distant shapes lose no digits.
function mesh.volume6(shape)
  local origin, sum = shape.vertices[1], 0
  for _, t in ipairs(shape.triangles) do
    local a = vector.sub(shape.vertices[t[1]], origin)
    local b = vector.sub(shape.vertices[t[2]], origin)
    local c = vector.sub(shape.vertices[t[3]], origin)
    sum = sum + vector.dot(a, vector.cross(b, c))
  end
  return sum
end

--- Reverses the orientation of every triangle.
function mesh.flip(shape)
  for _, t in ipairs(shape.triangles) do t[2], t[3] = t[3], t[2] end
  return shape
end

--- Orients the triangles of a closed shape outward; raises an error if it has no volume.
function mesh.outward(shape, subject)
  local volume = #shape.triangles > 0 and mesh.volume6(shape) or 0
  if volume == 0 then fail(subject, "expected a solid, got a shape without volume") end
  return volume > 0 and shape or mesh.flip(shape)
end

--- A copy with every vertex p replaced by map(p); raises an error if the result is not a point.
function mesh.map(shape, map, subject)
  local vertices, triangles = {}, {}
  for i, p in ipairs(shape.vertices) do
    vertices[i] = map(p)
    check_vertex(subject, i, vertices[i])
  end
  for i, t in ipairs(shape.triangles) do triangles[i] = {t[1], t[2], t[3]} end
  return {vertices = vertices, triangles = triangles, round = shape.round}
end

return mesh
