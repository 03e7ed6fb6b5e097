-- scripts/models/obstacles.lua
--- Obstacles. All stand on z = 0: see models/obstacles/README.md for the dimensions.
local shapes = require "clench.shapes"

-- densities [g/mm^3]
local board, particle_board, concrete = 0.28e-3, 0.65e-3, 2.4e-3

local function block(x, y, z, center, rounding)
  return shapes.move(shapes.box {x, y, z, rounding = rounding or 2, segments = 2}, center)
end

local function low_table()
  local parts = {{block(550, 550, 50, {0, 0, 425}), color = {0.80, 0.66, 0.48}}}
  for _, x in ipairs {-245, 245} do
    for _, y in ipairs {-245, 245} do
      parts[#parts + 1] = {block(50, 50, 410, {x, y, 205}), color = {0.62, 0.48, 0.33}}
    end
  end
  return parts
end

--- open towards -y, its back at +y
local function shelf()
  local wood, back = {0.85, 0.80, 0.72}, {0.78, 0.73, 0.65}
  local parts = {
    {block(16, 280, 1060, {-392, 0, 530}, 1), color = wood}, {block(16, 280, 1060, {392, 0, 530}, 1), color = wood},
    {block(790, 4, 1000, {0, 137, 552}, 1), color = back},
  }
  for _, z in ipairs {58, 382, 706, 1052} do parts[#parts + 1] = {block(772, 272, 16, {0, 0, z}, 1), color = wood} end
  return parts
end

--- a column between two plates, as a pedestal for an arm
local function stand()
  return {
    {block(420, 420, 15, {0, 0, 7.5}), color = {0.25, 0.27, 0.30}},
    {block(120, 120, 576, {0, 0, 300}, 8), color = {0.42, 0.45, 0.48}},
    {block(240, 240, 15, {0, 0, 592.5}), color = {0.25, 0.27, 0.30}},
  }
end

return {
  {"models/obstacles/table.iv", about = "low table", material = "wood", density = board, parts = low_table()},
  {"models/obstacles/shelf.iv", about = "shelf with three boards", material = "wood", density = particle_board,
   parts = shelf()},
  {"models/obstacles/floor.iv", about = "floor, 2 m square, its top at z = 0", material = "stone", density = concrete,
   parts = {{shapes.move(shapes.box {2000, 2000, 40}, {0, 0, -20}), color = {0.70, 0.70, 0.68}}}},
  {"models/obstacles/wall.iv", about = "wall, 2 m long", material = "stone", density = concrete,
   parts = {{shapes.move(shapes.box {2000, 115, 1250}, {0, 0, 625}), color = {0.84, 0.81, 0.76}}}},
  {"models/obstacles/stand.iv", about = "stand for an arm", material = "metal", mass = 40000, parts = stand()},
}
