--- Does a grasp hold when it is not met exactly, and against loads? What is asked of a grasp that is called verified.
local give_way = require "clench.plan.give_way"
local share_friction = require "clench.study.motion.share_friction"
local verification = {}

verification.defaults = {displacement = 0.001, force_ratio = 10, min_load = 2, min_slippery_load = 0, min_epsilon = 0.01, lift = 0.1}

verification.too_weak = "too weak against loads"

--- min_slippery_load of grasps that are shaken, too
verification.min_slippery_load_of_shaken = 2

--- the six directions in which the object is displaced and pulled, in the world
verification.directions = {clench.vec3(1, 0, 0), clench.vec3(-1, 0, 0), clench.vec3(0, 1, 0), clench.vec3(0, -1, 0),
                           clench.vec3(0, 0, 1), clench.vec3(0, 0, -1)}

local function moved(pose, way) return clench.pose {xyz = way} * pose end

-- Closes on an object that lies free: while one side alone touches it, it gives way by half of what is left on the other.
local function close_on_free(hand, object, way, options)
  local grasp
  for _ = 1, 3 do
    hand:autograsp()
    grasp = clench.grasp(hand, object, options)
    if #grasp.points == 0 or grasp:quality "epsilon" > 0 then break end
    local push = clench.vec3(0, 0, 0)
    for _, contact in ipairs(hand.world:contacts(hand, object)) do push = push + contact.normal end
    -- nor does it give way where it was displaced into what it stands on
    if push:norm() < 0.5 or hand.world:collides(object) then break end
    push = push / push:norm()
    local X_WO = object.pose
    local move = object:move_to(moved(X_WO, push * way))
    object.pose = move.touched and moved(X_WO, push * (move.fraction * way / 2)) or X_WO
    if not move.touched then break end
  end
  return grasp
end

-- Jaws that one motor closes draw what lies free between them, and turn it.
local function close_around_free(hand, object, dofs, options)
  local X_WH, X_WO = hand.pose, object.pose
  local after = give_way.turn(hand, object, X_WH, dofs)
  hand:set_posture(X_WH, dofs)
  if after then
    object.pose = X_WH * after:inverse() * X_WO
    if hand.world:collides(object) then object.pose = X_WO end
  end
  hand:autograsp()
  return clench.grasp(hand, object, options)
end

--- The least epsilon when the hand closes again on the object displaced along each axis of the world, from the pose of
--- the grasp and the DOFs before it closed; 0 where something is in the way. An object that one side alone touches gives
--- way; between jaws that one motor closes it turns as well. Looks no further once it is not above `enough`.
function verification.perturbed_epsilon(hand, object, grasp, displacement, enough, options)
  local world = hand.world
  local here <close> = world:snapshot()
  local X_WH, dofs, X_WO = object.pose * grasp.pose, grasp.pregrasp.dofs, object.pose
  local least, jaws = math.huge, give_way.are_jaws(hand)
  for _, direction in ipairs(verification.directions) do
    object.pose = moved(X_WO, direction * displacement)
    hand:set_posture(X_WH, dofs)
    local epsilon = 0
    if hand.world:collides(hand) then
      -- the object is met earlier: the hand stays back by as much as it was displaced
      hand:set_posture(moved(X_WH, hand.approach.direction * (-2 * displacement)), dofs)
    end
    if not world:collides(hand) then
      local stands = hand.pose
      local again = close_on_free(hand, object, 4 * displacement, options)
      if jaws and (#again.points == 0 or again:quality "epsilon" <= enough) then
        object.pose = moved(X_WO, direction * displacement)
        hand:set_posture(stands, dofs)
        again = close_around_free(hand, object, dofs, options)
      end
      epsilon = #again.points > 0 and again:quality "epsilon" or 0
    end
    least = math.min(least, epsilon)
    if least <= enough then break end
  end
  world:restore(here)
  return math.max(least, 0)
end

--- How many times the object's weight the hand holds in the worst of six directions, its motors within their limits and
--- all normal forces together at most `force_ratio` weights.
function verification.load(object, grasp, force_ratio)
  local weight = 9.81 * object.mass
  local least = math.huge
  for _, d in ipairs(verification.directions) do
    local result = grasp:max_load {direction = {d.x * weight, d.y * weight, d.z * weight, 0, 0, 0},
                                   max_total_force = force_ratio * weight, torque_limits = true}
    local load = (result.status == "optimal" or result.status == "unlimited") and result.load or 0
    least = math.min(least, load)
    if least <= 0 then break end
  end
  return math.max(least, 0)
end

--- The same with half of the friction between hand and object.
function verification.slippery_load(hand, object, force_ratio, options)
  local world = hand.world
  local here <close> = world:snapshot()
  share_friction(hand, object, 0.5)
  local load = verification.load(object, clench.grasp(hand, object, options), force_ratio)
  world:restore(here)
  return load
end

--- Do hand and object stay clear of everything else while they are lifted together?
function verification.can_be_lifted(hand, object, height)
  local world = hand.world
  local here <close> = world:snapshot()
  local X_WH, X_WO = hand.pose, object.pose
  local steps, free = math.max(1, math.ceil(height / 0.004)), true
  world:set_collision(false, hand, object)
  for i = 1, steps do
    local up = clench.pose {xyz = {0, 0, height * i / steps}}
    hand.pose, object.pose = up * X_WH, up * X_WO
    -- the first steps leave what the object stands on
    if world:collides(hand) or i > 1 and world:collides(object) then free = false break end
  end
  world:restore(here)
  return free
end

--- Is the object held when its weight pulls it along each axis of the world in turn, by a hand that presses with force_ratio weights?
--- See study.shake.
---@return integer held  in how many of the six directions
---@return boolean survived
function verification.shake(hand, object, shake, force_ratio)
  local weight = 9.81 * object.mass
  local options = {hand = hand, object = object, mass = object.mass, force = weight, grip_force = force_ratio * weight}
  for key, value in pairs(shake) do options[key] = value end
  local verdict = clench.study.shake(options)
  return verdict.held, verdict.survived
end

---@param hand robot  as it holds the object
---@param options {displacement: number, min_epsilon: number, force_ratio: number, min_load: number, min_slippery_load: number, lift: number, grasp?: table, shake?: table, keep_lost?: boolean}
---@return table? numbers, string? why, number? load  in weights, where that is too small; numbers: perturbed_epsilon, load_margin; directions_held and survived (1 or 0) of those that were shaken
function verification.check(hand, object, grasp, options)
  if not grasp.collision_free then return nil, "in collision when closed" end
  if grasp.epsilon < options.min_epsilon then return nil, "epsilon too small" end
  local load = verification.load(object, grasp, options.force_ratio)
  if load < options.min_load then return nil, verification.too_weak, load end
  if options.min_slippery_load > 0 and verification.slippery_load(hand, object, options.force_ratio, options.grasp) < options.min_slippery_load then
    return nil, "too weak with half of the friction"
  end
  if options.lift > 0 and not verification.can_be_lifted(hand, object, options.lift) then
    return nil, "in the way of the lift"
  end
  local epsilon = verification.perturbed_epsilon(hand, object, grasp, options.displacement, options.min_epsilon, options.grasp)
  if epsilon < options.min_epsilon then return nil, "lost when the object is displaced" end
  local numbers = {load_margin = load, perturbed_epsilon = epsilon}
  if options.shake then
    local held, survived = verification.shake(hand, object, options.shake, options.force_ratio)
    if not survived and not options.keep_lost then return nil, "lost when shaken" end
    numbers.directions_held, numbers.survived = held, survived and 1 or 0
  end
  return numbers
end

return verification
