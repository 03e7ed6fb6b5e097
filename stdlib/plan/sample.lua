local sampling = require "clench.plan.sampling"
local verification = require "clench.plan.verification"

local function read_verify(read, grasp_options)
  if read:get "verify" == false then return nil end
  local own = read:table "verify"
  local options = {grasp = grasp_options}
  for _, name in ipairs {"displacement", "force_ratio", "lift", "min_epsilon", "min_load", "keep_lost"} do options[name] = own:get(name) end
  local shake = own:get "shake"
  if shake == true then shake = {} end
  for _, name in ipairs {"hand", "object", "world"} do
    if shake and shake[name] ~= nil then own:fail("shake: unknown key '%s'", name) end
  end
  options.shake = shake
  options.min_slippery_load = own:get("min_slippery_load", shake and verification.min_slippery_load_of_shaken or 0)
  own:done()
  return options
end

--- Random sampling of starts: alternately approaches along surface normals to the first touch and approaches with thumb and fingers on both sides of two
--- opposite points, later also starts near successful ones; the hand closes from each. Grasps in force closure are improved by small random changes and
--- verified. Fast and diverse; the grasps do not depend on the number of threads.
---@param options table  hand, object and settings of the search
---@like clench.plan.anneal  hand, object
---@option count? integer [1 to 1000000] = 100  the search ends once it has found this many grasps, and returns the best of them
---@option candidates? integer [1 to 1000000000] = 100000  maximum number of candidates
---@like clench.plan.anneal  seconds, seed, threads
---@option refine? integer [0 to 10000] = 10  number of changes tried to improve each grasp
---@option verify? boolean|table = true  false: grasps are not verified; a table: settings of the verification
---@option verify.displacement? number [m, >= 0] = 0.001  displacement of the object in each of six directions
---@option verify.force_ratio? number [> 0] = 10  maximum sum of the normal forces, in weights of the object
---@option verify.lift? number [m, >= 0] = 0.1  height of the lift
---@option verify.min_epsilon? number [>= 0] = 0.01  minimum epsilon, also after the displacement
---@option verify.min_load? number [>= 0] = 2  minimum load that the grasp must hold, in weights of the object
---@option verify.min_slippery_load? number [>= 0]  minimum load that the grasp must hold with half of the friction, in weights: 2 if grasps are shaken, else 0
---@option verify.shake? boolean|table  true, false or options of study.shake: grasps are shaken by the weight of the object, as the last
---  stage; by default only grasps with at most two touching fingers are, if they hold the weight with half of the friction
---@option verify.keep_lost? boolean = false  true: grasps that do not survive shaking are kept and marked
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
---@return {grasps: grasps, report: table} # in order of decreasing epsilon, from different sides if more than `count` were found; each with `info.load_margin` [weights] and `info.perturbed_epsilon`, shaken grasps also with `info.directions_held` and `info.survived`, 1 or 0; report.shaken, report.survived: numbers of grasps
---@effect long
--- > run = clench.plan.sample {hand = hand, object = flask, count = 3, refine = 2}
--- > run.grasps[1].epsilon > 0, run.report.candidates > 3  --> true, true
--- > clench.plan.sample {hand = hand, object = flask, verify = {lfit = 0}}  --> error: unknown key 'lfit'
--- > clench.plan.sample {hand = hand, object = flask, verify = {shake = 1}}  --> error: shake must be a boolean or a table, got 1
return function(options)
  return sampling("sample", options, function(read, own, job)
    own.near_found = true
    own.refine = read:get "refine"
    own.verify = read_verify(read, job.grasp_options)
  end)
end
