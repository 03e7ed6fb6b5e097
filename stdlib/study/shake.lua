local read_options = require "clench.options"
local read_motion = require "clench.study.motion.options"
local bounds = require "clench.study.motion.bounds"
local push_along_axes = require "clench.study.motion.push_along_axes"
local new_trial = require "clench.study.motion.trial"
local verdict = require "clench.study.motion.verdict"

--- The six-direction force test. In a copy of the world with only the hand, the robots that carry it and the object, the hand first presses without gravity for
--- `grip_seconds`, and everything comes to rest for `settle`. Then a force pushes the object's center of mass along each axis of the world in turn, each time
--- from that state. Motors hold with the gains of their files; motors without gains get a natural frequency of 60 rad/s, with the object's mass at their lever
--- arm. The object is held while its displacement from that state, in the frame of the hand's base, is less than max_distance and max_angle.
--- The test is conservative: contacts have three quarters of their friction (`friction_share`), and touch within 0.02 mm, so that a grasp which needs the full
--- friction, or the full torsion of a contact patch, counts as lost.
--- The hand presses with "forces": motors hold its posture, and add the torques of contact forces in equilibrium, whose normal forces sum to `grip_force`;
--- compliant DOFs pull with their maximum effort. With "close", or if no such forces exist, the motors close it as autograsp {dynamic = true} does. Motors
--- exert efforts within hand.effort_ranges; joints without motors are free.
---@param options table  hand, object and settings of test and grip
---@option hand robot  hand that holds the object
---@option object body  object that is held
---@option world? world  world of both; a clone of it moves
---@option force? number [N, > 0] = 1  force on the object, at most that which accelerates it by 1e6 m/s^2
---@option seconds? number [s, > 0, <= 1000000] = 2  time in each direction
---@option mass? number [kg, > 0, <= 1e12] = 0.1  mass of the object
---@option gravity? vec3 [m/s^2] = {0, 0, 0}  gravity during the test
---@option max_distance? number [m, > 0] = 0.05  displacement in the hand beyond which the object is lost
---@option max_angle? number [rad, > 0] = 0.26179938779914941  rotation in the hand beyond which the object is lost; 15 degrees
---@option grip? "forces"|"close" = "forces"  forces: motors press with contact forces in equilibrium; close: they close the fingers
---@option grip_force? number [N, > 0, <= 1e15]  sum of the normal forces, ten times the force by default
---@option grip_seconds? number [s, >= 0, <= 1000000] = 0.5  time in which the grip grows
---@option settle? number [s, >= 0, <= 1000000] = 1  time to come to rest
---@option friction_share? number [> 0] = 0.75  factor on the friction between hand and object
---@option surroundings? boolean = false  true: all other bodies stay in the world
---@option until_lost? boolean = false  true: the test ends after the first direction in which the object is lost
---@return {survived: boolean, directions: table[], held: integer, settled: table, grip: string, grip_force: number, unlimited_efforts?: string[], contacts: integer, failures: integer, protocol: string} # survived: held in all directions; directions: {direction, moved [m], turned [rad], held, time [s] at which it was lost}; held: number of directions; settled: result of gripping, {moved [m], turned [rad], held}; failures: number of time steps not solved to the tolerance; grip: "forces", "close", or "none" if no motor closes the hand; grip_force: sum of the normal forces between hand and object at rest, measured [N]; unlimited_efforts: names of motors without a limit; protocol: a sentence that describes the test
---@effect long
--- > verdict = clench.study.shake {hand = hand, object = flask, seconds = 0.1, settle = 0.1}
--- > #verdict.directions, verdict.survived  --> 6, true
--- > clench.study.shake {hand = hand, object = flask, mas = 1}  --> error: unknown key 'mas'
return function(options)
  local read = read_options("study.shake", options)
  local force, seconds = read:get "force", read:get "seconds"
  local job = read_motion(read, 10 * force)
  local until_lost = read:get "until_lost"
  read:done()
  bounds.check_force(read, "force", force, job.mass)
  local trial = new_trial(job)
  local result = verdict.new(trial, job, ("%g N along each axis for %g s"):format(force, seconds))
  return push_along_axes(trial, job, result, seconds, function() return force end, {until_lost = until_lost, is_steady = true})
end
