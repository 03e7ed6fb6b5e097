--- The console: an input line of Lua, and the output of it and of commands; Up and Down recall lines, Tab completes names. `session`, `world`, `hand`,
--- `object` and `view` are defined.
local completion = require "clench.view.completion"
local history = require "clench.session.history"

-- what a line sees before the globals of Lua
local function names_of(view)
  local session = view.session
  local names = {session = session, world = session.world, hand = session.hand, object = session.object, view = view}
  for name, value in pairs(view.globals) do
    if names[name] == nil then names[name] = value end
  end
  return names
end

local function environment(view)
  return setmetatable({}, {__index = function(_, name)
    local value = names_of(view)[name]
    if value == nil then return _G[name] end
    return value
  end, __newindex = function(_, name, value) view.globals[name] = value end})
end

-- calls a function whose output appears in the console: returns what pcall returns, in a table
local function captured(view, f)
  local before = print
  print = function(...)
    local texts = table.pack(...)
    for i = 1, texts.n do texts[i] = tostring(texts[i]) end
    view:print(table.concat(texts, "\t"))
  end
  local results = table.pack(pcall(f))
  print = before
  return results
end

local function run(view, line)
  view:print("> " .. line, "input")
  local env = environment(view)
  local f, message = load("return " .. line, "=console", "t", env)
  if not f then f, message = load(line, "=console", "t", env) end
  if not f then return view:print(message, "error") end
  local results = captured(view, f)
  history.refresh(view.session)  -- the line may have removed bodies
  if not results[1] then return view:print(tostring(results[2]), "error") end
  local texts = {}
  for i = 2, results.n do texts[#texts + 1] = tostring(results[i]) end
  if #texts > 0 then view:print(table.concat(texts, "  ")) end
  view:changed()
end

-- by the kind of a line, on a light and on a dark background
local light = {error = {0.84, 0.37, 0}, input = {0.4, 0.45, 0.5}, lua = {0, 0.45, 0.7}}
local dark = {error = {0.9, 0.5, 0.2}, input = {0.6, 0.65, 0.7}, lua = {0.34, 0.71, 0.91}}

local up, down = 265, 264  -- codes of keys

-- lines that were entered, and the number of the one that is shown; after the last one, the line that is being typed
local function history_of(view)
  view.console_history = view.console_history or {lines = {}, at = 1, version = 0}
  return view.console_history
end

local function remember(history, line)
  if history.lines[#history.lines] ~= line then history.lines[#history.lines + 1] = line end
  history.at = #history.lines + 1
end

-- the keys Up and Down recall lines
local function recall(view, ui, history)
  for _, press in ipairs(ui.pressed) do
    local by = press.key == up and -1 or press.key == down and 1 or 0
    local at = math.max(1, math.min(#history.lines + 1, history.at + by))
    if at ~= history.at then
      if history.at > #history.lines then history.typed = view.console_text end
      history.at, view.console_text = at, history.lines[at] or history.typed or ""
      history.version, history.focus = history.version + 1, true  -- a field that is being typed in takes no other text
      view.needs_frame = true
    end
  end
end

local function draw_input(view, ui)
  local history = history_of(view)
  local text, _, entered
  ui:id("line " .. history.version, function(ui)
    ui:width(-1)
    text, _, entered = ui:text_input("##console", view.console_text, {hint = "Lua", on_enter = true, focus = history.focus,
                                                                      complete = function(before) return completion.of(view, before, names_of(view)) end})
  end)
  history.focus, view.console_text = false, text
  if entered and text ~= "" then
    view.console_text = ""
    remember(history, text)
    run(view, text)
    history.focus = true  -- Enter ends the input
  elseif ui:active() then
    recall(view, ui, history)
  end
end

local hint = [[
Each command appears here as Lua. Type Lua below, for example:
  hand:autograsp()      hand.dofs      object.mass = 0.2      world:contacts(hand, object)      help "robot:autograsp"
session, world, hand, object and view are defined. Ctrl+P finds a command by a few letters, ? lists the keys.]]

local function draw(ui, view)
  local colors = view.dark and dark or light
  ui:child("lines", {height = -ui.line_height}, function(ui)
    if #view.lines == 0 then ui:text(hint, {wrap = true, color = {0.5, 0.5, 0.5}}) end
    for i = math.max(1, #view.lines - 200), #view.lines do ui:text(view.lines[i].text, {wrap = true, color = colors[view.lines[i].kind]}) end
    if view.scroll_console then ui:scroll_to_end() view.scroll_console = false end
  end)
  draw_input(view, ui)
end

return {name = "Console", place = "bottom", draw = draw}
