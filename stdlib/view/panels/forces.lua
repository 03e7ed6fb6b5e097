--- Force optimization and stability analysis of the current grasp: forces for a load, the largest load, torques of the motors, and the loads that they hold.
local dof_labels = require "clench.view.dof_labels"
local edit = require "clench.view.edit"
local results = require "clench.view.force_results"
local gray = {0.5, 0.5, 0.5}

local objectives = {"min_sum", "min_norm", "min_max", "max_margin", "max_margin_sum"}
local coordinates = {"fx", "fy", "fz", "tx", "ty", "tz"}

local function index_of(list, value)
  for i, item in ipairs(list) do
    if item == value then return i end
  end
end

local function choose(ui, label, width, list, value)
  ui:width(width)
  local chosen, changed = ui:combo(label, index_of(list, value), list)
  return changed and list[chosen] or value
end

-- a number of the state that is dragged or typed
local function number(view, ui, label, owner, key, options)
  local value = edit.number(view, ui, label, "forces " .. label, owner[key], options)
  if value then owner[key] = math.max(options.min or value, value) end
end

local function draw_load(view, ui, state)
  local object = view.session.object
  if ui:radio("weight", not state.wrench) then state.wrench = nil end
  ui:tooltip(("Weight of %s, %.3g kg"):format(object.name, object.mass))
  ui:same_line()
  if ui:radio("wrench", state.wrench ~= nil) then state.wrench = state.wrench or {0, 0, 0, 0, 0, 0} end
  ui:tooltip "Any load, along the axes of the world, torques about the center of mass of the object [N, N m]"
  if not state.wrench then return end
  for i, name in ipairs(coordinates) do
    if i % 3 ~= 1 then ui:same_line(6) end
    ui:width(52 * view.scale)
    number(view, ui, name, state.wrench, i, {speed = i <= 3 and 0.05 or 0.005, format = "%.3g"})
  end
end

local function draw_limits(view, ui, state)
  ui:width(120 * view.scale)
  number(view, ui, "max. force [N]", state, "max_force", {speed = 0.1, min = 0, max = 1e5, format = "%.3g"})
  ui:tooltip "Largest normal force of each contact; 0: no limit."
  state.torque_limits = ui:checkbox("torques of the motors", state.torque_limits == true)
  ui:tooltip "The motors stay within their limits."
end

-- sums that the optimization prescribes
local function draw_sums(view, ui, state)
  ui:width(120)
  number(view, ui, "sum of forces [N]", state, "total_force", {speed = 0.1, min = 0, max = 1e6, format = "%.3g"})
  ui:tooltip "Prescribed sum of the normal forces, for Optimize; 0: none."
  ui:width(120)
  number(view, ui, "sum of torques", state, "total_torque", {speed = 0.01, min = 0, max = 1e6, format = "%.3g"})
  ui:tooltip "Prescribed sum of the efforts of all motors, closing [N m or N], for Optimize; 0: none."
  state.unilateral = ui:checkbox("motors only close", state.unilateral == true)
  ui:tooltip "No motor may pull in the opening direction, for Optimize."
  state.nearest = ui:checkbox("nearest balance", state.nearest == true)
  ui:tooltip "If no forces balance the load, Optimize finds those with the smallest unbalanced wrench."
end

-- torques that the motors keep, one per DOF: the force of its tendon, if it has one
local function draw_torques(view, ui, state)
  local hand = view.session.hand
  local on, changed = ui:checkbox("constant torques", state.torques ~= nil)
  ui:tooltip "The motors keep these torques at every load, one per DOF; of a DOF on springs, that of its tendon. Optimal Preload sets them."
  state.springs = ui:checkbox("springs hold", state.springs == true)
  ui:tooltip "Stability: motors hold the tendons of compliant DOFs at their present lengths, and their springs press.\ngrasp:equilibrium {torques = \"springs\"}"
  if changed or state.torques and #state.torques ~= #hand.dofs then
    state.torques = on and {} or nil
    for i = 1, on and #hand.dofs or 0 do state.torques[i] = 0 end
  end
  for i, label in ipairs(state.torques and dof_labels.of(hand) or {}) do
    ui:width(120 * view.scale)
    number(view, ui, ("%s##torque%d"):format(label.text, i), state.torques, i, {speed = 0.01, format = "%.4g"})
  end
end

local function ask(view, state, kind, options)
  options.max_force = state.max_force > 0 and state.max_force or nil
  local result = view:run("grasp." .. kind, options)
  state.kind, state.result, state.hash = kind, result, view.session.world:hash()
  view.shown_forces = result and result.forces and #result.forces > 0 and {forces = result.forces, stamp = view.stamp, hash = state.hash} or nil
  return result
end

-- loads of a preload: none, and the load times the factor
local function loads_of(view, state)
  local object, g = view.session.object, view.session.world.gravity
  local load, scaled = state.wrench or {object.mass * g.x, object.mass * g.y, object.mass * g.z, 0, 0, 0}, {}
  for i = 1, 6 do scaled[i] = state.factor * load[i] end
  return {{0, 0, 0, 0, 0, 0}, scaled}
end

local function optimization(state)
  local function given(value) return value > 0 and value or nil end
  return {load = state.wrench, objective = state.objective, torque_limits = state.torque_limits or nil, total_force = given(state.total_force),
          total_torque = given(state.total_torque), unilateral = state.unilateral or nil, balance = state.nearest and "nearest" or nil}
end

local function draw_questions(view, ui, state)
  local torques = state.torques
  if ui:button "Optimize" then ask(view, state, "forces", optimization(state)) end
  ui:tooltip "Contact forces that hold the load"
  ui:same_line()
  state.objective = choose(ui, "##objective", 140, objectives, state.objective)
  ui:tooltip "Objective that selects one of many sets of forces"
  if ui:button "Stability" then ask(view, state, "stability", {load = state.wrench, torques = state.springs and "springs" or torques}) end
  ui:tooltip "Can object and joints be in balance?"
  ui:same_line()
  if ui:button "Maximum Wrench" then
    ask(view, state, "maximum_wrench", {direction = state.wrench, torque_limits = not torques and state.torque_limits or nil, torques = torques})
  end
  ui:tooltip "The largest multiple of the load that is held"
  if ui:button "Optimal Preload" then
    local result = ask(view, state, "preload", {loads = loads_of(view, state), locked = state.locked or nil})
    if result and result.torques then state.torques = {table.unpack(result.torques)} end
  end
  ui:tooltip "The smallest torques that hold the object without a load, and under the load times the factor on the right, without being adjusted"
  ui:same_line()
  ui:width(46 * view.scale)
  number(view, ui, "x load", state, "factor", {speed = 0.05, min = 0.01, max = 1000, format = "%.3g"})
  state.locked = ui:checkbox("locked joints", state.locked == true)
  ui:tooltip "The preload presses first; then the joints do not move, as with worm gears, and the contacts yield as equal springs. Otherwise the torques stay constant."
  if ui:button "Resistible Wrenches" then ask(view, state, "resistible_wrenches", {axes = {state.x, state.y}, torques = torques}) end
  ui:tooltip "All wrenches in the plane of two coordinates that are held"
  ui:text "in the plane of"
  ui:same_line()
  state.x = choose(ui, "##x", 56, coordinates, state.x)
  ui:same_line()
  state.y = choose(ui, "##y", 56, coordinates, state.y)
end

local function state_of(view)
  view.forces = view.forces or {objective = "min_sum", max_force = 0, total_force = 0, total_torque = 0, factor = 1.5, x = "fx", y = "fz"}
  return view.forces
end

local function draw(ui, view)
  local session = view.session
  if not (session.hand and session.object) then return ui:text("A hand and an object are needed.", {color = gray, wrap = true}) end
  local state = state_of(view)
  draw_load(view, ui, state)
  draw_limits(view, ui, state)
  ui:collapsing("Prescribed Sums", false, function(ui) draw_sums(view, ui, state) end)
  draw_torques(view, ui, state)
  draw_questions(view, ui, state)
  results.draw(view, ui, state)
end

-- makes torques the constant ones of the panel
local function use(view, torques) state_of(view).torques = torques end

return {name = "Forces", place = "right", tab = true, tall = true, draw = draw, use = use}
