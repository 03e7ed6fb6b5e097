--- Commands of the text protocol that step the world.
local units = require "clench.control.text.units"
local commands = {}

-- moveDynamicBodies [dt]
function commands.moveDynamicBodies(world, words)
  local dt = words:peek() and words:number "a time in seconds" or world.time_step
  words:done()
  if dt <= 0 then words.fail("moveDynamicBodies: expected a time > 0 s, got %s", units.text(dt)) end
  return {units.text(world:move_bodies(dt))}
end

-- computeNewVelocities dt: 0, or 1 if the solver did not reach its accuracy
function commands.computeNewVelocities(world, words)
  local dt = words:number "a time in seconds"
  words:done()
  if dt <= 0 then words.fail("computeNewVelocities: expected a time > 0 s, got %s", units.text(dt)) end
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
