local read_options = require "clench.options"
local read_motion = require "clench.study.motion.options"
local read_vector = require "clench.study.motion.read_vector"
local bounds = require "clench.study.motion.bounds"
local new_trial = require "clench.study.motion.trial"
local verdict = require "clench.study.motion.verdict"

local ramp = 0.1  -- in which the speed is reached, and lost again [s]

--- A lift. In a copy of the world the hand presses without gravity and all comes to rest, as in study.shake; then gravity acts, what
--- carries the hand moves up with it, whatever its joints could do, and stays up for a while. The object is held while it is displaced by less than
--- max_distance and max_angle, as the hand's base sees it. What else stands in the world stays there.
---@param options {hand: robot, object: body, world?: world, height?: number, speed?: number, hold?: number, direction?: vec3, mass?: number, gravity?: vec3, max_distance?: number, max_angle?: number, grip?: string, grip_force?: number, grip_seconds?: number, settle?: number, friction_share?: number, surroundings?: boolean}  height: 0.1 [m]; speed: 0.1 [m/s]; hold: 1 [s]; direction: up; mass: the object's [kg]; gravity: the world's [m/s^2]; grip_force: ten weights [N]; surroundings: true; the others as in study.shake
---@return {survived: boolean, rows: table[], held: integer, settled: table, grip: string, grip_force: number, unlimited_efforts?: string[], contacts: integer, failures: integer, protocol: string} # rows: of "gravity", "lift" and "hold", {phase, moved [m], turned [rad], held, time [s] at which it was lost}, as far as it came
--- > clench.study.lift({hand = hand, object = flask, height = 0.02, hold = 0.1, settle = 0.1, mass = 0.1}).survived  --> true
return function(options)
  local read = read_options("study.lift", options)
  local height, speed, hold = read:positive("height", 0.1, 1e6), read:positive("speed", 0.1, bounds.speed), read:not_negative("hold", 1, bounds.seconds)
  local direction = read_vector(read, "direction", clench.vec3(0, 0, 1), 1e6)
  if direction:norm() < 1e-9 then read:fail "direction must not be zero" end
  local job = read_motion(read, {surroundings = true})
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
  -- a short way has no room for the speed
  local length = height / speed + ramp
  local top = height / (length - ramp)
  -- as fast as in the middle of the step that comes
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
