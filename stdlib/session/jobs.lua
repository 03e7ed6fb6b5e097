--- Jobs of a session: their progress and end become events of the session, and the grasps that planners send are stored.
local jobs = {}

local interval = 0.1  -- time between two progress events [s]

-- stores the events that have arrived
local function collect(session, job)
  local found = session.found[job]
  for _, event in ipairs(job:events()) do
    if clench.type(event) == "grasp" then found[#found + 1] = event end
  end
  return found
end

--- Adds a job to `session.jobs`, and monitors it in the loop.
---@param name string  name of the command that started it
function jobs.add(session, job, name)
  session.jobs[#session.jobs + 1], session.found[job] = job, {}
  clench.loop.spawn(function()
    while not clench.loop.wait(job, interval) do
      collect(session, job)
      local progress = job.progress
      session:emit("progress", {command = name, job = job, fraction = progress.fraction, text = progress.text})
    end
    collect(session, job)
    session:emit("result", {command = name, job = job, state = job.state})
  end)
  return job
end

--- Grasps of a planner's job: those of its result, best first, or those found so far.
function jobs.grasps(session, job)
  local found = collect(session, job)
  if job.state ~= "done" then return found end
  local result = job:result()
  local list = {}
  for i, grasp in ipairs(type(result) == "table" and result.grasps or {}) do list[i] = grasp end
  return list
end

return jobs
