-- stdlib/shapes/sphere.lua
local read_options = require "clench.shapes.options"
local vector = require "clench.shapes.vector"

local function icosahedron()
  local g = (1 + math.sqrt(5)) / 2
  local vertices = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}}
  for i, p in ipairs(vertices) do vertices[i] = vector.unit(p) end
  return vertices, {{1, 12, 6}, {1, 6, 2}, {1, 2, 8}, {1, 8, 11}, {1, 11, 12}, {2, 6, 10}, {6, 12, 5},
                    {12, 11, 3}, {11, 8, 7}, {8, 2, 9}, {4, 10, 5}, {4, 5, 3}, {4, 3, 7}, {4, 7, 9},
                    {4, 9, 10}, {5, 10, 6}, {3, 5, 12}, {7, 3, 11}, {9, 7, 8}, {10, 9, 2}}
end

--- Divides each triangle into four, with the new vertices projected onto the unit sphere.
local function subdivide(vertices, triangles)
  local middle_of, finer = {}, {}
  local base = #vertices + 1
  local function middle(i, j)
    local key = math.min(i, j) * base + math.max(i, j)
    if not middle_of[key] then
      vertices[#vertices + 1] = vector.unit(vector.add(vertices[i], vertices[j]))
      middle_of[key] = #vertices
    end
    return middle_of[key]
  end
  for _, t in ipairs(triangles) do
    local a, b, c = middle(t[1], t[2]), middle(t[2], t[3]), middle(t[3], t[1])
    finer[#finer + 1] = {t[1], a, c}
    finer[#finer + 1] = {t[2], b, a}
    finer[#finer + 1] = {t[3], c, b}
    finer[#finer + 1] = {a, b, c}
  end
  return finer
end

--- A sphere about the origin: a subdivided icosahedron, with its vertices on the sphere.
---@param options table  {radius, ...} or by name
---@option radius number [m, > 0]  radius of the sphere
---@option subdivisions? integer [0 to 7] = 3  number of subdivisions; the mesh has 20 * 4^subdivisions triangles
---@return table mesh
---@effect reads
return function(options)
  local o = read_options("sphere", options, {"radius"})
  local radius, subdivisions = o:get "radius", o:get "subdivisions"
  o:done()
  local vertices, triangles = icosahedron()
  for _ = 1, subdivisions do triangles = subdivide(vertices, triangles) end
  for i, p in ipairs(vertices) do vertices[i] = vector.scale(p, radius) end
  return {vertices = vertices, triangles = triangles, round = true}
end
