--- Dialogs of commands, made from their parameters.
local leave = require "clench.view.leave"
local results = require "clench.view.planner_results"
local variables = require "clench.view.planner_variables"
local dialog = {}

local function is_planner(command) return command.name:find "^planner%." ~= nil end

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
  if parameter.type == "table" or parameter.type == "vec3" or parameter.type == "pose" or parameter.type == "any" then
    local f = load("return " .. text, "=" .. parameter.name, "t", {clench = clench, math = math})
    local ok, value = pcall(f or error, not f and "expected a Lua expression")
    if ok then return value end
  end
  return text
end

-- names of bodies or robots for a choice
local function names_of(session, kind)
  local names = {}
  if not session.world then return names end
  for i, thing in ipairs(kind == "robot" and session.world.robots or session.world.objects) do names[i] = thing.name end
  return names
end

local function index_in(list, value)
  for i, item in ipairs(list) do
    if item == value then return i end
  end
  return 0
end

local function draw_choice(ui, state, parameter, choices)
  local label = "##" .. parameter.name
  local index, changed = ui:combo(label, index_in(choices, state[parameter.name]), choices)
  if changed then state[parameter.name] = choices[index] end
end

local function choices_of(view, parameter)
  local choices = parameter.choices or (parameter.type == "robot" or parameter.type == "body") and names_of(view.session, parameter.type)
  return choices and #choices > 0 and choices or nil
end

-- name of the parameter whose field takes the keys when the dialog opens
local function first_text(view, command)
  for _, parameter in ipairs(command.parameters or {}) do
    if parameter.type ~= "boolean" and not choices_of(view, parameter) then return parameter.name end
  end
end

local function draw_field(view, ui, state, parameter)
  local name = parameter.name
  ui:next_column()
  ui:text(name:gsub("_", " ") .. (parameter.unit and (" [%s]"):format(parameter.unit) or ""))
  if parameter.text then ui:tooltip(parameter.text) end
  ui:next_column()
  ui:width(210)
  local choices = choices_of(view, parameter)
  if choices then
    draw_choice(ui, state, parameter, choices)
  elseif parameter.type == "boolean" then
    local value, changed = ui:checkbox("##" .. name, state[name] == true)
    if changed then state[name] = value end
  else
    local text, changed, entered = ui:text_input("##" .. name, state.texts[name] or shown(state[name]), {hint = parameter.optional and "default" or "", on_enter = true, focus = state.focus == name})
    if state.focus == name then state.focus = nil end
    state.entered = state.entered or entered
    if changed then state.texts[name], state[name] = text, read(parameter, text) end
  end
  if parameter.text then ui:tooltip(parameter.text) end
end

local function run(view, command, state)
  local args = {}
  for _, parameter in ipairs(command.parameters or {}) do args[parameter.name] = state[parameter.name] end
  state.error = nil
  local ok, result = pcall(view.session.run, view.session, command.name, args)
  if not ok then
    state.error = tostring(result)
    return
  end
  view:report(command, result, args)
  if command.name == "online.start" then view.hidden["On-line Planner"], view.front.right = nil, "On-line Planner" end
  if is_planner(command) then state.job, state.rank = result, nil else view.dialogs[command.name] = nil end
end

local leaving = {["world.new"] = "new", ["world.open"] = "open"}  -- commands that close the world

--- Opens the dialog of a command; a command without required parameters and without "…" in its label runs at once.
function dialog.open(view, command)
  local purpose = leaving[command.name]
  if purpose and not view.leaving then
    return leave.ask(view, purpose, function() dialog.fill(view, command) end)
  end
  dialog.fill(view, command)
end

function dialog.fill(view, command)
  local can, reason = true, nil
  if command.enabled then can, reason = command.enabled(view.session) end
  if not can then return view:fail(("%s cannot run now%s"):format((command.label or command.name):gsub("…", ""), reason and ": " .. reason or "")) end
  local asks = (command.label or ""):find "…"
  for _, parameter in ipairs(command.parameters or {}) do
    if not parameter.optional and parameter.default == nil then asks = true end
  end
  if not asks then return view:run(command.name) end
  local state = {texts = {}}
  for _, parameter in ipairs(command.parameters or {}) do state[parameter.name] = parameter.default end
  if is_planner(command) or command.name == "online.start" then state.hand, state.object = view.session.hand.name, view.session.object.name end
  -- in a window the user watches and stops a search: it is limited by time, not by steps
  if is_planner(command) and state.steps then state.steps, state.seconds = 10000000, 60 end
  if not is_planner(command) then state.focus = first_text(view, command) end
  view.dialogs[command.name] = state
end

local function title(command) return (command.label or command.name):gsub("…", "") .. "##" .. command.name end

local function draw_fields(view, ui, command, state, height)
  if not command.parameters or #command.parameters == 0 then return end
  ui:child("fields", {height = height}, function(ui)
    ui:table("parameters", {"##name", "##value"}, {}, function(ui)
      for _, parameter in ipairs(command.parameters) do
        if not variables.shows(command, parameter) then draw_field(view, ui, state, parameter) end
      end
    end)
  end)
end

-- a planner's dialog stays open: its controls are above the fields
local function draw_planner(view, ui, command, state)
  results.draw(view, ui, state, function() run(view, command, state) end)
  if state.error then ui:text(state.error, {color = {0.84, 0.37, 0}, wrap = true}) end
  ui:separator()
  if variables.has(command) then variables.draw(view, ui, state) end
  draw_fields(view, ui, command, state, 0)
end

local function draw(view, ui, command, state)
  if is_planner(command) then return draw_planner(view, ui, command, state) end
  draw_fields(view, ui, command, state, math.min(#(command.parameters or {}) * (ui.line_height + 6) + 8, 420))
  if state.error then ui:text(state.error, {color = {0.84, 0.37, 0}, wrap = true}) end
  if ui:button("OK", {width = 90}) or state.entered then
    state.entered = nil
    run(view, command, state)
  end
  ui:same_line()
  if ui:button("Cancel", {width = 90}) then view.dialogs[command.name] = nil end
end

--- Closes the open dialogs; those of planners stay, because their searches continue.
function dialog.cancel(view)
  for name in pairs(view.dialogs) do
    if not is_planner(view.session.commands[name]) then view.dialogs[name] = nil end
  end
end

--- Draws the open dialogs.
function dialog.draw(view, ui)
  local names = {}
  for name in pairs(view.dialogs) do names[#names + 1] = name end
  table.sort(names)
  for i, name in ipairs(names) do
    local command, state = view.session.commands[name], view.dialogs[name]
    local open = ui:window(title(command), {x = 320 + 24 * i, y = 120 + 24 * i, width = 470, height = is_planner(command) and 520 or 0, movable = true, resizable = true, can_close = true},
                           function(ui) draw(view, ui, command, state) end)
    if not open then view.dialogs[name] = nil end
  end
end

return dialog
