-- scripts/models/grippers.lua
--- Industrial grippers: a parallel jaw, two fingers on linkages, two on springs, and an adaptive one with three fingers. The flange is at z = 0 or
--- below, the fingers point along +z. See the README.md next to each for the dimensions.
local shapes = require "clench.shapes"
local build = require "models.build"
local robot = require "models.robot"
local eigengrasps = require "models.eigengrasps"
local sites = require "models.sites"

local white, black, steel = {0.86, 0.87, 0.88}, {0.15, 0.155, 0.16}, {0.64, 0.66, 0.68}
local gray, rubber, orange = {0.36, 0.37, 0.39}, {0.22, 0.22, 0.23}, {0.80, 0.42, 0.12}

local function body(folder, name, about, mass, material, parts, youngs)
  return {"models/hands/" .. folder .. "/iv/" .. name .. ".iv", about = about, material = material, mass = mass,
          parts = parts, youngs = youngs}
end

local soft_pad = 1.5e6  -- Young's modulus of rubber [Pa]

--- a prism with its outline in x and z, from y = low to y = high
local function slab(outline, low, high, rounding)
  local turned = {}
  for i, p in ipairs(outline) do turned[i] = {p[2], p[1]} end
  return shapes.turn(build.plate(turned, low, high, rounding), {1, 1, 1}, -2 * math.pi / 3)
end

--- a round flange below z = high
local function flange(radius, low, high, color)
  return {shapes.cylinder {radius, from = {0, 0, low}, to = {0, 0, high}, chamfer = 1, segments = 32}, color = color}
end

-- two jaws that slide along x, each 40 mm; the pads' tips are 58 mm in front of the housing
local function parallel_jaw()
  local stroke, reach = 40, 58
  local housing = slab(shapes.outline {{-101, 4, 12}, {101, 4, 12}, {101, 46, 6}, {90, 66, 6}, {-90, 66, 6},
                                       {-101, 46, 6},
                                       segments = 3}, -31, 31, 2.5)
  local palm = body("parallel_jaw", "housing", "housing of a parallel jaw", 600, "plastic", {
    flange(31.5, -8, 5, steel), {housing, color = white},
    {slab(shapes.outline {{-88, 60, 2}, {88, 60, 2}, {88, 66.6, 1}, {-88, 66.6, 1}, segments = 1}, -11, 11, 0.6),
     color = gray},
    {slab({{-34, 20}, {34, 20}, {34, 40}, {-34, 40}}, -31.6, 31.6, 0.4), color = orange},
  })
  -- a jaw: x along the finger, y towards the other jaw; when closed, the pads are a tenth of a millimeter apart
  local jaw = body("parallel_jaw", "jaw", "jaw with a pad", 65, "rubber", {
    {build.plate({{-56.6, -24}, {-42, -24}, {-42, -2}, {-56.6, -2}}, -10, 10, 1), color = steel},
    {build.spine {{x = -43, y = -12, h = 19, w = 19, r = 2}, {x = -30, y = -10, h = 14, w = 19, r = 2},
                  {x = -20, y = -8, h = 11, w = 19, r = 2}, {x = 0, y = -7, h = 9, w = 19, r = 2}}, color = white},
    {shapes.move(shapes.box {20, 4, 17.6, rounding = 0.6, segments = 1}, {-10, -2.05, 0}), color = rubber},
  }, soft_pad)
  local chains, places = {}, {}
  for k, side in ipairs {1, -1} do
    chains[k] = {
      about = k == 1 and "jaw at +x" or "jaw at -x",
      base = {robot.frame({0, 0, 0}, {0, 0, 1}, {-side, 0, 0})},
      joints = {{0, "d0+" .. -stroke, 66.6 + reach, 90, 0, stroke}, slide = true},
      links = {{"Prismatic", "jaw.iv", 0}},
    }
    for _, at in ipairs {{-17, 6}, {-17, -6}, {-3, 6}, {-3, -6}} do
      places[#places + 1] = {finger = k - 1, link = 0, body = jaw, at = {at[1], -2, at[2]}}
    end
  end
  local folder = "models/hands/parallel_jaw/"
  return {
    palm, jaw,
    {folder .. "parallel_jaw.cfg", text = robot.text {
      about = "A parallel jaw: two jaws, one motor", palm = "housing.iv", chains = chains,
      dofs = {{speed = 1, effort = 140, kp = 2000, kd = 40, slides = true}},
      approach = {{0, 0, 66}, {0, 0, 1}}, eigengrasps = "parallel_jaw.egr", virtual_contacts = "parallel_jaw.vgr",
    }},
    {folder .. "parallel_jaw.egr", text = eigengrasps({origin = {0}, {1}}, {true})},
    {folder .. "parallel_jaw.vgr", text = sites("parallel_jaw", places)},
  }
end

--- a finger's phalanx for the adaptive grippers
local function phalanx(o)
  o.shell, o.steel, o.rubber = o.shell or black, steel, rubber
  return build.segment(o)
end

-- two fingers whose pads stay parallel while cranks swing them; one motor
local function adaptive()
  local crank, open, height, reach = 57.1, 48.8, 54.9, 51.2  -- [mm], [degrees]
  local across = 30.6
  local block = slab(shapes.outline {{-38, 10, 6}, {38, 10, 6}, {38, 58}, {24, 75}, {-24, 75}, {-38, 58}, segments = 3}, -14, 14, 2)
  local parts = {flange(37.5, 0, 12, gray), {block, color = black},
                 {slab({{-18, 70}, {18, 70}, {18, 76}, {-18, 76}}, -11, 11, 1), color = rubber}}
  for _, side in ipairs {1, -1} do
    parts[#parts + 1] = {shapes.cylinder {5, from = {side * across, -17, height}, to = {side * across, 17, height}, chamfer = 0.8, segments = 16},
                         color = steel}
  end
  local palm = body("adaptive_gripper", "palm", "housing of a gripper with two fingers", 700, "plastic", parts)
  -- from its joint at x = -crank to the fingertip's at x = 0
  local swing = body("adaptive_gripper", "crank", "crank of a finger", 40, "metal", {
    {build.fork(build.belt({-crank, 0}, 8, {0, 0}, 7, 5), 14.6, 18, 0.6), color = gray},
    {build.drum(0, 0, 4, -18.5, 18.5, 16), color = steel}, {build.drum(-crank, 0, 4, -18.5, 18.5, 16), color = steel},
  })
  -- x along the finger, y towards the other one; when closed, the pads are a quarter of a millimeter apart
  local tip = body("adaptive_gripper", "fingertip", "fingertip with a pad", 45, "rubber", {
    {build.drum(-reach, 0, 7, -13.5, 13.5, 24), color = steel},
    {build.plate(shapes.outline {{-58, -6, 2}, {-46, -7.5, 2}, {-3, 8, 2}, {0, 12, 2}, {0, 19.6, 1}, {-37.5, 19.6, 1}, {-58, 6, 2}, segments = 2},
                 -10, 10, 1), color = black},
    {shapes.move(shapes.box {37.5, 6.9, 22, rounding = 0.6, segments = 1}, {-18.75, 22.45, 0}), color = rubber},
  }, soft_pad)
  local chains, places = {}, {}
  for k, side in ipairs {1, -1} do
    chains[k] = {
      about = k == 1 and "finger at +x" or "finger at -x",
      base = {robot.frame({side * across, 0, height}, {side, 0, 0}, {0, -side, 0})},
      joints = {{"d0+" .. open, 0, crank, 0, 0, 45.8}, {("d0*-1+%g"):format(90 - open), 0, reach, 0, -45.8, 0}},
      links = {{"Revolute", "crank.iv", 0}, {"Revolute", "fingertip.iv", 1}},
    }
    for _, at in ipairs {{-33, 7}, {-33, -7}, {-5, 7}, {-5, -7}} do
      places[#places + 1] = {finger = k - 1, link = 1, body = tip, at = {at[1], 22, at[2]}}
    end
  end
  places[#places + 1] = {finger = -1, link = 0, body = palm, at = {0, 0, 70}, along = {0, 0, 1}}
  local folder = "models/hands/adaptive_gripper/"
  return {
    palm, swing, tip,
    {folder .. "adaptive_gripper.cfg", text = robot.text {
      about = "A gripper of two fingers on linkages, one motor", palm = "palm.iv", chains = chains,
      dofs = {{speed = 1, effort = 23.5, kp = 100, kd = 1}},
      approach = {{0, 0, 76}, {0, 0, 1}}, eigengrasps = "adaptive_gripper.egr",
      virtual_contacts = "adaptive_gripper.vgr",
    }},
    {folder .. "adaptive_gripper.egr", text = eigengrasps {origin = {10}, {1}}},
    {folder .. "adaptive_gripper.vgr", text = sites("adaptive_gripper", places)},
  }
end

-- two fingers of two links on springs, pulled by one tendon
local function tendon()
  local lengths = {62, 44}
  local block = slab(shapes.outline {{-48, -62, 8}, {48, -62, 8}, {48, -16, 4}, {38, -6}, {21, -6}, {14, -14, 4},
                                     {-14, -14, 4},
                                     {-21, -6}, {-38, -6}, {-48, -16, 4}, segments = 3}, -26, 26, 1.6)
  local parts = {flange(31.5, -74, -60, steel), {block, color = orange},
                 {slab({{-13, -20}, {13, -20}, {13, -11}, {-13, -11}}, -22, 22, 1.2), color = rubber},
                 {shapes.cylinder {20, from = {0, -29, -40}, to = {0, 29, -40}, chamfer = 1.5, segments = 28},
                  color = black}}
  for _, side in ipairs {1, -1} do
    for _, y in ipairs {-19, 13} do
      parts[#parts + 1] = {slab(build.belt({side * 29, -14}, 10, {side * 29, 0}, 9, 5), y, y + 6, 0.8),
                           color = orange}
    end
    parts[#parts + 1] = {shapes.cylinder {4.5, from = {side * 29, -20.5, 0}, to = {side * 29, 20.5, 0}, chamfer = 0.8,
                                          segments = 16},
                         color = steel}
  end
  local palm = body("tendon_gripper", "palm", "palm with motor and tendon drum", 420, "plastic", parts)
  local proximal = body("tendon_gripper", "proximal", "proximal link on a spring", 38, "rubber", phalanx {
    length = lengths[1], drum = 8, grip = 12.4, wide = {24, 22}, high = {15, 13}, axle = 7.4, inner = 7.4,
    pad = {-50, -14, 3},
  })
  local distal = body("tendon_gripper", "distal", "distal link on a spring", 22, "rubber", phalanx {
    length = lengths[2], drum = 7, grip = 7, wide = {20, 18}, high = {12.6, 9.4}, pad = {-34, -6, 3},
  })
  local chains, places = {}, {}
  for k, side in ipairs {1, -1} do
    chains[k] = {
      about = k == 1 and "finger at +x" or "finger at -x",
      base = {robot.frame({side * 29, 0, 0}, {side, 0, 0}, {0, -side, 0})},
      -- friction [g mm^2/s], Coulomb friction, spring [N mm/rad], rest [rad]
      joints = {{"d0+75", 0, lengths[1], 0, 0, 75, 5e6, 0, 60, 0},
                {"d0*0.5+15", 0, lengths[2], 0, 0, 75, 5e6, 0, 40, 0}},
      links = {{"Revolute", "proximal.iv", 0}, {"Revolute", "distal.iv", 1}},
    }
    for _, at in ipairs {{proximal, -42}, {proximal, -22}, {distal, -28}, {distal, -10}} do
      places[#places + 1] = {finger = k - 1, link = at[1] == proximal and 0 or 1, body = at[1], at = {at[2], 0, 0}}
    end
  end
  places[#places + 1] = {finger = -1, link = 0, body = palm, at = {0, 0, -15}, along = {0, 0, 1}}
  local folder = "models/hands/tendon_gripper/"
  return {
    palm, proximal, distal,
    {folder .. "tendon_gripper.cfg", text = robot.text {
      about = "Two fingers on springs, one tendon", palm = "palm.iv", chains = chains,
      dofs = {{kind = "c", speed = 1, effort = 1.5, kp = 10, kd = 0.1}},
      approach = {{0, 0, -11}, {0, 0, 1}}, eigengrasps = "tendon_gripper.egr",
      virtual_contacts = "tendon_gripper.vgr",
    }},
    {folder .. "tendon_gripper.egr", text = eigengrasps {origin = {10}, {1}}},
    {folder .. "tendon_gripper.vgr", text = sites("tendon_gripper", places)},
  }
end

-- positions of the fingers of the three-fingered gripper
local base_y, base_x = 38, 36

local function three_finger_palm()
  local shell = shapes.outline {{-62, -34, 16}, {-30, -62, 14}, {30, -62, 14}, {62, -34, 16}, {62, 44, 16},
                                {44, 62, 14}, {-44, 62, 14},
                                {-62, 44, 16}, segments = 2}
  local parts = {
    flange(44, -84, -72, steel), {build.plate(shell, -74, -12, 3), color = black},
    {build.plate(shapes.outline {{-46, -40, 12}, {46, -40, 12}, {46, 30, 12}, {-46, 30, 12}, segments = 2}, -14, -6,
                 2), color = rubber},
    {build.plate(shapes.outline {{-63, -20, 3}, {63, -20, 3}, {63, 30, 3}, {-63, 30, 3}, segments = 1}, -56, -40, 2),
     color = gray},
  }
  for _, x in ipairs {-base_x, base_x} do
    parts[#parts + 1] = {shapes.cylinder {15, from = {x, base_y, -16}, to = {x, base_y, -11}, chamfer = 0.8,
                                          segments = 24}, color = steel}
  end
  -- the third finger's fork, fixed
  local cheeks = build.z_to_x(build.fork(build.belt({-base_y, 0}, 9, {-base_y - 2, -22}, 12, 5), 9, 14, 0.8))
  parts[#parts + 1] = {cheeks, color = black}
  parts[#parts + 1] = {build.z_to_x(build.drum(-base_y, 0, 4.5, -15, 15, 16)), color = steel}
  return body("three_finger", "palm", "palm and housing of a three-fingered gripper", 1700, "rubber", parts)
end

-- three fingers of three links that yield one after the other; two of them turn on the palm
local function three_finger()
  local lengths, palm = {57, 39, 36}, three_finger_palm()

  -- turns about y at x = 0 and carries the knuckle in the frame's origin
  local turntable = body("three_finger", "turntable", "turning base of a finger", 50, "metal", {
    {shapes.cylinder {13.4, from = {0, -11.5, 0}, to = {0, -7, 0}, chamfer = 0.8, segments = 24}, color = gray},
    {build.fork(build.belt({0, -5}, 10, {0, 0}, 9, 5), 9, 13, 0.8), color = black},
    {build.drum(0, 0, 4.5, -14, 14, 16), color = steel},
  })
  local proximal = body("three_finger", "proximal", "proximal link of a finger", 75, "rubber", phalanx {
    length = lengths[1], drum = 8.4, grip = 8.6, wide = {26, 24}, high = {20, 18}, axle = 9, inner = 8.2,
    pad = {-44, -16, 3},
  })
  local middle = body("three_finger", "middle", "middle link of a finger", 50, "rubber", phalanx {
    length = lengths[2], drum = 8.2, grip = 7.8, wide = {24, 22}, high = {18, 16}, axle = 8, inner = 7,
    pad = {-28, -14, 3},
  })
  local distal = body("three_finger", "distal", "distal link of a finger", 40, "rubber", phalanx {
    length = lengths[3], drum = 7.4, grip = 6.6, wide = {22, 19}, high = {15, 11}, pad = {-27, -4, 3},
  })
  local function joints(dof)
    return {{dof .. "+68", 0, lengths[1], 0, 0, 70}, {dof .. "+12", 0, lengths[2], 0, 0, 90},
            {dof .. "*0.6+10", 0, lengths[3], 0, 0, 60}}
  end
  local chains, places = {}, {}
  for k, side in ipairs {1, -1} do
    local list = joints("d" .. k)
    table.insert(list, 1, {"d0" .. (k == 1 and "" or "*-1"), 0, 0, 90, -16, 16})
    chains[k] = {
      about = k == 1 and "finger at +x" or "finger at -x",
      base = {robot.frame({side * base_x, base_y, 0}, {0, 1, 0}, {0, 0, 1})},
      joints = list,
      links = {{"Revolute", "turntable.iv", 0}, {"Revolute", "proximal.iv", 1}, {"Revolute", "middle.iv", 2},
               {"Revolute", "distal.iv", 3}},
    }
  end
  chains[3] = {
    about = "third finger, which does not turn", base = {robot.frame({0, -base_y, 0}, {0, -1, 0}, {-1, 0, 0})},
    joints = joints "d3",
    links = {{"Revolute", "proximal.iv", 0}, {"Revolute", "middle.iv", 1}, {"Revolute", "distal.iv", 2}},
  }
  for f = 0, 2 do
    for k, at in ipairs {{proximal, -30}, {middle, -21}, {distal, -10}} do
      places[#places + 1] = {finger = f, link = f < 2 and k or k - 1, body = at[1], at = {at[2], 0, 0}}
    end
  end
  for _, at in ipairs {{-26, 0}, {26, 0}, {0, -22}} do
    places[#places + 1] = {finger = -1, link = 0, body = palm, at = {at[1], at[2], -10}, along = {0, 0, 1}}
  end
  local dofs = {{speed = 0, effort = 3, kp = 50, kd = 1}}
  for f = 2, 4 do dofs[f] = {kind = "b", speed = 1, effort = 3, kp = 50, kd = 1, breakaway = 0.4} end
  local folder = "models/hands/three_finger/"
  return {
    palm, turntable, proximal, middle, distal,
    {folder .. "three_finger.cfg", text = robot.text {
      about = "An adaptive gripper with three fingers", palm = "palm.iv", chains = chains, dofs = dofs,
      approach = {{0, 0, -6}, {0, 0, 1}}, eigengrasps = "three_finger.egr", virtual_contacts = "three_finger.vgr",
    }},
    {folder .. "three_finger.egr", text = eigengrasps {origin = {0, 20, 20, 20}, {0, 1, 1, 1}, {1, 0, 0, 0}}},
    {folder .. "three_finger.vgr", text = sites("three_finger", places)},
  }
end

local all = {}
for _, list in ipairs {parallel_jaw(), adaptive(), tendon(), three_finger()} do table.move(list, 1, #list, #all + 1, all) end
return all
