--- Commands of the original's Element menu: bodies and robots by their addresses.
local arguments = require "clench.session.arguments"
local script = require "clench.session.script"

local function has_world(session) return session.world ~= nil, "no world is open" end
local body = {name = "body", type = "body", text = "address of a body or robot"}

-- a command that sets one field of a body
local function setter(field, parameter)
  parameter.name = field
  return {
    name = "body." .. field, label = "Set " .. field, menu = "Element", enabled = has_world, parameters = {body, parameter},
    run = function(session, args) arguments.find_body(session, args.body)[field] = args[field] end,
    script = function(session, args)
      return ("%s.%s = %s"):format(script.name_of(arguments.find_body(session, args.body)), field, script.literal(args[field]))
    end,
  }
end

local function pose_of(value) return clench.type(value) == "pose" and value or clench.pose(value) end

return {
  {name = "body.move", label = "Move", menu = "Element", enabled = has_world,
   parameters = {body, {name = "pose", type = "pose", text = "where it is from now on, in the world frame"}},
   run = function(session, args) arguments.find(session, args.body).pose = pose_of(args.pose) end,
   script = function(session, args)
     return ("%s.pose = %s"):format(script.name_of(arguments.find(session, args.body)), script.literal(pose_of(args.pose)))
   end},
  {name = "body.remove", label = "Remove", menu = "Element", shortcut = "Delete", enabled = has_world, parameters = {body},
   run = function(session, args) session.world:remove(arguments.find(session, args.body)) end,
   script = function(session, args) return ("world:remove(%s)"):format(script.name_of(arguments.find(session, args.body))) end},
  setter("mass", {type = "number", min = 0, unit = "kg", text = "mass"}),
  setter("material", {type = "string", text = "name of a material"}),
  {name = "body.collisions", label = "Collisions on or off", menu = "Element", enabled = has_world,
   parameters = {body, {name = "on", type = "boolean", text = "does it collide with anything?"}},
   run = function(session, args) session.world:set_collision(args.on, arguments.find(session, args.body)) end,
   script = function(session, args) return ("world:set_collision(%s, %s)"):format(tostring(args.on), script.name_of(arguments.find(session, args.body))) end},
}
