--- Jobs of JSON-RPC clients: searches and long commands. Each has a number; its client is notified of its states and events.
local failure = require "clench.control.rpc.failure"
local files = require "clench.control.rpc.files"
local jobs = {}

local max_jobs = 100  -- maximum number that a server keeps, including those that are over

local function number_of(context, number)
  return context.server.jobs[number] or failure.raise("params", "job: there is no job %s", tostring(number))
end

local function described_job(number, kept)
  local job = kept.job
  local progress = job.progress
  return {job = number, name = job.name, state = job.state, progress = progress and progress.fraction}
end

local is_over = {done = true, failed = true, stopped = true}

-- makes space for one more job: removes the oldest of those that are over
local function make_place(server)
  local kept, oldest = 0, nil
  for number, one in pairs(server.jobs) do
    kept = kept + 1
    if is_over[one.job.state] and (not oldest or number < oldest) then oldest = number end
  end
  if kept < max_jobs then return true end
  if oldest then server.jobs[oldest] = nil end
  return oldest ~= nil
end

--- Calls on_end(job) when a job is over; without it, sends events and states of the job to its client until then.
local function watch(context, number, kept, on_end)
  local client = context.client
  local notify = on_end and function() end or context.notify
  clench.loop.spawn(function()
    local state
    repeat
      clench.loop.wait(kept.job, 0.05)
      local now = kept.job.state  -- once: the job may end at any time
      for _, event in ipairs(kept.job:events()) do notify(client, "job.event", {job = number, event = event}) end
      if is_over[now] and on_end then
        local ok, problem = pcall(on_end, kept)
        if not ok then kept.problem = problem end
      end
      if now ~= state then
        state = now
        notify(client, "job.state", described_job(number, kept))
      end
    until is_over[state]
  end)
end

--- Adds a job to the list of the server.
---@return integer number
function jobs.keep(context, job, on_end)
  local server = context.server
  if not make_place(server) then
    job:stop()
    failure.raise("refused", "%d jobs are running already", max_jobs)
  end
  server.job_count = server.job_count + 1
  local number = server.job_count
  server.jobs[number] = {job = job}
  watch(context, number, server.jobs[number], on_end)
  return number
end

local job_parameter = {name = "job", type = "integer", text = "its number"}

local function entity_options(session, options)
  local out = {}
  for key, value in pairs(options) do out[key] = value end
  for _, key in ipairs {"hand", "object"} do
    if type(out[key]) == "string" then out[key] = session:find(out[key]) end
    out[key] = out[key] or session[key]
  end
  return out
end

jobs.methods = {
  {name = "plan.start", text = "Starts a search in the background, on a copy of the world; its grasps are events of the job.",
   parameters = {{name = "planner", type = "string", text = "primitive, sample, antipodal, random, anneal, loop or guided"},
                 {name = "options", type = "table", default = {}, text = "of that planner; hand and object by address, the current ones by default"}},
   run = function(context, args)
     files.check_planner(args.planner, args.options)
     return {job = jobs.keep(context, clench.plan.start(args.planner, entity_options(context.session, args.options)))}
   end},
  {name = "job.list", reads = true, text = "All jobs of this server.", parameters = {}, run = function(context)
    local out = {}
    for number, kept in pairs(context.server.jobs) do out[#out + 1] = described_job(number, kept) end
    table.sort(out, function(x, y) return x.job < y.job end)
    return out
  end},
  {name = "job.state", reads = true, text = "State and progress of a job.", parameters = {job_parameter},
   run = function(context, args) return described_job(args.job, number_of(context, args.job)) end},
  {name = "job.result", reads = true, text = "The result of a job that is over.", parameters = {job_parameter}, run = function(context, args)
    local kept = number_of(context, args.job)
    if not is_over[kept.job.state] then failure.raise("failed", "job %d is not over", args.job) end
    if kept.problem then error(kept.problem, 0) end
    if kept.result ~= nil then return kept.result end
    return kept.job:result()
  end},
  {name = "job.stop", text = "Stops a job.", parameters = {job_parameter}, run = function(context, args) number_of(context, args.job).job:stop() end},
  {name = "job.pause", text = "Holds a job.", parameters = {job_parameter}, run = function(context, args) number_of(context, args.job).job:pause() end},
  {name = "job.resume", text = "Lets a job run on.", parameters = {job_parameter}, run = function(context, args) number_of(context, args.job).job:resume() end},
  {name = "job.forget", text = "Stops a job and drops its result.", parameters = {job_parameter}, run = function(context, args)
    number_of(context, args.job).job:stop()
    context.server.jobs[args.job] = nil
  end},
}

return jobs
