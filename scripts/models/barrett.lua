-- scripts/models/barrett.lua
--- A three-fingered hand modeled on the BarrettHand BH8-262: see models/hands/barrett/README.md for the dimensions.
local shapes = require "clench.shapes"
local build = require "models.build"
local eigengrasps = require "models.eigengrasps"
local sites = require "models.sites"

local black, gray, metal, rubber = {0.13, 0.14, 0.15}, {0.34, 0.36, 0.38}, {0.74, 0.76, 0.78}, {0.2, 0.2, 0.21}

--- between the knuckle of a finger (x = -70) and its distal joint (x = 0)
local function inner_link()
  local body = build.spine {
    {x = -58.5, y = -1, h = 15, w = 18, r = 3}, {x = -55, y = -1, h = 19, w = 21, r = 4},
    {x = -30, y = -1.2, h = 18, w = 19.5, r = 4}, {x = -11, y = -1, h = 16, w = 18, r = 4},
    {x = -8.5, y = -0.8, h = 13, w = 16, r = 3},
  }
  local neck = build.plate({{-72, -8}, {-52, -8.5}, {-52, 6.5}, {-72, 7}}, -7.2, 7.2)
  local gear = build.spine {{x = -50, y = -10.4, h = 4, w = 11, r = 1.5},
                            {x = -46, y = -11.2, h = 5, w = 13, r = 1.8},
                            {x = -22, y = -10.8, h = 5, w = 12, r = 1.8},
                            {x = -16, y = -9.6, h = 3.4, w = 9, r = 1.2}}
  local cheeks = build.fork(build.belt({-12, -0.8}, 7.4, {0, 0}, 8.6), 6.4, 9)
  return {
    {build.drum(-70, 0, 10.6, -7.4, 7.4), color = gray}, {neck, color = metal}, {body, color = metal},
    {gear, color = black}, {cheeks, color = metal}, {build.drum(0, 0, 4.2, -9.8, 9.8, 20), color = gray},
  }
end

--- from the distal joint (x = -55) to the fingertip, a claw that bends over its pad
local function outer_link()
  local claw = build.spine({
    {x = -50, y = -0.4, h = 13, w = 11, r = 3, lean = 4}, {x = -45, y = -0.9, h = 15.6, w = 14, r = 4, lean = 4},
    {x = -30, y = -1.5, h = 15, w = 14, r = 4.5}, {x = -15, y = -1.1, h = 12.6, w = 13, r = 4.2, lean = -4},
    {x = -6, y = -0.2, h = 10.4, w = 11.6, r = 4, lean = -9}, {x = -1, y = 0.5, h = 8, w = 9.4, r = 3.6, lean = -14},
    {x = 1.7, y = 1.1, h = 4.8, w = 5.6, r = 2.2, lean = -18},
  }, {2.9, 1.4})
  local pad = build.spine {
    {x = -43, y = 5.4, h = 3.4, w = 8, r = 1.2, lean = 4}, {x = -40, y = 5.8, h = 4.4, w = 11, r = 1.6, lean = 3},
    {x = -28, y = 5.4, h = 4.4, w = 11.2, r = 1.6}, {x = -15, y = 4.6, h = 4.2, w = 10.4, r = 1.6, lean = -4},
    {x = -6, y = 4.3, h = 3.8, w = 9, r = 1.5, lean = -9}, {x = -1.6, y = 3.9, h = 2.4, w = 6.6, r = 1, lean = -14},
  }
  return {
    {build.drum(-55, 0, 8, -6, 6), color = gray},
    {build.plate({{-56, -6}, {-44, -7}, {-44, 6}, {-56, 6}}, -5.6, 5.6), color = metal},
    {claw, color = metal}, {pad, color = rubber},
  }
end

--- turns about the spread axis (x = -50) below the palm and carries the knuckle (x = 0) in a fork
local function spread_link()
  -- outlines in x and z, stacked along y, the palm's normal
  local carrier = shapes.prism {build.belt({-50, 0}, 23, {2, 0}, 11.2, 14), 28, rounding = 2, segments = 3}
  return {
    {shapes.move(shapes.turn(carrier, {1, 0, 0}, -math.pi / 2), {0, -42, 0}), color = metal},
    {build.fork(build.belt({0, 0}, 11.4, {0, -26}, 11.4), 7.8, 11.8, 1.2), color = metal},
    {build.drum(0, 0, 5.4, -12.6, 12.6, 20), color = gray},
  }
end

local function palm()
  local plate = shapes.prism {build.belt({-25, 0}, 35, {25, 0}, 35, 16), 12, rounding = 2.5, segments = 3}
  local pad = shapes.prism {build.belt({-23, 0}, 27, {23, 0}, 27, 16), 6, rounding = 1, segments = 2}
  -- the third finger's fork is fixed: outlines in y and z, stacked along x
  local cheeks = build.z_to_x(build.fork(build.belt({-50, -1}, 11.4, {-47, -32}, 13), 7.8, 11.8, 1.2))
  local web = build.z_to_x(build.plate({{-58, -44}, {-18, -44}, {-18, -13.5}, {-58, -13.5}}, -9, 9, 1.5))
  local axle = build.z_to_x(build.drum(-50, -1, 5.4, -12.6, 12.6, 20))
  local housing = shapes.lathe {shapes.outline {
    {0, -118}, {37, -118, 2}, {37, -107, 1.5}, {44.5, -101, 4}, {44.5, -48, 5}, {0, -44}, segments = 4,
  }}
  local band = shapes.lathe {{{40, -92}, {45.2, -92}, {45.6, -91}, {45.6, -80}, {45.2, -79}, {40, -79}}}
  local column = shapes.cylinder {17, from = {0, -26, -46}, to = {0, -26, -6}, segments = 32}
  return {
    {shapes.move(plate, {0, 0, -13.2}), color = metal}, {shapes.move(pad, {0, 0, -6}), color = black},
    {cheeks, color = metal}, {web, color = gray}, {axle, color = gray}, {housing, color = black},
    {band, color = gray}, {column, color = gray},
  }
end

-- the published weight of the complete hand, 1180 g, distributed by volume and thickness of the parts
local bodies = {
  {"models/hands/barrett/iv/palm.iv", about = "palm and motor housing of a three-fingered hand",
   material = "plastic", mass = 690, parts = palm()},
  {"models/hands/barrett/iv/spread.iv", about = "spread link of a three-fingered hand",
   material = "metal", mass = 85, parts = spread_link()},
  {"models/hands/barrett/iv/inner.iv", about = "inner link of a three-fingered hand",
   material = "metal", mass = 65, parts = inner_link()},
  {"models/hands/barrett/iv/outer.iv", about = "outer link of a three-fingered hand",
   material = "rubber", mass = 41, parts = outer_link()},
}

--- two sites on each inner link, three on each outer link, one on the palm
local function places()
  local list = {{finger = -1, link = 0, body = bodies[1], at = {0, 0, -5}, along = {0, 0, 1}}}
  for finger, first in ipairs {1, 1, 0} do
    for _, x in ipairs {-46, -24} do
      list[#list + 1] = {finger = finger - 1, link = first, body = bodies[3], at = {x, 0, 0}}
    end
    for _, x in ipairs {-38, -22, -5} do
      list[#list + 1] = {finger = finger - 1, link = first + 1, body = bodies[4], at = {x, 0, 0}}
    end
  end
  return list
end

return {
  bodies[1], bodies[2], bodies[3], bodies[4],
  {"models/hands/barrett/barrett.egr", text = eigengrasps {origin = {0, 45, 45, 45}, {0, 1, 1, 1}, {1, 0, 0, 0}}},
  {"models/hands/barrett/barrett.vgr", text = sites("barrett", places())},
}
