-- stdlib/plan/list.lua
local raise = require "clench.raise"
local described = require "clench.described"
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local closing = require "clench.plan.closing"

-- the state before the grasp closed, else that of the grasp itself, with DOFs found by their names; a table is returned unchanged
local function state_of(item, hand)
  if clench.type(item) ~= "grasp" then return item end
  local dofs, dofs_before = item:dofs_for(hand)
  local before = item.pregrasp
  if not before then return {pose = item.pose, dofs = dofs} end
  return {pose = before.pose, dofs = dofs_before, way = item.pose and (item.pose.position - before.pose.position):norm()}
end

local margin = 0.01  -- added to the travel from a pregrasp to the first touch [m]

-- maximum travel of the hand to the first touch; nil: it does not approach
local function approach_of(state, given)
  if given then return given > 0 and given or nil end
  return state.way and state.way > 1e-6 and state.way + margin or nil
end

local function check_dofs(read, place, dofs, hand)
  -- a table by names; DOFs that it omits keep their values
  if type(dofs) == "table" and #dofs == 0 and next(dofs) ~= nil then return end
  local count = #hand.dofs
  if type(dofs) ~= "table" or #dofs ~= count then read:expected(place, ("%d numbers, one per DOF"):format(count), dofs) end
  for i, value in ipairs(dofs) do
    if type(value) ~= "number" or value - value ~= 0 then read:expected(("%s[%d]"):format(place, i), "a finite number", value) end
  end
end

local function read_states(read, hand)
  local states = read:raw "states"
  local is_list = clench.type(states) == "grasps"
  if type(states) ~= "table" and not is_list then read:expected("states", "a list of grasps or states", states) end
  if #states == 0 then read:fail "states: expected at least one grasp or state, got none" end
  local out = {}
  for i = 1, #states do
    local place, item = ("states[%d]"):format(i), states[i]
    if clench.type(item) ~= "grasp" and type(item) ~= "table" then read:fail("%s: expected a grasp or {pose =, dofs =}, got %s", place, described(item)) end
    local state = state_of(item, hand)
    if state.pose == nil then read:fail("%s: pose is missing: expected a grasp or {pose =, dofs =}", place) end
    if state.dofs == nil then read:fail("%s: dofs are missing: expected a grasp or {pose =, dofs =}", place) end
    if clench.type(state.pose) ~= "pose" then read:expected(place .. ".pose", "a pose", state.pose) end
    check_dofs(read, place .. ".dofs", state.dofs, hand)
    out[i] = {pose = state.pose, dofs = state.dofs, way = clench.type(item) == "grasp" and state.way or nil}
  end
  return out
end

--- Tries a given list of states, from another planner, another hand or a file: the hand closes from each.
---@param options table  hand, object and settings of the search
---@like clench.plan.anneal  hand, object
---@option states grasps|table  grasps, which start at their pregrasps, or a list of {pose = of the hand in the object, dofs =}
---@option approach? number [m, >= 0, <= 1000000]  maximum travel to the first touch; by default the distance of the grasp from its pregrasp,
---  else 0
---@option energy? string|energy|function  stored with each grasp, computed before the hand closes
---@option count? integer [1 to 1000000]  number of grasps that ends the search, any number by default
---@like clench.plan.anneal  seconds, seed, threads, contacts, touch, grasp, world, max_effort
---@return {grasps: grasps, report: table} # all grasps with contacts, in order of decreasing epsilon
---@effect long
--- > run = clench.plan.list {hand = hand, object = flask, states = {{pose = grasp.pose, dofs = grasp.dofs}, grasp}}
--- > #run.grasps, run.report.candidates  --> 1, 2
--- > clench.plan.list {hand = hand, object = flask, states = {3}}  --> error: states[1]: expected a grasp or {pose =, dofs =}, got 3
return function(options)
  local states, approach, count
  local job = new_job("plan.list", options, function(read, job)
    states = read_states(read, options.hand)
    approach = read:get "approach"
    job.energy = read:get "energy"
    count = read:get("count", 1000000)
  end)
  local energy = job.energy and job:energy_of(job.energy)
  local function energy_at(state)
    if not energy or not closing.place(job.hand, job.object, state) then return nil end
    local value = energy()
    if type(value) ~= "number" or value - value ~= 0 then
      raise("plan.list: energy: expected a finite number, got " .. described(value))
    end
    return value
  end
  local stats = {planner = "plan.list", candidates = 0, rejected = {}}
  local found = {}
  job:search_in_time(function()
    for i, state in ipairs(states) do
      if not job:goes_on() then break end
      stats.candidates = stats.candidates + 1
      local value = energy_at(state)
      local grasp = job:close(job.hand, job.object, state, stats, approach_of(state, approach))
      if grasp then found[#found + 1] = closing.note(grasp, "list", {energy = value, number = i}) end
    end
  end)
  table.sort(found, function(a, b)
    if a.epsilon ~= b.epsilon then return a.epsilon > b.epsilon end
    return a.info.number < b.info.number
  end)
  job:finish()
  return new_run(job, found, stats, {count = count, distance = 1e-6})
end
