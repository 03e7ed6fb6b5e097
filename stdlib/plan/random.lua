local sampling = require "clench.plan.sampling"

--- Random approaches alone, neither improved nor verified: what other planners are compared with.
---@param options table  the hand, the object and how the search goes
---@like clench.plan.anneal  hand, object
---@option count? integer [1 to 1000000] = 100  the best of those that were found when there were as many
---@option candidates? integer [1 to 1000000000] = 100000  largest number of candidates
---@like clench.plan.anneal  seconds, seed, threads
---@option standoff? number [m, > 0, <= 10] = 0.15  distance of the middle between thumb and fingers from the surface at the start
---@option distance? number [>= 0] = 0.1  grasps nearer than this part of the radius of the object, of half a turn and of the ranges of the
---  DOFs are alike
---@like clench.plan.anneal  contacts, touch
---@option keep_searching? boolean = false  true: the search continues until its time or its candidates run out, and the best `count` are
---  kept
---@option on_grasp? function  on_grasp(grasp) is called for each grasp that is found
---@option on_progress? function  on_progress(state) is called as candidates are tried, with {candidates, grasps, rejected = counts by
---  reason, elapsed [s], hint = a sentence that names which of friction, force and effort is too small}
---@like clench.plan.anneal  grasp, world, max_effort
---@return {grasps: grasps, report: table} # in force closure, the largest epsilon first
--- > run = clench.plan.random {hand = hand, object = flask, count = 3}
--- > run.grasps[1].epsilon > 0  --> true
--- > clench.plan.random {hand = hand, object = flask, refine = 3}  --> error: unknown key 'refine'
return function(options) return sampling("random", options) end
