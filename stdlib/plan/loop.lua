-- stdlib/plan/loop.lua
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local chain = require "clench.plan.chain"
local closing = require "clench.plan.closing"

--- Annealing again and again: what a loop found is avoided by those that follow, so that they look elsewhere.
---@param options {hand: robot, object: body, energy?: string|energy|function, steps?: integer, loop_steps?: integer, seconds?: number, seed?: integer, max_energy?: number, count?: integer, world?: world, max_effort?: number}  energy: "guided_potential_quality" by default; steps: 70000 in all, loop_steps of each loop, 5000; max_energy: states above 10 are not kept; count: of grasps, any number by default; and as of plan.anneal; max_effort: of motors without a limit [N m or N]
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
