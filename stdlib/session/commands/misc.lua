--- Commands of the Misc. menu.
local conditions = require "clench.session.conditions"
local script = require "clench.session.script"

return {
  {name = "world.build_arch", label = "Arch Builder…", menu = "Misc.", enabled = conditions.world,
   parameters = {{name = "inner_radius", type = "number", min = 1e-3, unit = "m", default = 0.9, text = "radius of the opening"},
                 {name = "outer_radius", type = "number", min = 1e-3, unit = "m", default = 1.1, text = "radius of the outside"},
                 {name = "thickness", type = "number", min = 1e-3, unit = "m", default = 0.2, text = "size across the arch"},
                 {name = "blocks", type = "integer", min = 3, max = 200, default = 9, text = "number of stone blocks, each of which spans pi / blocks"},
                 {name = "supports", type = "boolean", default = true, text = "true: it stands on two supports"}},
   run = function(session, args) return clench.build_arch(session.world, args) end,
   script = function(_, args) return ("clench.build_arch(world, %s)"):format(script.literal(args)) end},
}
