--- Closing phases of a grasp: steps by which a hand moves from its pregrasp to the grasp. Each is a table with a kind:
--- {kind = "approach", reach = [m]} moves the hand until it touches, {kind = "posture", dofs = {...}} drives the DOFs towards values until contact stops them,
--- {kind = "close"} closes the hand.
local described = require "clench.described"
local raise = require "clench.raise"
local script = require "clench.session.script"
local phases = {}

local kinds = {
  approach = {fields = {reach = "number"}, run = function(hand, phase) return hand:approach_object {reach = phase.reach} end,
              line = function(phase) return ("approach_object({reach = %s})"):format(script.literal(phase.reach)) end},
  posture = {fields = {dofs = "table"}, run = function(hand, phase) return hand:move_dofs(phase.dofs) end,
             line = function(phase) return ("move_dofs(%s)"):format(script.literal(phase.dofs)) end},
  close = {fields = {}, run = function(hand) return hand:autograsp() end, line = function() return "autograsp()" end},
}

--- Raises an error if a list of phases is not valid.
---@param subject string  for the message
function phases.check(subject, list)
  if type(list) ~= "table" or #list == 0 and next(list) ~= nil then raise(("%s: phases: expected a list, got %s"):format(subject, described(list))) end
  for i, phase in ipairs(list) do
    local kind = type(phase) == "table" and kinds[phase.kind]
    if not kind then
      raise(("%s: phases[%d]: expected {kind = \"approach\", \"posture\" or \"close\"}, got %s"):format(subject, i, described(type(phase) == "table" and phase.kind or phase)))
    end
    for key in pairs(phase) do
      if key ~= "kind" and not kind.fields[key] then raise(("%s: phases[%d]: unknown key '%s'"):format(subject, i, tostring(key))) end
    end
    for key, expected in pairs(kind.fields) do
      if type(phase[key]) ~= expected then raise(("%s: phases[%d].%s: expected a %s, got %s"):format(subject, i, key, expected, described(phase[key]))) end
    end
  end
end

--- Runs phases.
---@return table? result  of the last one
function phases.run(hand, list)
  local result
  for _, phase in ipairs(list) do result = kinds[phase.kind].run(hand, phase) end
  return result
end

--- Lines of Lua with the same effect.
---@param name string  expression of the hand
---@return string[]
function phases.lines(name, list)
  local lines = {}
  for i, phase in ipairs(list) do lines[i] = ("%s:%s"):format(name, kinds[phase.kind].line(phase)) end
  return lines
end

return phases
