--- Settings of the world: friction of materials, gravity, contacts and the time step.
local conditions = require "clench.session.conditions"
local script = require "clench.session.script"

local function materials(session) return session.world.materials end

local fields = {"time_step", "gravity", "contact_threshold"}

return {
  {name = "world.friction", label = "Friction…", menu = "File", section = 4, enabled = conditions.world,
   parameters = {{name = "a", type = "string", suggested = materials, text = "a material"}, {name = "b", type = "string", suggested = materials, text = "the other material"},
                 {name = "mu", type = "number", min = 0, max = 1000, text = "coefficient, static and kinetic unless `kinetic` is given"},
                 {name = "kinetic", type = "number", min = 0, max = 1000, optional = true, text = "kinetic coefficient"}},
   run = function(session, args) session.world:set_friction(args.a, args.b, {static = args.mu, kinetic = args.kinetic or args.mu}) end,
   script = function(_, args)
     return ("world:set_friction(%q, %q, %s)"):format(args.a, args.b, script.literal {static = args.mu, kinetic = args.kinetic or args.mu})
   end},
  {name = "world.settings", label = "Edit Settings…", menu = "File", section = 4, enabled = conditions.world,
   parameters = {{name = "time_step", type = "number", unit = "s", min = 1e-7, max = 1, optional = true, text = "length of a step"},
                 {name = "gravity", type = "vec3", optional = true, text = "acceleration of free fall [m/s^2]"},
                 {name = "contact_threshold", type = "number", unit = "m", min = 0, optional = true, text = "surfaces closer than this touch"}},
   run = function(session, args)
     for _, field in ipairs(fields) do
       if args[field] ~= nil then session.world[field] = args[field] end
     end
   end,
   script = function(_, args)
     local lines = {}
     for _, field in ipairs(fields) do
       if args[field] ~= nil then lines[#lines + 1] = ("world.%s = %s"):format(field, script.literal(args[field])) end
     end
     return table.concat(lines, "\n")
   end},
}
