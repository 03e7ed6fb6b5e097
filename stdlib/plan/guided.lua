-- stdlib/plan/guided.lua
local on_behalf_of = require "clench.on_behalf_of"
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local chain = require "clench.plan.chain"
local closing = require "clench.plan.closing"

local piece = 2000           -- steps of the parent per run of its children, which take about the same time
local child_steps = 200
local max_seeds, seed_distance = 20, 0.3
local seed_energy = -0.1     -- states of the parent with lower energies are seeds, see GraspIt!'s "Multi-Threaded"
local trust = {position = 0.65, posture = 0.5}

-- targets of the children's variables: all values of the seed, with less confidence for those of the posture
local function targets_of(state)
  local targets = {}
  for name, value in pairs(state.values) do
    targets[name] = {value, name:find "^EG %d" and trust.posture or trust.position}
  end
  return targets
end

-- A new seed of the parent: its best state below the threshold that differs from all earlier seeds.
local function take_seed(parent, stats)
  local best = parent.best[1]
  if best and best.energy < seed_energy then
    stats.seeds = stats.seeds + 1
    parent:avoid(best)
    parent:clear()
    parent:reset()
    return best
  end
end

--- Annealing that is guided by the quality of virtual contacts; from each promising state a child chain searches for the best closed grasp nearby. Children run
--- in parallel to the parent and are merged at fixed steps, so the grasps do not depend on the number of threads.
---@param options table  hand, object and settings of the search
---@like clench.plan.anneal  hand, object
---@option energy? string|energy|function = "guided_potential_quality"  objective of the parent chain
---@option steps? integer [1 to 1000000000] = 70000  steps of annealing of the parent
---@option children? integer [1 to 64] = 1  maximum number of child chains that run at once
---@option child_steps? integer [1 to 1000000] = 200  steps of each child
---@option child_energy? string|energy|function  objective of the children, "strict_autograsp" without its volume by default
---@option count? integer [1 to 1000000]  number of grasps that ends the search, any number by default
---@like clench.plan.anneal  seconds, seed, position, posture, semi_axes, limits, jumps, values, targets, fixed, start, variables,
---  collisions, max_tries, contacts, touch, threads, grasp, world, max_effort
---@return {grasps: grasps, report: table} # grasps in force closure, in order of decreasing epsilon
---@effect long
--- > run = clench.plan.guided {hand = hand, object = flask, steps = 500, seed = 1}
--- > run.report.steps, run.report.seeds >= 0  --> 500, true
return function(options)
  local children, steps_of_child, child_energy, count
  local job = new_job("plan.guided", options, function(read, job)
    job.energy = read:get "energy"
    job.steps = read:get "steps"
    children = read:get "children"
    steps_of_child = read:get "child_steps"
    child_energy = read:get "child_energy"
    count = read:get("count", 1000000)
  end)
  local parent = job:annealing {energy = job:energy_of(job.energy), seed = job.seed,
                                best = {distance = seed_distance, size = max_seeds, max_energy = seed_energy}}
  -- without the volume, which is slowest to compute and has the least influence
  local energy_of_child = child_energy and job:energy_of(child_energy) or
                          clench.energy.strict_autograsp {hand = job.hand, object = job.object, volume_weight = 0}
  local stats = {planner = "plan.guided", seeds = 0, threshold = seed_energy, trace = {}, first = parent.first_energy, best = parent.energy}
  local found, running, waiting = {}, {}, {}

  -- a child begins in a separate world; it is merged after the next piece of the parent's steps
  local function begin_child(seed)
    local number = stats.seeds
    local world = job.world:clone()
    local search = job:annealing {world = world, energy = energy_of_child, seed = job.seed + 7919 * number,
                                  schedule = "strict", targets = targets_of(seed), values = seed.values,
                                  best = {size = 4, distance = 0.1}}
    return {search = search, world = world, number = number, seed = seed}
  end

  local function merge(child)
    local hand, object = child.world:robot(job.hand.name), child.world:body(job.object.name)
    for _, state in ipairs(child.search.best) do
      if state.energy < 0 then
        local grasp = job:close(hand, object, state, stats, 0.03)
        if grasp and grasp.epsilon > 0 then
          found[#found + 1] = closing.note(grasp, "guided", {energy = state.energy, step = state.step, seed = job.seed, child = child.number})
        end
      end
    end
  end

  local bar <close> = clench.progress(job.steps, job.subject)
  local done = 0
  job:interruptible(function()
    while (done < job.steps or #waiting > 0) and job:goes_on() and #found < count do
      while #running < children and #waiting > 0 do
        running[#running + 1] = begin_child(table.remove(waiting, 1))
      end
      local asked = math.min(piece, job.steps - done)
      local searches, steps = {parent}, {asked}
      for i, child in ipairs(running) do searches[i + 1], steps[i + 1] = child.search, steps_of_child end
      local taken = job:in_time(function() return on_behalf_of(job.subject, clench.run_annealings, searches, steps, job.threads) end)
      for _, child in ipairs(running) do merge(child) end
      running = {}
      if not taken then break end
      done = done + taken[1]
      bar:step(taken[1], ("%d grasps"):format(#found))
      stats.best = math.min(stats.best, parent.best[1] and parent.best[1].energy or parent.energy)
      stats.trace[#stats.trace + 1] = {done, stats.best}
      if #waiting < max_seeds then waiting[#waiting + 1] = take_seed(parent, stats) end
      if taken[1] < asked then break end
    end
  end)
  local counts = parent.counts
  for _, name in ipairs {"steps", "accepted", "in_collision", "avoided", "stuck"} do stats[name] = counts[name] end
  table.sort(found, function(a, b) return a.epsilon > b.epsilon end)
  if #found == 0 and not job.stopped then chain.nearest(job, parent, stats) end
  job:finish()
  return new_run(job, found, stats, {count = count, distance = 0.1})
end
