--- Turns a state into a grasp: places the hand, moves it to the first touch if asked to, closes it, and computes the grasp.
local give_way = require "clench.plan.give_way"
local closing = {}

--- Places the hand in its world.   returns  true if it is free of collision there
function closing.place(hand, object, state)
  hand:set_posture(object.pose * state.pose, state.dofs)
  return not hand.world:collides(hand)
end

-- Grasps of jaws that touch one side only are not computed.
local function measure(hand, object, options, jaws)
  hand:autograsp()
  if jaws and give_way.touches_one_side(hand, object) then return nil, true end
  local grasp = clench.grasp(hand, object, options)
  if #grasp.points == 0 then return nil end
  grasp:quality "epsilon"
  grasp.collision_free = not hand.world:collides(hand)
  return grasp
end

-- Closes at the first touch; while the grasp has no force closure, closes again from one step further back.
local function close_behind(hand, object, dofs, steps, options, jaws)
  local touched, grasp, one_sided = hand.pose, nil, nil
  local back = -hand.approach.direction
  for i = 0, steps.count do
    if i > 0 then
      hand:set_posture(clench.pose {xyz = back * (i * steps.length)} * touched, dofs)
      if hand.world:collides(hand) then break end
    end
    local next_grasp, on_one_side = measure(hand, object, options, jaws)
    one_sided = one_sided or on_one_side
    if next_grasp and (not grasp or next_grasp.epsilon > grasp.epsilon) then grasp = next_grasp end
    if grasp and grasp.epsilon > 0 then break end
  end
  return grasp, one_sided
end

local at_once = {count = 0, length = 0}
local one_side = "only one side touched"

-- as closing.close, without compliance of hand and object
-- returns  the grasp, or the reason for its absence; the pose of the hand in the world where it began to close
local function close_from(hand, object, state, options, jaws)
  if not closing.place(hand, object, state) then return nil, "in collision at the start" end
  if state.reach then
    hand:approach_object {reach = state.reach}
  elseif options.approach then
    local move = hand:approach_object {reach = options.approach}
    if not move.touched then return nil, "the object is out of reach" end
    if (state.retreat or 0) > 0 then
      local back = math.min(state.retreat, move.fraction * options.approach)
      hand.pose = clench.pose {xyz = hand.approach.direction * -back} * hand.pose
    end
  end
  local from = hand.pose
  local grasp, one_sided = close_behind(hand, object, state.dofs, options.back or at_once, options.grasp, jaws)
  if not grasp then return nil, one_sided and one_side or "nothing touched", from end
  grasp.pregrasp = {pose = state.pose, dofs = state.dofs}
  return grasp, nil, from
end

-- the state from which the hand reaches the pose `after` instead of `before`
local function moved(object, state, before, after)
  local X_WO = object.pose
  return {dofs = state.dofs, reach = state.reach, retreat = state.retreat,
          pose = X_WO:inverse() * after * before:inverse() * X_WO * state.pose}
end

--- Closes the hand from a state. If one DOF drives several fingers, the hand shifts, and jaws also turn, until both sides touch; then it closes again from
--- there.
---@param hand robot
---@param object body
---@param state {pose: pose, dofs: number[], reach?: number, retreat?: number}  of the hand in the object; reach: maximum approach travel, without which the hand closes even if nothing touches; retreat: travel back from the first touch [m]
---@param options {approach?: number, back?: {count: integer, length: number}, grasp?: table, turn?: boolean}  approach: maximum travel to the first touch [m]; turn: false: jaws shift only
---@return grasp? grasp, string? why  reason for the absence of a grasp
function closing.close(hand, object, state, options)
  local jaws = give_way.are_jaws(hand)
  local grasp, why, from = close_from(hand, object, state, options, jaws)
  if not give_way.is_coupled(hand) or grasp and grasp.epsilon > 0 or not grasp and why ~= one_side then return grasp, why end
  local give = jaws and options.turn ~= false and give_way.turn or give_way.shift
  local after = give(hand, object, from, state.dofs)
  local again = after and close_from(hand, object, moved(object, state, from, after), options, jaws)
  grasp = again or grasp
  return grasp, not grasp and why or nil
end

--- Adds numbers to the info of a grasp, and the planner to its labels.
function closing.note(grasp, planner, numbers)
  local info = grasp.info
  for name, value in pairs(numbers) do info[name] = value end
  grasp.info = info
  grasp.labels = {planner = planner}
  return grasp
end

return closing
