--- Units of the original's text protocol: mm, rad, N and N m; efforts of motors in 1e-6 N and 1e-9 N m, as in its robot files.
local units = {}

--- A number as text with a relative precision of 1e-9.
function units.text(x) return ("%.9g"):format(x + 0.0) end

--- Numbers in one line.
function units.line(numbers)
  local words = {}
  for i, x in ipairs(numbers) do words[i] = units.text(x) end
  return table.concat(words, " ")
end

--- Adds a line per value to a reply.
function units.add_values(reply, values, factors)
  for i, value in ipairs(values) do reply[#reply + 1] = units.text(value * factors[i]) end
end

-- by DOF of a robot: does it slide?
local function slides(robot)
  local list = {}
  for i in ipairs(robot.dofs) do list[i] = false end
  for _, chain in ipairs(robot.chains) do
    for _, joint in ipairs(chain.joints) do
      if joint.dof and joint.kind == "prismatic" then list[joint.dof] = true end
    end
  end
  return list
end

local cached = setmetatable({}, {__mode = "k"})  -- factors by world and name of a robot: {robot, value, effort}

local function find_factors(robot)
  local value, effort = {}, {}
  for i, is_sliding in ipairs(slides(robot)) do
    value[i], effort[i] = is_sliding and 1e3 or 1, is_sliding and 1e6 or 1e9
  end
  return {robot = robot, value = value, effort = effort}
end

--- Factors from SI to the protocol's unit, of values (rad, mm) and efforts, per DOF.
function units.of_dofs(world, robot)
  local of_world = cached[world] or {}
  cached[world] = of_world
  local name = robot.name
  local factors = of_world[name]
  if not factors or factors.robot ~= robot then
    factors = find_factors(robot)
    of_world[name] = factors
  end
  return factors.value, factors.effort
end

return units
