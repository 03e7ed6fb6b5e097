--- Fields of dialogs, one for each parameter of a command: choices, checkboxes, numbers of poses and vectors, and typed texts.
local units = require "clench.view.units"
local fields = {}

local width, path_width, pose_width = 210, 340, 282  -- at scale 1 [pixels]

-- text that a field shows for a value of any type
local function shown(value)
  if value == nil then return "" end
  if type(value) == "table" then return require("clench.session.script").literal(value) end
  return tostring(value)
end

-- the value of a typed text; nil if it is empty
local function read(parameter, text)
  if text == "" then return nil end
  if parameter.type == "number" then return tonumber(text) or text end
  if parameter.type == "integer" then return math.tointeger(tonumber(text)) or text end
  if parameter.type == "table" or parameter.type == "vec3" or parameter.type == "any" then
    local f = load("return " .. text, "=" .. parameter.name, "t", {clench = clench, math = math})
    local ok, value = pcall(f or error, not f and "expected a Lua expression")
    if ok then return value end
  end
  return text
end

-- names for a choice: robots; objects for a parameter of that name; otherwise all that a command can refer to
local function names_of(session, parameter)
  local world, names = session.world, {}
  if not world then return names end
  local lists = parameter.type == "robot" and {world.robots} or parameter.name == "object" and {world.objects} or {world.objects, world.obstacles, world.robots}
  for _, list in ipairs(lists) do
    for _, thing in ipairs(list) do names[#names + 1] = thing.name end
  end
  return names
end

-- the choices of a parameter; nil if its value is typed
local function choices_of(view, parameter)
  local choices = parameter.choices or parameter.suggested or (parameter.type == "robot" or parameter.type == "body") and names_of(view.session, parameter)
  if type(choices) == "function" then choices = choices(view.session) end
  return choices and #choices > 0 and choices or nil
end

-- is it set by a checkbox?
local function is_checked(parameter, choices)
  return parameter.type == "boolean" or choices and type(choices[1]) == "boolean"
end

-- an optional value can be left to the command
local function draw_choice(ui, state, parameter, choices)
  local values, labels, index = {}, {}, 0
  if parameter.optional and parameter.default == nil then values[1], labels[1] = false, "default" end
  for _, choice in ipairs(choices) do values[#values + 1], labels[#labels + 1] = choice, choice end
  local current = state[parameter.name]
  for i, value in ipairs(values) do
    if value == (current or false) then index = i end
  end
  if index == 0 and current then index, values[#values + 1], labels[#labels + 1] = #values + 1, current, shown(current) end  -- a link, or a value of a script
  local chosen, changed = ui:combo("##" .. parameter.name, index, labels)
  if changed then state[parameter.name] = values[chosen] or nil end
end

-- three numbers in a row; returns the changed ones
local function draw_row(view, ui, parameter, names, values, unit)
  local factor, _, format = units.of(view, unit)
  local changed
  for i, name in ipairs(names) do
    if i > 1 then ui:same_line(3) end
    ui:width((pose_width - 6) / 3 * view.scale)
    local value, is_changed = ui:drag(("##%s %s"):format(parameter.name, name), units.field(values[i] * factor, format), {speed = factor * (unit == "rad" and 5e-3 or 1e-3), format = name .. " " .. format})
    ui:tooltip(("%s [%s] of the pose"):format(name, select(2, units.of(view, unit))))
    if is_changed then values[i], changed = value / factor, true end
  end
  return changed
end

-- position and angles of a pose; without a value, zeros until one is changed
local function draw_pose(view, ui, state, parameter)
  local pose = state[parameter.name] or clench.pose {}
  local p, angles = pose.position, pose.rpy
  local at, turn = {p.x, p.y, p.z}, {angles[1], angles[2], angles[3]}
  local moved = draw_row(view, ui, parameter, {"x", "y", "z"}, at, "m")
  local turned = draw_row(view, ui, parameter, {"roll", "pitch", "yaw"}, turn, "rad")
  if moved or turned then state[parameter.name] = clench.pose {xyz = at, rpy = turn} end
  if not parameter.optional then return end
  ui:disabled(state[parameter.name] == nil, function(ui)
    if ui:button("Reset##" .. parameter.name) then state[parameter.name] = nil end
  end)
  ui:same_line()
  ui:text(state[parameter.name] and "this pose" or "not given", {color = {0.5, 0.5, 0.5}})
end

local function draw_text(ui, state, parameter)
  local name = parameter.name
  local text, changed, entered = ui:text_input("##" .. name, state.texts[name] or shown(state[name]), {hint = state.hints[name] or parameter.optional and "default" or "", on_enter = true, focus = state.focus == name})
  if state.focus == name then state.focus = nil end
  if ui:active() then state.used = name end
  state.entered = state.entered or entered
  if changed then state.texts[name], state[name] = text, read(parameter, text) end
end

--- Draws the field of a parameter.
---@param state table  values by name; `texts`: typed texts; `hints`: of empty fields; `focus`: name of the field that takes the keys; `used`: of the one that had them last; `lists`: of files, by name; `answered`: questions about files, by path; `entered`: Enter was pressed
local function draw_value(view, ui, state, parameter)
  local name = parameter.name
  local choices = choices_of(view, parameter)
  if parameter.type == "pose" then return draw_pose(view, ui, state, parameter) end
  ui:width((parameter.files and path_width or width) * view.scale)
  local checked = is_checked(parameter, choices)
  if choices and not checked then return draw_choice(ui, state, parameter, choices) end
  if not checked then return draw_text(ui, state, parameter) end
  local value, changed = ui:checkbox("##" .. name, state[name] == true)
  if changed then state[name] = value end
end

--- Draws the name and the field of a parameter, in two cells of a table.
function fields.draw(view, ui, state, parameter)
  ui:next_column()
  ui:text(parameter.name:gsub("_", " ") .. (parameter.unit and (" [%s]"):format(parameter.unit) or ""))
  if parameter.text then ui:tooltip(parameter.text) end
  ui:next_column()
  draw_value(view, ui, state, parameter)
  if parameter.text and parameter.type ~= "pose" then ui:tooltip(parameter.text) end
end

--- The values with which a dialog opens, and its first typed field, which takes the keys.
---@return table state
function fields.new(view, command)
  local state = {texts = {}, hints = {}, lists = {}, answered = {}}
  for _, parameter in ipairs(command.parameters or {}) do
    local value = parameter.in_dialog
    if type(value) == "function" then value = value(view.session) end
    if value == nil then value = parameter.default end
    state[parameter.name] = value
    if parameter.hint then state.hints[parameter.name] = parameter.hint() end
    local is_typed = parameter.type ~= "boolean" and parameter.type ~= "pose" and not choices_of(view, parameter)
    if is_typed and not state.focus then state.focus = parameter.name end
  end
  return state
end

--- Height of the fields of a command [pixels].
function fields.height(view, ui, command)
  local rows = 0
  for _, parameter in ipairs(command.parameters or {}) do rows = rows + (parameter.type == "pose" and (parameter.optional and 3 or 2) or 1) end
  return math.min(rows * (ui.line_height + 2 * view.scale) + 8, 420 * view.scale)
end

return fields
