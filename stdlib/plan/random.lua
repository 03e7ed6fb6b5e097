local sampling = require "clench.plan.sampling"

--- Random approaches alone, neither improved nor verified: what other planners are compared with.
---@param options table  the hand, the object and how the search goes
---@option hand robot  hand that grasps; it moves in a clone of its world
---@option object body  object that is grasped
---@option count? integer [1 to 1000000] = 100  the best of those that were found when there were as many
---@option candidates? integer [1 to 1000000000] = 100000  largest number of candidates
---@option seconds? number [s, > 0]  time limit, unlimited by default
---@option seed? integer = 1  seed of the random numbers
---@option threads? integer [1 to 1024] = 1  number of threads; the grasps do not depend on it
---@option standoff? number [m, > 0, <= 10] = 0.15  distance of the middle between thumb and fingers from the surface at the start
---@option distance? number [>= 0] = 0.1  grasps nearer than this part of the radius of the object, of half a turn and of the ranges of the
---  DOFs are alike
---@option contacts? "fingertip"|"power"|"any"  fingertip: only the last links of fingers touch; power: the palm touches as well
---@option touch? table  {must = names of links, or lists of which one must touch, may = names}, in place of contacts
---@option keep_searching? boolean = false  true: the search continues until its time or its candidates run out, and the best `count` are
---  kept
---@option on_grasp? function  on_grasp(grasp) is called for each grasp that is found
---@option on_progress? function  on_progress(state) is called as candidates are tried, with {candidates, grasps, rejected = counts by
---  reason, elapsed [s], hint = a sentence that names which of friction, force and effort is too small}
---@option grasp? table  options of clench.grasp
---@option world? world  world of both that the planner moves instead of that of the hand
---@option max_effort? number [N m or N, > 0]  largest torque or force of motors without a limit
---@return {grasps: grasps, report: table} # in force closure, the largest epsilon first
--- > run = clench.plan.random {hand = hand, object = flask, count = 3}
--- > run.grasps[1].epsilon > 0  --> true
--- > clench.plan.random {hand = hand, object = flask, refine = 3}  --> error: unknown key 'refine'
return function(options) return sampling("random", options) end
