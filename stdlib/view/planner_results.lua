--- The part of planner dialogs below their fields: start, pause and stop of the search, and stepping through its grasps.
local results = {}

local gray, orange = {0.5, 0.5, 0.5}, {0.84, 0.37, 0}

local function number_of(session, job)
  for i, other in ipairs(session.jobs) do
    if other == job then return i end
  end
end

local function is_busy(job) return job and (job.state == "running" or job.state == "queued" or job.state == "paused") end

-- moves the hand to a grasp of the job
local function show(view, state, rank)
  state.rank = rank
  view:run("grasp.apply", {job = number_of(view.session, state.job), rank = rank})
end

local function draw_controls(view, ui, state, start)
  local job = state.job
  local busy = is_busy(job) == true
  ui:disabled(busy, function(ui)
    if ui:button("Start", {width = 80 * view.scale}) then start() end
  end)
  ui:same_line()
  ui:disabled(not busy, function(ui)
    local paused = job and job.state == "paused"
    if ui:button(paused and "Resume" or "Pause", {width = 80 * view.scale}) then
      if paused then job:resume() else job:pause() end
    end
    ui:same_line()
    if ui:button("Stop", {width = 80 * view.scale}) then job:stop() end
  end)
end

local function text_of(grasp, rank, count)
  local parts = {("grasp %d of %d"):format(rank, count)}
  if grasp.epsilon then parts[#parts + 1] = ("epsilon %.4f"):format(grasp.epsilon) end
  if grasp.info.energy then parts[#parts + 1] = ("energy %.4g"):format(grasp.info.energy) end
  return table.concat(parts, ", ")
end

local function draw_steps(view, ui, state, grasps)
  local count = #grasps
  local rank = math.min(state.rank or 0, count)
  local function step(label, to, enabled)
    ui:disabled(not enabled, function(ui)
      if ui:button(label, {width = 50 * view.scale}) then show(view, state, to) end
    end)
    ui:same_line()
  end
  step("<##result", rank - 1, rank > 1)
  step("Best##result", 1, count > 0)
  step(">##result", rank + 1, rank < count)
  ui:text(rank > 0 and text_of(grasps[rank], rank, count) or count > 0 and ("%d grasps"):format(count) or is_busy(state.job) and "no grasps yet" or "no grasps", {color = gray})
end

-- why a search has found nothing
local function draw_report(ui, state)
  if state.reported ~= state.job then
    local ok, result = pcall(state.job.result, state.job)
    local report = ok and type(result) == "table" and result.report or nil
    state.reported, state.causes, state.report = state.job, report and report.causes or {}, report and tostring(report) or ""
  end
  if #state.causes > 0 then ui:text("Nothing was found, because", {color = orange}) end
  for _, cause in ipairs(state.causes) do ui:text("- " .. cause, {wrap = true, color = orange}) end
  if state.report == "" then return end
  ui:collapsing("Counts and Assumptions##report", #state.causes == 0, function(ui) ui:text((state.report:gsub("\nwhy: [^\n]*", "")), {wrap = true, color = gray}) end)
end

--- Draws the controls of a planner.
---@param state table  of the dialog: `job` once it has started
---@param start fun()  starts the search
function results.draw(view, ui, state, start)
  draw_controls(view, ui, state, start)
  local job = state.job
  if not job then return end
  local progress = job.progress
  ui:progress(job.state == "done" and 1 or math.max(0, math.min(1, progress.fraction or 0)), "")
  ui:text(("%s  %s"):format(job.state, progress.text or ""), {wrap = true})
  local ok, grasps = pcall(view.session.grasps_of, view.session, job)
  if not ok then return ui:text(tostring(grasps), {color = {0.84, 0.37, 0}, wrap = true}) end
  draw_steps(view, ui, state, grasps)
  if #grasps == 0 and job.state == "done" then draw_report(ui, state) end
end

return results
