--- Shared by plan.sample and plan.random: random starts, tried in several threads.
local assumptions = require "clench.plan.assumptions"
local diagnosis = require "clench.plan.diagnosis"
local drives = require "clench.drives"
local given_of = require "clench.plan.given"
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local batch = require "clench.plan.batch"
local recorded = require "clench.plan.recorded"
local report = require "clench.plan.report"
local script_line = require "clench.script_line"
local starts = require "clench.plan.starts"

local diagnosis_after = 3   -- a search without grasps after this time is diagnosed [s]
local max_diagnosis_time = 1  -- [s]

local function diagnose(job, own, next_state, assumed)
  local seconds = math.min(max_diagnosis_time, math.max(0.2, (job.seconds or math.huge) / 10))
  return diagnosis.text(diagnosis.of(job, next_state, own, seconds), assumed)
end

-- Returns a function that diagnoses the search once if it has found no grasps, and returns the result as a hint.
local function watch(job, own, next_state, assumed)
  return function(found)
    if own.diagnosis or found > 0 or not own.verify or job:elapsed() < diagnosis_after then return nil end
    own.diagnosis = diagnose(job, own, next_state, assumed) or ""
    return own.diagnosis ~= "" and own.diagnosis or nil
  end
end

---@param name string  "sample"
---@param options table
---@param read_more? fun(read: table, own: table, job: table)  reads refine and verify
return function(name, options, read_more)
  local own = {planner = name, refine = 0, friction = 0.5, width = 0.2, kind = "both"}
  local job = new_job("plan." .. name, options, function(read, job)
    own.count = read:get "count"
    own.limit = read:get "candidates"
    own.standoff = read:get "standoff"
    own.distance = read:get "distance"
    own.on_grasp = read:get "on_grasp"
    own.on_progress = read:get "on_progress"
    own.keep_searching = read:get "keep_searching"
    if read_more then read_more(read, own, job) end
  end)
  local no_force = own.verify and drives.no_force(job.hand)
  if no_force then clench.log.warning(script_line() .. ("%s: %s"):format(job.subject, no_force)) end
  own.approach = 2 * own.standoff
  local assumed = assumptions.of(job.hand, job.object, own.verify, given_of[options] or {})
  local stats = {planner = "plan." .. name}
  local journal = recorded[options]
  own.journal = journal
  local found = {}
  if no_force and own.verify.min_load > 0 and drives.is_inert(job.hand) then
    stats.verify, stats.candidates, stats.rejected = own.verify, 0, {}
  else
    local hopeless = own.verify and report.too_wide(job)
    if hopeless then clench.log.warning(script_line() .. ("%s: %s"):format(job.subject, hopeless)) end
    local next_state = job:prepare(starts.random, own)
    own.hint = next_state and watch(job, own, next_state, assumed)
    found = batch.try(job, stats, next_state, own)
    if #found == 0 and next_state and own.verify and not own.diagnosis and stats.candidates > 0 and not job.stopped then
      own.diagnosis = job:interruptible(function() return diagnose(job, own, next_state, assumed) end)
    end
    stats.short = own.diagnosis ~= "" and own.diagnosis or nil
    if journal then journal:add_listed(found) end
  end
  job:finish()
  stats.assumptions = assumed
  return new_run(job, batch.sort(found), stats, {count = math.max(own.count, journal and journal.keep or 0), distance = own.distance, spread = true})
end
