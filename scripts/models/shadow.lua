-- scripts/models/shadow.lua
--- A right hand modeled on the Shadow Dexterous Hand: x towards the thumb, y along the fingers, z out of the palm, the wrist at the origin. See
--- models/hands/shadow/README.md for the dimensions.
local shapes = require "clench.shapes"
local build = require "models.build"
local robot = require "models.robot"
local eigengrasps = require "models.eigengrasps"
local sites = require "models.sites"

local black, steel, gray = {0.13, 0.135, 0.14}, {0.62, 0.64, 0.66}, {0.30, 0.31, 0.32}
local rubber, blue = {0.52, 0.54, 0.56}, {0.16, 0.30, 0.46}
local folder = "models/hands/shadow/"

-- knuckles [mm] and lengths of the links
local fingers = {
  {name = "first", 33, 95}, {name = "middle", 11, 99}, {name = "ring", -11, 95}, {name = "little", -33, 86.6},
}
local finger = {45, 25, 26}
local thumb = {38, 32, 27.5}
local thumb_base = {34, 29, 8.58}
local half = math.sqrt(0.5)

local function phalanx(o)
  o.shell, o.steel, o.rubber = o.shell or black, steel, rubber
  return build.segment(o)
end

--- a fingertip: a ball of rubber on a short neck, with a nail of steel
local function tip(o)
  local parts = phalanx(o)
  local w, h, l = o.wide[2], o.high[2], o.length
  parts[#parts + 1] = {build.limb({
    {x = -0.62 * l, y = -0.46 * h, h = 0.14 * h, w = 0.6 * w, n = 3},
    {x = -0.2 * l, y = -0.45 * h, h = 0.2 * h, w = 0.7 * w, n = 3},
    {x = 0, y = -0.36 * h, h = 0.2 * h, w = 0.5 * w, n = 3, lean = 8},
  }, {first = 0.8, last = 0.8, steps = 2, sides = 12}), color = steel}
  return parts
end

local function palm()
  local plate = shapes.outline {
    {-27, -8, 4}, {27, -8, 4}, {43, 24, 16}, {45, 78, 8}, {26, 88}, {-6, 88}, {-24, 80}, {-44, 70, 6}, {-41, 26, 18},
    segments = 2,
  }
  local pad = shapes.outline {
    {-30, 14, 8}, {6, 14, 6}, {12, 44, 10}, {37, 58, 6}, {37, 76, 6}, {-36, 70, 6}, {-35, 40, 12}, segments = 2,
  }
  local back = shapes.outline {{-20, 4, 6}, {20, 4, 6}, {34, 34, 12}, {34, 74, 8}, {-34, 64, 8}, {-32, 34, 12},
                               segments = 2}
  local parts = {
    {build.plate(plate, -13, 10, 3), color = black}, {build.plate(pad, 9, 13.5, 1.5), color = blue},
    {build.plate(back, -16, -12, 1.2), color = steel},
  }
  -- the knuckles are on posts between two plates
  for _, f in ipairs(fingers) do
    local y = f[2]
    local post = shapes.outline {{f[1] - 8.4, y - 22}, {f[1] + 8.4, y - 22}, {f[1] + 7.4, y - 2, 4},
                                 {f[1] - 7.4, y - 2, 4}, segments = 2}
    parts[#parts + 1] = {build.plate(post, -9, 8, 0.8), color = gray}
    parts[#parts + 1] = {shapes.cylinder {6.4, from = {f[1], y, -10.5}, to = {f[1], y, 9.5}, chamfer = 0.8,
                                          segments = 12},
                         color = steel}
  end
  -- the thumb's roll axis is halfway between the directions of fingers and side
  local function along(k) return {thumb_base[1] + k * half, thumb_base[2] + k * half, thumb_base[3]} end
  parts[#parts + 1] = {shapes.cylinder {13, from = along(-26), to = along(-11), chamfer = 1.5, segments = 16},
                       color = gray}
  parts[#parts + 1] = {shapes.cylinder {10, from = along(-12), to = along(-6), chamfer = 1, segments = 16},
                       color = steel}
  -- wrist: a fork about its axis, then the forearm with its motors
  local fork = build.fork(build.belt({-34, 0}, 13, {-6, -1}, 12), 20, 26, 1)
  parts[#parts + 1] = {build.z_to_x(shapes.move(fork, {0, -1.5, 0})), color = gray}
  parts[#parts + 1] = {build.z_to_x(build.drum(-34, -1.5, 9, -30, 30, 20)), color = steel}
  parts[#parts + 1] = {build.z_to_x(build.plate({{-62, -15}, {-28, -12}, {-28, 9}, {-62, 12}}, -18, 18, 2)),
                       color = gray}
  local forearm = build.limb({
    {x = -247, y = -1.5, h = 112, w = 124, n = 2.6}, {x = -150, y = -1.5, h = 112, w = 124, n = 2.6},
    {x = -92, y = -1.5, h = 92, w = 104, n = 2.6}, {x = -56, y = -1.5, h = 62, w = 70, n = 2.6},
  }, {sides = 20, last = 4, steps = 2})
  local band = build.limb({{x = -236, y = -1.5, h = 115, w = 127, n = 2.6},
                           {x = -222, y = -1.5, h = 115, w = 127, n = 2.6}},
                          {sides = 20, steps = 1})
  local second = build.limb({{x = -160, y = -1.5, h = 114, w = 126, n = 2.6},
                             {x = -154, y = -1.5, h = 114, w = 126, n = 2.6}},
                            {sides = 20, steps = 1})
  for i, mesh in ipairs {forearm, band, second} do
    parts[#parts + 1] = {build.z_to_x(mesh), color = i == 1 and black or i == 2 and blue or steel}
  end
  return parts
end

local function body(name, about, mass, material, parts)
  return {folder .. "iv/" .. name .. ".iv", about = about, material = material, mass = mass, parts = parts}
end

-- the published weight of hand and forearm, 4.3 kg, distributed to the links by size
local proximal = body("proximal", "proximal link of a finger", 30, "plastic", phalanx {
  length = finger[1], drum = 8.6, grip = 8, wide = {17.4, 16.6}, high = {17.4, 15}, axle = 7.8, inner = 5.2,
  pad = {-35, -12, 2},
})
local middle = body("middle", "middle link of a finger", 17, "plastic", phalanx {
  length = finger[2], drum = 7.4, grip = 5, wide = {16, 15}, high = {14.4, 13.4}, axle = 6.8, inner = 4.6,
  pad = {-18, -8, 2},
})
local distal = body("distal", "fingertip", 12, "rubber", tip {
  length = finger[3], drum = 6.4, grip = 4.4, wide = {14.4, 13.4}, high = {13, 11.6},
})
local thumb1 = body("thumb1", "proximal link of the thumb", 70, "plastic", phalanx {
  length = thumb[1], drum = 10.6, grip = 9.4, wide = {20, 18.6}, high = {20, 17}, axle = 8.6, inner = 6,
  pad = {-26, -12, 2},
})
local thumb2 = body("thumb2", "middle link of the thumb", 30, "plastic", phalanx {
  length = thumb[2], drum = 8.2, grip = 5.8, wide = {18, 17}, high = {16.4, 15}, axle = 7.6, inner = 5.2,
  pad = {-24, -10, 2},
})
local thumb3 = body("thumb3", "fingertip of the thumb", 16, "rubber", tip {
  length = thumb[3], drum = 7.2, grip = 5, wide = {16.4, 15.4}, high = {14.6, 13},
})
local base = body("palm", "palm, wrist and forearm", 3948, "plastic", palm())

local chains, dofs, places = {}, {}, {}
for f, k in ipairs(fingers) do
  local d = 4 * (f - 1)
  chains[f] = {
    about = k.name .. " finger: J4, J3, J2, J1", base = {robot.frame({k[1], k[2], 0}, {0, 1, 0}, {0, 0, 1})},
    joints = {
      {"d" .. d, 0, 0, 90, -20, 20}, {"d" .. d + 1, 0, finger[1], 0, -15, 90}, {"d" .. d + 2, 0, finger[2], 0, 0, 90},
      {"d" .. d + 3, 0, finger[3], 0, 0, 90},
    },
    links = {{"Universal", "proximal.iv", 1}, {"Revolute", "middle.iv", 2}, {"Revolute", "distal.iv", 3}},
  }
  for j, speed in ipairs {0, 1, 0.8, 0.8} do
    dofs[d + j] = {speed = speed, effort = 2, kp = 20, kd = 0.4, handle = 15}
  end
  for link, at in ipairs {{proximal, -22}, {middle, -13}, {distal, -4}} do
    places[#places + 1] = {finger = f - 1, link = link - 1, body = at[1], at = {at[2], 0, 0}}
  end
end
chains[5] = {
  about = "thumb: J5, J4, J2, J1", base = {robot.frame(thumb_base, {0, 0, 1}, {-1, -1, 0})},
  joints = {
    {"d16", 0, 0, 90, -60, 60}, {"d17+-90", 0, thumb[1], -90, 0, 70}, {"d18", 0, thumb[2], 0, -40, 40},
    {"d19", 0, thumb[3], 0, 0, 90},
  },
  links = {{"Universal", "thumb1.iv", 1}, {"Revolute", "thumb2.iv", 2}, {"Revolute", "thumb3.iv", 3}},
}
for j, motor in ipairs {{0, 5}, {0, 3}, {0.5, 2}, {0.8, 1}} do
  dofs[16 + j] = {speed = motor[1], effort = motor[2], kp = 10 * motor[2], kd = 0.2 * motor[2], handle = 15}
end
for link, at in ipairs {{thumb1, -19}, {thumb2, -17}, {thumb3, -4}} do
  places[#places + 1] = {finger = 4, link = link - 1, body = at[1], at = {at[2], 0, 0}}
end
for _, at in ipairs {{-22, 36}, {-20, 62}, {18, 64}} do
  places[#places + 1] = {finger = -1, link = 0, body = base, at = {at[1], at[2], 0}, along = {0, 0, 1}}
end

local function each_finger(spread, others)
  local list = {}
  for f = 1, 4 do table.move({spread[f], others[1], others[2], others[3]}, 1, 4, #list + 1, list) end
  return list
end
local function posture(value, spread, others, opposed)
  local list = table.move(opposed, 1, 4, 17, each_finger(spread, others))
  list.value = value
  return list
end

return {
  base, proximal, middle, distal, thumb1, thumb2, thumb3,
  {folder .. "shadow.cfg", text = robot.text {
    about = "A five-fingered hand after the Shadow Dexterous Hand", class = "Shadow", palm = "palm.iv", dofs = dofs,
    chains = chains,
    approach = {{0, 62, 14}, {0, 0, 1}}, eigengrasps = "shadow.egr", virtual_contacts = "shadow.vgr",
  }},
  {folder .. "shadow.egr", text = eigengrasps {
    origin = posture(nil, {0, 0, 0, 0}, {35, 40, 25}, {20, 45, 5, 20}),
    posture(1, {-0.1, 0, 0, 0.1}, {1, 0.7, 0.4}, {0.3, 0.2, 0.2, 0.3}),
    posture(1, {0, 0, 0, 0}, {-0.8, 1, 0.6}, {-0.2, 0, 0.3, 0.4}),
    posture(1, {0.2, 0.05, -0.05, -0.2}, {0, 0, 0}, {1, 0.8, 0.2, 0.1}),
  }},
  {folder .. "shadow.vgr", text = sites("shadow", places)},
}
