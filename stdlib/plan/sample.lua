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

--- Random approaches, by turns along the surface's normals to the first touch, and with thumb and fingers about two points that
--- face each other, later also near those that succeeded; then the hand closes. What is in force closure is improved by small random changes and verified. Fast,
--- diverse, and any number of threads gives the same grasps.
---@param options table  the hand, the object and how the search goes
---@like clench.plan.anneal  hand, object
---@option count? integer [1 to 1000000] = 100  the best of those that were found when there were as many
---@option candidates? integer [1 to 1000000000] = 100000  largest number of candidates
---@like clench.plan.anneal  seconds, seed, threads
---@option refine? integer [0 to 10000] = 10  changes that are tried to improve each grasp
---@option verify? boolean|table = true  false: grasps are not verified; a table: how they are
---@option verify.displacement? number [m, >= 0] = 0.001  largest displacement of the object
---@option verify.force_ratio? number [>= 0] = 10  largest normal force, in weights of the object
---@option verify.lift? number [m, >= 0] = 0.1  height of the lift
---@option verify.min_epsilon? number [>= 0] = 0.01  smallest epsilon
---@option verify.min_load? number [>= 0] = 2  load that is held, in weights of the object
---@option verify.min_slippery_load? number [>= 0]  load that is held with half of the friction, in weights: 2 if grasps are shaken, else 0
---@option verify.shake? boolean|table  true, false or options of study.shake: grasps are shaken by the weight of the object, as the last
---  stage; by default those in which no more than two fingers touch are, after they have held the weight with half of the friction
---@option verify.keep_lost? boolean = false  true: grasps that do not survive shaking are kept and marked
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
---@return {grasps: grasps, report: table} # the largest epsilon first, and grasps from different sides if there were more than `count`; each with `info.load_margin` [weights] and `info.perturbed_epsilon`, of those that were shaken `info.directions_held` and `info.survived`, 1 or 0; report.survived, report.shaken: how many
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
