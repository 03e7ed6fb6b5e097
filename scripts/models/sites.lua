-- scripts/models/sites.lua
--- Text of a file of virtual contacts (.vgr): sites on the pads of a hand's links [mm].
local shapes = require "clench.shapes"
local vector = require "clench.shapes.vector"
local robot = require "models.robot"

-- static friction against plastic, by the link's material
local friction = {rubber = 1, wood = 0.4, plastic = 0.3, metal = 0.2}

--- the outermost point where a ray from p along d leaves the surface, and the normal there
--- source  Moeller & Trumbore (1997)
local function outermost(mesh, p, d, subject)
  local best, normal = -math.huge, nil
  for _, t in ipairs(mesh.triangles) do
    local a = mesh.vertices[t[1]]
    local e1, e2 = vector.sub(mesh.vertices[t[2]], a), vector.sub(mesh.vertices[t[3]], a)
    local h = vector.cross(d, e2)
    local det = vector.dot(e1, h)
    if math.abs(det) > 1e-12 then
      local s = vector.sub(p, a)
      local u = vector.dot(s, h) / det
      local q = vector.cross(s, e1)
      local v, s_along = vector.dot(d, q) / det, vector.dot(e2, q) / det
      if u >= -1e-9 and v >= -1e-9 and u + v <= 1 + 1e-9 and s_along > best then
        best, normal = s_along, vector.unit(vector.cross(e1, e2))
      end
    end
  end
  if not normal then error(subject .. ": the ray misses the link", 0) end
  return vector.along(p, best, d), normal
end

local function row(numbers, format)
  local out = {}
  for i, x in ipairs(numbers) do
    local text = format:format(x):gsub("0+$", ""):gsub("%.$", "")
    out[i] = text == "-0" and "0" or text
  end
  return table.concat(out, " ")
end

--- the complete surface of a body that models.inventor writes
local function surface(body)
  local meshes = {}
  for i, part in ipairs(body.parts) do meshes[i] = part[1] end
  return shapes.union(meshes)
end

--- @param name string  of the robot
--- @param list {finger: integer, link: integer, body: table, at: number[], along?: number[]}[]
---   finger from 0, -1: the palm; at: a point inside the body; along: the direction in which its pad lies, else +y
return function(name, list)
  local out, surfaces = {name, tostring(#list)}, {}
  local function add(text) out[#out + 1] = text end
  for i, site in ipairs(list) do
    local body = site.body
    surfaces[body] = surfaces[body] or surface(body)
    local along = vector.unit(site.along or {0, 1, 0})
    local p, normal = outermost(surfaces[body], site.at, along, ("%s: site %d"):format(name, i))
    local x, y = vector.frame(normal)
    add(site.finger .. " " .. site.link)
    -- a point contact with friction: its cone's edges in the contact frame
    add "8"
    for k = 0, 7 do
      add(row({math.cos(math.pi * k / 4), math.sin(math.pi * k / 4), 0, 0, 0, 0}, "%.6f"))
    end
    add(row(p, "%.4f"))
    add(row(robot.quaternion(x, y, normal), "%.9f"))
    add(row(p, "%.4f"))
    add(row(normal, "%.9f"))
    add(tostring(friction[body.material]))
  end
  add ""
  return table.concat(out, "\n")
end
