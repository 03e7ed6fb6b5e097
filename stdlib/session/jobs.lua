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

-- is grasp a better than b? Annealing minimizes an energy, other planners maximize epsilon
local function is_better(a, b)
  local one, other = a.info.energy, b.info.energy
  if one and other then return one < other end
  return (a.epsilon or 0) > (b.epsilon or 0)
end

-- the best first; equally good ones in the order in which they were found
local function best_first(found)
  local order, list = {}, {}
  for i in ipairs(found) do order[i] = i end
  table.sort(order, function(i, j)
    if is_better(found[i], found[j]) then return true end
    return not is_better(found[j], found[i]) and i < j
  end)
  for rank, i in ipairs(order) do list[rank] = found[i] end
  return list
end

--- Grasps of a planner's job, best first: those of its result, or those found so far.
function jobs.grasps(session, job)
  local found = collect(session, job)
  if job.state ~= "done" then return best_first(found) end
  local result = job:result()
  local list = {}
  for i, grasp in ipairs(type(result) == "table" and result.grasps or {}) do list[i] = grasp end
  return list
end

return jobs
