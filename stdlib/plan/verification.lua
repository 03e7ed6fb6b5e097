--- Verification of grasps: does a grasp resist loads, and does it hold if the object is displaced before the hand closes?
local give_way = require "clench.plan.give_way"
local held_load = require "clench.study.motion.held_load"
local opposition = require "clench.plan.opposition"
local share_friction = require "clench.study.motion.share_friction"
local supports = require "clench.plan.supports"
local verification = {}

verification.defaults = {displacement = 0.001, force_ratio = held_load.force_ratio, min_load = 2, min_slippery_load = 0, min_epsilon = 0.01, lift = 0.1}

verification.too_weak = "too weak against loads"
verification.lost_when_shaken = "lost when shaken"

--- Minimum load that a grasp of two fingers must hold with half of the friction: the weight, since the torsional friction that keeps the object from pivoting
--- is the least certain of all friction.
verification.min_slippery_load_of_two_fingers = 1
verification.too_slippery = "too weak with half of the friction"

--- min_slippery_load of grasps that are also shaken
verification.min_slippery_load_of_shaken = 2

verification.directions = held_load.directions

local function moved(pose, way) return clench.pose {xyz = way} * pose end

-- Moves the object along `way`, as far as its supports permit, by half of the distance at which the hand touches its other side.
-- returns  has the object moved?
local function give(hand, object, home, way, held_up)
  local X_WO = object.pose
  way = held_up:slide(X_WO.position - home.position, way)
  if way:norm() < 1e-9 then return false end
  local move = object:move_to(moved(X_WO, way))
  local is_stopped_by_hand = false
  for _, pair in ipairs(move.stopped_by) do is_stopped_by_hand = is_stopped_by_hand or pair[2].robot == hand end
  object.pose = is_stopped_by_hand and moved(X_WO, way * (move.fraction / 2)) or X_WO
  if is_stopped_by_hand and held_up:entered_by(object) then
    object.pose = X_WO
    return false
  end
  return is_stopped_by_hand
end

-- Closes on an object that is free to move: it yields while the hand touches it on one side only.
-- home  initial pose of the object; reach  maximum displacement in one attempt [m]
local function close_on_free(hand, object, home, reach, held_up, options)
  local grasp
  for _ = 1, 3 do
    hand:autograsp()
    grasp = clench.grasp(hand, object, options)
    if #grasp.points == 0 or grasp:quality "epsilon" > 0 then break end
    local push = clench.vec3(0, 0, 0)
    for _, contact in ipairs(hand.world:contacts(hand, object)) do push = push + contact.normal end
    if push:norm() < 0.5 or not give(hand, object, home, push / push:norm() * reach, held_up) then break end
  end
  return grasp
end

-- Jaws that one motor closes shift and turn an object that is free to move. Here the jaws are shifted and turned instead: the motion relative
-- to the object is the same.
local function close_around_free(hand, object, dofs, options)
  local X_WH = hand.pose
  hand:set_posture(give_way.turn(hand, object, X_WH, dofs) or X_WH, dofs)
  hand:autograsp()
  return clench.grasp(hand, object, options)
end

-- Does the object collide with any body except the hand?
local function is_in_something(hand, object)
  for _, pair in ipairs(hand.world:colliding(object)) do
    if pair[1].robot ~= hand and pair[2].robot ~= hand then return true end
  end
  return false
end

-- Displaces the object relative to the open hand: moves the object if its surroundings permit that, otherwise the hand in the opposite direction.
-- returns  is the hand free of collision there, or a little farther back along its approach?
local function displace(hand, object, at, direction, displacement, held_up)
  local X_WH, X_WO, way = at.hand, at.object, direction * displacement
  object.pose = moved(X_WO, way)
  hand:set_posture(X_WH, at.dofs)
  if not held_up:permit(direction) or is_in_something(hand, object) then
    object.pose, X_WH = X_WO, moved(X_WH, -way)
    hand:set_posture(X_WH, at.dofs)
  end
  if hand.world:collides(hand) then
    -- the hand touches the object earlier: it stays back by twice the displacement
    hand:set_posture(moved(X_WH, hand.approach.direction * (-2 * displacement)), at.dofs)
  end
  return not hand.world:collides(hand)
end

--- The minimum epsilon when the hand closes again on the object displaced along each axis of the world, from the pose of the grasp and the DOFs before it
--- closed; 0 if the hand collides. Displacements are of the object relative to the hand: if a support of the object blocks its displacement, the hand is moved
--- in the opposite direction. An object that is touched on one side only yields along its supports; jaws that one motor closes also turn about it. Stops as
--- soon as the minimum is at most `enough`.
function verification.perturbed_epsilon(hand, object, grasp, displacement, enough, options)
  local world = hand.world
  local here <close> = world:snapshot()
  local at = {object = object.pose, hand = object.pose * grasp.pose, dofs = grasp.pregrasp.dofs}
  local least, jaws = math.huge, give_way.are_jaws(hand)
  local held_up = supports.of(hand, object)
  held_up:release(object)
  for _, direction in ipairs(verification.directions) do
    local epsilon = 0
    if displace(hand, object, at, direction, displacement, held_up) then
      local X_WH, X_WO = hand.pose, object.pose
      local again = close_on_free(hand, object, at.object, 4 * displacement, held_up, options)
      if jaws and (#again.points == 0 or again:quality "epsilon" <= enough) then
        object.pose = X_WO
        hand:set_posture(X_WH, at.dofs)
        again = close_around_free(hand, object, at.dofs, options)
      end
      epsilon = #again.points > 0 and again:quality "epsilon" or 0
    end
    least = math.min(least, epsilon)
    if least <= enough then break end
  end
  world:restore(here)
  return math.max(least, 0)
end

verification.load = held_load.of

--- The load that the hand holds with half of the friction between hand and object [weights of the object].
function verification.slippery_load(hand, object, force_ratio, options)
  local world = hand.world
  local here <close> = world:snapshot()
  share_friction(hand, object, 0.5)
  local load = verification.load(object, clench.grasp(hand, object, options), force_ratio)
  world:restore(here)
  return load
end

--- Targets of the DOFs at which motors with the gains of the hand press with contact forces in equilibrium, whose normal forces sum to
--- `force_ratio` weights; they may exceed the limits of DOFs. nil if the motors are too weak.
---@return number[]?  [rad or m]
function verification.squeeze(hand, object, grasp, force_ratio)
  local found = grasp:contact_forces {objective = "max_margin", total_force = force_ratio * 9.81 * object.mass, torque_limits = true}
  if found.status ~= "optimal" then return nil end
  local targets, gains = grasp.dofs, hand.gains
  for i, torque in ipairs(found.joint_torques) do
    if gains[i].kp > 0 then targets[i] = targets[i] + torque / gains[i].kp end
  end
  return targets
end

--- Do hand and object stay free of other collisions while they are lifted together?
function verification.can_be_lifted(hand, object, height)
  local world = hand.world
  local here <close> = world:snapshot()
  local X_WH, X_WO = hand.pose, object.pose
  local steps, free = math.max(1, math.ceil(height / 0.004)), true
  world:set_collision(false, hand, object)
  for i = 1, steps do
    local up = clench.pose {xyz = {0, 0, height * i / steps}}
    hand.pose, object.pose = up * X_WH, up * X_WO
    -- the first step separates the object from its supports
    if world:collides(hand) or i > 1 and world:collides(object) then free = false break end
  end
  world:restore(here)
  return free
end

--- Is the object held when its weight pulls it along each axis of the world in turn, by a hand that presses with force_ratio weights? See study.shake.
---@param shake table  options of study.shake
---@return integer held  number of directions, of six
---@return boolean survived
function verification.shake(hand, object, shake, force_ratio)
  local weight = 9.81 * object.mass
  local options = {hand = hand, object = object, mass = object.mass, force = weight, grip_force = force_ratio * weight}
  for key, value in pairs(shake) do options[key] = value end
  local verdict = clench.study.shake(options)
  return verdict.held, verdict.survived
end

--- Can the object pivot about a line between two fingers? If at most two fingers press, only the torsional friction of their patches resists that; a palm stops
--- it in one direction at most. A load margin assumes that all points of a patch act at once, but when the object moves by less than the contact threshold, few
--- of them carry the load, and these are often too near to the line. So grasps of this kind are verified in motion.
function verification.can_pivot(hand, grasp)
  local touching, count = {}, 0
  for _, name in ipairs(grasp.links) do touching[name] = true end
  for _, finger in ipairs(opposition.fingers(hand)) do
    for _, link in ipairs(finger.links) do
      if touching[link.name] then
        count = count + 1
        break
      end
    end
  end
  return count <= 2
end

-- Options of the shaking that a grasp has to pass, or nil; and true if it is required because the object can pivot.
local function shaking_of(hand, grasp, options)
  if options.shake == nil and verification.can_pivot(hand, grasp) then return {until_lost = not options.keep_lost}, true end
  return options.shake or nil, false
end

---@param hand robot  in the state of the grasp
---@param options {displacement: number, min_epsilon: number, force_ratio: number, min_load: number, min_slippery_load: number, lift: number, grasp?: table, shake?: table|false, keep_lost?: boolean}  shake: nil: grasps that can pivot are shaken
---@return table? numbers, string? why, number? load  load: in weights, if it is too small; numbers: perturbed_epsilon, load_margin; for shaken grasps also directions_held and survived (1 or 0)
function verification.check(hand, object, grasp, options)
  if not grasp.collision_free then return nil, "in collision when closed" end
  if grasp.epsilon < options.min_epsilon then return nil, "epsilon too small" end
  local load = verification.load(object, grasp, options.force_ratio)
  if load < options.min_load then return nil, verification.too_weak, load end
  local shaking, may_pivot = shaking_of(hand, grasp, options)
  local min_slippery_load = math.max(options.min_slippery_load, may_pivot and verification.min_slippery_load_of_two_fingers or 0)
  if min_slippery_load > 0 and verification.slippery_load(hand, object, options.force_ratio, options.grasp) < min_slippery_load then
    return nil, verification.too_slippery
  end
  if options.lift > 0 and not verification.can_be_lifted(hand, object, options.lift) then
    return nil, "in collision when lifted"
  end
  local epsilon = verification.perturbed_epsilon(hand, object, grasp, options.displacement, options.min_epsilon, options.grasp)
  if epsilon < options.min_epsilon then return nil, "lost when the object is displaced" end
  grasp.squeeze = verification.squeeze(hand, object, grasp, options.force_ratio)
  local numbers = {load_margin = load, perturbed_epsilon = epsilon}
  if shaking then
    local held, survived = verification.shake(hand, object, shaking, options.force_ratio)
    if not survived and not options.keep_lost then return nil, verification.lost_when_shaken end
    numbers.directions_held, numbers.survived = held, survived and 1 or 0
  end
  return numbers
end

return verification
