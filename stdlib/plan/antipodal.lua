local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local batch = require "clench.plan.batch"
local starts = require "clench.plan.starts"
local opposition = require "clench.plan.opposition"

--- For two jaws: a point of the surface, the one that the inward normal meets opposite, and the jaws about both, from any
--- side across that line.
---@param options {hand: robot, object: body, count?: integer, candidates?: integer, seconds?: number, seed?: integer, threads?: integer, friction?: number, width?: number, standoff?: number, distance?: number, on_grasp?: function, grasp?: table, world?: world, max_effort?: number}  count: the best of those that were found when there were as many, 100; candidates: at most, 20000; friction: the cones in which the line lies, 0.5; width: between the points at most, 0.2 [m]; standoff: before the grasp, 0.1 [m]; max_effort: of motors without a limit [N m or N]
---@return {grasps: grasps, report: table} # in force closure, the largest epsilon first
--- > world = clench.world()
--- > jaws = world:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
--- > bar = world:add_object(clench.shapes.box {0.03, 0.03, 0.1}, {pose = {xyz = {0, 0, 1}}})
--- > run = clench.plan.antipodal {hand = jaws, object = bar, count = 3}
--- > #run.grasps > 0 and run.grasps[1].epsilon > 0  --> true
return function(options)
  local own = {}
  local job = new_job("plan.antipodal", options, function(read)
    own.count = read:count("count", 100, 1, 1000000)
    own.limit = read:count("candidates", 20000, 1, 1e9)
    own.friction = read:positive("friction", 0.5)
    own.width = read:positive("width", 0.2, 10)
    own.standoff = read:positive("standoff", 0.1, 10)
    own.distance = read:not_negative("distance", 0.1)
    own.on_grasp = read:callback "on_grasp"
  end)
  if not opposition.thumb(job.hand) then
    require "clench.raise" "plan.antipodal: hand: expected one of two fingers or more"
  end
  local told = {planner = "plan.antipodal"}
  own.planner, own.kind = "antipodal", "antipodal"
  local found = batch.try(job, told, job:prepare(starts.random, own), own)
  job:finish()
  return new_run(job, batch.sort(found), told, {count = own.count, distance = own.distance})
end
