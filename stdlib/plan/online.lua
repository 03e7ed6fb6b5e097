local class = require "clench.class"
local closing = require "clench.plan.closing"
local described = require "clench.described"
local period = require "clench.plan.online_period"
local raise = require "clench.raise"

local max_solutions = 10  -- solutions that are kept
local usual_steps = 500

-- the given number of steps, or the usual one
local function checked_steps(subject, steps)
  if steps == nil then return usual_steps end
  local count = type(steps) == "number" and math.tointeger(steps)
  if not count or count < 0 then raise(("planner:%s: steps: expected an integer >= 0, got %s"):format(subject, described(steps))) end
  return count
end

local Online = class "planner"

-- distance of a grasp from the present pose of the hand: 45 degrees count as much as 50 mm to the side
local function closeness(X_WH_now, X_WH_grasp)
  local between = X_WH_now:inverse() * X_WH_grasp
  local p = between.position
  return math.max(between:angle() / (math.pi / 4), math.sqrt(p.x * p.x + p.y * p.y) / 0.05)
end

local function rank(self)
  local X_WH, X_WO = self.job.given_hand.pose, self.job.given_object.pose
  for _, s in ipairs(self.solutions) do s.closeness = closeness(X_WH, X_WO * s.grasp.pose) end
  table.sort(self.solutions, function(a, b)
    if a.closeness ~= b.closeness then return a.closeness < b.closeness end
    return a.number < b.number
  end)
  while #self.solutions > max_solutions do table.remove(self.solutions) end
end

-- brings the planner's copy of hand and object to the poses in the user's world, which may have changed
local function follow(self)
  local job = self.job
  job.hand:set_posture(job.given_hand.pose, job.given_hand.dofs)
  job.object.pose = job.given_object.pose
end

local function is_new(self, grasp)
  for _, s in ipairs(self.solutions) do
    local between = s.grasp.pose:inverse() * grasp.pose
    if between.position:norm() < 0.01 and between:angle() < 0.1 then return false end
  end
  return true
end

-- adds the grasps of a period
local function merge(self, found, stats)
  self.tested = self.tested + stats.tested
  for why, count in pairs(stats.rejected or {}) do self.rejected[why] = (self.rejected[why] or 0) + count end
  for _, one in ipairs(found) do
    if is_new(self, one.grasp) then
      self.found = self.found + 1
      closing.note(one.grasp, "online", {energy = one.energy, number = self.found, seed = self.job.seed})
      self.solutions[#self.solutions + 1] = {grasp = one.grasp, number = self.found}
    end
  end
end

--- Continues the search around the present poses of hand and object; closes from the best states, and keeps grasps in force closure.
---@param steps? integer  number of steps, 500 by default
---@return grasp[]  all known grasps, the nearest to the hand first
function Online:search(steps)
  steps = checked_steps("search", steps)
  self.periods = self.periods + 1
  follow(self)
  merge(self, period.search(self.job, self.energy, self.periods, steps))
  return self:grasps()
end

--- The same in the background, on a copy of the world: `planner:finish(job)` takes the grasps over. Several jobs may run at once.
---@param steps? integer  number of steps, 500 by default
---@return job  its snapshot is the state that the search has reached: `pose` of the hand in the world, and `dofs`
function Online:start(steps)
  steps = checked_steps("start", steps)
  self.periods = self.periods + 1
  return clench.job("clench.plan.online_background", {args = {self.options, self.periods, steps}, name = "plan.online"})
end

--- Takes over the grasps of a job that has ended.
---@return grasp[]  all known grasps, the nearest to the hand first
function Online:finish(job)
  local result = clench.type(job) == "job" and job:result()
  if type(result) ~= "table" or type(result.found) ~= "table" or type(result.stats) ~= "table" then
    raise("planner:finish: expected a job of planner:start, got " .. described(job))
  end
  merge(self, result.found, result.stats)
  return self:grasps()
end

--- All known grasps, the nearest to the present pose of the hand first.
function Online:grasps()
  rank(self)
  local list = clench.grasps()
  for _, s in ipairs(self.solutions) do list:add(s.grasp) end
  return list
end

--- The nearest grasp to the present pose of the hand.
---@return {grasp: grasp, closeness: number, distance: number, angle: number}?  closeness: 1 at 45 degrees or 50 mm to the side; distance [m] and angle [rad] between the poses
function Online:nearest()
  rank(self)
  local nearest = self.solutions[1]
  if not nearest then return nil end
  local between = self.job.given_hand.pose:inverse() * self.job.given_object.pose * nearest.grasp.pose
  return {grasp = nearest.grasp, closeness = nearest.closeness, distance = between.position:norm(), angle = between:angle()}
end

--- DOFs of the nearest grasp before it closes; they open in proportion to the distance of the hand, fully from 0.2 m.
---@return number[]?
function Online:preshape()
  local nearest = self:nearest()
  if not nearest then return nil end
  local part = math.min(1, nearest.distance / period.reach)
  local dofs = {}
  for i, closed in ipairs(nearest.grasp.dofs) do
    dofs[i] = closed + part * (nearest.grasp.pregrasp.dofs[i] - closed)
  end
  return dofs
end

--- A search that continues while hand and object move: each `planner:search()` searches around their present poses, and ranks the grasps by their distance from
--- the hand. It moves nothing in the user's world.
---@param options table  hand, object and settings of the search
---@like clench.plan.anneal  hand, object
---@option energy? string|energy = "contact"  objective; functions of the script are not allowed
---@like clench.plan.anneal  seed, threads, posture, semi_axes, values, targets, fixed, variables, collisions, max_tries,
---  contacts, touch, grasp, world, max_effort
---@return table planner  `search(steps)`, `grasps()`, `nearest()`, `preshape()`, the DOFs for the further approach, `tested`, `found`, `rejected`; `start(steps)` returns a job that searches in the background, `finish(job)` takes its grasps over
---@effect long
--- > planner = clench.plan.online {hand = hand, object = flask}
--- > list = planner:search(200)
--- > planner.tested > 0, #list == #planner:grasps()  --> true, true
--- > job = planner:start(50)
--- > job:wait()  --> true
--- > #planner:finish(job) >= #list  --> true
return function(options)
  local job = period.new(options)
  return setmetatable({job = job, options = options, energy = job:energy_of(job.energy), solutions = {}, periods = 0, tested = 0, found = 0, rejected = {}}, Online)
end
