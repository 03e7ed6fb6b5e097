--- Commands of the text protocol about bodies and robots: names, DOFs and motors.
local lists = require "clench.control.text.lists"
local move_robot = require "clench.control.text.move_robot"
local units = require "clench.control.text.units"

local commands = {}

local function names(kind, field)
  return function(world, words)
    local chosen, reply = lists.read(words, kind, world[field])
    words:done()
    for _, item in ipairs(chosen) do reply[#reply + 1] = item.name end
    return reply
  end
end

commands.getBodyName, commands.getRobotName = names("body", "bodies"), names("robot", "robots")

-- getDOFVals L
function commands.getDOFVals(world, words)
  local robots, reply = lists.read(words, "robot", world.robots)
  words:done()
  for _, robot in ipairs(robots) do
    local values = robot.dofs
    reply[#reply + 1] = tostring(#values)
    units.add_values(reply, values, (units.of_dofs(world, robot)))
  end
  return reply
end

-- moveDOFs robot n v1 ... vn s1 ... sn
function commands.moveDOFs(world, words)
  local robot = world.robots[words:index "the index of a robot" + 1] or words.fail "Robot does not exist."
  local count = words:dof_count(robot)
  local values, steps = words:numbers(count, "values"), words:numbers(count, "steps")
  words:done()
  return move_robot(world, robot, values, steps)
end

-- setDOFForces L, then for each robot: n f1 ... fn
function commands.setDOFForces(world, words)
  local robots, reply = lists.read(words, "robot", world.robots)
  local forces = {}
  for r, robot in ipairs(robots) do
    forces[r] = words:numbers(words:dof_count(robot), "forces")
  end
  words:done()
  -- nothing is set unless the complete line is valid
  for r, robot in ipairs(robots) do
    local _, factors = units.of_dofs(world, robot)
    for i, range in ipairs(robot.effort_ranges) do forces[r][i] = math.max(range[1], math.min(range[2], forces[r][i] / factors[i])) end
    robot.controller = "none"
    robot:set_forces(forces[r])
    units.add_values(reply, forces[r], factors)
  end
  return reply
end

-- moveToContacts: the current hand moves along its approach direction until it touches something, at most 30 mm
function commands.moveToContacts(world, words, session)
  words:done()
  local hand = session.hand or words.fail "Robot does not exist."
  hand:approach_object {reach = 0.03}
  return {}
end

return commands
