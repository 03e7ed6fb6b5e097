--- Jobs of the session, with their progress.
local function draw(ui, view)
  local session = view.session
  if #session.jobs == 0 then return ui:text("No job was started.", {color = {0.5, 0.5, 0.5}}) end
  for i, job in ipairs(session.jobs) do
    ui:id("job" .. i, function(ui)
      ui:text(("%d  %s  %s"):format(i, job.name or "", job.state))
      local progress = job.progress
      local fraction = job.state == "done" and 1 or progress.fraction or 0
      ui:progress(math.max(0, math.min(1, fraction)), "")
      if progress.text then ui:text(progress.text, {wrap = true}) end
      if job.state == "running" or job.state == "paused" or job.state == "queued" then
        if ui:button(job.state == "paused" and "Resume" or "Pause") then view:run(job.state == "paused" and "job.resume" or "job.pause", {job = i}) end
        ui:same_line()
        if ui:button("Stop Job") then view:run("job.stop", {job = i}) end
      end
      local ok, grasps = pcall(session.grasps_of, session, job)
      if ok and #grasps > 0 and ui:collapsing(("%d grasps###grasps"):format(#grasps), false, function(ui)
        for rank = 1, math.min(#grasps, 50) do
          if ui:selectable(("grasp %d"):format(rank), false) then view:run("grasp.apply", {job = i, rank = rank}) end
        end
      end) then end
    end)
  end
end

return {name = "Jobs", place = "right", tab = true, draw = draw}
