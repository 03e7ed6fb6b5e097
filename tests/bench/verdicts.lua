-- Grasps of URDF hands on scans, their verdicts by study.shake, and all data that another engine needs to judge them again, as JSON: one file per
-- pair.
-- clench run tests/bench/verdicts.lua FOLDER KIND [COUNT [SEED]]
--   KIND   "random", force closure from random approaches; "planned", by plan.sample; "verified", by plan.sample with shake; "brief", two grasps of a
--          shipped hand on the shipped cube
--   COUNT  number per pair
--   SEED   of the tested approaches
package.path = "tests/bench/?.lua;" .. package.path
local clench = require "clench"
local describe = require "verdicts.describe"

local folder, kind, count, seed = ...
count, seed = math.tointeger(tonumber(count)) or 15, math.tointeger(tonumber(seed)) or 3
local data = (os.getenv "CLENCH_SHARED" or "../shared") .. "/data/"
local hands = {allegro = "allegro_hand/allegro_hand_right", leap = "leap_hand/leap_hand_right", shadow = "shadow_hand/shadow_hand_right",
               barrett = "barrett_hand/bhand_model"}
local objects = {apple = "013_apple", can = "005_tomato_soup_can", mustard = "006_mustard_bottle", banana = "011_banana"}
local mass, mu, weights, min_epsilon = 0.1, 0.6, 10, 0.01

-- DOF values at which the hand is described: as close to 0 as possible
local function zero(hand)
  local values = {}
  for i, limits in ipairs(hand.dof_limits) do values[i] = math.max(limits[1], math.min(limits[2], 0)) end
  hand:set_dofs(values)
end

local function make(hand_name, object_name)
  local world = clench.world()
  local hand = world:add_robot(kind == "brief" and "models/hands/parallel_jaw/parallel_jaw.cfg" or data .. "hands-urdf/" .. hands[hand_name] .. ".urdf")
  zero(hand)
  local out = {hand_name = hand_name, object_name = object_name, mu = mu, force = mass * 9.81, hand = describe.hand(hand)}
  hand:open()
  local object = world:add_object(kind == "brief" and "models/objects/cube.iv" or data .. "ycb/" .. objects[object_name] .. ".obj", {mass = mass, pose = clench.pose {xyz = {2, 0, 0}}})
  out.object = describe.body(object)
  for _, body in ipairs(hand.bodies) do world:set_friction(body.material, object.material, {static = mu, kinetic = mu}) end
  return hand, object, out
end

local function find(hand, object)
  local options = {hand = hand, object = object, threads = clench.parallel.cores, seed = seed}
  if kind == "verified" or kind == "planned" then
    options.count, options.seconds, options.verify = count, 25, kind == "verified" and {shake = true} or nil
    local found = {}
    for i, grasp in ipairs(clench.plan.sample(options).grasps) do found[i] = grasp end
    return found
  end
  options.count, options.candidates = 100000, 1000
  local all = {}
  for _, grasp in ipairs(clench.plan.random(options).grasps) do
    if grasp.epsilon > min_epsilon then all[#all + 1] = grasp end
  end
  -- a random subset, not the best grasps
  local random = clench.random(seed + 4)
  for i = #all, 2, -1 do
    local j = random:integer(1, i)
    all[i], all[j] = all[j], all[i]
  end
  return table.move(all, 1, math.min(count, #all), 1, {})
end

-- the other engines move each joint separately: the joints of a DOF share its torque
local function judge(grasp, shared)
  local clench = require "clench"
  local hand, object = shared.hand, shared.object
  local placed = grasp:apply(hand.world, {hand = hand, object = object})
  local weight = 9.81 * object.mass
  local forces = placed:contact_forces {objective = "max_margin", total_force = shared.weights * weight}
  local verdict = clench.study.shake {hand = hand, object = object, force = weight, mass = object.mass, grip_force = shared.weights * weight}
  local torques = forces.joint_torques
  for i, dof in ipairs(torques and shared.dofs or {}) do torques[i] = torques[i] / dof.joints end
  return {pose = grasp.pose, dofs = hand.dofs, torques = torques, epsilon = placed.epsilon,
          load = require "clench.plan.verification".load(object, placed, shared.weights), held = verdict.held, survived = verdict.survived}
end

if kind == "brief" then count = 2 end
for _, object_name in ipairs(kind == "brief" and {"cube"} or {"apple", "can", "mustard", "banana"}) do
  for _, hand_name in ipairs(kind == "brief" and {"parallel_jaw"} or {"allegro", "leap", "shadow", "barrett"}) do
    local hand, object, out = make(hand_name, object_name)
    local grasps = find(hand, object)
    out.grasps = {}
    for _, row in ipairs(clench.parallel.map(judge, grasps, {shared = {hand = hand, object = object, weights = weights, dofs = out.hand.dofs}})) do
      if row.error then error(row.error) end
      row.pose, row.verified = describe.pose(row.pose), kind == "verified"
      out.grasps[#out.grasps + 1] = row
    end
    if #out.grasps > 0 then clench.files.save_text(("%s/%s_%s_%s.json"):format(folder, kind, hand_name, object_name), clench.json.encode(out)) end
    print(("%d grasps of %s on %s"):format(#out.grasps, hand_name, object_name))
  end
end
