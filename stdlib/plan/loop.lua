-- stdlib/plan/loop.lua
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local chain = require "clench.plan.chain"
local closing = require "clench.plan.closing"

--- Repeated annealing: each loop avoids the states that earlier loops found, so that it searches elsewhere.
---@param options table  hand, object and settings of the search
---@like clench.plan.anneal  hand, object
---@option energy? string|energy|function = "guided_potential_quality"  objective
---@option steps? integer [1 to 1000000000] = 70000  total number of annealing steps
---@option loop_steps? integer [1 to 1000000000] = 5000  steps of each loop
---@option max_energy? number = 10  states with higher energies are not kept
---@option count? integer [1 to 1000000]  number of grasps that ends the search, any number by default
---@like clench.plan.anneal  seconds, seed, position, posture, semi_axes, limits, jumps, values, targets, fixed, start, variables,
---  collisions, max_tries, contacts, touch, threads, grasp, world, max_effort
---@return {grasps: grasps, report: table}
---@effect long
--- > run = clench.plan.loop {hand = hand, object = flask, steps = 600, loop_steps = 200, energy = "contact", max_energy = 500}
--- > run.report.steps, run.report.loops  --> 600, 3
return function(options)
  local loop_steps, max_energy, count
  local job = new_job("plan.loop", options, function(read, job)
    job.energy = read:get "energy"
    job.steps = read:get "steps"
    loop_steps = read:get "loop_steps"
    max_energy = read:get "max_energy"
    count = read:get("count", 1000000)
  end)
  local search = job:annealing {energy = job:energy_of(job.energy), seed = job.seed, schedule = "loop",
                                best = {distance = 0.1, max_energy = max_energy}}
  local stats, found, done = nil, {}, 0
  local loops = 0
  job:interruptible(function()
    while done < job.steps and job:goes_on() and #found < count do
      local before = done
      stats = chain.run(job, search, math.min(loop_steps, job.steps - done), stats)
      done, loops = stats.steps, loops + 1
      chain.energies(stats, search)
      for _, state in ipairs(search.best) do
        local grasp = job:close(job.hand, job.object, state, stats)
        if grasp then found[#found + 1] = closing.note(grasp, "loop", {energy = state.energy, step = state.step, seed = job.seed, loop = loops}) end
        search:avoid(state)
      end
      search:clear()
      search:reset()
      if done == before then break end  -- no legal neighbor
    end
  end)
  stats = stats or {steps = 0, accepted = 0, in_collision = 0, avoided = 0, stuck = 0}
  stats.planner, stats.loops, stats.threshold = "plan.loop", loops, max_energy
  table.sort(found, function(a, b) return a.info.energy < b.info.energy end)
  if #found == 0 and not job.stopped then chain.nearest(job, search, stats) end
  job:finish()
  return new_run(job, found, stats, {count = count})
end
