local sample = require "clench.plan.sample"

--- Random approaches alone, neither improved nor verified: what other planners are compared with.
---@param options {hand: robot, object: body, count?: integer, candidates?: integer, seconds?: number, seed?: integer, threads?: integer, standoff?: number, distance?: number, on_grasp?: function, grasp?: table, world?: world}  as of plan.sample
---@return {grasps: grasps, report: table} # in force closure, the largest epsilon first
--- > run = clench.plan.random {hand = hand, object = flask, count = 3}
--- > run.grasps[1].epsilon > 0  --> true
--- > clench.plan.random {hand = hand, object = flask, refine = 3}  --> error: refine
return function(options)
  local all = {}
  for key, value in pairs(type(options) == "table" and options or {}) do
    if key == "refine" or key == "verify" then
      require "clench.raise"(("plan.random: unknown key '%s'; plan.sample refines and verifies"):format(key))
    end
    all[key] = value
  end
  all.refine, all.verify = 0, false
  return sample(all)
end
