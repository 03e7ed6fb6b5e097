--- Commands of the File menu: worlds, their files, and imports.
local conditions = require "clench.session.conditions"
local history = require "clench.session.history"
local raise = require "clench.raise"
local script = require "clench.session.script"
local with_ending = require "clench.session.with_ending"

local path = {name = "path", type = "string", text = "a file"}
local options = {name = "options", type = "table", optional = true, text = "options of the function that reads it"}

local function call(name, args)
  return args.options and ("%s(%s, %s)"):format(name, script.literal(args.path), script.literal(args.options)) or ("%s(%s)"):format(name, script.literal(args.path))
end

local function import(kind, label)
  local method = "add_" .. kind
  return {
    name = "world.import_" .. kind, label = label, menu = "File", enabled = conditions.world, parameters = {path, options},
    run = function(session, args)
      local added = session.world[method](session.world, args.path, args.options)
      if kind == "robot" then session.hand = added elseif kind == "object" then session.object = added end
      return added
    end,
    script = function(_, args) return call("world:" .. method, args) end,
  }
end

local function save(session, to)
  session:end_gesture()
  session.world:save(to)
  session.path, session.saved_at = to, session.history.done[#session.history.done]
  return to
end

return {
  {name = "world.new", label = "New", menu = "File", shortcut = "ctrl+n", run = function(session) history.take(session, clench.world()) session.path = nil end,
   script = function() return "world = clench.world()" end},
  {name = "world.open", label = "Open…", menu = "File", shortcut = "ctrl+o", parameters = {path, options},
   run = function(session, args)
     history.take(session, clench.load(args.path, args.options))
     session.path = args.path
   end,
   script = function(_, args) return "world = " .. call("clench.load", args) end},
  {name = "world.save", label = "Save", menu = "File", shortcut = "ctrl+s", enabled = conditions.world, reads = true,
   parameters = {{name = "path", type = "string", optional = true, text = "the file; by default the one that was opened or saved last"}},
   run = function(session, args)
     return save(session, args.path or session.path or raise "session: world.save: path: expected a file, as the world has no file yet")
   end},
  {name = "world.save_as", label = "Save As…", menu = "File", shortcut = "ctrl+shift+s", enabled = conditions.world, reads = true,
   parameters = {{name = "path", type = "string", text = "a file; .wld is appended to a name without an extension"}},
   run = function(session, args) return save(session, with_ending(args.path, ".wld")) end},
  {name = "world.save_image", label = "Save Image…", menu = "File", enabled = conditions.world, reads = true, long = true,
   parameters = {{name = "path", type = "string", text = "a file; .png is appended to a name without an extension"},
                 {name = "options", type = "table", optional = true, text = "options of clench.render"}},
   run = function(session, args)
     local to = with_ending(args.path, ".png")
     clench.render(session.world, args.options):save(to)
     return to
   end},
  import("robot", "Import Robot…"), import("object", "Import Object…"), import("obstacle", "Import Obstacle…"),
}
