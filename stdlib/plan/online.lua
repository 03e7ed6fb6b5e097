local class = require "clench.class"
local on_behalf_of = require "clench.on_behalf_of"
local new_job = require "clench.plan.job"
local closing = require "clench.plan.closing"

local best_states = {size = 20, distance = 0.4}
local near_object = {behind = 0.03, before = 0.2}  -- range of the search along the approach [m]
local max_solutions = 10                                    -- solutions that are kept

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

--- Continues the search around the present poses of hand and object; closes from the best states, and keeps grasps in force closure.
---@param steps? integer  number of steps, 500 by default
---@return grasp[]  all known grasps, the nearest to the hand first
function Online:search(steps)
  local job = self.job
  self.periods = self.periods + 1
  follow(self)
  local reach = job.hand.world:distance(job.hand, job.object)
  local range = math.min(near_object.before, math.max(reach, 0.01)) + near_object.behind
  local search = job:annealing {energy = self.energy, position = "approach", start = "hand", schedule = "online",
                                seed = job.seed + self.periods, best = best_states, jumps = {dist = 0.33 * range},
                                limits = {dist = {-near_object.behind, range - near_object.behind}}}
  on_behalf_of("planner:search", search.run, search, steps or 500)
  for _, state in ipairs(search.best) do
    self.tested = self.tested + 1
    local grasp = job:close(job.hand, job.object, state, self, 0.03 + range)
    if grasp and grasp.epsilon > 0 and grasp.collision_free and is_new(self, grasp) then
      self.found = self.found + 1
      closing.note(grasp, "online", {energy = state.energy, number = self.found, seed = job.seed})
      self.solutions[#self.solutions + 1] = {grasp = grasp, number = self.found}
    end
  end
  return self:grasps()
end

--- All known grasps, the nearest to the present pose of the hand first.
function Online:grasps()
  rank(self)
  local list = clench.grasps()
  for _, s in ipairs(self.solutions) do list:add(s.grasp) end
  return list
end

--- DOFs of the nearest grasp before it closes; they open in proportion to the distance of the hand, fully from 0.2 m.
---@return number[]?
function Online:preshape()
  rank(self)
  local nearest = self.solutions[1]
  if not nearest then return nil end
  local away = (self.job.given_hand.pose.position - (self.job.given_object.pose * nearest.grasp.pose).position):norm()
  local part = math.min(1, away / near_object.before)
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
---@return table planner  `search(steps)`, `grasps()`, `preshape()`, the DOFs for the further approach, `tested`, `found`
---@effect long
--- > planner = clench.plan.online {hand = hand, object = flask}
--- > list = planner:search(200)
--- > planner.tested > 0, #list == #planner:grasps()  --> true, true
return function(options)
  local job = new_job("plan.online", options, function(read, job)
    job.energy = read:get "energy"
    if clench.type(job.energy) == "energy" and not job.energy.any_thread then
      read:fail("energy: expected an energy of the engine, as the planner moves a copy of the world")
    end
  end)
  return setmetatable({job = job, energy = job:energy_of(job.energy), solutions = {}, periods = 0, tested = 0, found = 0}, Online)
end
