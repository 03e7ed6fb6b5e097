--- Commands of the File menu: worlds, their files, and imports.
local conditions = require "clench.session.conditions"
local history = require "clench.session.history"
local placing = require "clench.session.placing"
local raise = require "clench.raise"
local script = require "clench.session.script"

-- scenes of MuJoCo are of the kind robot; of a robot or a body, a world is made
local world_path = {name = "path", type = "string", files = {kinds = {"world", "robot", "body"}, catalog = {"worlds"}}, text = "a file"}
local options = {name = "options", type = "table", optional = true, text = "options of the function that reads it"}

local function pose_of(value) return clench.type(value) == "pose" and value or clench.pose(value) end

local function call(name, args)
  return args.options and ("%s(%s, %s)"):format(name, script.literal(args.path), script.literal(args.options)) or ("%s(%s)"):format(name, script.literal(args.path))
end

local pose = {name = "pose", type = "pose", optional = true, text = "its pose in the world; by default that of `place`"}
local place = {name = "place", type = "string", choices = {"origin", "free"}, default = "origin", in_dialog = "free",
               text = "without a pose: at the origin, or free: an object on the selected or largest obstacle; anything else at the origin if that is free, or else on an obstacle or beside the rest"}

local function point_text(thing)
  local p = thing.pose.position
  return ("(%.3f, %.3f, %.3f)"):format(p.x, p.y, p.z)
end

local function kind_of(thing) return clench.type(thing) == "body" and thing.kind or "robot" end

-- lowers a new body on the selected obstacle, or on another one; returns that, or nil
local function put_on_support(session, thing)
  local chosen = session.selection[1]
  local list = placing.supports(thing)
  if #session.selection == 1 and kind_of(chosen) == "obstacle" and chosen ~= thing then table.insert(list, 1, chosen) end
  for _, support in ipairs(list) do
    if placing.on(thing, support) then return support end
  end
end

-- places a new body or robot where it is free, and reports where and why
local function place_free(session, thing)
  local overlapped = placing.overlapped(thing)
  local is_free = #overlapped == 0
  local support = (kind_of(thing) == "object" or not is_free) and put_on_support(session, thing)
  local why = is_free and "" or (": at the origin of the world it would overlap '%s'"):format(table.concat(overlapped, "', '"))
  if support then
    return clench.log.info(("'%s' rests on '%s', its origin at %s m%s"):format(thing.name, support.name, point_text(thing), why))
  end
  if is_free then return clench.log.info(("'%s' is at the origin of the world, where it overlaps nothing"):format(thing.name)) end
  placing.beside(thing)
  clench.log.info(("'%s' is beside the rest, its origin at %s m%s"):format(thing.name, point_text(thing), why))
end

local function import(kind, label, files)
  local method = "add_" .. kind
  local path = {name = "path", type = "string", files = files, text = "a file"}
  -- the options of the function that reads it, with the pose
  local function reading_of(args, at)
    if not at then return args.options end
    local options = {pose = at}
    for name, value in pairs(args.options or {}) do options[name] = options[name] or value end
    return options
  end
  local function is_free(args) return args.place == "free" and not args.pose and not (args.options and args.options.pose) end
  local function lines(args, at) return call("world:" .. method, {path = args.path, options = reading_of(args, at)}) end
  return {
    name = "world.import_" .. kind, label = label, menu = "File", section = 3, enabled = conditions.world, parameters = {path, pose, place, options},
    run = function(session, args)
      local added = session.world[method](session.world, args.path, reading_of(args, args.pose and pose_of(args.pose)))
      if is_free(args) then place_free(session, added) end
      local is_hand = kind == "robot" and (#added.chains > 1 or not session.hand or #session.hand.chains <= 1)  -- an arm does not replace a hand
      if is_hand then session.hand = added elseif kind == "object" then session.object = added end
      return added
    end,
    script = function(_, args)
      if is_free(args) then return function(added) return lines(args, added.pose) end end
      return lines(args, args.pose and pose_of(args.pose))
    end,
  }
end

local function save(session, to)
  session:end_gesture()
  session.world:save(to)
  session.path, session.saved_at = to, session.history.done[#session.history.done]
  return to
end

return {
  {name = "world.new", label = "New", menu = "File", section = 1, shortcut = "ctrl+n", run = function(session) history.take(session, clench.world()) session.path = nil end,
   script = function() return "world = clench.world()" end},
  {name = "world.open", label = "Open…", menu = "File", section = 1, shortcut = "ctrl+o", parameters = {world_path, options},
   run = function(session, args)
     history.take(session, clench.load(args.path, args.options))
     session.path = args.path
   end,
   script = function(_, args) return "world = " .. call("clench.load", args) end},
  {name = "world.save", label = "Save", menu = "File", section = 2, shortcut = "ctrl+s", enabled = conditions.world, reads = true,
   parameters = {{name = "path", type = "string", optional = true, text = "the file; by default the one that was opened or saved last"}},
   run = function(session, args)
     return save(session, args.path or session.path or raise "session: world.save: path: expected a file, as the world has no file yet")
   end},
  {name = "world.save_as", label = "Save As…", menu = "File", section = 2, shortcut = "ctrl+shift+s", enabled = conditions.world, reads = true,
   parameters = {{name = "path", type = "string", files = {endings = {".wld", ".xml", ".mjcf", ".lua"}, writes = true, ending = ".wld"}, text = "a file; .wld is appended to a name without an extension"}},
   run = function(session, args) return save(session, args.path) end},
  {name = "world.save_image", label = "Save Image…", menu = "File", section = 5, enabled = conditions.world, reads = true, long = true,
   parameters = {{name = "path", type = "string", files = {endings = {".png"}, writes = true, ending = ".png"}, text = "a file; .png is appended to a name without an extension"},
                 {name = "options", type = "table", optional = true, text = "options of clench.render"}},
   run = function(session, args)
     clench.render(session.world, args.options):save(args.path)
     return args.path
   end},
  import("robot", "Import Robot…", {kinds = {"robot"}, catalog = {"hands", "arms"}}), import("object", "Import Object…", {kinds = {"body"}, catalog = {"objects"}}),
  import("obstacle", "Import Obstacle…", {kinds = {"body"}, catalog = {"obstacles"}}),
}
