--- Moves of robots as in the text protocol: each DOF by its own step size, until the first contact.
local units = require "clench.control.text.units"

-- Moves DOFs from their present values, each by its own step size, until the first contact: a DOF with few steps arrives before the others.
local function move(robot, goals, steps)
  local start, arrivals, times = robot.dofs, {}, {}
  for i, goal in ipairs(goals) do
    local limits = robot.dof_limits[i]
    goals[i] = robot.dof_info[i].endless and goal or math.max(limits[1], math.min(limits[2], goal))
    times[i] = steps[i] == 0 and math.huge or math.abs((goals[i] - start[i]) / steps[i])
    if times[i] > 0 and times[i] < math.huge then arrivals[#arrivals + 1] = times[i] end
  end
  table.sort(arrivals)
  for i, time in ipairs(arrivals) do
    if time ~= arrivals[i - 1] then
      local target = {}
      for k, goal in ipairs(goals) do
        local part = times[k] == 0 and 1 or math.min(1, time / times[k])
        target[k] = part == 1 and goal or start[k] + part * (goal - start[k])
      end
      local result = robot:move_dofs(target, {stop_at_contact = true})
      if #result.stopped_by > 0 then return end
    end
  end
end

--- Moves a robot to values in the protocol's units.
---@param world world
---@param robot robot  of it
---@param values number[]
---@param steps number[]  only their proportions matter
---@return string[] reply  a line per DOF with the actual value
return function(world, robot, values, steps)
  local factors = units.of_dofs(world, robot)
  for i in ipairs(values) do values[i], steps[i] = values[i] / factors[i], math.abs(steps[i]) / factors[i] end
  move(robot, values, steps)
  local reply = {}
  units.add_values(reply, robot.dofs, factors)
  return reply
end
