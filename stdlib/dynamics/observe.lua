--- Calls the logs and recordings of a world that a script steps itself by move_bodies and solve_velocities.
local calls = require "clench.dynamics.hook_calls"

---@param hooks table  of stdlib/dynamics/hooks.lua
---@param world world
return function(hooks, world)
  if not hooks.observers then return end
  hooks.runs = true
  local running <close> = setmetatable({}, {__close = function() hooks.runs = nil end})
  calls.observers(world, hooks.observers)
end
