-- scripts/models/objects.lua
--- Objects to grasp. All stand on z = 0: see models/objects/README.md for the dimensions.
local shapes = require "clench.shapes"

-- densities [g/mm^3]
local borosilicate, soda_glass, stoneware, tinplate, beech = 2.23e-3, 2.5e-3, 2.4e-3, 0.45e-3, 0.72e-3
local paper = 0.75e-3

--- a hollow body about z, from one closed profile whose first and last corner lie on the axis
local function vessel(corners, segments, steps)
  corners.segments = steps or 5
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
  local path, center = {{38.6, 0, 76}, {44, 0, 76.4}}, {47, 50}
  for k = 0, 12 do
    local angle = math.rad(82 - 164 * k / 12)
    path[#path + 1] = {center[1] + 24 * math.cos(angle), 0, center[2] + 26.6 * math.sin(angle)}
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

local function bottle()
  local body = vessel({
    {0, 4}, {14, 4, 4}, {21, 0, 3}, {30, 0, 8}, {32.5, 14, 10}, {32.5, 66, 4}, {30.5, 72, 6}, {32.5, 78, 6},
    {32.5, 128, 4},
    {30.5, 134, 6}, {32.5, 140, 6}, {31, 160, 20}, {12.6, 196, 12}, {12.6, 203}, {0, 203},
  }, 28, 2)
  local ring = shapes.cylinder {16.4, from = {0, 0, 199}, to = {0, 0, 202}, chamfer = 0.6, segments = 28}
  local cap = shapes.cylinder {15, from = {0, 0, 203.5}, to = {0, 0, 220}, chamfer = 1.2, segments = 28}
  local neck = shapes.cylinder {13, from = {0, 0, 201}, to = {0, 0, 206}, segments = 24}
  local label = shapes.cylinder {32.9, from = {0, 0, 82}, to = {0, 0, 124}, chamfer = 0.4, segments = 28}
  return {{body, color = {0.55, 0.76, 0.88}, transparency = 0.3}, {label, color = {0.90, 0.92, 0.94}},
          {ring, color = {0.55, 0.76, 0.88}}, {neck, color = {0.55, 0.76, 0.88}}, {cap, color = {0.10, 0.32, 0.62}}}
end

local function plate()
  return vessel({
    {0, 2}, {72, 2, 1}, {74, 0, 1}, {78, 0, 1}, {92, 5, 12}, {134.5, 24, 1.5}, {133.5, 27.2, 1.2}, {90, 9.6, 14},
    {0, 7},
  }, 44, 3)
end

local function bowl()
  return vessel({
    {0, 3}, {26, 3, 1}, {28, 0, 0.8}, {34, 0, 1}, {60, 24, 26}, {75, 70, 1.2}, {71, 70, 1.2}, {55, 26, 24},
    {26, 8, 8}, {0, 7},
  }, 40, 3)
end

--- a block of pages between two covers and a spine, lying
local function book()
  local cover = {0.55, 0.13, 0.14}
  local function board(z) return shapes.move(shapes.box {148, 210, 2.6, chamfer = 0.4}, {0, 0, z}) end
  local spine = shapes.move(shapes.box {2.6, 209.4, 23.4, chamfer = 0.4}, {-73, 0, 12})
  local pages = shapes.move(shapes.box {141, 203, 20, chamfer = 0.2}, {-1.5, 0, 12})
  local title = shapes.move(shapes.box {86, 34, 0.6}, {0, 48, 23.9})
  return {{board(1.3), color = cover}, {board(22.7), color = cover}, {spine, color = cover},
          {pages, color = {0.94, 0.92, 0.85}},
          {title, color = {0.86, 0.72, 0.36}}}
end

local function phone()
  local shell = shapes.prism {shapes.outline {{-35.75, -73.35}, {35.75, -73.35}, {35.75, 73.35}, {-35.75, 73.35},
                                              rounding = 11,
                                              segments = 5}, 7.65, rounding = 1.6, segments = 2}
  local screen = shapes.prism {shapes.outline {{-33.4, -71}, {33.4, -71}, {33.4, 71}, {-33.4, 71}, rounding = 9,
                                               segments = 5}, 0.5}
  local camera = shapes.prism {shapes.outline {{-31, 38}, {-2, 38}, {-2, 68}, {-31, 68}, rounding = 7, segments = 4},
                               1.2,
                               chamfer = 0.3}
  return {{shapes.move(shell, {0, 0, 1.2}), color = {0.24, 0.26, 0.30}},
          {shapes.move(screen, {0, 0, 8.5}), color = {0.04, 0.05, 0.07}},
          {shapes.move(camera, {0, 0, 0}), color = {0.18, 0.19, 0.22}}}
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
  {"models/objects/bottle.iv", about = "water bottle, 500 ml, full", material = "plastic", mass = 525,
   parts = bottle()},
  {"models/objects/plate.iv", about = "dinner plate", material = "glass", density = stoneware,
   parts = {{plate(), color = {0.93, 0.92, 0.88}}}},
  {"models/objects/bowl.iv", about = "bowl", material = "glass", density = stoneware,
   parts = {{bowl(), color = {0.85, 0.55, 0.30}}}},
  {"models/objects/book.iv", about = "book, A5", material = "wood", density = paper, parts = book()},
  {"models/objects/phone.iv", about = "phone", material = "glass", mass = 173, parts = phone()},
  {"models/objects/box.iv", about = "box of wood", material = "wood", density = beech,
   parts = {{shapes.move(shapes.box {50, 80, 120}, {0, 0, 60}), color = {0.76, 0.60, 0.40}}}},
  {"models/objects/cube.iv", about = "cube of wood", material = "wood", density = beech,
   parts = {{shapes.move(shapes.box {60, 60, 60}, {0, 0, 30}), color = {0.72, 0.30, 0.24}}}},
  {"models/objects/sphere.iv", about = "ball of wood", material = "wood", density = beech,
   parts = {{shapes.move(shapes.sphere {35}, {0, 0, 35}), color = {0.25, 0.48, 0.70}}}},
  {"models/objects/cylinder.iv", about = "cylinder of wood", material = "wood", density = beech,
   parts = {{shapes.cylinder {30, from = {0, 0, 0}, to = {0, 0, 120}}, color = {0.35, 0.58, 0.36}}}},
}
