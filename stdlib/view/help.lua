--- Windows of the Help menu: the table of keys, in which they are changed, the manual, and the version.
local bindings = require "clench.view.bindings"
local keys = require "clench.view.keys"
local help = {}

local function draw_action(view, ui, action)
  ui:next_column()
  local is_chosen = view.binding == action.name
  local text = is_chosen and "Press a key" or action.shortcut and keys.shown(action.shortcut) or "none"
  if ui:button(text .. "##" .. action.name, {width = 130 * view.scale, selected = is_chosen}) then view.binding = not is_chosen and action.name or nil end
  ui:tooltip "Click, then press the new key; Delete removes the key, Escape keeps it."
  ui:next_column()
  ui:text(action.label)
end

-- does the table list the action? Those without a key if the user has asked for all, or looks for one
local function is_listed(view, action)
  if view.key_search ~= "" then return action.label:lower():find(view.key_search:lower(), 1, true) ~= nil end
  return action.shortcut or view.keys_with_all or view.bindings[action.name] ~= nil
end

local function draw_keys(view, ui)
  if ui:button "Reset All" then bindings.reset(view) end
  ui:same_line()
  view.keys_with_all = ui:checkbox("all commands", view.keys_with_all or false)
  ui:tooltip "Also lists commands without a key"
  ui:same_line()
  ui:width(-1)
  view.key_search = ui:text_input("##search", view.key_search or "", {hint = "Find a command"})
  ui:child("list", {}, function(ui)
    ui:table("keys", {"Key", "Command"}, {}, function(ui)
      for _, action in ipairs(bindings.list(view)) do
        if is_listed(view, action) then draw_action(view, ui, action) end
      end
    end)
  end)
end

--- Draws the open windows.
function help.draw(view, ui)
  if view.shows_about and not ui:window("About", {width = 0, x = 0, movable = true, can_close = true}, function(ui)
    ui:text("Clench " .. clench.version)
    ui:text "Simulates, evaluates and plans robotic grasps."
  end) then view.shows_about = nil end
  if view.shows_manual and not ui:window("Manual", {width = 0, movable = true, can_close = true}, function(ui)
    ui:text "docs/guide/viewer.md describes the viewer; help() in the console describes a function."
  end) then view.shows_manual = nil end
  if not view.shows_keys then return end
  local scale = view.scale
  local open = ui:window("Keys", {x = 300 * scale, y = 100 * scale, width = 460 * scale, height = 500 * scale, movable = true, resizable = true, can_close = true}, function(ui) draw_keys(view, ui) end)
  if not open then view.shows_keys, view.binding = nil, nil end
end

return help
