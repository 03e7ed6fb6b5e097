--- Commands of the Grasp menu that move the current hand, or another one by address.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local raise = require "clench.raise"
local script = require "clench.session.script"

local hand = {name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"}
local reach = {name = "reach", type = "number", min = 0, unit = "m", optional = true, text = "maximum distance"}

local function call_of(method, robot, options)
  return ("%s:%s(%s)"):format(script.name_of(robot), method, options and script.literal(options) or "")
end

local function options_of(parameters, args)
  local options = {}
  for _, parameter in ipairs(parameters) do options[parameter.name] = args[parameter.name] end
  return next(options) and options or nil
end

-- a command that calls a method of the hand with a table of options
local function caller(name, label, method, shortcut, parameters, menu)
  return {
    name = "grasp." .. name, label = label, menu = menu or "Grasp", section = menu and 4 or 1, shortcut = shortcut, enabled = conditions.hand, parameters = {hand, table.unpack(parameters)},
    run = function(session, args)
      local robot = arguments.find_robot(session, args.hand)
      return robot[method](robot, options_of(parameters, args))
    end,
    script = function(session, args) return call_of(method, arguments.find_robot(session, args.hand), options_of(parameters, args)) end,
  }
end

-- a command that calls a method of the hand with a list of numbers and a table of options
local function setter(menu, name, label, method, values, parameters)
  return {
    name = "grasp." .. name, label = label, menu = menu, section = 4, enabled = conditions.hand, parameters = {hand, values, table.unpack(parameters)},
    run = function(session, args)
      local robot = arguments.find_robot(session, args.hand)
      return robot[method](robot, args[values.name], options_of(parameters, args))
    end,
    script = function(session, args)
      local options = options_of(parameters, args)
      return ("%s:%s(%s%s)"):format(script.name_of(arguments.find_robot(session, args.hand)), method, script.literal(args[values.name]),
                                   options and ", " .. script.literal(options) or "")
    end,
  }
end

-- the saved posture of a robot
local function posture_of(session, args)
  local robot = arguments.find_robot(session, args.hand)
  local saved = session.postures[robot.name] or raise(("session: no posture of '%s' was saved; grasp.save_posture saves one"):format(robot.name))
  return robot, saved
end

-- a name that no robot of the world has
local function free_name(world, name)
  local taken, number = {}, 2
  for _, robot in ipairs(world.robots) do taken[robot.name] = true end
  while taken[name .. "_" .. number] do number = number + 1 end
  return name .. "_" .. number
end

local function grasp_of(session, args)
  if args.grasp then return args.grasp end
  local job = arguments.find_job(session, args.job)
  local found = session:grasps_of(job)
  return found[args.rank] or raise(("session: grasp.apply: rank: expected 1 to %d, the number of grasps of job '%s', got %d"):format(#found, job.name, args.rank))
end

return {
  caller("autograsp", "Auto Grasp", "autograsp", "ctrl+g", {{name = "speed", type = "number", min = 1e-6, optional = true, text = "1: the default speeds of the hand"}}),
  caller("open", "Auto Open", "open", nil, {}),
  caller("approach", "Approach", "approach_object", nil, {reach}),
  {name = "grasp.approach_and_grasp", label = "Approach and Grasp", menu = "Grasp", section = 1, shortcut = "g", enabled = conditions.hand,
   parameters = {hand, {name = "reach", type = "number", min = 0, unit = "m", default = 0.03, text = "maximum distance"}},
   run = function(session, args)
     local robot = arguments.find_robot(session, args.hand)
     robot:approach_object {reach = args.reach}
     return robot:autograsp()
   end,
   script = function(session, args)
     local robot = arguments.find_robot(session, args.hand)
     return call_of("approach_object", robot, {reach = args.reach}) .. "\n" .. call_of("autograsp", robot)
   end},
  setter("Grasp/Posture", "dofs", "Set DOFs…", "set_dofs", {name = "dofs", type = "table", text = "values of all DOFs, or of some by name [rad or m]"}, {}),
  setter("Grasp/Posture", "move_dofs", "Move DOFs…", "move_dofs", {name = "dofs", type = "table", text = "values of all DOFs, or of some by name [rad or m]"},
         {{name = "stop_at_contact", type = "boolean", optional = true, text = "true: ends at the first contact of any link"}}),
  setter("Grasp/EigenGrasps", "amplitudes", "EigenGrasp Interface…", "set_amplitudes", {name = "amplitudes", type = "table", text = "one per eigengrasp"},
         {{name = "keep", type = "boolean", optional = true, text = "true: keeps the part of the posture that no eigengrasp describes"},
          {name = "fixed", type = "table", optional = true, text = "numbers of the amplitudes that keep their values"}}),
  caller("virtual_contacts", "Virtual Contacts…", "find_virtual_contacts", nil,
         {{name = "count_per_link", type = "integer", min = 1, max = 100, optional = true, text = "number of contacts on each link"},
          {name = "palm", type = "boolean", optional = true, text = "true: also on the palm"},
          {name = "object_material", type = "string", suggested = function(session) return session.world.materials end, optional = true, text = "material to be grasped"}}, "Grasp/Virtual Contacts"),
  {name = "grasp.save_posture", label = "Save Posture", menu = "Grasp/Posture", section = 4, shortcut = "s", enabled = conditions.hand, reads = true, parameters = {hand},
   run = function(session, args)
     local robot = arguments.find_robot(session, args.hand)
     session.postures[robot.name] = {pose = robot.pose, dofs = robot.dofs}
   end},
  {name = "grasp.restore_posture", label = "Restore Posture", menu = "Grasp/Posture", section = 4, shortcut = "r", enabled = conditions.hand, parameters = {hand},
   run = function(session, args)
     local robot, saved = posture_of(session, args)
     if robot.parent then robot:set_dofs(saved.dofs) else robot:set_posture(saved.pose, saved.dofs) end
   end,
   script = function(session, args)
     local robot, saved = posture_of(session, args)
     if robot.parent then return ("%s:set_dofs(%s)"):format(script.name_of(robot), script.literal(saved.dofs)) end
     return ("%s:set_posture(%s, %s)"):format(script.name_of(robot), script.literal(saved.pose), script.literal(saved.dofs))
   end},
  -- logged as calls, which read the hand's file again
  {name = "grasp.clone_hand", label = "Clone Hand", menu = "Grasp/Posture", section = 4, shortcut = "c", enabled = conditions.hand, parameters = {hand},
   run = function(session, args)
     local robot, world = arguments.find_robot(session, args.hand), session.world
     local copy = world:add_robot(robot.source, {pose = robot.pose, name = free_name(world, robot.name)})
     world:set_collision(false, robot, copy)
     copy:set_dofs(robot.dofs)
     return copy
   end,
   script = function(session, args)
     local robot = arguments.find_robot(session, args.hand)
     local name = free_name(session.world, robot.name)
     return ("world:add_robot(%q, {pose = %s, name = %q})\nworld:set_collision(false, %s, world:robot(%q))\nworld:robot(%q):set_dofs(%s)"):format(
       robot.source, script.literal(robot.pose), name, script.name_of(robot), name, name, script.literal(robot.dofs))
   end},
  -- logged as the resulting state, since the grasps of a planner may depend on the clock
  {name = "grasp.apply", label = "Apply Grasp…", menu = "Grasp/Grasp Lists", section = 4, enabled = conditions.hand_and_object,
   parameters = {{name = "grasp", type = "any", optional = true, text = "a grasp; by default one of a planner's job"},
                 {name = "job", type = "integer", min = 1, optional = true, text = "number of the job in session.jobs; the last one by default"},
                 {name = "rank", type = "integer", min = 1, default = 1, text = "rank of the job's grasp, 1 for the best"}},
   run = function(session, args)
     local grasp = grasp_of(session, args)
     if clench.type(grasp) ~= "grasp" then raise("session: grasp.apply: grasp: expected a grasp, got " .. clench.type(grasp)) end
     return grasp:apply(session.world)
   end},
}
