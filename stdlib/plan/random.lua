local sampling = require "clench.plan.sampling"

--- Random approaches alone, neither improved nor verified: what other planners are compared with.
---@param options {hand: robot, object: body, count?: integer, candidates?: integer, seconds?: number, seed?: integer, threads?: integer, standoff?: number, distance?: number, on_grasp?: function, grasp?: table, world?: world, max_effort?: number}  as of plan.sample; max_effort: of motors without a limit [N m or N]
---@return {grasps: grasps, report: table} # in force closure, the largest epsilon first
--- > run = clench.plan.random {hand = hand, object = flask, count = 3}
--- > run.grasps[1].epsilon > 0  --> true
--- > clench.plan.random {hand = hand, object = flask, refine = 3}  --> error: unknown key 'refine'
return function(options) return sampling("random", options) end
