-- stdlib/plan/start.lua
local described = require "clench.described"
local raise = require "clench.raise"
require "clench.plan.run" -- the class of the result, and that of its report

--- Runs a planner in the background, as a `clench.job` on a copy of the world; the grasps are bit-identical to those of the planner itself. Options may not
--- contain energies or other functions of the script; a planner may use these in a function of `clench.loop.spawn`, while other functions of the loop run
--- between its pieces of work.
---@param planner string  "sample", "anneal", ...
---@param options table  of that planner, without functions
---@return job job # each grasp is an event as soon as it is found; `result()` returns the planner's {grasps, report}, whose grasps belong to no world; `snapshot` is the progress of clench.plan.sample. If the job is stopped, the grasps found so far are its events
---@effect reads
--- > job = clench.plan.start("sample", {hand = hand, object = flask, count = 2, refine = 2})
--- > clench.loop.wait(job)
--- > #job:result().grasps == 2, #job:events() >= 2  --> true, true
--- > clench.plan.start("smple", {})  --> error: plan.start: planner: there is no 'smple'
return function(planner, options)
  if type(planner) ~= "string" then raise(("plan.start: planner: expected a name, got %s"):format(described(planner))) end
  if planner == "online" or planner == "start" then
    raise(("plan.start: planner: '%s' is not a search that ends"):format(planner))
  end
  local known, plan = pcall(function() return clench.plan[planner] end)
  if not known then raise((tostring(plan):gsub("^.-plan: there", "plan.start: planner: there"))) end
  if type(options) ~= "table" then raise(("plan.start: options: expected a table, got %s"):format(described(options))) end
  for name, value in pairs(options) do
    if type(value) == "function" then
      raise(("plan.start: %s: a function of the script cannot run in the background; grasps and progress arrive as events and snapshot of the job"):format(tostring(name)))
    end
  end
  return clench.job("clench.plan.background", {args = {planner, options}, name = "plan." .. planner})
end
