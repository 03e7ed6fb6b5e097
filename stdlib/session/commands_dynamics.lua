--- Commands of the original's Dynamics menu.
local script = require "clench.session.script"

local function has_world(session) return session.world ~= nil, "no world is open" end

return {
  {name = "dynamics.run", label = "Run dynamics", menu = "Dynamics", enabled = has_world, long = true,
   parameters = {{name = "seconds", type = "number", min = 0, max = 1e6, unit = "s", default = 1, text = "of simulated time"}},
   run = function(session, args) session.world:run(args.seconds) end,
   script = function(_, args) return ("world:run(%s)"):format(script.literal(args.seconds)) end},
  {name = "dynamics.push", label = "Push state", menu = "Dynamics", enabled = has_world, run = function(session) table.insert(session.stack, session.world:snapshot()) end,
   script = function() return "world:push()" end},
  {name = "dynamics.pop", label = "Pop state", menu = "Dynamics", enabled = function(session) return #session.stack > 0, "no state was pushed" end,
   run = function(session) session.world:restore(table.remove(session.stack)) end,
   script = function() return "world:pop()" end},
}
