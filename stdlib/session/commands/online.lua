--- Commands of the on-line planner, which searches for grasps while hand and object move.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local online = require "clench.session.online"
local script = require "clench.session.script"

local switches = {{"auto", "true: it shapes the hand while a grasp is near, within 45 degrees and 50 mm to the side, and only searches otherwise"},
                  {"shape_hand", "true: while grasping, the simulated hand takes the DOFs of the nearest grasp, opened in proportion to its distance"},
                  {"shape_real", "true: the real hand follows the simulated one"}}

local function is_running(session) return session.online ~= nil, "the on-line planner is not running" end

local function start(session, args)
  local hand = arguments.find_robot(session, args.hand)
  local object = args.object and arguments.find_body(session, args.object) or session.object
  online.start(session, {hand = hand, object = object, energy = args.energy, seed = args.seed},
               {steps = args.steps, auto = args.auto, shape_hand = args.shape_hand, shape_real = args.shape_real})
end

local parameters = {{name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"},
                    {name = "object", type = "body", optional = true, text = "address of the object; the current one by default"},
                    {name = "energy", type = "string", default = "contact", text = "objective of the search"},
                    {name = "steps", type = "integer", min = 1, max = 100000, default = 300, text = "steps of annealing between two looks at the hand"},
                    {name = "seed", type = "integer", min = 0, default = 0, text = "of the random numbers"}}
local settings = {}
for i, switch in ipairs(switches) do
  parameters[#parameters + 1] = {name = switch[1], type = "boolean", default = switch[1] == "shape_hand", text = switch[2]}
  settings[i] = {name = switch[1], type = "boolean", optional = true, text = switch[2]}
end

local function status(verb, label, value)
  return {name = "online." .. verb, label = label, enabled = is_running, reads = true, run = function(session) online.set_status(session, value) end}
end

return {
  {name = "online.start", label = "On-line Planner…", menu = "Grasp", section = 2, enabled = conditions.hand_and_object, reads = true, parameters = parameters, run = start},
  status("plan", "On-line Planner: Plan", "planning"),
  status("grasp", "On-line Planner: Grasp", "grasping"),
  {name = "online.open", label = "On-line Planner: Open", enabled = is_running,
   run = function(session)
     online.set_status(session, "open")
     return session.online.hand:open()
   end,
   script = function(session) return script.name_of(session.online.hand) .. ":open()" end},
  {name = "online.settings", label = "On-line Planner: Settings…", enabled = is_running, reads = true, parameters = settings, run = online.set},
  {name = "online.stop", label = "On-line Planner: Stop", enabled = is_running, reads = true, run = online.stop},
}
