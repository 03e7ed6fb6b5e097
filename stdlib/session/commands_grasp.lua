--- Commands of the original's Grasp menu, on the current hand unless another is named.
local arguments = require "clench.session.arguments"
local raise = require "clench.raise"
local script = require "clench.session.script"

local function has_hand(session) return session.hand ~= nil, "no hand is current" end
local hand = {name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"}

-- a command that calls a method of the hand
local function caller(name, label, method, shortcut, parameters)
  local all = {hand}
  for _, parameter in ipairs(parameters or {}) do all[#all + 1] = parameter end
  local function options_of(args)
    local options = {}
    for _, parameter in ipairs(parameters or {}) do options[parameter.name] = args[parameter.name] end
    return next(options) and options
  end
  return {
    name = "grasp." .. name, label = label, menu = "Grasp", shortcut = shortcut, enabled = has_hand, parameters = all,
    run = function(session, args)
      local robot = arguments.find_robot(session, args.hand)
      return robot[method](robot, options_of(args) or nil)
    end,
    script = function(session, args)
      local options = options_of(args)
      return ("%s:%s(%s)"):format(script.name_of(arguments.find_robot(session, args.hand)), method, options and script.literal(options) or "")
    end,
  }
end

return {
  caller("autograsp", "Autograsp", "autograsp", "Space", {{name = "speed", type = "number", min = 1e-6, optional = true, text = "1: the hand's own pace"}}),
  caller("open", "Open the hand", "open"),
  caller("approach", "Approach", "approach_object", "G", {{name = "reach", type = "number", min = 0, unit = "m", optional = true, text = "how far at most"}}),
  {name = "grasp.dofs", label = "Set DOFs", menu = "Grasp", enabled = has_hand,
   parameters = {hand, {name = "dofs", type = "table", text = "values of all DOFs [rad or m]"}},
   run = function(session, args) arguments.find_robot(session, args.hand).dofs = args.dofs end,
   script = function(session, args) return ("%s.dofs = %s"):format(script.name_of(arguments.find_robot(session, args.hand)), script.literal(args.dofs)) end},
  {name = "grasp.quality", label = "Quality", menu = "Grasp", enabled = has_hand, reads = true,
   parameters = {hand, {name = "measure", type = "string", default = "epsilon", text = "name of a measure"}},
   run = function(session, args)
     local object = session.object or raise "session: no object is current"
     return clench.grasp(arguments.find_robot(session, args.hand), object):quality(args.measure)
   end},
  {name = "grasp.forces", label = "Contact forces", menu = "Grasp", enabled = has_hand, reads = true, parameters = {hand},
   run = function(session, args)
     local object = session.object or raise "session: no object is current"
     return clench.grasp(arguments.find_robot(session, args.hand), object):contact_forces {load = "weight"}
   end},
}
