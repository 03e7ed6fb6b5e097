-- Displacing the object by 1 mm loses no verified grasp: shown by an independent loop, in a world that no planner has used, from the data of the
-- grasp's line only.
local test, clench = require "test", require "clench"

-- from the pregrasp in a straight line to the grasp of the object at X_WO, or to the first contact; then the hand closes
local function close_from_pregrasp(hand, X_WO, grasp)
  hand:set_posture(X_WO * grasp.pregrasp.pose, grasp.pregrasp.dofs)
  if hand.world:collides(hand) then return false end
  local way = (X_WO * grasp.pose).position - hand.pose.position
  if way:norm() > 0 then hand:approach_object {reach = way:norm()} end
  hand:autograsp()
  return true
end

local function epsilon_of(hand, object)
  local grasp = clench.grasp(hand, object)
  return #grasp.points > 0 and grasp.epsilon or 0
end

-- Jaws of one motor stop when one of them touches: the object is pushed along, in steps that are halved if it is pushed back or would overlap, until
-- both touch. Finally contacts are found within twice the threshold, because the pads are of rubber.
local function push_until_held(hand, object)
  local world, step, last = hand.world, 1e-4, nil
  for _ = 1, 40 do
    if epsilon_of(hand, object) > 0 then return true end
    local push = clench.vec3(0, 0, 0)
    for _, contact in ipairs(world:contacts(hand, object)) do push = push + contact.normal end
    if push:norm() < 0.5 then break end
    push = push / push:norm()
    if last and push:dot(last) < 0 then step = step / 2 end
    last = push
    local X_WO = object.pose
    object.pose = clench.pose {xyz = push * step} * X_WO
    if world:collides(hand) then
      object.pose, step = X_WO, step / 2
    else
      hand:autograsp()
    end
  end
  local threshold = world.contact_threshold
  world.contact_threshold = 2 * threshold
  local held = epsilon_of(hand, object) > 0
  world.contact_threshold = threshold
  return held
end

local function displaced_poses(X_WO, random)
  local poses = {}
  for axis = 1, 3 do
    for _, way in ipairs {-0.001, 0.001} do
      local xyz = {0, 0, 0}
      xyz[axis] = way
      poses[#poses + 1] = clench.pose {xyz = xyz} * X_WO
    end
  end
  -- and two random directions
  for _ = 1, 2 do poses[#poses + 1] = clench.pose {xyz = random:direction() * 0.001} * X_WO end
  return poses
end

local function check_pair(t, hand_path, object_path, is_pushed)
  local function scene()
    local world = clench.world()
    return world, world:add_robot(hand_path), world:add_object(object_path, {pose = {xyz = {0, 0, 2}}})
  end
  local _, planned_hand, planned_object = scene()
  local run = clench.plan.sample {hand = planned_hand, object = planned_object, count = 20, seed = 3, refine = 4}
  t.ok(#run.grasps >= 18, hand_path)
  local world, hand, object = scene()
  local X_WO, random, lost, blocked = object.pose, clench.random(7), 0, 0
  for _, grasp in ipairs(run.grasps) do
    for _, X in ipairs(displaced_poses(X_WO, random)) do
      object.pose = X
      if not close_from_pregrasp(hand, X_WO, grasp) then
        blocked = blocked + 1
      else
        local held
        if is_pushed then held = push_until_held(hand, object) else held = epsilon_of(hand, object) > 0 end
        lost = lost + (held and 0 or 1)
      end
    end
  end
  t.equal({hand_path, lost, blocked}, {hand_path, 0, 0})
end

test("verified grasps of three hands hold the object when it is displaced by 1 mm", function(t)
  check_pair(t, "models/hands/barrett/barrett.cfg", "models/objects/mug.iv")
  check_pair(t, "models/hands/dlr/dlr.cfg", "models/objects/bottle.iv")
  check_pair(t, "models/hands/parallel_jaw/parallel_jaw.cfg", "models/objects/banana.iv", true)
end)
