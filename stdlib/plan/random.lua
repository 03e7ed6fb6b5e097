local sampling = require "clench.plan.sampling"

--- Random approaches without refinement or verification, as a baseline for other planners.
---@param options table  hand, object and settings of the search
---@like clench.plan.anneal  hand, object
---@option count? integer [1 to 1000000] = 100  the search ends once it has found this many grasps, and returns the best of them
---@option candidates? integer [1 to 1000000000] = 100000  maximum number of candidates
---@like clench.plan.anneal  seconds, seed, threads
---@option standoff? number [m, > 0, <= 10] = 0.15  distance of the middle between thumb and fingers from the surface at the start
---@option distance? number [>= 0] = 0.1  grasps count as similar if they differ by less than this fraction of the object's radius, of half a turn
---  and of the ranges of the DOFs
---@like clench.plan.anneal  contacts, touch
---@option keep_searching? boolean = false  true: the search continues until its time or its candidates are used up, and returns the best
---  `count` grasps
---@option on_grasp? function  on_grasp(grasp) is called for each grasp that is found
---@option on_progress? function  on_progress(state) is called as candidates are tried, with {candidates, grasps, rejected = counts by
---  reason, elapsed [s], hint = a sentence that says whether friction, force or effort is too small}
---@like clench.plan.anneal  grasp, world, max_effort
---@return {grasps: grasps, report: table} # grasps in force closure, in order of decreasing epsilon
---@effect long
--- > run = clench.plan.random {hand = hand, object = flask, count = 3}
--- > run.grasps[1].epsilon > 0  --> true
--- > clench.plan.random {hand = hand, object = flask, refine = 3}  --> error: unknown key 'refine'
return function(options) return sampling("random", options) end
