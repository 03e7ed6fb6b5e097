--- What a planner gives: grasps, best first, and a report.
local report = require "clench.plan.report"
local reach = require "clench.plan.reach"

--- how far each DOF of a hand goes; 0: without end
local function ranges_of(hand)
  local ranges = {}
  for i, limit in ipairs(hand.dof_limits) do
    local range = limit[2] - limit[1]
    ranges[i] = range < math.huge and range or 0
  end
  return ranges
end

--- grasps that are alike are kept once: hands nearer than `distance` of the object's radius, turned by less than that part
--- of half a turn, and no DOF farther apart than that part of its range
local function are_alike(a, b, ranges, radius, distance)
  if (a.point - b.point):norm() / radius >= distance then return false end
  for i, range in ipairs(ranges) do
    if range > 0 and math.abs(a.dofs[i] - b.dofs[i]) / range >= distance then return false end
  end
  return (a.pose:inverse() * b.pose):angle() / math.pi < distance
end

local Run = {__name = "run"}
Run.__index = Run
function Run:__tostring() return ("%d grasps: %s"):format(#self.grasps, tostring(self.report)) end

---@param job table
---@param found grasp[]  in the order in which they count
---@param told table  of plan.report
---@param options {count?: integer, distance?: number}
return function(job, found, told, options)
  local ranges = ranges_of(job.hand)
  local approach = job.hand.pose:inverse() * job.hand.approach.point  -- in the base
  told.out_of_reach = 0
  if job.arm then found, told.out_of_reach = reach.filter(job, found) end
  local bounds = job.object.mesh.bounds
  local radius = math.max((bounds.high - bounds.low):norm() / 2, 1e-6)
  local grasps, kept, alike = clench.grasps(), {}, 0
  for _, grasp in ipairs(found) do
    if options.count and #kept >= options.count then break end
    local new, pose = true, grasp.pose
    local compared = {pose = pose, point = pose * approach, dofs = grasp.dofs}
    for _, other in ipairs(kept) do
      if are_alike(compared, other, ranges, radius, options.distance or 0) then
        new, alike = false, alike + 1
        break
      end
    end
    if new then
      kept[#kept + 1] = compared
      grasps:add(grasp)
    end
  end
  told.grasps, told.alike, told.found = #kept, alike, #found
  told.seconds, told.stopped = job:elapsed(), job.stopped or job.cancelled
  return setmetatable({grasps = grasps, report = report(job, told)}, Run)
end
