local read_options = require "clench.options"
local read_motion = require "clench.study.motion.options"
local bounds = require "clench.study.motion.bounds"
local push_along_axes = require "clench.study.motion.push_along_axes"
local new_trial = require "clench.study.motion.trial"
local verdict = require "clench.study.motion.verdict"

--- Load and time at which a hand loses an object. The hand presses as in study.shake; then a force at the object's center of mass grows along each axis of the
--- world in turn, from zero by `rate`, until the object is displaced by max_distance or max_angle.
---@param options table  hand, object and settings of test and grip
---@like clench.study.shake  hand, object, world
---@option rate? number [N/s, > 0] = 5  growth of the force
---@option max_force? number [N, > 0] = 20  force at which the test ends
---@like clench.study.shake  mass, gravity, max_distance, max_angle, grip, grip_seconds, settle, friction_share, surroundings
---@option grip_force? number [N, > 0, <= 1e15] = 10  sum of the normal forces
---@return {survived: boolean, directions: table[], min_force: number, min_time: number, held: integer, settled: table, grip: string, grip_force: number, unlimited_efforts?: string[], contacts: integer, failures: integer, protocol: string} # survived: held in all directions; directions: {direction, force [N] and time [s] at which it was lost or the test ended, moved [m], turned [rad], held}; min_force, min_time: minima over all directions
---@effect long
--- > clench.study.fall_off({hand = hand, object = flask, rate = 10, max_force = 2, settle = 0.1}).min_force  --> 2.0
return function(options)
  local read = read_options("study.fall_off", options)
  local rate, most = read:get "rate", read:get "max_force"
  local job = read_motion(read)
  read:done()
  bounds.check_force(read, "max_force", most, job.mass)
  if most / rate > bounds.seconds then
    read:expected("rate", ("at least %g N/s, to reach max_force in a million seconds"):format(most / bounds.seconds), rate)
  end
  local trial = new_trial(job)
  local result = verdict.new(trial, job, ("a force along each axis that grows by %g N/s up to %g N"):format(rate, most))
  result.min_force, result.min_time = math.huge, math.huge
  local seconds = most / rate
  return push_along_axes(trial, job, result, seconds, function(time) return rate * time end, {note = function(row)
    row.time = row.time or seconds
    row.force = rate * row.time
    result.min_force, result.min_time = math.min(result.min_force, row.force), math.min(result.min_time, row.time)
  end})
end
