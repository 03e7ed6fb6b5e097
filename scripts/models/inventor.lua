-- scripts/models/inventor.lua
--- A body as Inventor text: colored parts [mm], material, mass [g], center of gravity [mm] and inertia [mm^2].
local shapes = require "clench.shapes"
local inventor = {}

--- a number with up to four decimals and no more characters than required
local function number(x)
  local text = ("%.4f"):format(x):gsub("0+$", ""):gsub("%.$", "")
  return text == "-0" and "0" or text
end

--- the mesh as a reader will get it: coordinates with four decimals
local function rounded(mesh)
  local vertices = {}
  for i, p in ipairs(mesh.vertices) do
    vertices[i] = {}
    for k = 1, 3 do vertices[i][k] = tonumber(number(p[k])) end
  end
  return {vertices = vertices, triangles = mesh.triangles}
end

--- faults that a file must not have: openings, triangles without area
local function check(mesh, subject)
  local closed, why = shapes.closed(mesh)
  if not closed then error(subject .. ": expected a closed part, but " .. why, 0) end
  for i, t in ipairs(mesh.triangles) do
    local corners = {mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]}
    local area = shapes.area {vertices = corners, triangles = {{1, 2, 3}}}
    if area < 1e-4 then
      error(("%s: triangle %d has an area of %.3g mm^2, expected at least 1e-4"):format(subject, i, area), 0)
    end
  end
end

local function row(numbers)
  local words = {}
  for i, x in ipairs(numbers) do words[i] = number(x) end
  return table.concat(words, " ")
end

--- one part: its color and its surface
local function part_text(mesh, part)
  local out = {"  Separator {", ("    Material { diffuseColor %s%s }"):format(row(part.color),
               part.transparency and " transparency " .. number(part.transparency) or "")}
  out[#out + 1] = "    Coordinate3 { point ["
  for _, p in ipairs(mesh.vertices) do out[#out + 1] = "      " .. row(p) .. "," end
  out[#out + 1] = "    ] }"
  out[#out + 1] = "    IndexedFaceSet { coordIndex ["
  for _, t in ipairs(mesh.triangles) do
    out[#out + 1] = ("      %d, %d, %d, -1,"):format(t[1] - 1, t[2] - 1, t[3] - 1)
  end
  out[#out + 1] = "    ] }"
  out[#out + 1] = "  }"
  return table.concat(out, "\n")
end

---@param body {about: string, material: string, youngs?: number, mass?: number, density?: number, cog?: number[], inertia?: number[],
---  parts: table[]}
---  parts: {mesh, color = {r, g, b}, transparency?}; youngs: of an elastic body [Pa]; mass [g] or density [g/mm^3]; published center of gravity [mm] and
---  principal moments about it, divided by the mass [mm^2], instead of those of the solid
---@param subject string  for messages
---@return string text, integer triangles
function inventor.text(body, subject)
  local meshes, texts, count = {}, {}, 0
  for i, part in ipairs(body.parts) do
    local mesh = rounded(part[1])
    check(mesh, ("%s: part %d"):format(subject, i))
    meshes[i], texts[i] = mesh, part_text(mesh, part)
    count = count + #mesh.triangles
  end
  local solid = shapes.mass(shapes.union(meshes))
  local moments = body.inertia
  local inertia = moments and {{moments[1], 0, 0}, {0, moments[2], 0}, {0, 0, moments[3]}} or solid.inertia
  local out = {
    "#Inventor V2.1 ascii",
    "# " .. body.about .. "; made by scripts/make_models.lua [mm]",
    "#material " .. body.material,
    "#mass " .. number(body.mass or body.density * solid.volume),
    "#cog " .. row(body.cog or solid.centroid),
    "#inertia_matrix",
    "#" .. row(inertia[1]),
    "#" .. row(inertia[2]),
    "#" .. row(inertia[3]),
    "Separator {",
    "  ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID faceType CONVEX creaseAngle 0.6 }",
    table.concat(texts, "\n"),
    "}",
    "",
  }
  if body.youngs then table.insert(out, 4, "#youngs " .. number(body.youngs)) end
  return table.concat(out, "\n"), count
end

return inventor
