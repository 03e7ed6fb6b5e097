--- The selection: pose, DOFs and body properties, in the units of the user. A number is dragged to change it, or typed after Ctrl and a click.
local dof_labels = require "clench.view.dof_labels"
local edit = require "clench.view.edit"
local facts = require "clench.view.world_facts"
local outline = require "clench.view.outline"
local properties = require "clench.view.properties"
local units = require "clench.view.units"

local function draw_pose(ui, view, thing)
  local position, angles = thing.pose.position, thing.pose.rpy
  local values = {position.x, position.y, position.z, angles[1], angles[2], angles[3]}
  local changed, finished = false, false
  for i, axis in ipairs {"x", "y", "z", "roll", "pitch", "yaw"} do
    local factor, name, format = units.of(view, i <= 3 and "m" or "rad")
    ui:width(-90 * view.scale)
    local value, is_changed, is_finished = ui:drag(("%s [%s]"):format(axis, name), units.field(values[i] * factor, format), {speed = factor * (i <= 3 and 1e-3 or 5e-3), format = format})
    if is_changed then values[i], changed = value / factor, true end
    finished = finished or is_finished
  end
  if changed then
    edit.begin(view, "Move " .. thing.name)
    thing.pose = clench.pose {xyz = {values[1], values[2], values[3]}, rpy = {values[4], values[5], values[6]}}
    view.session:emit("changed", {gesture = true})
  end
  if finished then edit.finish(view) end
end

local function draw_dof(ui, view, robot, i, label, value, limits)
  local factor, _, format = units.of(view, label.unit)
  ui:width(-130 * view.scale)
  local set, changed, finished = ui:slider(("%s##dof%d"):format(label.short, i), value * factor, {min = limits[1] * factor, max = limits[2] * factor, format = format})
  ui:tooltip(label.text)
  outline.mark(view, ui, robot, i)
  if changed then
    edit.begin(view, "Set DOFs of " .. robot.name)
    local goal = {table.unpack(robot.dofs)}
    goal[i] = math.max(limits[1], math.min(limits[2], set / factor))
    robot:move_dofs(goal)
    view.session:emit("changed", {gesture = true})
  end
  if finished then edit.finish(view) end
end

-- the DOFs, each finger below its number
local function draw_dofs(ui, view, robot)
  local dofs, limits, finger = robot.dofs, robot.dof_limits, ""
  for i, label in ipairs(dof_labels.of(robot)) do
    if label.finger ~= finger then
      finger = label.finger
      ui:text(finger, {color = {0.5, 0.5, 0.5}})
    end
    draw_dof(ui, view, robot, i, label, dofs[i], limits[i])
  end
end

local function draw_one(ui, view, thing)
  ui:text(thing.name)
  local is_robot = clench.type(thing) == "robot"
  local mount = is_robot and thing.parent
  if mount then
    ui:text(("mounted on %s"):format(mount.name), {color = {0.5, 0.5, 0.5}})
  elseif is_robot or not thing.robot then
    draw_pose(ui, view, thing)
  else
    ui:text(("link of %s"):format(thing.robot.name), {color = {0.5, 0.5, 0.5}})
  end
  if is_robot then ui:collapsing("DOFs", true, function(ui) draw_dofs(ui, view, thing) end) end
end

local function draw(ui, view)
  local selection = view.session.selection
  if #selection == 0 then return facts.draw(view, ui) end
  if #selection == 1 then
    draw_one(ui, view, selection[1])
  else
    local names = {}
    for i, thing in ipairs(selection) do names[i] = thing.name end
    ui:text(table.concat(names, ", "), {wrap = true})
  end
  ui:collapsing("Body Properties", true, function(ui) properties.draw(view, ui) end)
end

return {name = "Inspector", place = "right", draw = draw}
