-- stdlib/plan/anneal.lua
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local chain = require "clench.plan.chain"
local closing = require "clench.plan.closing"

--- Simulated annealing: one chain minimizes the energy from a start; then the hand closes from each of the best states.
---@param options table  hand, object and settings of the search
---@option hand robot  hand that grasps; it moves in a clone of its world
---@option object body  object that is grasped
---@option energy? string|energy|function = "contact"  objective, or its name in clench.energy
---@option steps? integer [1 to 1000000000] = 70000  steps of annealing
---@option seconds? number [s, > 0]  time limit, unlimited by default
---@option seed? integer = 1  seed of the random numbers
---@like clench.annealing  schedule, best, position, posture, semi_axes, limits, jumps, values, targets, fixed, start, variables, collisions,
---  max_tries
---@option contacts? "fingertip"|"power"|"any" = "any"  fingertip: only the last links of fingers touch; power: the palm touches as well
---@option touch? table  links that touch, instead of contacts
---@option touch.must? table  names of links, or lists of names of which at least one must touch
---@option touch.may? string[]  names of links, all by default
---@option threads? integer [1 to 1024] = 1  number of threads; the grasps do not depend on it
---@option grasp? table  options of clench.grasp
---@option world? world  world of hand and object that the planner moves, the hand's by default
---@option max_effort? number [N m or N, > 0]  maximum torque or force of motors without a limit
---@return {grasps: grasps, report: table} # grasps in order of increasing energy, each with its `pregrasp`, and `info.energy`, `info.step`, `info.seed`; report: steps, first, best, steps_per_second, accepted, in_collision, ..., trace, causes; chart() draws the best energy over the steps
---@effect long
--- > run = clench.plan.anneal {hand = hand, object = flask, steps = 500, seed = 1}
--- > run.report.steps, run.report.best < run.report.first  --> 500, true
--- > clench.plan.anneal {hand = hand, object = flask, step = 500}  --> error: unknown key 'step'
--- > clench.plan.anneal {hand = hand, object = flask, energy = "contct"}  --> error: clench.energy has no 'contct'; did you mean 'contact'?
return function(options)
  local job = new_job("plan.anneal", options, function(read, job)
    job.energy = read:get "energy"
    job.steps = read:get "steps"
    job.schedule, job.best = read:checked "schedule", read:checked "best"
  end)
  local search = job:annealing {energy = job:energy_of(job.energy), seed = job.seed, schedule = job.schedule, best = job.best}
  local stats = chain.run(job, search, job.steps)
  chain.energies(stats, search)
  stats.planner = "plan.anneal"

  local found = {}
  job:interruptible(function()
    for _, state in ipairs(search.best) do
      if not job:has_patience() then break end
      local grasp = job:close(job.hand, job.object, state, stats)
      if grasp then
        found[#found + 1] = closing.note(grasp, "anneal", {energy = state.energy, step = state.step, seed = job.seed})
      end
    end
  end)
  if #found == 0 and not job.stopped then chain.nearest(job, search, stats) end
  job:finish()
  return new_run(job, found, stats, {})
end
