--- The function of the jobs of `clench.plan.start`: a planner whose grasps are sent as events as soon as they are found, and whose progress is
--- shown.
local early = {sample = true, random = true, antipodal = true, primitive = true} -- planners that report each grasp as it is found

return function(planner, options)
  local job = clench.this_job
  if early[planner] then
    options.on_grasp = function(grasp) job:event(grasp) end
    if planner == "sample" then options.on_progress = function(state) job:show(state) end end
  end
  local run = clench.plan[planner](options)
  if not early[planner] then
    for _, grasp in ipairs(run.grasps) do job:event(grasp) end
  end
  return run
end
