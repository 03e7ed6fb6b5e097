--- Commands of the original's File menu: worlds and what they contain.
local arguments = require "clench.session.arguments"
local history = require "clench.session.history"
local raise = require "clench.raise"
local script = require "clench.session.script"

local function world_of(session) return session.world or raise "session: no world is open" end
local function has_world(session) return session.world ~= nil, "no world is open" end

local path = {name = "path", type = "string", text = "a file"}
local options = {name = "options", type = "table", optional = true, text = "of the function that reads it"}

local function call(name, args)
  return args.options and ("%s(%s, %s)"):format(name, script.literal(args.path), script.literal(args.options)) or ("%s(%s)"):format(name, script.literal(args.path))
end

local function import(kind, method)
  return {
    name = "world.import_" .. kind, label = "Import " .. kind, menu = "File", enabled = has_world, parameters = {path, options},
    run = function(session, args)
      local added = session.world[method](session.world, args.path, args.options)
      if kind == "robot" then session.hand = added elseif kind == "object" then session.object = added end
      return added
    end,
    script = function(_, args) return call("world:" .. method, args) end,
  }
end

return {
  {name = "world.new", label = "New world", menu = "File", run = function(session) history.take(session, clench.world()) session.path = nil end,
   script = function() return "world = clench.world()" end},
  {name = "world.open", label = "Open", menu = "File", shortcut = "Ctrl+O", parameters = {path, options},
   run = function(session, args)
     history.take(session, clench.load(args.path, args.options))
     session.path = args.path
   end,
   script = function(_, args) return "world = " .. call("clench.load", args) end},
  {name = "world.save", label = "Save", menu = "File", shortcut = "Ctrl+S", enabled = has_world, reads = true,
   parameters = {{name = "path", type = "string", optional = true, text = "the file that was opened or saved last, unless given"}},
   run = function(session, args)
     local to = args.path or session.path or raise "session: world.save: path: expected a file, as the world has none yet"
     session.world:save(to)
     session.path, session.saved_at = to, session.history.done[#session.history.done]
     return to
   end},
  import("robot", "add_robot"), import("object", "add_object"), import("obstacle", "add_obstacle"),
  {name = "world.select", label = "Select", enabled = has_world, reads = true,
   parameters = {{name = "addresses", type = "table", text = "of bodies and robots"}},
   run = function(session, args)
     local selection = {}
     for i, address in ipairs(args.addresses) do selection[i] = arguments.find(session, address) end
     session.selection = selection
   end},
  {name = "world.friction", label = "Friction", menu = "File", enabled = has_world,
   parameters = {{name = "a", type = "string", text = "a material"}, {name = "b", type = "string", text = "the other one"},
                 {name = "mu", type = "number", min = 0, max = 1000, text = "coefficient, static and kinetic"}},
   run = function(session, args) world_of(session):set_friction(args.a, args.b, {static = args.mu, kinetic = args.mu}) end,
   script = function(_, args) return ("world:set_friction(%q, %q, {static = %s, kinetic = %s})"):format(args.a, args.b, script.literal(args.mu), script.literal(args.mu)) end},
}
