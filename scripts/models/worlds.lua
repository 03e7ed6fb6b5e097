-- scripts/models/worlds.lua
--- Worlds as text files (.wld): robots, bodies and their poses [mm, rad]. See worlds/README.md for a description of each.
local robot = require "models.robot"
local vector = require "clench.shapes.vector"

local function row(numbers)
  local out = {}
  for i, x in ipairs(numbers) do
    local text = ("%.9f"):format(x):gsub("0+$", ""):gsub("%.$", "")
    out[i] = text == "-0" and "0" or text
  end
  return table.concat(out, " ")
end

local function pose(at, turn) return ("T (%s)[%s]"):format(row(turn or {1, 0, 0, 0}), row(at)) end

local function obstacle(name, material, at, turn)
  return table.concat({"Obstacle", ("models/obstacles/%s.iv"):format(name), material, pose(at, turn)}, "\n")
end

local function object(name, at, turn)
  return table.concat({"GraspableBody", ("models/objects/%s.iv"):format(name), pose(at, turn)}, "\n")
end

--- state: one number per DOF; that of a breakaway DOF is followed by 0 for each of its joints
local function a_robot(path, state, at, turn)
  return table.concat({"Robot", "models/" .. path .. ".cfg", row(state), pose(at, turn)}, "\n")
end

local function connection(parent, child, at, turn)
  return table.concat({"Connection", parent .. " 0 " .. child, "", pose(at, turn)}, "\n")
end

--- a camera that looks from `eye` at `target` with z up
local function camera(eye, target)
  local back = vector.sub(eye, target)
  local z = vector.unit(back)
  local x = vector.unit(vector.cross({0, 0, 1}, z))
  local q = robot.quaternion(x, vector.cross(z, x), z)
  return "CameraFull\n" .. row {eye[1], eye[2], eye[3], q[2], q[3], q[4], q[1], vector.norm(back)}
end

local function world(name, blocks)
  return {"worlds/" .. name .. ".wld", text = "#GraspIt! version 2.0\n" .. table.concat(blocks, "\n\n") .. "\n"}
end

local function zeros(count, others)
  local list = {}
  for i = 1, count do list[i] = others and others[i] or 0 end
  return list
end

local half = math.sqrt(0.5)
local down, upright = {0, 1, 0, 0}, {half, half, 0, 0}
-- the palm looks along +x with its fingers towards -y; the same for a gripper
local sideways, forward = {0, half, 0, half}, {0.5, 0.5, 0.5, 0.5}

-- the tall hands are at the back, palms to the front, and the grippers in front of them; each 1 mm above the floor
local function gallery()
  local blocks = {obstacle("floor", "stone", {0, 0, -1})}
  local function place(list, y, pitch, turn)
    for i, entry in ipairs(list) do
      local at = {(i - (#list + 1) / 2) * pitch, y, entry.height}
      blocks[#blocks + 1] = a_robot("hands/" .. entry[1], entry[2], at, entry.turn or turn)
    end
  end
  place({
    {"human/human16", zeros(16), height = 46}, {"shadow/shadow", zeros(20), height = 247},
    {"human/human20", zeros(20), height = 46}, {"robonaut/robonaut", zeros(14), height = 66},
    {"dlr/dlr", zeros(12), height = 40},
  }, 180, 260, upright)
  local free = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}
  place({
    {"barrett/barrett", free, height = 118, turn = {half, 0, 0, half}},
    {"three_finger/three_finger", zeros(13), height = 84},
    {"tendon_gripper/tendon_gripper", {0}, height = 74}, {"adaptive_gripper/adaptive_gripper", {0}, height = 0.1},
    {"parallel_jaw/parallel_jaw", {0}, height = 8},
  }, -160, 250, nil)
  blocks[#blocks + 1] = camera({0, -1250, 560}, {0, 40, 130})
  return blocks
end

-- the Puma holds the three-fingered hand next to the glass; wrist and hand are 174.8 mm apart
local puma = {0.277772466, 0.625708328, -3.300412191, 0.309085993, 1.123136761, 3.004243047}
local ur5 = {-1.83401603, -1.391489376, 1.966112735, -0.574623359, 1.307576623, 3.141592654}

return {
  world("human_flask", {
    object("flask", {0, 0, 0}),
    a_robot("hands/human/human20", zeros(20, {[17] = 0.52, [18] = -0.3}), {-60.7138, 88.6327, 64.6091},
            {0.0560226, 0.763129, 0.0667652, 0.640342}),
    camera({420, -330, 330}, {0, 0, 90}),
  }),
  world("shadow_bottle", {
    object("bottle", {0, 0, 0}),
    a_robot("hands/shadow/shadow", zeros(20, {[17] = 0.5, [18] = 1.2, [19] = -0.6}), {-53, 100, 90}, sideways),
    camera({560, -420, 360}, {-10, 30, 100}),
  }),
  world("robonaut_glass", {
    object("glass", {0, 0, 0}), a_robot("hands/robonaut/robonaut", zeros(14, {-0.3}), {-44, 75, 90}, sideways),
    camera({400, -320, 320}, {-10, 20, 75}),
  }),
  world("three_finger_sphere", {
    object("sphere", {0, 0, 0}), a_robot("hands/three_finger/three_finger", zeros(13, {0.15}), {0, 10, 155}, down),
    camera({430, -380, 300}, {0, 0, 90}),
  }),
  world("parallel_jaw_cube", {
    object("cube", {0, 0, 0}), a_robot("hands/parallel_jaw/parallel_jaw", {0}, {0, 0, 150}, down),
    camera({360, -400, 260}, {0, 0, 70}),
  }),
  world("tendon_cylinder", {
    object("cylinder", {0, 0, 0}), a_robot("hands/tendon_gripper/tendon_gripper", {0}, {-60, 0, 60}, forward),
    camera({330, -400, 320}, {-20, 0, 55}),
  }),
  world("barrett_plane", {
    object("plane", {0, 0, 0}), a_robot("hands/barrett/barrett", {0.2, 0.6, 0, 0, 0.6, 0, 0, 0.6, 0, 0},
                                        {-35, 0, 124}, down),
    camera({470, -420, 380}, {0, 0, 60}),
  }),
  world("puma_barrett_glass", {
    obstacle("table", "wood", {0, 0, 0}), object("glass", {0, 0, 450.05}),
    a_robot("arms/puma560/puma560", puma, {-820, 0, 0}),
    a_robot("hands/barrett/barrett", {0, 0.3, 0, 0, 0.3, 0, 0, 0.3, 0, 0}, {-98, 0, 530}, sideways),
    connection(0, 1, {0, 0, 174.8}), camera({800, -1650, 1250}, {-400, 0, 520}),
  }),
  world("ur5_jaw_shelf", {
    obstacle("stand", "metal", {0, -150, 0}), obstacle("shelf", "wood", {0, 650, 0}),
    object("box", {0, 570, 714.05}), object("bottle", {160, 600, 714.05}), object("book", {-180, 640, 390.05}),
    a_robot("arms/ur5/ur5", ur5, {0, -150, 600.5}),
    a_robot("hands/parallel_jaw/parallel_jaw", {0}, {0, 360, 800}, {half, -half, 0, 0}),
    connection(0, 1, {0, 0, 8.2}), camera({1350, -1150, 1300}, {0, 200, 640}),
  }),
  world("gallery", gallery()),
}
