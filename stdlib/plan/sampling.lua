--- What plan.sample and plan.random share: random starts, tried over threads.
local drives = require "clench.drives"
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local batch = require "clench.plan.batch"
local recorded = require "clench.plan.recorded"
local script_line = require "clench.script_line"
local starts = require "clench.plan.starts"

---@param name string  "sample"
---@param options table
---@param read_more? fun(read: table, own: table, job: table)  reads refine and verify
return function(name, options, read_more)
  local own = {planner = name, refine = 0, friction = 0.5, width = 0.2, kind = "both"}
  local job = new_job("plan." .. name, options, function(read, job)
    own.count = read:count("count", 100, 1, 1000000)
    own.limit = read:count("candidates", 100000, 1, 1e9)
    own.standoff = read:positive("standoff", 0.15, 10)
    own.distance = read:not_negative("distance", 0.1)
    own.on_grasp = read:callback "on_grasp"
    if read_more then read_more(read, own, job) end
  end)
  local no_force = own.verify and drives.no_force(job.hand)
  if no_force then clench.log.warning(script_line() .. ("%s: %s"):format(job.subject, no_force)) end
  own.approach = 2 * own.standoff
  local told = {planner = "plan." .. name}
  local journal = recorded[options]
  own.journal = journal
  local found = {}
  if no_force and own.verify.min_load > 0 and drives.is_inert(job.hand) then
    told.verify, told.candidates, told.rejected = own.verify, 0, {}
  else
    found = batch.try(job, told, job:prepare(starts.random, own), own)
    if journal then journal:add_listed(found) end
  end
  job:finish()
  return new_run(job, batch.sort(found), told, {count = math.max(own.count, journal and journal.keep or 0), distance = own.distance})
end
