-- scripts/models/objects.lua
--- Things to grasp and things in the way. All stand on z = 0, upright about z: see the README files beside them.
local shapes = require "clench.shapes"

-- densities [g/mm^3]
local borosilicate, soda_glass, stoneware, tinplate, board = 2.23e-3, 2.5e-3, 2.4e-3, 0.45e-3, 0.28e-3

--- a hollow body about z, from one closed profile whose first and last corner lie on the axis
local function vessel(corners, segments)
  corners.segments = 5
  return shapes.lathe {shapes.outline(corners), segments = segments}
end

local function flask()
  return vessel({
    {0, 0}, {65.5, 0, 13}, {21, 182, 16}, {21, 212.5, 1.5}, {24.5, 216, 1.5}, {24.5, 220, 1.2},
    {18.6, 220, 2.5}, {18.6, 182.5, 13.5}, {62.3, 2.8, 10}, {0, 2.8},
  }, 56)
end

local function mug()
  local body = vessel({
    {0, 3}, {27, 3, 1}, {29, 0, 0.8}, {33.5, 0, 1}, {41, 6, 4}, {41, 95, 2}, {36.4, 95, 2}, {36.4, 8, 7}, {0, 8},
  }, 56)
  -- the handle: a flattened loop that starts and ends inside the wall
  local path, centre = {{38.6, 0, 76}, {44, 0, 76.4}}, {47, 50}
  for k = 0, 12 do
    local angle = math.rad(82 - 164 * k / 12)
    path[#path + 1] = {centre[1] + 24 * math.cos(angle), 0, centre[2] + 26.6 * math.sin(angle)}
  end
  path[#path + 1] = {44, 0, 23.6}
  path[#path + 1] = {38.6, 0, 24}
  local section = {}
  for k = 1, 14 do
    local angle = 2 * math.pi * k / 14
    section[k] = {4.4 * math.cos(angle), 7 * math.sin(angle)}
  end
  return body, shapes.tube {path, profile = section, up = {0, 1, 0}}
end

local function glass()
  return vessel({
    {0, 1.5}, {18, 1.5, 1}, {21, 0, 1}, {26.5, 0, 3}, {29, 30, 40}, {36, 140, 0.8},
    {33.8, 140, 0.8}, {26, 16, 8}, {0, 13},
  }, 56)
end

local function tin()
  local body = shapes.move(shapes.box {84, 64, 100, rounding = 4, segments = 3}, {0, 0, 50})
  local lid = shapes.move(shapes.box {85.2, 65.2, 26, rounding = 4.4, segments = 3}, {0, 0, 100.2})
  local label = shapes.move(shapes.box {84.5, 64.5, 44, rounding = 4.2, segments = 3}, {0, 0, 50})
  return body, lid, label
end

local function table_parts()
  local top = shapes.move(shapes.box {550, 550, 50, rounding = 2, segments = 2}, {0, 0, 425})
  local parts = {{top, color = {0.80, 0.66, 0.48}}}
  for _, x in ipairs {-245, 245} do
    for _, y in ipairs {-245, 245} do
      local leg = shapes.move(shapes.box {50, 50, 410, rounding = 2, segments = 2}, {x, y, 205})
      parts[#parts + 1] = {leg, color = {0.62, 0.48, 0.33}}
    end
  end
  return parts
end

local mug_body, mug_handle = mug()
local tin_body, tin_lid, tin_label = tin()

return {
  {"models/objects/flask.iv", about = "conical flask, 1000 ml", material = "glass", density = borosilicate,
   parts = {{flask(), color = {0.72, 0.86, 0.9}, transparency = 0.35}}},
  {"models/objects/mug.iv", about = "mug, 325 ml", material = "glass", density = stoneware,
   parts = {{mug_body, color = {0.23, 0.42, 0.62}}, {mug_handle, color = {0.23, 0.42, 0.62}}}},
  {"models/objects/glass.iv", about = "drinking glass, 350 ml", material = "glass", density = soda_glass,
   parts = {{glass(), color = {0.75, 0.87, 0.85}, transparency = 0.4}}},
  {"models/objects/tea_tin.iv", about = "tea tin, 125 g of tea", material = "metal", density = tinplate,
   parts = {{tin_body, color = {0.16, 0.36, 0.27}}, {tin_lid, color = {0.16, 0.36, 0.27}},
            {tin_label, color = {0.88, 0.82, 0.66}}}},
  {"models/obstacles/table.iv", about = "low table", material = "wood", density = board, parts = table_parts()},
}
