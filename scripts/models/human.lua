-- scripts/models/human.lua
--- A right human hand, palm up: x towards the thumb, y along the middle finger, z out of the palm. See models/hands/human/README.md for the
--- dimensions.
local shapes = require "clench.shapes"
local build = require "models.build"
local robot = require "models.robot"
local eigengrasps = require "models.eigengrasps"
local sites = require "models.sites"

local skin, nail, cuff = {0.82, 0.60, 0.48}, {0.92, 0.76, 0.70}, {0.23, 0.30, 0.40}
local flesh = 1.16e-3
local folder = "models/hands/human/"

-- lengths of the bones as fractions of the hand's length; girth: width at the knuckle [mm]
local hand = 190
local fingers = {
  {name = "index", x = 27, y = 86, turn = -4, girth = 18.2, 0.245 * hand, 0.143 * hand, 0.097 * hand},
  {name = "middle", x = 7.5, y = 87, turn = 0, girth = 18.4, 0.266 * hand, 0.170 * hand, 0.108 * hand},
  {name = "ring", x = -11.5, y = 82, turn = 4, girth = 17.4, 0.244 * hand, 0.165 * hand, 0.107 * hand},
  {name = "little", x = -28.5, y = 73, turn = 9, girth = 15.4, 0.204 * hand, 0.117 * hand, 0.093 * hand},
}
local thumb = {0.251 * hand, 0.196 * hand, 0.158 * hand}
local knuckle_z = -4

local function body(name, about, parts)
  return {folder .. "iv/" .. name .. ".iv", about = about, material = "rubber", density = flesh, parts = parts}
end

local function proximal(finger)
  local l, g = finger[1], finger.girth / 18
  return {{build.limb({
    {x = -l, y = -0.5, h = 20 * g, w = 18 * g}, {x = -0.6 * l, y = 0.8, h = 19.4 * g, w = 17.2 * g},
    {x = -0.28 * l, y = 0.7, h = 17.6 * g, w = 16.6 * g}, {x = 0, h = 16.6 * g, w = 17.4 * g},
  }, {first = 8 * g, last = 6.5 * g}), color = skin}}
end

local function middle(finger)
  local l, g = finger[2], finger.girth / 18
  return {{build.limb({
    {x = -l, h = 16.4 * g, w = 17.2 * g}, {x = -0.5 * l, y = 0.7, h = 16.2 * g, w = 15.8 * g},
    {x = 0, h = 13.6 * g, w = 15.6 * g},
  }, {first = 6.5 * g, last = 5.4 * g}), color = skin}}
end

--- the fingertip ends beyond its bone, with a nail on its back
local function distal(l, w, h)
  local tip = build.limb({
    {x = -l, h = h, w = w}, {x = -0.55 * l, y = 0.6, h = 1.02 * h, w = 0.98 * w},
    {x = -0.18 * l, y = 0.5, h = 0.86 * h, w = 0.9 * w}, {x = 0, y = 0.6, h = 0.6 * h, w = 0.66 * w, lean = 5},
  }, {first = 0.4 * w, last = 0.22 * w})
  local plate = build.limb({
    {x = -0.42 * l, y = -0.43 * h, h = 0.1 * h, w = 0.56 * w, n = 2.6},
    {x = -0.16 * l, y = -0.39 * h, h = 0.14 * h, w = 0.66 * w, n = 2.6, lean = 5},
    {x = 0.1 * l, y = -0.21 * h, h = 0.09 * h, w = 0.5 * w, n = 2.6, lean = 12},
  }, {first = 0.6, last = 0.8, sides = 12, steps = 2})
  return {{tip, color = skin}, {plate, color = nail}}
end

local function metacarpal()
  local l = thumb[1]
  return {{build.limb({
    {x = -l, y = -1, h = 27, w = 30}, {x = -0.6 * l, y = 1.5, h = 31, w = 30}, {x = -0.25 * l, y = 1, h = 25, w = 25},
    {x = 0, h = 20.5, w = 21.5},
  }, {first = 12, last = 8.5, sides = 18}), color = skin}}
end

local function thumb_proximal()
  local l = thumb[2]
  return {{build.limb({
    {x = -l, h = 20.4, w = 21.2}, {x = -0.5 * l, y = 0.5, h = 19, w = 19}, {x = 0, h = 17, w = 19.6},
  }, {first = 8.5, last = 7}), color = skin}}
end

local function palm()
  -- built along x with its face towards y, then turned: x to y, y to z, z to x
  local flat = build.limb({
    {x = -18, y = -3, z = 0, h = 38, w = 56, n = 2.4}, {x = 4, y = -3, z = 1, h = 38, w = 61, n = 2.5},
    {x = 30, y = -4, z = 1, h = 34, w = 76, n = 2.7},
    {x = 56, y = -4, z = 0.5, h = 29, w = 85, n = 2.9, slope = 0.08},
    {x = 78, y = -4, z = -0.5, h = 25, w = 86, n = 3, slope = 0.2},
    {x = 95, y = -4.5, z = -0.5, h = 19, w = 79, n = 3, slope = 0.24},
  }, {last = 6, sides = 28})
  local little_side = build.limb({
    {x = 2, y = 4, z = -18, h = 24, w = 30}, {x = 30, y = 3.5, z = -24, h = 28, w = 36},
    {x = 60, y = 0, z = -27, h = 20, w = 30},
  }, {first = 12, last = 18, sides = 18})
  local thumb_side = build.limb({
    {x = 6, y = 5, z = 15, h = 24, w = 28}, {x = 28, y = 5, z = 20, h = 28, w = 34},
    {x = 52, y = 0, z = 26, h = 20, w = 26},
  }, {first = 10, last = 14, sides = 18})
  local sleeve = build.limb({
    {x = -46, y = -3, h = 45, w = 66, n = 2.3}, {x = -15, y = -3, h = 43, w = 63, n = 2.3},
  }, {steps = 1, sides = 28})
  local parts = {}
  for i, mesh in ipairs {flat, little_side, thumb_side, sleeve} do
    parts[i] = {build.z_to_x(mesh), color = i == 4 and cuff or skin}
  end
  return parts
end

local bodies = {palm = body("palm", "palm and wrist of a human hand", palm())}
local order = {bodies.palm}
local function add(name, about, parts)
  bodies[name] = body(name, about, parts)
  order[#order + 1] = bodies[name]
end
for _, finger in ipairs(fingers) do
  local g = finger.girth / 18
  add(finger.name .. "1", "proximal phalanx of the " .. finger.name .. " finger", proximal(finger))
  add(finger.name .. "2", "middle phalanx of the " .. finger.name .. " finger", middle(finger))
  add(finger.name .. "3", "distal phalanx of the " .. finger.name .. " finger", distal(finger[3], 15.6 * g, 13.6 * g))
end
add("thumb1", "metacarpal and ball of the thumb", metacarpal())
add("thumb2", "proximal phalanx of the thumb", thumb_proximal())
add("thumb3", "distal phalanx of the thumb", distal(thumb[3], 19.6, 15.6))

--- Chains with or without independent distal joints of the fingers; otherwise these turn 2/3 as far as the middle ones.
local function chains(free)
  local list, dof = {}, 0
  local function take()
    dof = dof + 1
    return "d" .. dof - 1
  end
  for _, finger in ipairs(fingers) do
    local a = math.rad(finger.turn)
    local spread, bend, curl = take(), take(), take()
    list[#list + 1] = {
      about = finger.name .. " finger",
      base = {robot.frame({finger.x, finger.y, knuckle_z}, {-math.sin(a), math.cos(a), 0}, {0, 0, 1})},
      joints = {
        {spread, 0, 0, 90, -15, 15}, {bend, 0, finger[1], 0, -10, 90}, {curl, 0, finger[2], 0, 0, 100},
        {free and take() or curl .. "*0.666666667", 0, finger[3], 0, 0, 70},
      },
      links = {{"Universal", finger.name .. "1.iv", 1}, {"Revolute", finger.name .. "2.iv", 2},
               {"Revolute", finger.name .. "3.iv", 3}},
    }
  end
  -- the thumb: about the hand's length from the side of the palm to before it, then in its own plane
  list[#list + 1] = {
    about = "thumb", base = {robot.frame({21, 15, 3}, {1, 0, 0.9}, {-0.25, -1, 0.1})},
    joints = {
      {take(), 0, 0, -90, -45, 30}, {take() .. "+42", 0, thumb[1], 0, -20, 35}, {take(), 0, thumb[2], 0, -10, 55},
      {take(), 0, thumb[3], 0, -10, 80},
    },
    links = {{"Universal", "thumb1.iv", 1}, {"Revolute", "thumb2.iv", 2}, {"Revolute", "thumb3.iv", 3}},
  }
  return list
end

--- spread joints do not close; maximal torques are estimates, from 1.5 N m at a knuckle to 0.3 N m at a fingertip
local function dofs(free)
  local list = {}
  local function motor(speed, effort)
    list[#list + 1] = {speed = speed, effort = effort, kp = 20 * effort, kd = 0.4 * effort, handle = 15}
  end
  for _ = 1, 4 do
    motor(0, 0.8)
    motor(1, 1.5)
    motor(1, 0.8)
    if free then motor(0.66, 0.3) end
  end
  motor(0, 1.5)
  motor(0.5, 1.5)
  motor(0.7, 0.8)
  motor(0.7, 0.5)
  return list
end

-- The six principal components, by joint: spread, bend, curl of each finger; the thumb's opposition, its base,
-- middle and end joints. The first two dominate: all joints close; knuckles against middle joints.
local components = {
  {value = 0.56, spread = {0.1, 0, -0.05, -0.1}, bend = {0.9, 1, 1, 0.9}, curl = {0.45, 0.5, 0.55, 0.5},
   thumb = {0.35, 0.3, 0.2, 0.15}},
  {value = 0.24, spread = {0.1, 0, -0.05, -0.1}, bend = {-0.7, -0.8, -0.75, -0.6}, curl = {1, 1, 1, 0.9},
   thumb = {-0.45, 0.1, 0.3, 0.35}},
  {value = 0.06, spread = {-0.1, 0, 0.1, 0.2}, bend = {-0.25, -0.1, 0.1, 0.25}, curl = {-0.3, -0.1, 0.1, 0.25},
   thumb = {1, 0.2, 0.45, 0.5}},
  {value = 0.04, spread = {0.25, 0, -0.15, -0.3}, bend = {0.9, 0.25, -0.45, -0.8}, curl = {0.5, 0.15, -0.25, -0.5},
   thumb = {0.2, 0, -0.1, -0.2}},
  {value = 0.03, spread = {0.3, 0, -0.2, -0.4}, bend = {0.15, 0, 0, 0.1}, curl = {-0.1, 0, 0, -0.1},
   thumb = {0.1, -0.7, -0.2, 0.3}},
  {value = 0.02, spread = {0.1, 0, 0, 0.1}, bend = {-0.3, 0.4, 0.25, -0.4}, curl = {0.5, -0.4, -0.4, 0.6},
   thumb = {0, -0.1, 0.5, -0.6}},
}
-- their mean posture [degrees]
local mean = {spread = {-4, 0, 2, 4}, bend = {33, 36, 36, 34}, curl = {40, 42, 40, 36}, thumb = {-5, 8, 16, 22}}

local function postures(free)
  local function spread_out(posture)
    local list = {}
    for f = 1, 4 do
      table.move({posture.spread[f], posture.bend[f], posture.curl[f]}, 1, 3, #list + 1, list)
      if free then list[#list + 1] = 2 / 3 * posture.curl[f] end
    end
    return table.move(posture.thumb, 1, 4, #list + 1, list)
  end
  local out = {origin = spread_out(mean)}
  for i, component in ipairs(components) do
    out[i] = spread_out(component)
    out[i].value = component.value
  end
  return eigengrasps(out)
end

-- 18 sites: each phalanx on its pad, and on the palm the ball below the fingers and the two at the wrist
local places = {}
for f, finger in ipairs(fingers) do
  for link, share in ipairs {0.45, 0.45, 0.35} do
    places[#places + 1] = {finger = f - 1, link = link - 1, body = bodies[finger.name .. link],
                           at = {-share * finger[link], 0, 0}}
  end
end
for link, share in ipairs {0.3, 0.45, 0.35} do
  places[#places + 1] = {finger = 4, link = link - 1, body = bodies["thumb" .. link],
                         at = {-share * thumb[link], 0, 0}}
end
for _, at in ipairs {{-26, 34, 0}, {17, 78, -4}, {-16, 74, -4}} do
  places[#places + 1] = {finger = -1, link = 0, body = bodies.palm, at = at, along = {0, 0, 1}}
end

for _, free in ipairs {true, false} do
  local name = free and "human20" or "human16"
  table.move({
    {folder .. name .. ".cfg", text = robot.text {
      about = free and "A human hand, every joint of its fingers free" or
              "A human hand, the end joints of its fingers coupled to the middle ones",
      palm = "palm.iv", dofs = dofs(free), chains = chains(free), approach = {{0, 62, 12}, {0, 0, 1}},
      eigengrasps = name .. ".egr", virtual_contacts = name .. ".vgr",
    }},
    {folder .. name .. ".egr", text = postures(free)},
    {folder .. name .. ".vgr", text = sites(name, places)},
  }, 1, 3, #order + 1, order)
end

return order
