--- Does a grasp hold when it is not met exactly, and against loads? What is asked of a grasp that is called verified.
local closing = require "clench.plan.closing"
local verified = {}

verified.defaults = {displacement = 0.001, force_ratio = 10, min_load = 2, min_epsilon = 0.01, lift = 0.1}

--- the six directions in which the object is displaced and pulled, in the world
verified.directions = {clench.vec3(1, 0, 0), clench.vec3(-1, 0, 0), clench.vec3(0, 1, 0), clench.vec3(0, -1, 0),
                       clench.vec3(0, 0, 1), clench.vec3(0, 0, -1)}

--- The least epsilon when the hand closes again on the object displaced along each axis of the world, from the pose of
--- the grasp and the DOFs before it closed; 0 where something is in the way. Looks no further once it is not above
--- `enough`.
function verified.reclosed(hand, object, grasp, displacement, enough, options)
  local world = hand.world
  local here <close> = world:snapshot()
  local X_WH, dofs, X_WO = object.pose * grasp.pose, grasp.pregrasp.dofs, object.pose
  local least = math.huge
  for _, direction in ipairs(verified.directions) do
    object.pose = clench.pose {xyz = direction * displacement} * X_WO
    hand:set_posture(X_WH, dofs)
    local epsilon = 0
    if hand.world:collides(hand) then
      -- the object is met earlier: the hand stays back by as much as it was displaced
      hand:set_posture(clench.pose {xyz = hand.approach.direction * -2 * displacement} * X_WH, dofs)
    end
    if not world:collides(hand) then
      hand:autograsp()
      local again = clench.grasp(hand, object, options)
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
function verified.load(object, grasp, force_ratio)
  local weight = 9.81 * object.mass
  local least = math.huge
  for _, d in ipairs(verified.directions) do
    local result = grasp:max_load {direction = {d.x * weight, d.y * weight, d.z * weight, 0, 0, 0},
                                   max_total_force = force_ratio * weight, torque_limits = true}
    local load = (result.status == "optimal" or result.status == "unlimited") and result.load or 0
    least = math.min(least, load)
    if least <= 0 then break end
  end
  return math.max(least, 0)
end

--- Do hand and object stay clear of everything else while they are lifted together?
function verified.can_be_lifted(hand, object, height)
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

---@param hand robot  as it holds the object
---@param options {displacement: number, min_epsilon: number, force_ratio: number, min_load: number, lift: number, grasp?: table}
---@return table? numbers, string? why  reclosed_epsilon, load_margin
function verified.check(hand, object, grasp, options)
  if not grasp.collision_free then return nil, "in collision when closed" end
  if grasp.epsilon < options.min_epsilon then return nil, "epsilon too small" end
  local load = verified.load(object, grasp, options.force_ratio)
  if load < options.min_load then return nil, "too weak against loads" end
  if options.lift > 0 and not verified.can_be_lifted(hand, object, options.lift) then
    return nil, "in the way of the lift"
  end
  local epsilon = verified.reclosed(hand, object, grasp, options.displacement, options.min_epsilon, options.grasp)
  if epsilon < options.min_epsilon then return nil, "lost when the object is displaced" end
  return {load_margin = load, reclosed_epsilon = epsilon}
end

return verified
