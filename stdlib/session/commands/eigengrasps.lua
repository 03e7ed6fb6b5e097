--- Commands that change the eigengrasps of the current hand.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local script = require "clench.session.script"

local hand = {name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"}
local loaded = {name = "path", type = "string", files = {kinds = {"eigengrasps"}}, text = "a file, .egr or .xml"}
local saved = {name = "path", type = "string", files = {kinds = {"eigengrasps"}, writes = true}, text = "file to write, .egr or .xml"}

-- one eigengrasp per DOF, with the limits of the DOF, and the zero posture as the origin
local function identity(robot)
  local vectors, origin = {}, {}
  for i = 1, #robot.dofs do
    vectors[i], origin[i] = {}, 0
    for j = 1, #robot.dofs do vectors[i][j] = i == j and 1 or 0 end
  end
  return {vectors = vectors, origin = origin, limits = robot.dof_limits}
end

-- the same eigengrasps about the present posture
local function about_posture(robot)
  local old = robot.eigengrasps
  return {vectors = old.vectors, origin = robot.dofs}
end

-- a command that gives the hand the eigengrasps of options(robot)
local function setter(name, label, options)
  return {name = "grasp." .. name, label = label, menu = "Grasp/EigenGrasps", section = 4, enabled = conditions.hand, parameters = {hand},
          run = function(session, args)
            local robot = arguments.find_robot(session, args.hand)
            robot.eigengrasps = clench.eigengrasps(options(robot))
          end,
          script = function(session, args)
            local robot = arguments.find_robot(session, args.hand)
            return ("%s.eigengrasps = clench.eigengrasps %s"):format(script.name_of(robot), script.literal(options(robot)))
          end}
end

return {
  setter("set_origin", "Set Origin of EigenGrasps", about_posture),
  setter("identity_eigengrasps", "Use Identity EigenGrasps", identity),
  {name = "grasp.load_eigengrasps", label = "Load EigenGrasps…", menu = "Grasp/EigenGrasps", section = 4, enabled = conditions.hand, parameters = {loaded, hand},
   run = function(session, args) arguments.find_robot(session, args.hand).eigengrasps = clench.files.eigengrasps(args.path) end,
   script = function(session, args)
     return ("%s.eigengrasps = clench.files.eigengrasps(%q)"):format(script.name_of(arguments.find_robot(session, args.hand)), args.path)
   end},
  {name = "grasp.save_eigengrasps", label = "Save EigenGrasps…", menu = "Grasp/EigenGrasps", section = 4, enabled = conditions.hand, reads = true, parameters = {saved, hand},
   run = function(session, args)
     arguments.find_robot(session, args.hand).eigengrasps:save(args.path)
     return args.path
   end},
}
