--- Commands that select the targets of other commands. They do not change the world, and are undone together with the command that follows.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local raise = require "clench.raise"

local function chosen(session, what)
  session:emit("changed", {selection = true})
  return what
end

return {
  {name = "world.select", label = "Select", enabled = conditions.world, reads = true,
   parameters = {{name = "addresses", type = "table", text = "addresses of bodies and robots"}},
   run = function(session, args)
     session.selection = arguments.find_all(session, "addresses", args.addresses)
     chosen(session)
   end},
  {name = "grasp.select_hand", label = "Select Hand…", menu = "Grasp", section = 5, enabled = conditions.world, reads = true,
   parameters = {{name = "hand", type = "robot", text = "address of the robot that becomes the current hand"}},
   run = function(session, args)
     session.hand = arguments.find_robot(session, args.hand)
     return chosen(session, session.hand)
   end},
  {name = "grasp.select_object", label = "Select Object…", menu = "Grasp", section = 5, enabled = conditions.world, reads = true,
   parameters = {{name = "object", type = "body", text = "address of the object to be grasped"}},
   run = function(session, args)
     local object = arguments.find(session, args.object)
     if clench.type(object) ~= "body" or object.kind ~= "object" then
       raise(("session: expected an object, got '%s', %s"):format(object.name, clench.type(object) == "robot" and "a robot" or "of kind " .. object.kind))
     end
     session.object = object
     return chosen(session, object)
   end},
}
