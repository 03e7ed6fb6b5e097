--- The result of a planner: grasps, best first, and a report.
local assumptions = require "clench.plan.assumptions"
local class = require "clench.class"
local report = require "clench.plan.report"
local reach = require "clench.plan.reach"
local distinct = require "clench.plan.distinct"
local spread = require "clench.plan.spread"

local Run = class "run"
function Run:__tostring() return ("%d grasps: %s"):format(#self.grasps, tostring(self.report)) end

---@param job table
---@param found grasp[]  best first
---@param stats table  of plan.report
---@param options {count?: integer, distance?: number, spread?: boolean}  spread: if there are more than `count` grasps, those from different sides are preferred
return function(job, found, stats, options)
  stats.out_of_reach = 0
  if job.arm then found, stats.out_of_reach = reach.filter(job, found) end
  local is_new = distinct(job.hand, job.object, options.distance or 0)
  local unlike, alike = {}, 0
  for _, grasp in ipairs(found) do
    if options.count and not options.spread and #unlike >= options.count then break end
    if is_new(grasp) then unlike[#unlike + 1] = grasp else alike = alike + 1 end
  end
  local grasps = clench.grasps()
  for _, grasp in ipairs(options.spread and spread(job.hand, unlike, options.count) or unlike) do grasps:add(grasp) end
  stats.grasps, stats.alike, stats.found = #grasps, alike, #found
  stats.seconds, stats.stopped = job:elapsed(), job.stopped
  stats.assumptions = stats.assumptions or assumptions.of(job.hand, job.object, nil, {})
  return setmetatable({grasps = grasps, report = report.new(job, stats)}, Run)
end
