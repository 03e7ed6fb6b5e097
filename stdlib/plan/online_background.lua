--- The function of the jobs of an on-line planner: one period, on a copy of the world. It shows the state that the search has reached.
local period = require "clench.plan.online_period"
local quiet = require "clench.plan.quiet"

return function(options, number, steps)
  local silence <close> = quiet()  -- the planner itself has warned
  local job = period.new(options)
  local this = clench.this_job
  local found, stats = period.search(job, job:energy_of(job.energy), number, steps, function(state) this:show(state) end)
  return {found = found, stats = stats}
end
