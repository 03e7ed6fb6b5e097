local sampling = require "clench.plan.sampling"
local verification = require "clench.plan.verification"

local function read_verify(read, grasp_options)
  local given = read:raw "verify"
  if given == false then return nil end
  if given ~= nil and given ~= true and type(given) ~= "table" then read:expected("verify", "a boolean or a table", given) end
  local own = require "clench.options"(read.subject .. ": verify", type(given) == "table" and given or {})
  local options = {grasp = grasp_options}
  local defaults = verification.defaults
  for _, name in ipairs {"displacement", "force_ratio", "lift", "min_epsilon", "min_load"} do options[name] = own:not_negative(name, defaults[name]) end
  options.keep_lost = own:flag "keep_lost"
  local shake = own:raw "shake"
  if shake == true then shake = {} end
  if shake ~= nil and shake ~= false and type(shake) ~= "table" then own:expected("shake", "a boolean or a table", shake) end
  for _, name in ipairs {"hand", "object", "world"} do
    if shake and shake[name] ~= nil then own:fail("shake: unknown key '%s'", name) end
  end
  options.shake = shake
  options.min_slippery_load = own:not_negative("min_slippery_load", shake and verification.min_slippery_load_of_shaken or defaults.min_slippery_load)
  own:done()
  return options
end

--- Random approaches, by turns along the surface's normals to the first touch, and with thumb and fingers about two points that
--- face each other, later also near those that succeeded; then the hand closes. What is in force closure is improved by small random changes and verified. Fast,
--- diverse, and any number of threads gives the same grasps.
---@param options {hand: robot, object: body, count?: integer, candidates?: integer, seconds?: number, seed?: integer, threads?: integer, refine?: integer, verify?: boolean|table, standoff?: number, distance?: number, contacts?: "fingertip"|"power"|"any", touch?: table, keep_searching?: boolean, on_grasp?: function, on_progress?: function, grasp?: table, world?: world, max_effort?: number}  count: the best of those that were found when there were as many, 100; candidates: at most, 100000; refine: changes that are tried, 10; verify: {displacement: 0.001 [m], force_ratio: 10 weights of normal force, min_load: 2 weights, min_slippery_load: the same with half of the friction, 2 weights of grasps that are shaken, otherwise 0, min_epsilon: 0.01, lift: 0.1 [m], shake: true, false or options of study.shake: grasps are shaken by the object's weight, as the last stage; by default those in which no more than two fingers touch are, after they have held the weight with half of the friction; keep_lost: false, those that do not survive it are kept and marked}; standoff: of the middle between thumb and fingers before the surface, 0.15 [m]; distance: grasps nearer than that part of the object's radius, of half a turn and of the DOFs' ranges are alike, 0.1; contacts: fingertip: with the last links of fingers alone; power: with the palm as well; or touch = {must = names of links, or lists of which one must, may = names}, of any planner; keep_searching: false; true: the search continues until its time or its candidates run out, and the best `count` are kept; on_grasp(grasp): called as soon as one is found; on_progress(state): called as candidates are tried, with {candidates, grasps, rejected = counts by reason, elapsed [s], hint = a sentence that names which of friction, force and effort is too small}; grasp: options of clench.grasp; max_effort: of motors without a limit [N m or N]
---@return {grasps: grasps, report: table} # the largest epsilon first, and grasps from different sides if there were more than `count`; each with `info.load_margin` [weights] and `info.perturbed_epsilon`, of those that were shaken `info.directions_held` and `info.survived`, 1 or 0; report.survived, report.shaken: how many
--- > run = clench.plan.sample {hand = hand, object = flask, count = 3, refine = 2}
--- > run.grasps[1].epsilon > 0, run.report.candidates > 3  --> true, true
--- > clench.plan.sample {hand = hand, object = flask, verify = {lfit = 0}}  --> error: unknown key 'lfit'
--- > clench.plan.sample {hand = hand, object = flask, verify = {shake = 1}}  --> error: shake must be a boolean or a table, got 1
return function(options)
  return sampling("sample", options, function(read, own, job)
    own.near_found = true
    own.refine = read:count("refine", 10, 0, 10000)
    own.verify = read_verify(read, job.grasp_options)
  end)
end
