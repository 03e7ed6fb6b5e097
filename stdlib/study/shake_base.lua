local read_options = require "clench.options"
local read_motion = require "clench.study.motion.options"
local bounds = require "clench.study.motion.bounds"
local new_trial = require "clench.study.motion.trial"
local verdict = require "clench.study.motion.verdict"

local axes = {{"x", clench.vec3(1, 0, 0)}, {"y", clench.vec3(0, 1, 0)}, {"z", clench.vec3(0, 0, 1)}}

--- Shakes the hand. In a copy of the world with only the hand, the robots that carry it and the object, the hand presses and everything comes to rest, as in
--- study.shake; then gravity acts, and the base that carries the hand oscillates sinusoidally along each axis of the world in turn, with the full amplitude
--- from the second period on.
---@param options table  hand, object and settings of motion and grip
---@like clench.study.shake  hand, object, world
---@option acceleration? number [m/s^2, > 0]  maximum acceleration, 9.81 by default
---@option amplitude? number [m, > 0]  amplitude of the motion, instead of the acceleration
---@option frequency? number [Hz, > 0] = 5  frequency of the motion
---@option seconds? number [s, > 0, <= 1000000] = 2  time along each axis
---@like clench.study.lift  mass, gravity
---@like clench.study.shake  max_distance, max_angle, grip, grip_seconds, settle, friction_share
---@like clench.study.lift  grip_force
---@like clench.study.shake  surroundings
---@return {survived: boolean, axes: table[], held: integer, settled: table, grip: string, grip_force: number, unlimited_efforts?: string[], contacts: integer, failures: integer, protocol: string} # axes: {axis, moved [m], turned [rad], held, time [s] at which it was lost}
---@effect long
--- > clench.study.shake_base({hand = hand, object = flask, seconds = 0.4, settle = 0.1, mass = 0.1, acceleration = 2}).survived  --> true
return function(options)
  local read = read_options("study.shake_base", options)
  local frequency, seconds = read:get "frequency", read:get "seconds"
  local rate = 2 * math.pi * frequency
  local acceleration
  if read:raw "amplitude" ~= nil then
    if read:raw "acceleration" ~= nil then read:fail "expected acceleration or amplitude, got both" end
    acceleration = read:get "amplitude" * rate ^ 2
  else
    acceleration = read:get("acceleration", 9.81)
  end
  local job = read_motion(read)
  read:done()
  bounds.check_frequency(read, frequency, job.world.time_step)
  if acceleration > bounds.acceleration then
    local name = read:raw "amplitude" ~= nil and "amplitude" or "acceleration"
    local largest = name == "amplitude" and bounds.acceleration / rate ^ 2 or bounds.acceleration
    read:expected(name, ("at most %g %s"):format(largest, name == "amplitude" and "m at that frequency" or "m/s^2"), read:raw(name))
  end
  local trial = new_trial(job)
  local result = verdict.new(trial, job, ("shaken along each axis with up to %.3g m/s^2 at %g Hz for %g s"):format(acceleration, frequency, seconds))
  for _, axis in ipairs(axes) do
    local row = verdict.attempt(trial, job, function()
      return trial:watch(seconds, function(time)
        local speed = acceleration / rate * math.sin(rate * time) * math.min(1, time * frequency)
        trial.root.base.velocity = {linear = axis[2] * speed}
      end, math.min(0.001, 0.02 / frequency))
    end)
    row.axis = axis[1]
    verdict.add(result, "axes", row, trial)
  end
  return verdict.close(result)
end
