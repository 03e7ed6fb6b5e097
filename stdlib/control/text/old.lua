--- The dialect of version 0.9: `step dynamics`, `get contacts`, and `setDOFVals`, whose numbers follow on separate lines.
local contacts = require "clench.control.text.contacts"
local dynamics = require "clench.control.text.dynamics"
local lists = require "clench.control.text.lists"
local move_robot = require "clench.control.text.move_robot"
local new_words = require "clench.control.text.words"
local old = {}

-- step dynamics: replies with the time that has passed
local function step_dynamics(world, words, session)
  local reply = dynamics.moveDynamicBodies(world, words, session)
  world:solve_velocities(tonumber(reply[1]))
  return reply
end

-- get contacts [k L]: as getContacts, then "done"; of all bodies by default
local function get_contacts(world, words, session)
  local rest = words:peek() and table.concat(words, " ", words.at + 1) or "1 ALL"
  words = new_words("getContacts " .. rest)
  words:next()
  local reply = contacts.getContacts(world, words, session)
  reply[#reply + 1] = "done"
  return reply
end

local function numbers_needed(robot) return 1 + 2 * #robot.dofs end

-- moves the robots according to the collected numbers
local function move(pending)
  local words, reply = new_words("setDOFVals " .. table.concat(pending.numbers, " ")), {}
  words:next()
  local moves = {}
  for r, robot in ipairs(pending.robots) do
    local count = words:dof_count(robot)
    moves[r] = {values = words:numbers(count, "values"), steps = words:numbers(count, "steps")}
  end
  words:done()
  for r, robot in ipairs(pending.robots) do
    local values = move_robot(pending.world, robot, moves[r].values, moves[r].steps)
    table.move(values, 1, #values, #reply + 1, reply)
  end
  return reply
end

-- setDOFVals L [n]; the lines that follow have, for each robot: n, n values, n steps
local function set_dof_values(world, words, _, state)
  local chosen = lists.read(words, "robot", world.robots)
  if words:peek() then words:index "the number of DOFs" end
  words:done()
  local needed = 0
  for _, robot in ipairs(chosen) do needed = needed + numbers_needed(robot) end
  if needed == 0 then return {} end
  state.pending = {world = world, robots = chosen, numbers = {}, needed = needed}
  return {}
end

--- Processes a line that continues a setDOFVals.
---@return string[]? reply  nil: the line is another command, and the previous one was left unfinished
function old.continue(state, words)
  local pending = state.pending
  if not tonumber(words[1]) then
    state.pending = nil
    return nil
  end
  for _, word in ipairs(words) do pending.numbers[#pending.numbers + 1] = word end
  -- a wrong number of DOFs is reported at once, since the number of values that follow would be unknown
  local first = #pending.robots == 1 and math.tointeger(tonumber(pending.numbers[1]))
  if first ~= nil and first ~= false and first ~= #pending.robots[1].dofs then
    state.pending = nil
    words.fail("robot has %d DOF.", #pending.robots[1].dofs)
  end
  if #pending.numbers < pending.needed then return {} end
  state.pending = nil
  return move(pending)
end

old.commands = {setDOFVals = set_dof_values}
old.second_words = {step = {dynamics = step_dynamics}, get = {contacts = get_contacts}}

return old
