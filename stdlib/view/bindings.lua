--- Keys and their effects: actions of the view and commands of the session, each with a shortcut that the user may change.
local ask_path = require "clench.view.ask_path"
local described = require "clench.described"
local dialog = require "clench.view.dialog"
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local keys = require "clench.view.keys"
local measure = require "clench.view.measure"
local navigation = require "clench.view.navigation"
local stereo = require "clench.view.stereo"
local tools = require "clench.view.tools"
local bindings = {}

-- closes the palette and the question about a path
local function close_text(view) view.palette, view.ask = nil, nil end

local function cancel(view)
  if view.palette or view.ask then
    close_text(view)
  elseif view.leaving then
    view.leaving = nil
  elseif view.press then
    local drag = view.press.drag
    view.press = nil
    if drag then view.session:cancel_gesture(drag.gesture) end
  elseif not dialog.cancel(view) then
    measure.clear(view)
  end
end

-- actions of the view: name, label, shortcut by default, function
local own = {
  {"palette", "Command Palette", "ctrl+p", function(view) view:open_palette() end},
  {"exit", "Exit", "ctrl+q", function(view) view.wants_exit = true end},
  {"keys", "Keys", "shift+/", function(view) view.shows_keys = true end},
  {"panels", "Show or hide panels", "f9", function(view) view.panels_visible = not view.panels_visible end},
  {"cancel", "Cancel", "escape", cancel},
  {"home", "Home", "home", function(view) view:home() end},
  {"eyes apart", "Eyes of stereo farther apart", "+", function(view) stereo.step(view, 1) end},
  {"eyes together", "Eyes of stereo closer together", "-", function(view) stereo.step(view, -1) end},
  {"seek", "Seek the point under the mouse", "f", navigation.seek_mouse},
}
for i, tool in ipairs(tools.names) do
  own[#own + 1] = {"tool " .. tool, "Tool " .. tool, tostring(i), function(view) tools.choose(view, tool) end}
end
for i = 1, navigation.bookmark_count do
  own[#own + 1] = {"recall " .. i, "Recall bookmark " .. i, "f" .. i, function(view) navigation.recall(view, i) end}
  own[#own + 1] = {"store " .. i, "Store bookmark " .. i, "shift+f" .. i, function(view) navigation.store(view, i) end}
end

-- the user's shortcut, false if the user has removed it; otherwise the default
local function chosen(view, name, default)
  local shortcut = view.bindings[name]
  if shortcut == nil then return default end
  return shortcut or nil
end

--- All actions in the order of the table of keys.
---@return {name: string, label: string, shortcut?: string, run: fun(view: table)}[]
function bindings.list(view)
  local list = {}
  for i, action in ipairs(own) do
    list[i] = {name = action[1], label = action[2], shortcut = chosen(view, action[1], action[3]), run = action[4]}
  end
  for _, name in ipairs(view.session.order) do
    local command = view.session.commands[name]
    list[#list + 1] = {name = name, label = (command.label or name):gsub("…", ""), shortcut = chosen(view, name, command.shortcut),
                       run = function() dialog.open(view, command) end}
  end
  return list
end

--- The action of a shortcut; nil if it has none.
function bindings.find(view, shortcut)
  for _, action in ipairs(bindings.list(view)) do
    if action.shortcut == shortcut then return action end
  end
end

--- The shortcut of an action for display, "" if it has none.
function bindings.shown(view, name)
  for _, action in ipairs(own) do
    if action[1] == name then return keys.shown(chosen(view, name, action[3])) end
  end
  return keys.shown(chosen(view, name, view.session.commands[name].shortcut))
end

--- Gives an action a shortcut; the action that had it loses it.
---@param name string  of an action
---@param shortcut? string  nil: the action has none
---@return string? loser  label of the action that has lost it
function bindings.set(view, name, shortcut)
  local loser = shortcut and bindings.find(view, shortcut)
  if loser and loser.name ~= name then view.bindings[loser.name] = false else loser = nil end
  view.bindings[name] = shortcut or false
  return loser and loser.label
end

-- applies the shortcut of an action that a file says; taken: actions by the shortcuts applied before
local function apply(view, name, said, taken)
  if said == false then
    view.bindings[name] = false
    return
  end
  local shortcut = type(said) == "string" and keys.normal(said) or error("expected a shortcut, or false, got " .. described(said), 0)
  if taken[shortcut] then error(("'%s' belongs to '%s'"):format(shortcut, taken[shortcut]), 0) end
  taken[shortcut] = name
  bindings.set(view, name, shortcut)
end

--- Applies the shortcuts of a file, by the names of actions; false: the action has no shortcut.
---@return string[] problems  of those that are ignored
function bindings.apply(view, said)
  local names, problems, taken = {}, {}, {}
  for name in pairs(type(said) == "table" and said or {}) do
    if type(name) == "string" then names[#names + 1] = name end
  end
  table.sort(names)
  for _, name in ipairs(names) do
    local ok, problem = pcall(apply, view, name, said[name], taken)
    if not ok then problems[#problems + 1] = ("keys: %s: %s"):format(name, error_text(problem)) end
  end
  return problems
end

--- Gives all actions the shortcuts of the program.
function bindings.reset(view) view.bindings = {} end

-- a key pressed for the action whose shortcut is being changed
local function take_key(view, shortcut)
  local name = view.binding
  view.binding = nil
  if shortcut == "escape" then return end
  if shortcut == "delete" or shortcut == "backspace" then return bindings.set(view, name, nil) end
  local loser = bindings.set(view, name, shortcut)
  if loser then view.status = ("%s has no key now"):format(loser) end
end

local function run(view, action)
  local ok, problem = pcall(action.run, view)
  if ok then return end
  if is_stopped(problem) then error(problem, 0) end
  view:fail(problem)
end

--- Applies the keys pressed in this frame, unless text is being typed or a question is open: then Escape alone closes the palette, the question or the dialog.
function bindings.update(view)
  for _, press in ipairs(view.ui.pressed) do
    local shortcut = keys.shortcut(press)
    if view.ui.wants_text then
      if shortcut == "escape" then
        close_text(view)
        dialog.cancel(view)
      end
    elseif shortcut and ask_path.is_asking(view) then
      if shortcut == "escape" then cancel(view) end
    elseif shortcut and view.binding then
      take_key(view, shortcut)
    elseif shortcut then
      local action = bindings.find(view, shortcut)
      if action then run(view, action) end
    end
  end
end

return bindings
