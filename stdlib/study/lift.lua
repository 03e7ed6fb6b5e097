local read_options = require "clench.options"
local read_motion = require "clench.study.motion.options"
local read_vector = require "clench.study.motion.read_vector"
local bounds = require "clench.study.motion.bounds"
local new_trial = require "clench.study.motion.trial"
local verdict = require "clench.study.motion.verdict"

local ramp = 0.1  -- time to accelerate, and to decelerate [s]

--- Lifts a grasped object. In a copy of the world the hand presses without gravity and everything comes to rest, as in study.shake; then gravity acts, and the
--- base of the hand, or of the robot that carries it, moves along `direction`, regardless of what joints could do, and stops for `hold`. The object is held
--- while its displacement, in the frame of the hand's base, is less than max_distance and max_angle. All other bodies keep their poses.
---@param options table  hand, object and settings of motion and grip
---@like clench.study.shake  hand, object, world
---@option height? number [m, > 0, <= 1000000] = 0.1  height of the lift
---@option speed? number [m/s, > 0, <= 1000000] = 0.1  speed of the lift
---@option hold? number [s, >= 0, <= 1000000] = 1  time for which the object is held at the end
---@option direction? vec3 = {0, 0, 1}  direction of the lift, of any nonzero length
---@option mass? number [kg, > 0, <= 1e12]  mass of the object, by default that in the world
---@option gravity? vec3 [m/s^2]  gravity, by default that of the world
---@like clench.study.shake  max_distance, max_angle, grip, grip_seconds, settle, friction_share
---@option grip_force? number [N, > 0, <= 1e15]  sum of the normal forces, ten weights of the object by default
---@option surroundings? boolean = true  false: all bodies except hand, carrier and object are removed
---@return {survived: boolean, rows: table[], held: integer, settled: table, grip: string, grip_force: number, unlimited_efforts?: string[], contacts: integer, failures: integer, protocol: string} # rows: one for each of the phases "gravity", "lift" and "hold" that was reached, {phase, moved [m], turned [rad], held, time [s] at which it was lost}
---@effect long
--- > clench.study.lift({hand = hand, object = flask, height = 0.02, hold = 0.1, settle = 0.1, mass = 0.1}).survived  --> true
return function(options)
  local read = read_options("study.lift", options)
  local height, speed, hold = read:get "height", read:get "speed", read:get "hold"
  local direction = read_vector(read, "direction", nil, 1e6)
  if direction:norm() < 1e-9 then read:fail "direction must not be zero" end
  local job = read_motion(read)
  read:done()
  direction = direction / direction:norm()
  local trial = new_trial(job)
  local result = verdict.new(trial, job, ("lifted by %g m at %g m/s, and held for %g s"):format(height, speed, hold))
  local function add(phase, row)
    row.phase = phase
    verdict.add(result, "rows", row, trial)
    return row.held
  end
  if not trial.settled.held then
    add("gravity", verdict.lost_before(trial))
    return verdict.close(result)
  end
  trial.world.gravity = job.gravity
  -- a short lift does not reach the speed
  local length = height / speed + ramp
  local top = height / (length - ramp)
  -- speed at the middle of the next step
  local function rise()
    local began = trial.world.time
    return trial.world:on_step(function(world, dt)
      local time = world.time - began
      local part = math.min(1, (time + dt / 2) / ramp, (length - time) / ramp)
      trial.root.base.velocity = {linear = direction * (top * part)}
    end)
  end
  local function lift()
    local rising = rise()
    local row = trial:watch(length)
    rising:remove()
    return row
  end
  if add("gravity", trial:watch_steady(0.2)) and add("lift", lift()) then
    trial:halt()
    if hold > 0 then add("hold", trial:watch_steady(hold)) end
  end
  return verdict.close(result)
end
