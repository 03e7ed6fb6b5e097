local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local batch = require "clench.plan.batch"
local starts = require "clench.plan.starts"
local opposition = require "clench.plan.opposition"

--- For parallel jaws: samples a point of the surface and the point that the ray along its inward normal reaches on the opposite side; the jaws close on both
--- from any direction across that line.
---@param options table  hand, object and settings of the search
---@like clench.plan.anneal  hand, object
---@option count? integer [1 to 1000000] = 100  the search ends once it has found this many grasps, and returns the best of them
---@option candidates? integer [1 to 1000000000] = 20000  maximum number of candidates
---@like clench.plan.anneal  seconds, seed, threads
---@option friction? number [> 0] = 0.5  coefficient of the friction cones that contain the line
---@option width? number [m, > 0, <= 10] = 0.2  maximum distance between the points
---@option standoff? number [m, > 0, <= 10] = 0.1  distance of the start from the grasp
---@option distance? number [>= 0] = 0.1  grasps count as similar if they differ by less than this fraction of the object's radius, of half a turn
---  and of the ranges of the DOFs
---@like clench.plan.anneal  contacts, touch
---@option on_grasp? function  on_grasp(grasp) is called for each grasp that is found
---@like clench.plan.anneal  grasp, world, max_effort
---@return {grasps: grasps, report: table} # grasps in force closure, in order of decreasing epsilon
---@effect long
--- > world = clench.world()
--- > jaws = world:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
--- > bar = world:add_object(clench.shapes.box {0.03, 0.03, 0.1}, {pose = {xyz = {0, 0, 1}}})
--- > run = clench.plan.antipodal {hand = jaws, object = bar, count = 3}
--- > #run.grasps > 0 and run.grasps[1].epsilon > 0  --> true
return function(options)
  local own = {}
  local job = new_job("plan.antipodal", options, function(read)
    own.count = read:get "count"
    own.limit = read:get "candidates"
    own.friction = read:get "friction"
    own.width = read:get "width"
    own.standoff = read:get "standoff"
    own.distance = read:get "distance"
    own.on_grasp = read:get "on_grasp"
  end)
  if not opposition.thumb(job.hand) then
    require "clench.raise" "plan.antipodal: hand: expected one of two fingers or more"
  end
  local stats = {planner = "plan.antipodal"}
  own.planner, own.kind = "antipodal", "antipodal"
  local found = batch.try(job, stats, job:prepare(starts.random, own), own)
  job:finish()
  return new_run(job, batch.sort(found), stats, {count = own.count, distance = own.distance})
end
