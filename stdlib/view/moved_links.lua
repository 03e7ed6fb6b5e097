--- Links that a DOF moves, found by moving it in a copy of the world.

-- a value of a DOF different from the present one, within its limits
local function other_value(value, limits)
  local step = math.min(limits[2] - limits[1], 1) / 10
  return value + step <= limits[2] and value + step or value - step
end

---@param robot robot
---@param dof integer  from 1
---@return body[] links
return function(robot, dof)
  local twin = robot.world:clone():robot(robot.name)
  local values, poses, links = twin.dofs, {}, {}
  twin.dofs = values  -- engages the joints that have broken away
  for i, body in ipairs(twin.bodies) do poses[i] = body.pose end
  values[dof] = other_value(values[dof], robot.dof_limits[dof])
  twin.dofs = values
  local bodies = robot.bodies
  for i, body in ipairs(twin.bodies) do
    if body.pose ~= poses[i] then links[#links + 1] = bodies[i] end
  end
  return links
end
