-- stdlib/plan/list.lua
local raise = require "clench.raise"
local described = require "clench.described"
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local closing = require "clench.plan.closing"

-- a grasp's own state, or that before it closed; or a table of both
local function state_of(item, i)
  if described(item) == "a grasp" then return item.pregrasp or {pose = item.pose, dofs = item.dofs} end
  if type(item) ~= "table" or not item.pose or not item.dofs then
    raise(("plan.list: states[%d]: expected a grasp or {pose =, dofs =}, got %s"):format(i, described(item)))
  end
  return item
end

--- Tries a given list of states, of another planner, hand or file: the hand closes from each.
---@param options {hand: robot, object: body, states: grasps|table, approach?: number, energy?: string|energy|function, count?: integer, seconds?: number, world?: world}  states: grasps, from their pregrasps, or {pose = of the hand in the object, dofs =} each; approach: to the first touch, at most so far [m], 0 by default; energy: noted with each, measured before it closes
---@return {grasps: grasps, report: table} # all in contact, the largest epsilon first
--- > run = clench.plan.list {hand = hand, object = flask, states = {{pose = grasp.pose, dofs = grasp.dofs}, grasp}}
--- > #run.grasps, run.report.candidates  --> 1, 2
--- > clench.plan.list {hand = hand, object = flask, states = {3}}  --> error: states[1]: expected a grasp or {pose =, dofs =}, got 3
return function(options)
  local states, approach, count
  local job = new_job("plan.list", options, function(read, job)
    states = read:raw "states"
    if type(states) ~= "table" and described(states) ~= "a grasps" then read:expected("states", "a list of grasps or states", states) end
    approach = read:not_negative("approach", 0)
    job.energy = read:raw "energy"
    count = read:count("count", 1000000, 1, 1000000)
  end)
  local energy = job.energy and job:energy_of(job.energy)
  local told = {planner = "plan.list", candidates = 0, rejected = {}}
  local found = {}
  job:interruptible(function()
    for i, item in ipairs(states) do
      if not job:goes_on() then break end
      local state = state_of(item, i)
      told.candidates = told.candidates + 1
      local value = energy and closing.place(job.hand, job.object, state) and energy()
      local grasp = job:close(job.hand, job.object, state, told, approach > 0 and approach or nil)
      if grasp then found[#found + 1] = closing.note(grasp, "list", {energy = value or nil, number = i}) end
    end
  end)
  table.sort(found, function(a, b)
    if a.epsilon ~= b.epsilon then return a.epsilon > b.epsilon end
    return a.info.number < b.info.number
  end)
  job:finish()
  return new_run(job, found, told, {count = count, distance = 1e-6})
end
