--- One period of the search of an on-line planner: annealing around the present poses of hand and object, then closing from the best states.
local new_job = require "clench.plan.job"
local on_behalf_of = require "clench.on_behalf_of"
local period = {}

local best_states = {size = 20, distance = 0.4}
local near_object = {behind = 0.03, before = 0.2}  -- range of the search along the approach [m]
local slice = 50  -- steps between two states that are shown

period.reach = near_object.before  -- distance from which a hand is opened completely [m]

--- A planner's job with the options of `clench.plan.online`.
function period.new(options)
  return new_job("plan.online", options, function(read, job)
    job.energy = read:get "energy"
    if clench.type(job.energy) == "energy" and not job.energy.any_thread then
      read:fail("energy: expected an energy of the engine, as the planner moves a copy of the world")
    end
  end)
end

-- runs a search, in slices if its states are watched
local function run(job, search, steps, watch)
  local left = steps
  while left > 0 do
    local count = watch and math.min(slice, left) or left
    on_behalf_of("planner:search", search.run, search, count)
    left = left - count
    local state = search.state
    if watch then watch {pose = job.object.pose * state.pose, dofs = state.dofs} end
  end
end

--- Searches from the pose of the job's hand.
---@param energy energy
---@param number integer  of the period, which varies the random numbers
---@param watch? fun(state: table)  called with pose (in the world) and dofs of the hand that the search has reached
---@return {grasp: grasp, energy: number}[] found  grasps in force closure
---@return {tested: integer, rejected?: table} stats  number of states from which the hand was closed, and of grasps rejected by reason
function period.search(job, energy, number, steps, watch)
  local reach = job.hand.world:distance(job.hand, job.object)
  local range = math.min(near_object.before, math.max(reach, 0.01)) + near_object.behind
  local search = job:annealing {energy = energy, position = "approach", start = "hand", schedule = "online",
                                seed = job.seed + number, best = best_states, jumps = {dist = 0.33 * range},
                                limits = {dist = {-near_object.behind, range - near_object.behind}}}
  run(job, search, steps, watch)
  local found, stats = {}, {tested = 0}
  for _, state in ipairs(search.best) do
    stats.tested = stats.tested + 1
    local grasp = job:close(job.hand, job.object, state, stats, 0.03 + range)
    if grasp and grasp.epsilon > 0 and grasp.collision_free then found[#found + 1] = {grasp = grasp, energy = state.energy} end
  end
  return found, stats
end

return period
