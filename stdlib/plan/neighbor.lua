local closing = require "clench.plan.closing"

--- A start near another one: turned about the middle of the grasp, moved, and with changed DOFs.
---@param state {pose: pose, dofs: number[], reach?: number, retreat?: number}
---@param center vec3  middle of the grasp, in the object
---@param random random
---@param size number  scale of the changes; 1: standard deviations of 6 mm per axis, 9 degrees, and 6 % of the DOFs' ranges
---@param hand robot  in a world in which it may be moved: changes of DOFs that make it collide are reduced
---@param object body
return function(state, center, random, size, hand, object)
  local turn = clench.pose {axis = random:direction(), angle = random:normal() * 0.15 * size}
  local move = clench.vec3(random:normal(), random:normal(), random:normal()) * (0.006 * size)
  local about = clench.pose {xyz = center}
  local pose = clench.pose {xyz = move} * about * turn * about:inverse() * state.pose
  local limits, changes = hand.dof_limits, {}
  for i in ipairs(state.dofs) do changes[i] = random:normal() * 0.06 * size end
  local near
  for part = 1, 0, -0.25 do
    local dofs = {}
    for i, value in ipairs(state.dofs) do
      local low, high = limits[i][1], limits[i][2]
      local new = high - low < math.huge and value + part * changes[i] * (high - low) or value
      dofs[i] = math.max(low, math.min(high, new))
    end
    near = {pose = pose, dofs = dofs, retreat = state.retreat, reach = state.reach, is_near = state.is_near}
    if closing.place(hand, object, near) then break end
  end
  return near
end
