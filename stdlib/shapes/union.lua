-- stdlib/shapes/union.lua
local raise = require "clench.raise"
local described = require "clench.described"
local mesh = require "clench.shapes.mesh"

--- Combines several closed shapes: concatenates their vertices and triangles without removing anything. Parts may overlap; the interior is the union of the
--- parts (the engine counts windings), but volume and mass count overlaps twice.
---@param parts table[]  one or more meshes
---@return table mesh
---@effect reads
return function(parts)
  if type(parts) ~= "table" or #parts == 0 then
    raise("shapes.union: expected a list of shapes, got " .. (type(parts) == "table" and "none" or described(parts)))
  end
  local vertices, triangles, round = {}, {}, nil
  for i = 1, #parts do
    local part = mesh.check(parts[i], "shapes.union: part " .. i)
    local base = #vertices
    round = round or part.round
    for _, p in ipairs(part.vertices) do vertices[#vertices + 1] = {p[1], p[2], p[3]} end
    for _, t in ipairs(part.triangles) do triangles[#triangles + 1] = {t[1] + base, t[2] + base, t[3] + base} end
  end
  return {vertices = vertices, triangles = triangles, round = round}
end
