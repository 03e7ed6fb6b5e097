--- The on-line planner: it searches for grasps around the hand while the hand moves, and shapes the hand by the nearest one.
local dialog = require "clench.view.dialog"
local ghosts = require "clench.view.ghosts"
local units = require "clench.view.units"

local gray = {0.5, 0.5, 0.5}
local words = {planning = "PLANNING", grasping = "GRASPING", open = "OPEN"}
local colors = {planning = {0, 0.45, 0.7}, grasping = {0, 0.5, 0.35}, open = {0.5, 0.5, 0.5}}
local max_solutions = 10

local function button(view, ui, label, name, selected)
  dialog.button(view, ui, label .. "##online", "online." .. name, {selected = selected, width = 68 * view.scale})
end

local function row(ui, name, value, color)
  ui:next_column() ui:text(name, {color = gray})
  ui:next_column() ui:text(value, {color = color})
end

local function draw_state(view, ui, online)
  local nearest, planner = online.nearest, online.planner
  ui:table("on-line state", {"##name", "##value"}, {}, function(ui)
    row(ui, "status", words[online.status], colors[online.status])
    row(ui, "to the object", online.object_distance and units.text(view, online.object_distance, "m") or "–")
    row(ui, "to the solution", nearest and ("%s, %s"):format(units.text(view, nearest.distance, "m"), units.text(view, nearest.angle, "rad")) or "–")
    row(ui, "its epsilon", nearest and ("%.4f"):format(nearest.grasp.epsilon) or "–")
    row(ui, "solutions kept", ("%d of %d"):format(math.min(#planner.solutions, max_solutions), max_solutions))
    row(ui, "found, tested", ("%d, %d"):format(planner.found, planner.tested))
  end)
end

-- a setting of the planner, changed by its command
local function switch(view, ui, online, label, name)
  local on, changed = ui:checkbox(label, online[name])
  if changed then view:run("online.settings", {[name] = on}) end
  for _, parameter in ipairs(view.session.commands["online.settings"].parameters) do
    if parameter.name == name then ui:tooltip(parameter.text) end
  end
end

-- a ghost of the hand, switched by the view
local function ghost_switch(view, ui, label, name, kind)
  local on, changed = ui:checkbox(label, view[name] == true)
  if changed then
    view[name] = on
    view:changed()
  end
  ui:same_line()
  ui:text("■", {color = ghosts.colors[kind]})
end

local function draw_running(view, ui, online)
  draw_state(view, ui, online)
  button(view, ui, "Plan", "plan", online.status == "planning")
  ui:same_line()
  button(view, ui, "Grasp", "grasp", online.status == "grasping")
  ui:same_line()
  button(view, ui, "Open", "open", online.status == "open")
  ui:disabled(not online.nearest, function(ui)
    if ui:button "Go to Solution" then view:run("grasp.apply", {grasp = online.nearest.grasp}) end
  end)
  ui:tooltip "Moves the hand to the nearest grasp."
  switch(view, ui, online, "auto", "auto")
  switch(view, ui, online, "shape the simulated hand", "shape_hand")
  switch(view, ui, online, "shape the real hand", "shape_real")
end

local function draw(ui, view)
  local session = view.session
  local online = session.online
  if online then button(view, ui, "Stop", "stop") else button(view, ui, "Start…", "start") end
  ui:same_line()
  ui:text(online and ("%s, %s"):format(online.hand.name, online.object.name) or "not running", {color = gray})
  if online then draw_running(view, ui, online) end
  ghost_switch(view, ui, "show the search", "shows_search", "search")
  ghost_switch(view, ui, "show the nearest solution", "shows_solution", "solution")
  if not online then ui:text("Searches for grasps around the hand while you move it, or a sensor does.", {color = gray, wrap = true}) end
end

return {name = "On-line Planner", place = "right", tab = true, tall = true, draw = draw}
