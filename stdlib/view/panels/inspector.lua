--- Properties of what is selected: pose, DOFs, mass, material.
local function close_to(a, b) return math.abs(a - b) < 1e-12 end

local function draw_pose(ui, view, thing)
  local position, euler = thing.pose.position, thing.pose.rpy
  local values, changed, finished = {position.x, position.y, position.z}, false, false
  local factor = view.units.length == "mm" and 1000 or 1
  for i, axis in ipairs {"x", "y", "z"} do
    ui:width(-40)
    local value, is_changed, is_finished = ui:drag(axis .. " [" .. view.units.length .. "]", values[i] * factor, {speed = factor * 1e-3, format = "%.4g"})
    if is_changed and not close_to(value / factor, values[i]) then values[i], changed = value / factor, true end
    finished = finished or is_finished
  end
  if changed then
    if not view.session.gesture then view.session:begin_gesture("Move " .. thing.name) end
    thing.pose = clench.pose {xyz = clench.vec3(table.unpack(values))} * clench.pose {rpy = euler}
    view.session:emit("changed", {gesture = true})
  end
  if finished then view.session:end_gesture() end
end

local function draw_dofs(ui, view, robot)
  local dofs, limits, infos = robot.dofs, robot.dof_limits, robot.dof_info
  for i = 1, #dofs do
    local low, high = limits[i][1], limits[i][2]
    ui:width(-90)
    local name = infos and infos[i] and infos[i].name or "DOF " .. i
    local value, changed, finished = ui:slider(name .. "##dof" .. i, dofs[i], {min = low, max = high, format = "%.3f"})
    if changed then
      if not view.session.gesture then view.session:begin_gesture("Set DOFs of " .. robot.name) end
      local goal = {}
      for k = 1, #dofs do goal[k] = dofs[k] end
      goal[i] = math.max(low, math.min(high, value))
      robot:move_dofs(goal)
      view.session:emit("changed", {gesture = true})
    end
    if finished then view.session:end_gesture() end
  end
end

local function draw_body(ui, view, body)
  ui:text(("mass      %.4g kg"):format(body.mass))
  ui:text("material  " .. tostring(body.material))
  ui:text("kind      " .. body.kind)
end

local function draw(ui, view)
  local thing = view.session.selection[1]
  if not thing then return ui:text("Nothing is selected.", {color = {0.5, 0.5, 0.5}}) end
  local is_robot = clench.type(thing) == "robot"
  ui:text(thing.name)
  ui:separator()
  if is_robot or not thing.robot then draw_pose(ui, view, thing) end
  if is_robot then
    ui:collapsing("DOFs", true, function(ui) draw_dofs(ui, view, thing) end)
  else
    draw_body(ui, view, thing)
  end
end

return {name = "Inspector", place = "right", draw = draw}
