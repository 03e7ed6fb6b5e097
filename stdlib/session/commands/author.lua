--- Commands that author grasps: from a pregrasp in phases to the grasp, a tug test, and names and notes that are stored in files.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local described = require "clench.described"
local phases = require "clench.session.phases"
local raise = require "clench.raise"
local script = require "clench.session.script"

local hand = {name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"}
local pregrasp = {name = "pregrasp", type = "table", optional = true, text = "{pose =, dofs =} of the hand before it closes, its pose in the object"}
local list = {name = "phases", type = "table", optional = true, text = 'closing phases: {kind = "approach", reach =}, {kind = "posture", dofs =}, {kind = "close"}'}

local function check(name, args)
  local before = args.pregrasp
  if before and not (clench.type(before.pose) == "pose" and type(before.dofs) == "table") then
    raise(("session: %s: pregrasp: expected {pose = a pose, dofs = a list of numbers}"):format(name))
  end
  phases.check("session: " .. name, args.phases or {})
end

-- a text that files of grasps can store
local function check_text(name, text, pattern, what)
  if text and (not utf8.len(text) or text:find(pattern)) then raise(("session: grasp.author: %s: expected %s, got %s"):format(name, what, described(text))) end
end

-- pose and DOFs of the hand at the pregrasp, and those of an arm that carries it
local function placement(session, robot, before)
  local pose = session.object.pose * before.pose
  local arm = robot.parent
  if not arm then return {{robot, "set_posture", pose, before.dofs}} end
  local found = arm:ik(robot.base, pose)
  if not found.reached then
    raise(("session: the arm '%s' does not reach the pregrasp; %.1f mm and %.1f degrees are left"):format(arm.name, found.distance * 1000, math.deg(found.angle)))
  end
  return {{arm, "set_dofs", found.dofs}, {robot, "set_dofs", before.dofs}}
end

-- the list of authored grasps, which the gallery shows, too
local function authored(session)
  if not session.authored then
    session.authored = {}
    session.lists[#session.lists + 1] = {name = "authored", grasps = session.authored}
  end
  return session.authored
end

-- the index of the grasp with a name; one beyond the last if there is none
local function place_of(grasps, name)
  for i, grasp in ipairs(grasps) do
    if grasp.labels.name == name then return i end
  end
  return #grasps + 1
end

local function new_grasp(session, args)
  local grasp = clench.grasp(arguments.find_robot(session, args.hand), session.object)
  if #grasp.contacts == 0 then raise "session: grasp.author: the hand does not touch the object" end
  grasp:quality "epsilon"
  grasp.pregrasp = args.pregrasp
  grasp.labels = {name = args.name, notes = args.notes, planner = "author", phases = args.phases and clench.json.encode(args.phases)}
  grasp.info = {confidence = args.confidence, tug_force = args.tug and args.tug.force, tug_held = args.tug and args.tug.held}
  return grasp
end

-- runs in a thread, with copies
local function tug(hand, object, options)
  local clench = require "clench"
  options.hand, options.object = hand, object
  return clench.study.shake(options)
end

return {
  {name = "grasp.close_in_phases", label = "Close in Phases…", menu = "Grasp/Author", section = 4, enabled = conditions.hand_and_object, parameters = {hand, pregrasp, list},
   run = function(session, args)
     check("grasp.close_in_phases", args)
     local robot = arguments.find_robot(session, args.hand)
     for _, call in ipairs(args.pregrasp and placement(session, robot, args.pregrasp) or {}) do call[1][call[2]](call[1], table.unpack(call, 3)) end
     return phases.run(robot, args.phases or {})
   end,
   script = function(session, args)
     check("grasp.close_in_phases", args)
     local robot, lines = arguments.find_robot(session, args.hand), {}
     for _, call in ipairs(args.pregrasp and placement(session, robot, args.pregrasp) or {}) do
       local parts = {}
       for i = 3, #call do parts[#parts + 1] = script.literal(call[i]) end
       lines[#lines + 1] = ("%s:%s(%s)"):format(script.name_of(call[1]), call[2], table.concat(parts, ", "))
     end
     table.move(phases.lines(script.name_of(robot), args.phases or {}), 1, #(args.phases or {}), #lines + 1, lines)
     return table.concat(lines, "\n")
   end},
  {name = "grasp.tug", label = "Tug Test…", menu = "Grasp/Author", section = 4, enabled = conditions.hand_and_object, reads = true,
   parameters = {hand, {name = "force", type = "number", min = 1e-9, max = 1e6, unit = "N", default = 1, text = "force on the object along each axis of the world in turn"},
                 {name = "seconds", type = "number", min = 1e-3, max = 1000, unit = "s", default = 0.5, text = "time in each direction"}},
   run = function(session, args)
     local robot, object = arguments.find_robot(session, args.hand), session.object
     local job = clench.job(tug, {args = {robot, object, {force = args.force, seconds = args.seconds, mass = object.mass}}, name = "tug test"})
     return session:add_job(job, "grasp.tug")
   end},
  {name = "grasp.author", label = "Author Grasp…", menu = "Grasp/Author", section = 4, enabled = conditions.hand_and_object, reads = true,
   parameters = {hand, {name = "name", type = "string", text = "name of the grasp; an authored one of the same name is replaced"},
                 {name = "notes", type = "string", optional = true, text = "any text"},
                 {name = "confidence", type = "number", min = 0, max = 1, optional = true, text = "of the author in the grasp"}, pregrasp, list,
                 {name = "tug", type = "table", optional = true, text = "result of a tug test: {force = in N, held = number of directions}"}},
   run = function(session, args)
     check("grasp.author", args)
     check_text("name", args.name, "%c", "UTF-8 without control characters")
     check_text("name", args.name, "^%s*$", "a name")
     check_text("notes", args.notes, "%z", "UTF-8 without zero bytes")
     local grasp, grasps = new_grasp(session, args), authored(session)
     grasps[place_of(grasps, args.name)] = grasp
     return grasp
   end},
  {name = "grasp.forget", label = "Forget Authored Grasp…", menu = "Grasp/Author", section = 4, reads = true,
   enabled = function(session) return session.authored ~= nil and #session.authored > 0, "no grasp was authored" end,
   parameters = {{name = "name", type = "string", text = "name of an authored grasp"}},
   run = function(session, args)
     local i = place_of(session.authored, args.name)
     if i > #session.authored then raise(("session: grasp.forget: there is no authored grasp '%s'"):format(args.name)) end
     table.remove(session.authored, i)
   end},
}
