-- scripts/models/dlr.lua
--- A four-fingered hand modeled on the DLR Hand II: see models/hands/dlr/README.md for the dimensions.
local shapes = require "clench.shapes"
local build = require "models.build"
local eigengrasps = require "models.eigengrasps"
local sites = require "models.sites"

local silver, steel, black, rubber = {0.70, 0.72, 0.74}, {0.38, 0.40, 0.42}, {0.12, 0.125, 0.13}, {0.15, 0.15, 0.16}

-- positions of the fingers on the palm: see the chains of dlr.cfg
local fingers = {{x = -40, y = 128, turn = 6}, {x = 0, y = 133, turn = 0}, {x = 40, y = 128, turn = -6}}
local finger_height, thumb = -6, {30, 24, 30}

--- from the knuckle (x = -75) to the middle joint (x = 0)
local function proximal()
  local body = build.spine {
    {x = -66, y = 0, h = 17, w = 18, r = 5}, {x = -61, y = -0.3, h = 22, w = 23, r = 6.5},
    {x = -53, y = -0.8, h = 24, w = 24, r = 7}, {x = -36, y = -0.8, h = 22.5, w = 22.5, r = 7},
    {x = -18, y = -0.4, h = 19.5, w = 20.5, r = 6}, {x = -12.5, y = -0.2, h = 16, w = 18, r = 5},
  }
  local cover = build.spine {
    {x = -54, y = -10.4, h = 5, w = 10, r = 2}, {x = -50, y = -11.4, h = 6.4, w = 13, r = 2.6},
    {x = -27, y = -10.4, h = 6, w = 12, r = 2.5}, {x = -22, y = -9.4, h = 4.4, w = 9, r = 1.9},
  }
  local cheeks = build.fork(build.belt({-16, 0}, 8, {0, 0}, 9.4), 6.8, 10, 1)
  return {
    {shapes.move(shapes.sphere {14.2}, {-75, 0, 0}), color = steel},
    {build.drum(-75, 0, 7, -16.4, 16.4, 28), color = black},
    {body, color = silver}, {cover, color = black}, {cheeks, color = silver},
    {build.drum(0, 0, 5, -10.9, 10.9, 20), color = black},
  }
end

--- from the middle joint (x = -40) to the distal joint (x = 0)
local function middle()
  local body = build.spine {
    {x = -31.5, y = -0.2, h = 13, w = 14, r = 4}, {x = -28.5, y = -0.4, h = 17, w = 18.6, r = 5.5},
    {x = -14, y = -0.4, h = 16, w = 17.6, r = 5.5}, {x = -11, y = -0.3, h = 13.4, w = 15.6, r = 4.4},
  }
  local neck = build.plate({{-42, -6.4}, {-27, -6.8}, {-27, 6.2}, {-42, 6.4}}, -6.2, 6.2)
  local cheeks = build.fork(build.belt({-15, 0}, 7, {0, 0}, 8), 6, 8.8, 1)
  return {
    {build.drum(-40, 0, 8.8, -6.4, 6.4, 32), color = steel}, {neck, color = steel}, {body, color = silver},
    {cheeks, color = silver}, {build.drum(0, 0, 4.4, -9.6, 9.6, 20), color = black},
  }
end

--- from the distal joint (x = -31) to the center of the fingertip (x = 0)
local function distal()
  local neck = build.plate({{-32, -5.6}, {-20, -6.2}, {-20, 5.6}, {-32, 5.6}}, -5.4, 5.4)
  local sleeve = build.spine {
    {x = -23, y = -0.3, h = 13, w = 14, r = 4.5}, {x = -20.5, y = -0.3, h = 16.2, w = 17.2, r = 6},
    {x = -13, y = -0.2, h = 16.8, w = 17.4, r = 6.5}, {x = -11.4, y = -0.2, h = 15, w = 15.8, r = 6},
  }
  local tip = shapes.capsule {8.2, top = 9, from = {-11, 0.2, 0}, to = {0, 0, 0}, segments = 36}
  return {
    {build.drum(-31, 0, 7.6, -5.6, 5.6, 28), color = steel}, {neck, color = steel}, {sleeve, color = silver},
    {tip, color = rubber},
  }
end

--- a socket around a knuckle's ball, with the finger along `turn` degrees from +y
local function socket(finger)
  local ring = shapes.lathe {segments = 30, profile = shapes.outline {
    {0, -30}, {16.5, -30, 2}, {16.5, -13, 3}, {17.4, -5, 1.2}, {15, -4, 0.8}, {11, -9}, {0, -9}, segments = 2,
  }}
  local along = shapes.turn(ring, {1, 0, 0}, -math.pi / 2)
  return shapes.move(shapes.turn(along, {0, 0, 1}, math.rad(finger.turn)), {finger.x, finger.y, finger_height})
end

local function palm()
  local shell = shapes.outline {
    {-36, 0, 8}, {51, 0, 14}, {59, 46, 22}, {61, 112, 10}, {14, 117}, {-14, 117}, {-61, 112, 10}, {-50, 46, 30},
    segments = 5,
  }
  local pad = shapes.outline {
    {-31, 18, 6}, {4, 18, 6}, {8, 46, 8}, {42, 56, 8}, {47, 103, 8}, {-48, 103, 8}, {-40, 50, 20}, segments = 4,
  }
  local back = shapes.outline {
    {-27, 20, 10}, {27, 20, 10}, {42, 58, 16}, {44, 102, 10}, {-44, 102, 10}, {-36, 58, 16}, segments = 4,
  }
  -- the thumb is on a post in front of the palm
  local post = shapes.lathe {segments = 30, profile = shapes.outline {
    {0, -40}, {21, -40, 2}, {20, -24, 4}, {16.5, -18, 4}, {17.4, -5, 1.2}, {15, -4, 0.8}, {11, -9}, {0, -9},
    segments = 2,
  }}
  local wrist = shapes.lathe {segments = 40, profile = shapes.outline {
    {0, -34}, {36, -34, 2}, {36, -24, 2}, {28, -22, 1.5}, {26, 8, 4}, {16, 12}, {16, 24}, {0, 24}, segments = 2,
  }}
  local parts = {
    {shapes.move(shapes.prism {shell, 34, rounding = 6, segments = 4}, {0, 0, -28}), color = silver},
    {shapes.move(shapes.prism {pad, 6, rounding = 1.2, segments = 2}, {0, 0, 2}), color = rubber},
    {shapes.move(shapes.prism {back, 6, rounding = 1.5, segments = 2}, {0, 0, -31}), color = black},
    {shapes.move(post, thumb), color = steel},
    {shapes.move(shapes.turn(wrist, {1, 0, 0}, -math.pi / 2), {0, -5, -11}), color = steel},
  }
  for _, finger in ipairs(fingers) do parts[#parts + 1] = {socket(finger), color = steel} end
  return parts
end

-- the published weight of the complete hand, 1800 g, distributed by volume
local bodies = {
  {"models/hands/dlr/iv/palm.iv", about = "palm and wrist of a four-fingered hand",
   material = "rubber", mass = 880, parts = palm()},
  {"models/hands/dlr/iv/proximal.iv", about = "proximal link of a four-fingered hand",
   material = "metal", mass = 150, parts = proximal()},
  {"models/hands/dlr/iv/middle.iv", about = "middle link of a four-fingered hand",
   material = "metal", mass = 40, parts = middle()},
  {"models/hands/dlr/iv/distal.iv", about = "fingertip of a four-fingered hand",
   material = "rubber", mass = 40, parts = distal()},
}

--- one site on each proximal and middle link, one on each fingertip's pad, two on the palm
local function places()
  local list = {}
  for finger = 0, 3 do
    for link, x in ipairs {-38, -20, -2} do
      list[#list + 1] = {finger = finger, link = link - 1, body = bodies[link + 1], at = {x, 0, 0}}
    end
  end
  for _, at in ipairs {{-16, 62, 0}, {16, 84, 0}} do
    list[#list + 1] = {finger = -1, link = 0, body = bodies[1], at = at, along = {0, 0, 1}}
  end
  return list
end

-- all fingers close; bases against middle joints; the outer fingers spread
local motions = eigengrasps {
  origin = {10, 0, 40, 15, 8, 45, 15, 0, 45, 15, -8, 45},
  {0.8, 0, 0.8, 1, 0, 1, 1, 0, 1, 1, 0, 1}, {-0.8, 0, 0.8, -1, 0, 1, -1, 0, 1, -1, 0, 1},
  {0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1, 0},
}

return {
  bodies[1], bodies[2], bodies[3], bodies[4],
  {"models/hands/dlr/dlr.egr", text = motions},
  {"models/hands/dlr/dlr.vgr", text = sites("dlr", places())},
}
