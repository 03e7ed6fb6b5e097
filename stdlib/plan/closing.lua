--- From a state to a grasp: the hand is placed, comes to the first touch where that is asked for, closes, and what it
--- holds is measured.
local closing = {}

--- Places the hand of a world.   returns whether it is free of collision there
function closing.place(hand, object, state)
  hand:set_posture(object.pose * state.pose, state.dofs)
  return not hand.world:collides(hand)
end

---@param hand robot
---@param object body
---@param state {pose: pose, dofs: number[]}  of the hand in the object
---@param options {approach?: number, grasp?: table, needs_contact?: boolean}
---@return grasp? grasp, string? why  what was in the way
function closing.close(hand, object, state, options)
  if not closing.place(hand, object, state) then return nil, "in collision at the start" end
  if options.approach then hand:approach_object {reach = options.approach} end
  hand:autograsp()
  local grasp = clench.grasp(hand, object, options.grasp)
  if #grasp.points == 0 then return nil, "nothing touched" end
  grasp:quality "epsilon"
  grasp.pregrasp = {pose = state.pose, dofs = state.dofs}
  grasp.collision_free = not hand.world:collides(hand)
  return grasp
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
