-- stdlib/shapes/measure.lua
--- Measures of a shape: bounds, volume, mass properties, and whether it is closed.
local raise = require "clench.raise"
local mesh = require "clench.shapes.mesh"
local vector = require "clench.shapes.vector"
local measure = {}

--- Minimum and maximum coordinates.
---@param shape table  {vertices = ..., triangles = ...}
---@return number[] low, number[] high  [m]
---@effect reads
function measure.bounds(shape)
  shape = mesh.check(shape, "shapes.bounds")
  local low, high = {math.huge, math.huge, math.huge}, {-math.huge, -math.huge, -math.huge}
  for _, p in ipairs(shape.vertices) do
    for k = 1, 3 do low[k], high[k] = math.min(low[k], p[k]), math.max(high[k], p[k]) end
  end
  return low, high
end

--- Enclosed volume, > 0 if the triangles face outward; overlaps between parts of a union count twice.
---@param shape table  {vertices = ..., triangles = ...}
---@return number volume  [m^3]
---@effect reads
function measure.volume(shape) return mesh.volume6(mesh.check(shape, "shapes.volume")) / 6 end

--- Area of the surface.
---@param shape table  {vertices = ..., triangles = ...}
---@return number area  [m^2]
---@effect reads
function measure.area(shape)
  shape = mesh.check(shape, "shapes.area")
  local sum = 0
  for _, t in ipairs(shape.triangles) do
    local a, b, c = shape.vertices[t[1]], shape.vertices[t[2]], shape.vertices[t[3]]
    sum = sum + 0.5 * vector.norm(vector.cross(vector.sub(b, a), vector.sub(c, a)))
  end
  return sum
end

--- Does every edge occur exactly once in each direction, so that the surface bounds a solid?
---@param shape table  {vertices = ..., triangles = ...}
---@return boolean closed, string? why  the fault if it is not closed
---@effect reads
function measure.closed(shape)
  shape = mesh.check(shape, "shapes.closed")
  local runs, count = {}, #shape.vertices + 1
  for i, t in ipairs(shape.triangles) do
    for k = 1, 3 do
      local a, b = t[k], t[k % 3 + 1]
      if a == b then return false, ("triangle %d has a corner twice"):format(i) end
      local key = a * count + b
      if runs[key] then return false, ("triangles %d and %d run along an edge in the same direction"):format(runs[key], i) end
      runs[key] = i
    end
  end
  for i, t in ipairs(shape.triangles) do
    for k = 1, 3 do
      local a, b = t[k], t[k % 3 + 1]
      if not runs[b * count + a] then return false, ("triangle %d has an open edge"):format(i) end
    end
  end
  return true
end

--- Integrals over the solid, for uniform density; overlaps between parts of a union count twice.
--- Source: Eberly (2002), polyhedral mass properties: moments of the tetrahedra from a point to each triangle
---@param shape table  {vertices = ..., triangles = ...}
---@return {volume: number, centroid: number[], inertia: number[][]} mass  [m^3, m]; inertia about the centroid for
---  unit mass [m^2]
---@effect reads
function measure.mass(shape)
  shape = mesh.check(shape, "shapes.mass")
  local origin = shape.vertices[1]
  local volume, first, second = 0, {0, 0, 0}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}
  for _, t in ipairs(shape.triangles) do
    local corner = {}
    for k = 1, 3 do corner[k] = vector.sub(shape.vertices[t[k]], origin) end
    local part = vector.dot(corner[1], vector.cross(corner[2], corner[3])) / 6
    local sum = vector.add(corner[1], vector.add(corner[2], corner[3]))
    volume = volume + part
    for i = 1, 3 do
      first[i] = first[i] + part * sum[i] / 4
      for j = 1, 3 do
        local products = sum[i] * sum[j]
        for k = 1, 3 do products = products + corner[k][i] * corner[k][j] end
        second[i][j] = second[i][j] + part * products / 20
      end
    end
  end
  -- the quotient of smaller volumes overflows
  if math.abs(volume) < 1e-300 then raise("shapes.mass: expected a solid, got a shape without volume") end
  local center, spread, inertia = vector.scale(first, 1 / volume), {}, {}
  for i = 1, 3 do
    spread[i] = {}
    for j = 1, 3 do spread[i][j] = second[i][j] / volume - center[i] * center[j] end
  end
  local trace = spread[1][1] + spread[2][2] + spread[3][3]
  for i = 1, 3 do
    inertia[i] = {}
    for j = 1, 3 do inertia[i][j] = (i == j and trace or 0) - 0.5 * (spread[i][j] + spread[j][i]) end
  end
  return {volume = volume, centroid = vector.add(origin, center), inertia = inertia}
end

return measure
