--- Dialogs of commands, made from their parameters.
local ask_path = require "clench.view.ask_path"
local fields = require "clench.view.fields"
local guarded = require "clench.view.guarded"
local is_stopped = require "clench.is_stopped"
local keys = require "clench.view.keys"
local leave = require "clench.view.leave"
local paths = require "clench.view.paths"
local results = require "clench.view.planner_results"
local variables = require "clench.view.planner_variables"
local dialog = {}

local function is_planner(command) return command.name:find "^planner%." ~= nil end

-- the parameters that are paths of files
local function file_parameters(command)
  local list = {}
  for _, parameter in ipairs(command.parameters or {}) do
    if parameter.files then list[#list + 1] = parameter end
  end
  return list
end

-- the next question about a file that the command writes; nil once all are answered
local function question_of(command, state)
  for _, parameter in ipairs(file_parameters(command)) do
    local question = paths.question(parameter.files, state[parameter.name])
    if question and not state.answered[question.path] then
      question.parameter = parameter.name
      return question
    end
  end
end

-- is Enter pressed where no text is typed, and does only this dialog wait for it?
local function enters(view, ui)
  if ui.wants_text or view.palette or view.binding or ask_path.is_asking(view) then return false end
  local count = 0
  for name in pairs(view.dialogs) do count = count + (is_planner(view.session.commands[name]) and 0 or 1) end
  for _, press in ipairs(ui.pressed) do
    if count == 1 and keys.shortcut(press) == "enter" then return true end
  end
  return false
end

local function run(view, command, state)
  local args = {}
  for _, parameter in ipairs(command.parameters or {}) do args[parameter.name] = state[parameter.name] end
  local answered = state.question
  if answered then state.answered[answered.path] = answered end
  state.error, state.question = nil, not is_planner(command) and question_of(command, state) or nil
  if state.question then return end
  local ok, result = pcall(function()
    for _, question in pairs(state.answered) do
      if question.prepare then question.prepare() end
    end
    return view.session:run(command.name, args)
  end)
  state.answered = {}
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

-- a world without a file is saved under a new name
local function with_save_as(view, command)
  return command.name == "world.save" and not view.session.path and view.session.commands["world.save_as"] or command
end

function dialog.fill(view, command)
  command = with_save_as(view, command)
  local can, reason = view.session:can_run(command.name)
  if not can then return view:fail(("%s cannot run now%s"):format((command.label or command.name):gsub("…", ""), reason and ": " .. reason or "")) end
  local asks = (command.label or ""):find "…"
  for _, parameter in ipairs(command.parameters or {}) do
    if not parameter.optional and parameter.default == nil then asks = true end
  end
  if not asks then return view:run(command.name) end
  local ok, state = pcall(fields.new, view, command)
  if not ok then
    if is_stopped(state) then error(state, 0) end
    return view:fail(state)  -- an error of a function that suggests values
  end
  if is_planner(command) or command.name == "online.start" then state.hand, state.object = view.session.hand.name, view.session.object.name end
  -- in a window the user watches and stops a search: it is limited by time, not by steps
  if is_planner(command) and state.steps then state.steps, state.seconds = 10000000, 60 end
  if is_planner(command) then state.focus = nil end
  view.dialogs[command.name] = state
end

local function title(command) return (command.label or command.name):gsub("…", "") .. "##" .. command.name end

local function draw_fields(view, ui, command, state, height)
  if not command.parameters or #command.parameters == 0 then return end
  ui:child("fields", {height = height}, function(ui)
    ui:table("parameters", {"##name", "##value"}, {}, function(ui)
      for _, parameter in ipairs(command.parameters) do
        if not variables.shows(command, parameter) then fields.draw(view, ui, state, parameter) end
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

-- the files to choose from for the field that was used last, or for the first one
local function draw_files(view, ui, command, state, lines)
  local list = file_parameters(command)
  local shown = list[1]
  for _, parameter in ipairs(list) do
    if parameter.name == state.used then shown = parameter end
  end
  if not shown then return end
  local name = shown.name
  state.lists[name] = state.lists[name] or {}
  local path, accepted = paths.draw(view, ui, shown.files, state.lists[name], state.texts[name] or state[name] or "", lines)
  if path then state.texts[name], state[name] = path, path end
  state.entered = state.entered or accepted
end

local function draw(view, ui, command, state)
  if is_planner(command) then return draw_planner(view, ui, command, state) end
  -- an error takes its lines from the list of files, or from the fields: the window keeps its size, and its buttons remain visible
  local lines = state.error and 3 or state.question and 1 or 0
  local has_files = #file_parameters(command) > 0
  local height = fields.height(view, ui, command)
  draw_fields(view, ui, command, state, has_files and height or math.max(height - lines * ui.line_height, 2 * ui.line_height))
  draw_files(view, ui, command, state, lines)
  if state.error then ui:text(state.error, {color = {0.84, 0.37, 0}, wrap = true}) end
  local question, pressed = paths.draw_button(ui, state.question, state.question and state[state.question.parameter], "OK", 90 * view.scale)
  state.question = question
  local entered = state.entered or enters(view, ui)
  state.entered = nil
  if pressed or not question and entered then run(view, command, state) end
  ui:same_line()
  if ui:button("Cancel", {width = 90 * view.scale}) then view.dialogs[command.name] = nil end
end

--- A button that opens the dialog of a command or runs it. It is disabled while the command cannot run, and its tooltip gives the reason.
---@param options? {text?: string, selected?: boolean, width?: number}  text: of the tooltip instead of the command's label
function dialog.button(view, ui, label, name, options)
  options = options or {}
  local command = view.session.commands[name]
  local can, reason = view.session:can_run(name)
  ui:disabled(not can, function(ui)
    if ui:button(label, {selected = options.selected, width = options.width}) then dialog.open(view, command) end
  end)
  ui:tooltip(("%s%s\nsession:run(%q)"):format(options.text or (command.label or name):gsub("…", ""), reason and ": " .. reason or "", name))
end

--- Closes the open dialogs; those of planners stay, because their searches continue.
---@return boolean closed  was there one?
function dialog.cancel(view)
  local closed = false
  for name in pairs(view.dialogs) do
    if not is_planner(view.session.commands[name]) then view.dialogs[name], closed = nil, true end
  end
  return closed
end

--- Draws the open dialogs.
function dialog.draw(view, ui)
  local names = {}
  for name in pairs(view.dialogs) do names[#names + 1] = name end
  table.sort(names)
  local scale = view.scale
  for i, name in ipairs(names) do
    local command, state = view.session.commands[name], view.dialogs[name]
    local open = ui:window(title(command), {x = 320 * scale + 24 * i, y = 120 * scale + 24 * i, width = 470 * scale, height = is_planner(command) and 520 * scale or 0, movable = true, resizable = true, can_close = true},
                           function(ui) guarded(ui, function(ui) draw(view, ui, command, state) end) end)
    if not open then view.dialogs[name] = nil end
  end
end

return dialog
