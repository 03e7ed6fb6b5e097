--- Commands of the text protocol that step the world.
local units = require "clench.control.text.units"
local commands = {}

-- moveDynamicBodies [dt]: replies with the simulated time that has passed
function commands.moveDynamicBodies(world, words)
  local dt = words:seconds(world.time_step)
  words:done()
  return {units.text(world:move_bodies(dt))}
end

-- computeNewVelocities dt: replies with 0, or with 1 if the solver did not converge
function commands.computeNewVelocities(world, words)
  local dt = words:seconds()
  words:done()
  local before = world.report.failures
  world:solve_velocities(dt)
  return {world.report.failures == before and "0" or "1"}
end

-- render: listeners that display the world draw it again
function commands.render(_, words, session)
  words:done()
  session:emit("changed", {command = "render"})
  return {}
end

return commands
