--- From a state to a grasp: the hand is placed, comes to the first touch where that is asked for, closes, and what it
--- holds is measured.
local closing = {}

--- Places the hand of a world.   returns whether it is free of collision there
function closing.place(hand, object, state)
  hand:set_posture(object.pose * state.pose, state.dofs)
  return not hand.world:collides(hand)
end

local function measure(hand, object, options)
  hand:autograsp()
  local grasp = clench.grasp(hand, object, options)
  if #grasp.points == 0 then return nil end
  grasp:quality "epsilon"
  grasp.collision_free = not hand.world:collides(hand)
  return grasp
end

-- Closes where the hand touched; then, while that holds nothing, again from one step further back, and so on.
local function close_behind(hand, object, dofs, steps, options)
  local touched, grasp = hand.pose, nil
  local back = -hand.approach.direction
  for i = 0, steps.count do
    if i > 0 then
      hand:set_posture(clench.pose {xyz = back * (i * steps.length)} * touched, dofs)
      if hand.world:collides(hand) then break end
    end
    local next_grasp = measure(hand, object, options)
    if next_grasp and (not grasp or next_grasp.epsilon > grasp.epsilon) then grasp = next_grasp end
    if grasp and grasp.epsilon > 0 then break end
  end
  return grasp
end

-- does one DOF close two fingers? then it stops where the first of them touches
local function is_coupled(hand)
  local info, chain_of = hand.dof_info, {}
  for number, chain in ipairs(hand.chains) do
    for _, joint in ipairs(chain.joints) do
      local other = chain_of[joint.dof]
      if other and other ~= number and info[joint.dof].default_velocity ~= 0 then return true end
      chain_of[joint.dof] = number
    end
  end
  return false
end

local max_way, max_centrings = 0.05, 4  -- how far a hand gives way [m], and how often

-- Where one side alone touches, the hand gives way by half of what is left on the other side, and closes again, until it holds.
-- returns  by how much it gave way, in the world [m]; nil: it never held
local function centre(hand, object, options)
  local shift = clench.vec3(0, 0, 0)
  for _ = 1, max_centrings do
    local push = clench.vec3(0, 0, 0)
    for _, contact in ipairs(hand.world:contacts(hand, object)) do push = push + contact.normal end
    local z = hand.approach.direction
    push = push - z * push:dot(z)  -- to the side: what stops the palm is no reason
    if push:norm() < 0.5 then return end
    push = push / push:norm()
    local X_WO = object.pose
    local move = object:move_to(clench.pose {xyz = push * max_way} * X_WO)
    object.pose = X_WO
    if not move.touched then return end
    local step = push * (-move.fraction * max_way / 2)
    hand.pose, shift = clench.pose {xyz = step} * hand.pose, shift + step
    if hand.world:collides(hand) then return end
    local grasp = measure(hand, object, options)
    if grasp and grasp.epsilon > 0 then return shift end
  end
end

local at_once = {count = 0, length = 0}

-- as closing.close, without giving way
local function close_from(hand, object, state, options)
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
  local grasp = close_behind(hand, object, state.dofs, options.back or at_once, options.grasp)
  if not grasp then return nil, "nothing touched" end
  grasp.pregrasp = {pose = state.pose, dofs = state.dofs}
  return grasp
end

--- A hand whose fingers stop together, where the first of them touches, begins again to the side where both do.
---@param hand robot
---@param object body
---@param state {pose: pose, dofs: number[], reach?: number, retreat?: number}  of the hand in the object; reach: how far it goes on where nothing touches; retreat: from the first touch [m]
---@param options {approach?: number, back?: {count: integer, length: number}, grasp?: table}  approach: at most so far, to the first touch [m]
---@return grasp? grasp, string? why  what was in the way
function closing.close(hand, object, state, options)
  local grasp, why = close_from(hand, object, state, options)
  if not grasp or grasp.epsilon > 0 or not is_coupled(hand) then return grasp, why end
  local shift = centre(hand, object, options.grasp)
  if not shift then return grasp end
  local X_WO = object.pose
  local aside = {dofs = state.dofs, reach = state.reach, retreat = state.retreat,
                 pose = X_WO:inverse() * clench.pose {xyz = shift} * X_WO * state.pose}
  return close_from(hand, object, aside, options) or grasp
end

--- adds numbers to what is noted with a grasp
function closing.note(grasp, planner, numbers)
  local info = grasp.info
  for name, value in pairs(numbers) do info[name] = value end
  grasp.info = info
  grasp.labels = {planner = planner}
  return grasp
end

return closing
