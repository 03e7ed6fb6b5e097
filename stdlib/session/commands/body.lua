--- Commands of the Element menu: on bodies and robots by address, or on the selection.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local net_wrench = require "clench.session.net_wrench"
local placing = require "clench.session.placing"
local raise = require "clench.raise"
local script = require "clench.session.script"

local body = {name = "body", type = "body", in_dialog = arguments.selected(1), text = "address of a body or robot"}
local bodies = {name = "body", type = "body", optional = true, text = "address of a body or robot; the selection by default"}

local function lines_for(list, line)
  local lines = {}
  for i, thing in ipairs(list) do lines[i] = line(thing) end
  return table.concat(lines, "\n")
end

-- a command that sets one field of bodies; for a robot, of all its bodies
local function setter(field, label, parameter)
  parameter.name = field
  local function targets(session, args)
    local list = {}
    for _, thing in ipairs(arguments.find_several(session, args.body)) do
      local parts = clench.type(thing) == "robot" and thing.bodies or {thing}
      table.move(parts, 1, #parts, #list + 1, list)
    end
    return list
  end
  return {
    name = "body." .. field, label = label, menu = "Element", section = 3, enabled = conditions.world, parameters = {bodies, parameter},
    run = function(session, args)
      for _, thing in ipairs(targets(session, args)) do thing[field] = args[field] end
    end,
    script = function(session, args)
      return lines_for(targets(session, args), function(thing) return ("%s.%s = %s"):format(script.name_of(thing), field, script.literal(args[field])) end)
    end,
  }
end

local function pose_of_selected(session) return session.selection[1] and session.selection[1].pose end

local function pose_of(value) return clench.type(value) == "pose" and value or clench.pose(value) end

local function names_of(list) return (lines_for(list, script.name_of):gsub("\n", ", ")) end

-- arguments of set_collision: without bodies for the complete world, for two bodies their pair, otherwise each body with everything
local function collision_calls(session, args)
  local list = args.body == nil and session.selection or arguments.find_several(session, args.body)
  if args.other ~= nil then
    if #list ~= 1 then raise(("session: body.collisions: other: expected exactly one body as the first of the pair, got %d"):format(#list)) end
    list = {list[1], arguments.find(session, args.other)}
  end
  local on = args.on
  if on == nil then on = not session.world:may_collide(list[1], #list == 2 and list[2] or nil) end
  if #list == 0 or #list == 2 then return {{on, table.unpack(list)}} end
  local calls = {}
  for i, thing in ipairs(list) do calls[i] = {on, thing} end
  return calls
end

-- the body or robot that is put on another one: only one that moves freely
local function to_place(session, args)
  local list = arguments.find_several(session, args.body)
  if #list ~= 1 then raise(("session: body.place_on: body: expected one body or robot, got %d"):format(#list)) end
  local thing = list[1]
  if clench.type(thing) == "body" and thing.robot then thing = thing.robot end
  if clench.type(thing) == "robot" and thing.parent then raise(("session: body.place_on: '%s' is mounted on '%s'"):format(thing.name, thing.parent.name)) end
  local overlapped = args.on == nil and placing.overlapped(thing) or {}
  if #overlapped > 0 then raise(("session: body.place_on: '%s' overlaps '%s': choose a body to put it on, or move it above"):format(thing.name, table.concat(overlapped, "', '"))) end
  return thing
end

return {
  {name = "body.move", label = "Move…", menu = "Element", section = 2, enabled = conditions.world,
   parameters = {body, {name = "pose", type = "pose", in_dialog = pose_of_selected, text = "its new pose, in the world frame"},
                 {name = "stop_at_contact", type = "boolean", default = false, text = "true: it moves there along a straight line until first contact"}},
   run = function(session, args)
     local thing = arguments.find(session, args.body)
     if args.stop_at_contact then return thing:move_to(pose_of(args.pose)) end
     thing.pose = pose_of(args.pose)
   end,
   script = function(session, args)
     return (args.stop_at_contact and "%s:move_to(%s)" or "%s.pose = %s"):format(script.name_of(arguments.find(session, args.body)), script.literal(pose_of(args.pose)))
   end},
  {name = "body.place_on", label = "Place on…", menu = "Element", section = 2, enabled = conditions.world,
   parameters = {{name = "body", type = "body", optional = true, in_dialog = arguments.selected(1), text = "address of the body or robot that is moved; the selection by default"},
                 {name = "on", type = "body", optional = true, text = "address of the body or robot on which it is put, at the nearest free spot; by default it moves straight down until contact"}},
   run = function(session, args)
     local thing = to_place(session, args)
     if args.on == nil then
       local below = placing.drop(thing) or raise(("session: body.place_on: there is nothing below '%s'"):format(thing.name))
       clench.log.info(("'%s' rests on '%s'"):format(thing.name, below.name))
       return below
     end
     local support = arguments.find(session, args.on)
     if support == thing then raise(("session: body.place_on: on: expected another body than '%s'"):format(thing.name)) end
     if not placing.on(thing, support) then raise(("session: body.place_on: there is no free spot on '%s' for '%s'"):format(support.name, thing.name)) end
     clench.log.info(("'%s' rests on '%s'"):format(thing.name, support.name))
     return support
   end},
  {name = "body.remove", label = "Remove", menu = "Element", section = 2, shortcut = "delete", enabled = conditions.world, parameters = {bodies},
   run = function(session, args)
     for _, thing in ipairs(arguments.find_several(session, args.body)) do session.world:remove(thing) end
   end,
   script = function(session, args)
     return lines_for(arguments.find_several(session, args.body), function(thing) return ("world:remove(%s)"):format(script.name_of(thing)) end)
   end},
  {name = "body.collisions", label = "Collisions ON/OFF", menu = "Element", section = 3, enabled = conditions.world,
   parameters = {{name = "body", type = "body", optional = true, text = "address of a body or robot; the selection by default, and without one the complete world"},
                 {name = "other", type = "body", optional = true, text = "the other body of a pair; by default all bodies"},
                 {name = "on", type = "boolean", optional = true, text = "true: they collide; by default the present setting is inverted"}},
   run = function(session, args)
     for _, call in ipairs(collision_calls(session, args)) do session.world:set_collision(table.unpack(call)) end
   end,
   script = function(session, args)
     return lines_for(collision_calls(session, args), function(call)
       local names = names_of {table.unpack(call, 2)}
       return ("world:set_collision(%s%s)"):format(tostring(call[1]), names ~= "" and ", " .. names or "")
     end)
   end},
  setter("mass", "Mass…", {type = "number", min = 0, unit = "kg", text = "mass"}),
  setter("material", "Material…", {type = "string", suggested = function(session) return session.world.materials end, text = "name of a material"}),
  setter("transparency", "Transparency…", {type = "number", min = 0, max = 1, text = "0: opaque, 1: invisible"}),
  setter("color", "Color…", {type = "table", text = "red, green and blue, each from 0 to 1"}),
  setter("kind", "Dynamic or Static…", {type = "string", choices = {"object", "obstacle"}, text = "object: it moves in simulations and can be grasped; obstacle: it stays where it is"}),
  {name = "body.net_wrench", label = "Unbalanced Wrench…", menu = "Element", section = 4, enabled = conditions.world, reads = true,
   parameters = {{name = "body", type = "body", in_dialog = arguments.selected(1), text = "address of a body, or of a robot for its base"}},
   run = function(session, args) return net_wrench.of(arguments.find_body(session, args.body)) end},
  {name = "body.distance", label = "Distance…", menu = "Element", section = 4, shortcut = "v", enabled = conditions.world, reads = true,
   parameters = {{name = "a", type = "body", in_dialog = arguments.selected(1), text = "address of a body or robot"}, {name = "b", type = "body", in_dialog = arguments.selected(2), text = "address of the other body or robot"}},
   run = function(session, args) return session.world:distance(arguments.find(session, args.a), arguments.find(session, args.b)) end},
}
