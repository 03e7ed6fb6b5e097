--- Shared by the planners that anneal: runs a chain in pieces until its steps or its time are used up, and collects the numbers for its report.
local on_behalf_of = require "clench.on_behalf_of"
local raise = require "clench.raise"
local chain = {}

local piece = 1000  -- steps between two checks of the time

--- Runs a chain.
---@return table stats  statistics for plan.report
function chain.run(job, search, steps, stats)
  stats = stats or {steps = 0, accepted = 0, in_collision = 0, avoided = 0, stuck = 0, trace = {}}
  local bar <close> = clench.progress(steps, job.subject)
  local done, before = 0, search.counts
  job:search_in_time(function()
    while done < steps and job:goes_on() do
      local asked = math.min(piece, steps - done)
      local taken = on_behalf_of(job.subject, search.run, search, asked)
      done = done + taken
      bar:step(taken)
      local best = search.best[1]
      if best then stats.trace[#stats.trace + 1] = {stats.steps + done, best.energy} end
      if taken < asked then break end
    end
  end)
  local counts = search.counts
  for _, name in ipairs {"steps", "accepted", "in_collision", "avoided", "stuck"} do
    stats[name] = stats[name] + counts[name] - before[name]
  end
  return stats
end

--- Stores the best energy and the energy of the start in the statistics.
function chain.energies(stats, search)
  stats.first = stats.first or search.first_energy
  local best = search.best[1] and search.best[1].energy or search.energy
  stats.best = math.min(stats.best or math.huge, best)
end

--- Smallest distance of hand and object in the best states [m], for the report of a search without grasps.
function chain.nearest(job, search, stats)
  local here <close> = job.world:snapshot()
  local nearest = math.huge
  local states = search.best
  if #states == 0 and search.energy == math.huge then
    job:finish()
    raise(job.subject .. ": energy: expected a finite number of at least one state, got inf of all")
  end
  for _, state in ipairs(#states > 0 and states or {search.state}) do
    job.hand:set_posture(job.object.pose * state.pose, state.dofs)
    nearest = math.min(nearest, (job.world:distance(job.hand, job.object)))
  end
  job.world:restore(here)
  stats.nearest = nearest
end

return chain
