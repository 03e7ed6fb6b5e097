--- Tendons of the current hand: their lengths and forces, lines in the picture, and pulls that become the constant torques of panel Forces.
local camera = require "clench.view.camera"
local edit = require "clench.view.edit"
local forces = require "clench.view.panels.forces"
local routes = require "clench.tendon_routes"
local stereo = require "clench.view.stereo"
local units = require "clench.view.units"

local gray, blue, orange, green = {0.5, 0.5, 0.5}, {0, 0.45, 0.7, 1}, {0.9, 0.6, 0, 1}, {0, 0.5, 0.35, 1}

-- lines over the picture; the chosen tendon is orange
local function draw_lines(view, ui, tendons, chosen, plain)
  for _, tendon in ipairs(tendons) do
    local last_x, last_y
    for _, point in ipairs(routes.points(tendon)) do
      local x, y = camera.project(view.camera, ui.size, point)
      local color = tendon.name == chosen and orange or plain
      if x and last_x then ui:line({last_x, last_y, x, y}, {color = color, width = 2}) end
      if x then ui:circle(x, y, 3, {color = color, filled = true}) end
      last_x, last_y = x, y
    end
  end
end

local function draw_row(view, ui, state, tendon)
  local length = routes.length(tendon)
  ui:next_column()
  if ui:selectable(tendon.name .. "##tendon", state.chosen == tendon.name) then state.chosen = state.chosen ~= tendon.name and tendon.name or nil end
  ui:tooltip("length " .. units.text(view, length, "m") .. ", along straight lines between its points")
  ui:next_column()
  ui:text(tendon.rest_length and units.text(view, length - tendon.rest_length, "m") or "–")
  ui:next_column()
  ui:text(("%.3g"):format(routes.passive_force(tendon)))
  ui:next_column()
  ui:width(-1)
  local pull = edit.number(view, ui, "##pull" .. tendon.name, "pull " .. tendon.name, state.pulls[tendon.name] or 0, {speed = 0.05, min = 0, format = "%.3g"})
  if pull then state.pulls[tendon.name] = math.max(0, pull) end
end

-- torques of all pulls, one per DOF
local function torques_of(hand, tendons, pulls)
  local torques = {}
  for i = 1, #hand.dofs do torques[i] = 0 end
  for _, tendon in ipairs(tendons) do
    local pull = pulls[tendon.name] or 0
    for i, arm in ipairs(pull ~= 0 and routes.arms(hand, tendon) or {}) do torques[i] = torques[i] + pull * arm end
  end
  return torques
end

-- pulls that are not zero
local function given_pulls(tendons, pulls)
  local given, any = {}, false
  for _, tendon in ipairs(tendons) do
    given[tendon.name] = pulls[tendon.name] or 0
    any = any or given[tendon.name] > 0
  end
  return any and given or nil
end

local function draw_found(view, ui, state)
  local found = state.found
  ui:text(("%s, unbalanced torque %.2g N m, %.2g before"):format(found.status, found.error or 0, found.first_error or 0), {wrap = true, color = found.status == "balanced" and green or nil})
  ui:table("shifts", {"tendon", "points", "shift"}, {}, function(ui)
    for _, shift in ipairs(found.shifts) do
      ui:next_column() ui:text(shift.tendon)
      ui:next_column() ui:text(table.concat(shift.points, ", "))
      ui:next_column() ui:text(units.text(view, shift.value, "m"))
    end
  end)
end

-- McGrip's search: routes with which the pulls hold the grasp
local function draw_search(view, ui, state, hand)
  ui:disabled(not view.session.object, function(ui)
    if ui:button "Find Routes" then
      state.found = view:run("grasp.tendon_design", {pulls = given_pulls(hand.tendons, state.pulls)})
      state.found_for = hand
    end
  end)
  ui:tooltip "Shifts the points at which tendons cross joints until the pulls, 1 N by default, hold the object without further motors\nclench.study.tendon_design"
  if state.found and state.found_for == hand then draw_found(view, ui, state) else state.found = nil end
end

-- the routes that were found, as tendons
local function found_tendons(state)
  local list = {}
  for name, points in pairs(state.found.points) do list[#list + 1] = {name = name, points = points} end
  return list
end

local function draw(ui, view)
  local hand = view.session.hand
  if not hand then return ui:text("No hand is current.", {color = gray}) end
  local tendons = hand.tendons
  if #tendons == 0 then return ui:text(("%s has no tendons."):format(hand.name), {color = gray, wrap = true}) end
  view.tendons = view.tendons or {shows = true, pulls = {}}
  local state = view.tendons
  state.shows = ui:checkbox("show", state.shows)
  if state.shows then
    stereo.over(view, ui, function()
      draw_lines(view, ui, tendons, state.chosen, blue)
      if state.found then draw_lines(view, ui, found_tendons(state), nil, green) end
    end)
  end
  ui:table("tendons", {"tendon", "excursion", "passive [N]", "pull [N]"}, {}, function(ui)
    for _, tendon in ipairs(tendons) do draw_row(view, ui, state, tendon) end
  end)
  if ui:button "Use as Constant Torques" then
    forces.use(view, torques_of(hand, tendons, state.pulls))
    view.front.right = "Forces"
  end
  ui:tooltip "Panel Forces takes the torques that these pulls exert on the DOFs."
  draw_search(view, ui, state, hand)
end

return {name = "Tendons", place = "right", tab = true, draw = draw}
