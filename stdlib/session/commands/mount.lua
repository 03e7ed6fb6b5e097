--- Commands that mount robots on others: a hand on an arm.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local raise = require "clench.raise"
local script = require "clench.session.script"

local function two_robots(session)
  return session.world ~= nil and #session.world.robots > 1, session.world and "there is no other robot" or "no world is open"
end

local function carried(session)
  for _, robot in ipairs(session.world and session.world.robots or {}) do
    if robot.parent then return true end
  end
  return false, session.world and "no robot is mounted" or (select(2, conditions.world(session)))
end

local function options_of(args) return args.pose and {pose = clench.type(args.pose) == "pose" and args.pose or clench.pose(args.pose)} or nil end

-- the robot that the current hand can be mounted on, if there is only one
local function other_robot(session)
  local others = {}
  for _, robot in ipairs(session.world.robots) do
    if robot ~= session.hand then others[#others + 1] = robot.name end
  end
  return #others == 1 and others[1] or nil
end

-- the current hand by default
local hand = {name = "hand", type = "robot", optional = true, text = "address of the robot; the current hand by default"}

return {
  {name = "body.mount", label = "Mount on…", menu = "Element", section = 2, enabled = two_robots,
   parameters = {hand, {name = "on", type = "robot", in_dialog = other_robot, text = "address of the robot that carries it, by the last link of its first chain"},
                 {name = "pose", type = "pose", optional = true, text = "of its base in that link; by default they coincide"}},
   run = function(session, args)
     local robot, carrier = arguments.find_robot(session, args.hand), arguments.find_robot(session, args.on)
     if robot == carrier then raise(("session: body.mount: on: expected another robot than '%s'"):format(robot.name)) end
     robot:mount_on(carrier, options_of(args))
     return robot
   end,
   script = function(session, args)
     local options = options_of(args)
     return ("%s:mount_on(%s%s)"):format(script.name_of(arguments.find_robot(session, args.hand)), script.name_of(arguments.find_robot(session, args.on)),
                                         options and ", " .. script.literal(options) or "")
   end},
  {name = "body.dismount", label = "Dismount", menu = "Element", section = 2, enabled = carried, parameters = {hand},
   run = function(session, args) arguments.find_robot(session, args.hand):dismount() end,
   script = function(session, args) return script.name_of(arguments.find_robot(session, args.hand)) .. ":dismount()" end},
}
