--- Projections of the wrench space of the current grasp, in the panel and in separate windows: three coordinates are fixed, and a drag turns the picture.
local camera = require "clench.view.camera"
local edit = require "clench.view.edit"
local projections = {}

local coordinates = {"fx", "fy", "fz", "tx", "ty", "tz"}
local gray = {0.5, 0.5, 0.5}
local radians_per_pixel = math.pi / 200

--- Settings of a projection: the values of fixed coordinates by name, and the norm of forces.
---@return {fixed: table<string, number>, norm: string, key: string} state
function projections.new(key) return {fixed = {tx = 0, ty = 0, tz = 0}, norm = "L1", key = key} end

local function copy_of(state, key)
  local copy = projections.new(key)
  copy.fixed, copy.norm = {}, state.norm
  for name, value in pairs(state.fixed) do copy.fixed[name] = value end
  return copy
end

local function stamp_of(view, state)
  local parts = {tostring(view.stamp), state.norm}
  for _, name in ipairs(coordinates) do parts[#parts + 1] = state.fixed[name] and name .. state.fixed[name] or "" end
  return table.concat(parts, " ")
end

local function draw_settings(view, ui, state)
  local fixed = {}
  for i, name in ipairs(coordinates) do
    local on, changed = ui:checkbox(name .. "##fixed" .. state.key, state.fixed[name] ~= nil)
    if changed then state.fixed[name] = on and 0 or nil end
    ui:tooltip "Fixed at the value below; three coordinates must be left."
    if state.fixed[name] then fixed[#fixed + 1] = name end
    if i % 3 ~= 0 then ui:same_line() end
  end
  for i, name in ipairs(fixed) do
    local label = name .. "##value" .. state.key
    ui:width(52 * view.scale)
    local value = edit.number(view, ui, label, "projection " .. label, state.fixed[name], {speed = 0.005, format = "%.3g"})
    ui:tooltip "Its value [N], torques over rho"
    if value then state.fixed[name] = value end
    if i % 3 ~= 0 and i < #fixed then ui:same_line(6) end
  end
  for _, norm in ipairs {"L1", "Linf"} do
    if ui:radio(norm .. "##norm" .. state.key, state.norm == norm) then state.norm = norm end
    ui:same_line()
  end
  ui:spacing()
  return #fixed
end

-- the picture of this state of the grasp, from the direction of its last drag
local function refresh(view, state, size)
  local stamp = stamp_of(view, state)
  if state.stamp == stamp and state.seen == state.camera then return end
  if state.stamp ~= stamp then
    state.stamp = stamp
    local ok, result = pcall(function()
      return clench.grasp(view.session.hand, view.session.object):wrench_space {norm = state.norm}:project {fixed = state.fixed}
    end)
    state.projection, state.error = ok and result or nil, not ok and tostring(result):gsub("^.-%.lua:%d+: ", "") or nil
  end
  if not state.projection then return end
  local from = state.camera or {}
  local ok, result = pcall(state.projection.render, state.projection, {size = {size, size}, quality = "draft", eye = from.eye, target = from.target, up = from.up})
  state.picture, state.error = ok and result or nil, not ok and tostring(result):gsub("^.-%.lua:%d+: ", "") or nil
  state.seen = state.camera
end

local function draw_picture(view, ui, state, size)
  refresh(view, state, size)
  if not state.picture then return ui:text(state.error, {wrap = true}) end
  local pressed = ui:image("wrench space" .. state.key, state.picture, {width = size, height = size})
  local mouse = ui.mouse
  state.turns = (pressed or state.turns) and mouse.left.down
  if state.turns and (mouse.dx ~= 0 or mouse.dy ~= 0) then
    state.camera = camera.orbited(state.camera or state.picture.camera, mouse.dx * radians_per_pixel, mouse.dy * radians_per_pixel)
  end
  ui:tooltip "Drag to turn. The arrow is the worst disturbance, the ball epsilon."
end

--- Draws settings and picture.
---@param size integer  of the picture [pixels]
function projections.draw(view, ui, state, size)
  local session = view.session
  if not (session.hand and session.object) then return ui:text("A hand and an object are needed.", {color = gray, wrap = true}) end
  if #session.world:contacts(session.hand, session.object) == 0 then
    return ui:text("The hand does not touch the object, so there is no wrench space.", {color = gray, wrap = true})
  end
  if draw_settings(view, ui, state) ~= 3 then return ui:text("Fix exactly three coordinates.") end
  draw_picture(view, ui, state, size)
end

--- Opens a window with the same settings.
function projections.open(view, state)
  view.projections = view.projections or {}
  view.opened_projections = (view.opened_projections or 0) + 1
  view.projections[#view.projections + 1] = copy_of(state, "window" .. view.opened_projections)
end

--- Draws the windows.
function projections.draw_windows(view, ui)
  local open = {}
  for i, state in ipairs(view.projections or {}) do
    local title = ("Wrench Space %s##%s"):format(state.key:match "%d+", state.key)
    local stays = ui:window(title, {x = (280 + 40 * i) * view.scale, y = (60 + 40 * i) * view.scale, width = 330 * view.scale, height = 470 * view.scale, movable = true, resizable = true, can_close = true},
                            function(ui) projections.draw(view, ui, state, 300) end)
    if stays then open[#open + 1] = state end
  end
  view.projections = open
end

return projections
