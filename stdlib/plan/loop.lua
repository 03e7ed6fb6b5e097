-- stdlib/plan/loop.lua
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local chain = require "clench.plan.chain"
local closing = require "clench.plan.closing"

--- Annealing again and again: what a loop found is avoided by those that follow, so that they look elsewhere.
---@param options table  the hand, the object and how the search goes
---@option hand robot  hand that grasps; it moves in a clone of its world
---@option object body  object that is grasped
---@option energy? string|energy|function = "guided_potential_quality"  objective
---@option steps? integer [1 to 1000000000] = 70000  steps of annealing in all
---@option loop_steps? integer [1 to 1000000000] = 5000  steps of each loop
---@option max_energy? number = 10  states above it are not kept
---@option count? integer [1 to 1000000]  number of grasps that ends the search, any number by default
---@option seconds? number [s, > 0]  time limit, unlimited by default
---@option seed? integer = 1  seed of the random numbers
---@option position? string  as of clench.annealing
---@option posture? string  as of clench.annealing
---@option semi_axes? vec3  as of clench.annealing
---@option limits? table  as of clench.annealing
---@option jumps? table  as of clench.annealing
---@option values? table  as of clench.annealing
---@option targets? table  as of clench.annealing
---@option fixed? string[]  as of clench.annealing
---@option start? string  as of clench.annealing
---@option variables? table  as of clench.annealing
---@option collisions? boolean  as of clench.annealing
---@option max_tries? integer  as of clench.annealing
---@option contacts? "fingertip"|"power"|"any"  fingertip: only the last links of fingers touch; power: the palm touches as well
---@option touch? table  {must = names of links, or lists of which one must touch, may = names}, in place of contacts
---@option threads? integer [1 to 1024] = 1  number of threads; the grasps do not depend on it
---@option grasp? table  options of clench.grasp
---@option world? world  world of both that the planner moves instead of that of the hand
---@option max_effort? number [N m or N, > 0]  largest torque or force of motors without a limit
---@return {grasps: grasps, report: table}
--- > run = clench.plan.loop {hand = hand, object = flask, steps = 600, loop_steps = 200, energy = "contact", max_energy = 500}
--- > run.report.steps, run.report.loops  --> 600, 3
return function(options)
  local loop_steps, max_energy, count
  local job = new_job("plan.loop", options, function(read, job)
    job.energy = read:raw "energy" or "guided_potential_quality"
    job.steps = read:count("steps", 70000, 1, 1e9)
    loop_steps = read:count("loop_steps", 5000, 1, 1e9)
    max_energy = read:number("max_energy", 10)
    count = read:count("count", 1000000, 1, 1000000)
  end)
  local search = job:annealing {energy = job:energy_of(job.energy), seed = job.seed, schedule = "loop",
                                best = {distance = 0.1, max_energy = max_energy}}
  local told, found, done = nil, {}, 0
  local loops = 0
  job:interruptible(function()
    while done < job.steps and job:goes_on() and #found < count do
      local before = done
      told = chain.run(job, search, math.min(loop_steps, job.steps - done), told)
      done, loops = told.steps, loops + 1
      chain.energies(told, search)
      for _, state in ipairs(search.best) do
        local grasp = job:close(job.hand, job.object, state, told)
        if grasp then found[#found + 1] = closing.note(grasp, "loop", {energy = state.energy, step = state.step, seed = job.seed, loop = loops}) end
        search:avoid(state)
      end
      search:clear()
      search:reset()
      if done == before then break end  -- no legal neighbour
    end
  end)
  told = told or {steps = 0, accepted = 0, in_collision = 0, avoided = 0, stuck = 0}
  told.planner, told.loops, told.threshold = "plan.loop", loops, max_energy
  table.sort(found, function(a, b) return a.info.energy < b.info.energy end)
  if #found == 0 and not job.stopped then chain.nearest(job, search, told) end
  job:finish()
  return new_run(job, found, told, {count = count})
end
