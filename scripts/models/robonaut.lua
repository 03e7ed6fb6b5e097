-- scripts/models/robonaut.lua
--- A right hand modeled on NASA's Robonaut: x towards the thumb, y along the fingers, z out of the palm, the wrist at the origin. See
--- models/hands/robonaut/README.md for the dimensions.
local shapes = require "clench.shapes"
local build = require "models.build"
local robot = require "models.robot"
local eigengrasps = require "models.eigengrasps"
local sites = require "models.sites"

local silver, bronze, dark, black = {0.72, 0.72, 0.70}, {0.62, 0.50, 0.30}, {0.33, 0.33, 0.34}, {0.16, 0.16, 0.17}
local folder = "models/hands/robonaut/"

-- the table of a finger [mm]: yoke, proximal link, middle link; its fingertip
local yoke_length, finger = 8.0518, {45.72, 26.67, 23}
local thumb = {46, 30}
local knuckle_z = -6
local knuckles = {{27, 90, -4}, {3, 90, 0}}
-- the two outer fingers are on metacarpals that fold about a hinge along y
local hinge = {-9, -8}
local outer = {{side = 13.5, y = 85}, {side = 39, y = 77}}
local thumb_base, thumb_x, thumb_z = {34, 22, 6}, {1, 0, 0.8}, {-0.25, -1, 0.1}

local function link(o)
  o.shell, o.steel, o.rubber = silver, bronze, black
  return build.segment(o)
end

--- about the spread axis (along y at x = -8), with a fork around the knuckle
local function yoke()
  return {
    {shapes.cylinder {5.6, from = {-yoke_length, -8.6, 0}, to = {-yoke_length, 8.6, 0}, chamfer = 0.8, segments = 20},
     color = dark},
    {build.fork(build.belt({-yoke_length, 0}, 6.4, {0, 0}, 7, 5), 6.2, 8.6, 0.6), color = bronze},
    {build.plate({{-yoke_length - 4, -6}, {-yoke_length + 2.4, -6}, {-yoke_length + 2.4, 6}, {-yoke_length - 4, 6}},
                 -8.4, 8.4), color = bronze},
    {build.drum(0, 0, 3.4, -9.6, 9.6, 16), color = dark},
  }
end

--- carries the outer fingers: built in the palm's frame, transformed to the hinge's
local function metacarpal(k)
  local o = outer[k]
  local x = hinge[1] - o.side
  local blade = shapes.outline {{x - 8, 26, 3}, {x + 8, 26, 3}, {x + 8.6, o.y - 9, 2}, {x - 8.6, o.y - 9, 2},
                                segments = 2}
  local arm = k == 1 and {{hinge[1] - 2, 28}, {x + 2, 28}, {x + 2, 56}, {hinge[1] - 2, 56}} or
              {{hinge[1], 8}, {x - 7, 8}, {x - 7, 40}, {x + 6, 40}, {x + 6, 20}, {hinge[1], 20}}
  local parts = {
    {build.plate(blade, -15, 5, 2.4), color = silver},
    {build.plate(arm, k == 1 and -13 or -14, k == 1 and -4 or 0, 1.4), color = dark},
    {build.plate({{x - 5, 34}, {x + 5, 34}, {x + 5, o.y - 14}, {x - 5, o.y - 14}}, 4, 7.6, 1), color = black},
    {build.plate({{x - 7, o.y - 12}, {x + 7, o.y - 12}, {x + 6, o.y - 4.6}, {x - 6, o.y - 4.6}}, knuckle_z - 8,
                 knuckle_z + 8), color = bronze},
  }
  for _, part in ipairs(parts) do
    local seen = robot.seen_from(part[1], {hinge[1], o.y, hinge[2]}, {0, 0, 1}, {0, 1, 0})
    -- the frame after the hinge's joint: the former z is now -y
    part[1] = shapes.turn(seen, {1, 0, 0}, math.pi / 2)
  end
  return parts
end

local function palm()
  local plate = shapes.outline {
    {-20, -10, 4}, {26, -10, 4}, {40, 20, 10}, {39, 80, 4}, {-7, 80, 3}, {-7, 24, 3}, {-20, 18, 3}, segments = 2,
  }
  local pad = shapes.outline {{-3, 26, 3}, {20, 26, 8}, {34, 48, 6}, {34, 74, 4}, {-3, 74, 3}, segments = 2}
  local back = shapes.outline {{-2, 18, 4}, {30, 18, 8}, {33, 72, 6}, {-2, 72, 4}, segments = 2}
  local parts = {
    {build.plate(plate, -17, 6, 2.6), color = silver}, {build.plate(pad, 5, 9, 1.2), color = black},
    {build.plate(back, -20, -16, 1.4), color = dark},
    {shapes.cylinder {4, from = {hinge[1], 10, hinge[2]}, to = {hinge[1], 78, hinge[2]}, chamfer = 0.6,
                      segments = 16}, color = bronze},
  }
  for _, k in ipairs(knuckles) do
    parts[#parts + 1] = {build.plate({{k[1] - 7, 76}, {k[1] + 7, 76}, {k[1] + 6, k[2] - 4.6}, {k[1] - 6, k[2] - 4.6}},
                                     knuckle_z - 8, knuckle_z + 8), color = bronze}
  end
  -- the thumb's post, the wrist, the end of the forearm
  parts[#parts + 1] = {shapes.capsule {11, top = 9, from = {22, 16, -4}, to = {31, 20, 2}, segments = 20},
                       color = dark}
  parts[#parts + 1] = {build.z_to_x(build.drum(-14, -5.5, 12, -24, 30, 24)), color = bronze}
  parts[#parts + 1] = {build.z_to_x(build.plate({{-44, -20}, {-14, -15}, {-14, 4}, {-44, 9}}, -18, 24, 2)),
                       color = dark}
  local cuff = shapes.lathe {segments = 32, profile = shapes.outline {
    {0, -66}, {50.8, -66, 2}, {50.8, -46, 3}, {44, -38, 2}, {0, -38}, segments = 2,
  }}
  parts[#parts + 1] = {shapes.move(shapes.turn(cuff, {1, 0, 0}, -math.pi / 2), {3, 0, -5.5}), color = silver}
  return parts
end

local function body(name, about, mass, material, parts)
  return {folder .. "iv/" .. name .. ".iv", about = about, material = material, mass = mass, parts = parts}
end

local base = body("palm", "palm and wrist of a five-fingered hand", 1100, "metal", palm())
local yokes = body("yoke", "knuckle of a finger", 20, "metal", yoke())
local proximal = body("proximal", "proximal link of a finger", 45, "metal", link {
  length = finger[1], drum = 7.4, grip = 5.8, wide = {16, 15}, high = {15.5, 14}, axle = 7.4, inner = 5,
  pad = {-35, -11, 2.4},
})
local middle = body("middle", "middle link of a finger", 25, "metal", link {
  length = finger[2], drum = 7, grip = 4.8, wide = {15, 14.4}, high = {14, 13}, axle = 6.6, inner = 4.4,
  pad = {-19, -9, 2.2},
})
local function from_joint(parts, length)
  for _, part in ipairs(parts) do part[1] = shapes.move(part[1], {length, 0, 0}) end
  return parts
end
local distal = body("distal", "fingertip", 15, "rubber", from_joint(link {
  length = finger[3], drum = 6.2, grip = 4.2, wide = {14, 13.4}, high = {12.6, 11.6},
}, finger[3]))
local inner_metacarpal = body("metacarpal1", "metacarpal of the ring finger", 60, "metal", metacarpal(1))
local outer_metacarpal = body("metacarpal2", "metacarpal of the little finger", 60, "metal", metacarpal(2))
local thumb1 = body("thumb1", "proximal link of the thumb", 70, "metal", link {
  length = thumb[1], drum = 10.4, grip = 9.6, wide = {19, 17}, high = {19, 16}, axle = 8.2, inner = 5.6,
  pad = {-32, -12, 2.4},
})
local thumb2 = body("thumb2", "fingertip of the thumb", 25, "rubber", link {
  length = thumb[2], drum = 7.8, grip = 5.4, wide = {16, 15.4}, high = {14.6, 13},
})

local chains, places = {}, {}
local function finger_sites(number, first)
  for k, at in ipairs {{proximal, -23}, {middle, -14}, {distal, 17}} do
    places[#places + 1] = {finger = number, link = first + k - 1, body = at[1], at = {at[2], 0, 0}}
  end
end
chains[1] = {
  about = "thumb", base = {robot.frame(thumb_base, thumb_x, thumb_z)},
  joints = {{"d0", 0, 0, -90, -50, 30}, {"d1+38", 0, thumb[1], 0, -20, 45}, {"d2", 0, thumb[2], 0, 0, 80}},
  links = {{"Universal", "thumb1.iv", 1}, {"Revolute", "thumb2.iv", 2}},
}
for k, at in ipairs {{thumb1, -22}, {thumb2, -5}} do
  places[#places + 1] = {finger = 0, link = k - 1, body = at[1], at = {at[2], 0, 0}}
end
for f, k in ipairs(knuckles) do
  local d, turn = 3 * f, math.rad(k[3])
  chains[#chains + 1] = {
    about = f == 1 and "index finger" or "middle finger",
    base = {robot.frame({k[1], k[2], knuckle_z}, {-math.sin(turn), math.cos(turn), 0}, {0, 0, 1})},
    joints = {
      {"d" .. d, 0, yoke_length, 90, -20, 10}, {"d" .. d + 1 .. "+-5.9", 0, finger[1], 0, -10, 85},
      {"d" .. d + 2, 0, finger[2], 0, 0, 85}, {"d" .. d + 2 .. "+5.9", 0, 0, 0, 0, 85},
    },
    links = {{"Revolute", "yoke.iv", 0}, {"Revolute", "proximal.iv", 1}, {"Revolute", "middle.iv", 2},
             {"Revolute", "distal.iv", 3}},
  }
  finger_sites(f, 1)
end
for k, o in ipairs(outer) do
  local d = 8 + 2 * k
  chains[#chains + 1] = {
    about = k == 1 and "ring finger" or "little finger",
    base = {robot.frame({hinge[1], 0, hinge[2]}, {0, 0, 1}, {0, 1, 0})},
    joints = {
      {k == 1 and "d9*0.5" or "d9", o.y, 0, -90, 0, 30}, {"d" .. d .. "+-95.9", -o.side, finger[1], 0, 0, 85},
      {"d" .. d + 1, 0, finger[2], 0, 0, 85}, {"d" .. d + 1 .. "+5.9", 0, 0, 0, 0, 85},
    },
    links = {{"Revolute", "metacarpal" .. k .. ".iv", 0}, {"Revolute", "proximal.iv", 1},
             {"Revolute", "middle.iv", 2},
             {"Revolute", "distal.iv", 3}},
  }
  finger_sites(k + 2, 1)
end
for _, at in ipairs {{14, 64}, {14, 38}} do
  places[#places + 1] = {finger = -1, link = 0, body = base, at = {at[1], at[2], 0}, along = {0, 0, 1}}
end

local dofs = {}
for d, speed in ipairs {0, 0.6, 0.8, 0, 1, 1, 0, 1, 1, 0.4, 1, 1, 1, 1} do
  dofs[d] = {speed = speed, effort = 5, kp = 10, kd = 0.1, handle = 10}
end

return {
  base, yokes, proximal, middle, distal, inner_metacarpal, outer_metacarpal, thumb1, thumb2,
  {folder .. "robonaut.cfg", text = robot.text {
    about = "A five-fingered hand after the Robonaut hand", class = "Robonaut", palm = "palm.iv", dofs = dofs,
    chains = chains,
    approach = {{8, 60, 10}, {0, 0, 1}}, eigengrasps = "robonaut.egr", virtual_contacts = "robonaut.vgr",
  }},
  {folder .. "robonaut.egr", text = eigengrasps {
    origin = {0, 10, 25, 0, 35, 35, 0, 35, 35, 12, 35, 35, 35, 35},
    {0.2, 0.4, 0.4, 0, 1, 0.8, 0, 1, 0.8, 0.3, 1, 0.8, 1, 0.8},
    {-0.2, 0.2, 0.3, 0, -0.8, 1, 0, -0.8, 1, -0.2, -0.8, 1, -0.8, 1},
    {1, 0.2, 0.2, 0.2, 0, 0, -0.2, 0, 0, 0.3, 0, 0, 0, 0},
  }},
  {folder .. "robonaut.vgr", text = sites("robonaut", places)},
}
