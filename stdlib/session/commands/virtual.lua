--- Commands on the virtual contacts of the current hand: the points at which it is intended to touch.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local raise = require "clench.raise"
local script = require "clench.session.script"

local hand = {name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"}
local loaded = {name = "path", type = "string", files = {kinds = {"virtual contacts"}}, text = "a file, .vgr or .xml"}
local saved = {name = "path", type = "string", files = {kinds = {"virtual contacts"}, writes = true}, text = "file to write, .vgr or .xml"}

local function name_of(session, args) return script.name_of(arguments.find_robot(session, args.hand)) end

return {
  {name = "grasp.find_virtual", label = "Find Virtual Contacts", menu = "Grasp/Virtual Contacts", section = 4, enabled = conditions.hand,
   parameters = {hand, {name = "count_per_link", type = "integer", min = 1, max = 100, default = 1, text = "number of contacts on each link"}},
   run = function(session, args)
     local robot = arguments.find_robot(session, args.hand)
     robot.virtual_contacts = robot:find_virtual_contacts {count_per_link = args.count_per_link}
   end,
   script = function(session, args)
     local name = name_of(session, args)
     return ("%s.virtual_contacts = %s:find_virtual_contacts {count_per_link = %d}"):format(name, name, args.count_per_link)
   end},
  {name = "grasp.mark_virtual", label = "Mark Contacts", menu = "Grasp/Virtual Contacts", section = 4, enabled = conditions.hand_and_object, parameters = {hand},
   run = function(session, args)
     local robot = arguments.find_robot(session, args.hand)
     local contacts = session.world:contacts(robot, session.object)
     if #contacts == 0 then raise "session: grasp.mark_virtual: the hand does not touch the object" end
     for _, contact in ipairs(contacts) do robot:add_virtual_contact(contact) end
   end,
   script = function(session, args)
     local name = name_of(session, args)
     return ("for _, contact in ipairs(world:contacts(%s, %s)) do %s:add_virtual_contact(contact) end"):format(name, script.name_of(session.object), name)
   end},
  {name = "grasp.clear_virtual", label = "Clear Virtual Contacts", menu = "Grasp/Virtual Contacts", section = 4, enabled = conditions.hand, parameters = {hand},
   run = function(session, args) arguments.find_robot(session, args.hand).virtual_contacts = {} end,
   script = function(session, args) return name_of(session, args) .. ".virtual_contacts = {}" end},
  {name = "grasp.load_virtual", label = "Load Virtual Contacts…", menu = "Grasp/Virtual Contacts", section = 4, enabled = conditions.hand, parameters = {loaded, hand},
   run = function(session, args) arguments.find_robot(session, args.hand).virtual_contacts = clench.files.virtual_contacts(args.path) end,
   script = function(session, args) return ("%s.virtual_contacts = clench.files.virtual_contacts(%q)"):format(name_of(session, args), args.path) end},
  {name = "grasp.save_virtual", label = "Save Virtual Contacts…", menu = "Grasp/Virtual Contacts", section = 4, enabled = conditions.hand, reads = true, parameters = {saved, hand},
   run = function(session, args)
     arguments.find_robot(session, args.hand):save_virtual_contacts(args.path)
     return args.path
   end},
}
