local read_options = require "clench.options"
local read_motion = require "clench.study.motion.options"
local bounds = require "clench.study.motion.bounds"
local push_along_axes = require "clench.study.motion.push_along_axes"
local new_trial = require "clench.study.motion.trial"
local verdict = require "clench.study.motion.verdict"

--- The six-direction force test. In a copy of the world that holds nothing but the hand, what carries it and the object, the
--- hand first presses without gravity, `grip_seconds` long, and all comes to rest, `settle` long. Then a force pushes the object's center of mass along each axis of the
--- world in turn, each time from that state. Motors hold with the gains of their files; those without swing back at 60 rad/s with the object's mass on their lever. The object is held while it is displaced from there, as the hand's base sees it, by
--- less than max_distance and max_angle.
--- What holds only if its friction, or the torsion of a patch of contacts, is all that the model says, is called lost: contacts have three quarters of
--- their friction (`friction_share`), and touch within 0.02 mm.
--- The hand presses with "forces": motors hold its posture, and add the torques of contact forces in equilibrium, `grip_force` the
--- sum of their normals; compliant DOFs pull as hard as they can. With "close", and where no such forces exist, its motors close it as autograsp {dynamic = true} does. Motors exert what hand.effort_ranges allow; joints that no motor drives are free.
---@param options table  the grasp, the test and the grip
---@option hand robot  hand that holds the object
---@option object body  object that is held
---@option world? world  world of both; a clone of it moves
---@option force? number [N, > 0] = 1  force on the object, at most that of 1e6 m/s^2
---@option seconds? number [s, > 0, <= 1000000] = 2  time in each direction
---@option mass? number [kg, > 0, <= 1e12] = 0.1  mass of the object
---@option gravity? vec3 [m/s^2] = {0, 0, 0}  gravity during the test
---@option max_distance? number [m, > 0] = 0.05  the object is lost when it has moved farther in the hand
---@option max_angle? number [rad, > 0] = 0.26179938779914941  the object is lost when it has turned by more in the hand; 15 degrees
---@option grip? "forces"|"close" = "forces"  forces: motors press with contact forces in equilibrium; close: they close the fingers
---@option grip_force? number [N, > 0, <= 1e15]  sum of the normal forces, ten times the force by default
---@option grip_seconds? number [s, >= 0, <= 1000000] = 0.5  time in which the grip grows
---@option settle? number [s, >= 0, <= 1000000] = 1  time to come to rest
---@option friction_share? number [> 0] = 0.75  share of the friction between hand and object that is counted on
---@option surroundings? boolean = false  true: everything else stays
---@option until_lost? boolean = false  true: the first direction in which the object is lost is the last one
---@return {survived: boolean, directions: table[], held: integer, settled: table, grip: string, grip_force: number, unlimited_efforts?: string[], contacts: integer, failures: integer, protocol: string} # survived: it was held in all directions; directions: {direction, moved [m], turned [rad], held, time [s] at which it was lost}; held: in how many; settled: what the grip came to, moved and turned since the hand was as it stands, held where nothing was lost while all came to rest; failures: steps that were not solved to the tolerance; grip: "forces", "close", or "none" where no motor closes the hand; grip_force: sum of the normal forces between hand and object at rest, measured [N]; unlimited_efforts: names of motors without a limit; protocol: what was done, in a sentence
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
