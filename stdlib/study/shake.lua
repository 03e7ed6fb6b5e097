local read_options = require "clench.options"
local read_motion = require "clench.study.motion.options"
local bounds = require "clench.study.motion.bounds"
local push_along_axes = require "clench.study.motion.push_along_axes"
local new_trial = require "clench.study.motion.trial"
local verdict = require "clench.study.motion.verdict"

--- The six-direction force test. In a copy of the world that holds nothing but the hand, what carries it and the object, the
--- hand first presses without gravity, `grip_seconds` long, and all comes to rest, `settle` long. Then a force pushes the object's centre of mass along each axis of the
--- world in turn, each time from that state. Motors hold with the gains of their files; those without swing back at 60 rad/s with the object's mass on their lever. The object is held while it is displaced from there, as the hand's base sees it, by
--- less than max_distance and max_angle.
--- What holds only if its friction, or the torsion of a patch of contacts, is all that the model says, is called lost: contacts have three quarters of
--- their friction (`friction_share`), and touch within 0.02 mm.
--- The hand presses with "forces": motors hold its posture, and add the torques of contact forces in equilibrium, `grip_force` the
--- sum of their normals; compliant DOFs pull as hard as they can. With "close", and where no such forces exist, its motors close it as autograsp {dynamic = true} does. Motors exert what hand.effort_ranges allow; joints that no motor drives are free.
---@param options {hand: robot, object: body, world?: world, force?: number, seconds?: number, mass?: number, gravity?: vec3, max_distance?: number, max_angle?: number, grip?: string, grip_force?: number, grip_seconds?: number, settle?: number, friction_share?: number, surroundings?: boolean, until_lost?: boolean}  force: 1 [N]; seconds: 2 in each direction; mass of the object: 0.1 [kg]; gravity: none [m/s^2]; max_distance: 0.05 [m]; max_angle: 15 degrees [rad]; grip: "forces" or "close"; grip_force: ten times the force [N]; grip_seconds: 0.5; settle: 1 [s]; friction_share: of the friction between hand and object that is counted on, 0.75; surroundings: false, true: everything else stays; until_lost: false, true: the first direction in which it is lost is the last one
---@return {survived: boolean, directions: table[], held: integer, settled: table, grip: string, grip_force: number, unlimited_efforts?: string[], contacts: integer, failures: integer, protocol: string} # survived: it was held in all directions; directions: {direction, moved [m], turned [rad], held, time [s] at which it was lost}; held: in how many; settled: what the grip came to, moved and turned since the hand was as it stands, held where nothing was lost while all came to rest; failures: steps that were not solved to the tolerance; grip: "forces", "close", or "none" where no motor closes the hand; grip_force: sum of the normal forces between hand and object at rest, measured [N]; unlimited_efforts: names of motors without a limit; protocol: what was done, in a sentence
--- > verdict = clench.study.shake {hand = hand, object = flask, seconds = 0.1, settle = 0.1}
--- > #verdict.directions, verdict.survived  --> 6, true
--- > clench.study.shake {hand = hand, object = flask, mas = 1}  --> error: unknown key 'mas'
return function(options)
  local read = read_options("study.shake", options)
  local force, seconds = read:positive("force", 1), read:positive("seconds", 2, bounds.seconds)
  local job = read_motion(read, {mass = 0.1, gravity = clench.vec3(0, 0, 0), grip_force = 10 * force})
  local until_lost = read:flag "until_lost"
  read:done()
  bounds.check_force(read, "force", force, job.mass)
  local trial = new_trial(job)
  local result = verdict.new(trial, job, ("%g N along each axis for %g s"):format(force, seconds))
  return push_along_axes(trial, job, result, seconds, function() return force end, {until_lost = until_lost, is_steady = true})
end
