-- stdlib/plan/anneal.lua
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local chain = require "clench.plan.chain"
local closing = require "clench.plan.closing"

--- Simulated annealing: one chain from a start to small energies; then the hand closes from each of the best states.
---@param options {hand: robot, object: body, energy?: string|energy|function, steps?: integer, seconds?: number, seed?: integer, schedule?: string|table, best?: table, grasp?: table, world?: world, threads?: integer, max_effort?: number}  energy: "contact" by default; steps: 70000; and what clench.annealing takes: position, posture, limits, jumps, values, targets, fixed, start, variables, collisions; grasp: options of clench.grasp; max_effort: of motors without a limit [N m or N]
---@return {grasps: grasps, report: table} # grasps in the order of their energies, each with its `pregrasp`, and `info.energy`, `info.step`, `info.seed`; report: steps, first, best, steps_per_second, accepted, in_collision, ..., trace, causes; chart() draws the best energy over the steps
--- > run = clench.plan.anneal {hand = hand, object = flask, steps = 500, seed = 1}
--- > run.report.steps, run.report.best < run.report.first  --> 500, true
--- > clench.plan.anneal {hand = hand, object = flask, step = 500}  --> error: unknown key 'step'
--- > clench.plan.anneal {hand = hand, object = flask, energy = "contct"}  --> error: clench.energy has no 'contct'; did you mean 'contact'?
return function(options)
  local job = new_job("plan.anneal", options, function(read, job)
    job.energy = read:raw "energy" or "contact"
    job.steps = read:count("steps", 70000, 1, 1e9)
    job.schedule, job.best = read:raw "schedule", read:raw "best"
  end)
  local search = job:annealing {energy = job:energy_of(job.energy), seed = job.seed, schedule = job.schedule, best = job.best}
  local told = chain.run(job, search, job.steps)
  chain.energies(told, search)
  told.planner = "plan.anneal"

  local found = {}
  job:interruptible(function()
    for _, state in ipairs(search.best) do
      if not job:has_patience() then break end
      local grasp = job:close(job.hand, job.object, state, told)
      if grasp then
        found[#found + 1] = closing.note(grasp, "anneal", {energy = state.energy, step = state.step, seed = job.seed})
      end
    end
  end)
  if #found == 0 and not job.stopped then chain.nearest(job, search, told) end
  job:finish()
  return new_run(job, found, told, {})
end
