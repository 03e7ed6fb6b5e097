local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local batch = require "clench.plan.batch"
local starts = require "clench.plan.starts"
local opposition = require "clench.plan.opposition"

--- For two jaws: a point of the surface, the one that the inward normal meets opposite, and the jaws about both, from any
--- side across that line.
---@param options table  the hand, the object and how the search goes
---@like clench.plan.anneal  hand, object
---@option count? integer [1 to 1000000] = 100  the best of those that were found when there were as many
---@option candidates? integer [1 to 1000000000] = 20000  largest number of candidates
---@like clench.plan.anneal  seconds, seed, threads
---@option friction? number [> 0] = 0.5  coefficient of the cones in which the line lies
---@option width? number [m, > 0, <= 10] = 0.2  largest distance between the points
---@option standoff? number [m, > 0, <= 10] = 0.1  distance from the grasp at the start
---@option distance? number [>= 0] = 0.1  grasps nearer than this part of the radius of the object, of half a turn and of the ranges of the
---  DOFs are alike
---@like clench.plan.anneal  contacts, touch
---@option on_grasp? function  on_grasp(grasp) is called for each grasp that is found
---@like clench.plan.anneal  grasp, world, max_effort
---@return {grasps: grasps, report: table} # in force closure, the largest epsilon first
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
  local told = {planner = "plan.antipodal"}
  own.planner, own.kind = "antipodal", "antipodal"
  local found = batch.try(job, told, job:prepare(starts.random, own), own)
  job:finish()
  return new_run(job, batch.sort(found), told, {count = own.count, distance = own.distance})
end
