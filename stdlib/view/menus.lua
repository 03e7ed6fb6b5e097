--- The menu bar: menus of the session's commands, in the order of GraspIt!, and those of the view itself.
local bindings = require "clench.view.bindings"
local dialog = require "clench.view.dialog"
local keys = require "clench.view.keys"
local navigation = require "clench.view.navigation"
local preferences = require "clench.view.preferences"
local stereo = require "clench.view.stereo"
local tools = require "clench.view.tools"
local units = require "clench.view.units"
local with_ending = require "clench.session.with_ending"
local menus = {}

local order = {"File", "Edit", "Element", "Grasp", "Dynamics", "Jobs"}

local function draw_command(view, ui, command)
  local enabled = not command.enabled or (command.enabled(view.session)) and true or false
  if ui:menu_item(command.label or command.name, {shortcut = bindings.shown(view, command.name), enabled = enabled}) then dialog.open(view, command) end
end

local own = {
  File = function(view, ui)
    ui:disabled(#view.recent == 0, function(ui)
      ui:menu("Open Recent", function(ui)
        for i, path in ipairs(view.recent) do
          if ui:menu_item(("%s##recent%d"):format(path, i)) then preferences.open_recent(view, path) end
        end
      end)
    end)
    ui:separator()
    if ui:menu_item("Save View…") then
      view.ask = {title = "Save View", text = "view.png", done = function(path) view:screenshot {path = with_ending(path, ".png"), panels = false} end}
    end
    if ui:menu_item("Save Session as Script…") then view.ask = {title = "Save Session as Script", text = "session.lua", done = function(path) view:save_script(path) end} end
    if ui:menu_item("Exit", {shortcut = bindings.shown(view, "exit")}) then view.wants_exit = true end
  end,
  Element = function(view, ui)
    for _, tool in ipairs(view.tools) do
      if ui:menu_item(tool, {shortcut = bindings.shown(view, "tool " .. tool), selected = view.current_tool == tool}) then tools.choose(view, tool) end
    end
    ui:separator()
  end,
}

local function view_menu(view, ui)
  if ui:menu_item("Home", {shortcut = bindings.shown(view, "home")}) then view:home() end
  if ui:menu_item("View All") then view:home(true) end
  if ui:menu_item("Orthographic", {selected = view.camera.orthographic ~= nil}) then view:toggle_orthographic() end
  navigation.draw_menu(view, ui, function(name) return bindings.shown(view, name) end)
  stereo.draw_menu(view, ui)
  ui:separator()
  ui:menu("Show Panel", function(ui)
    for _, panel in ipairs(view.panels) do
      if ui:menu_item(panel.name, {selected = not view.hidden[panel.name]}) then view.hidden[panel.name] = not view.hidden[panel.name] or nil end
    end
  end)
  if ui:menu_item("Panels", {shortcut = bindings.shown(view, "panels"), selected = view.panels_visible}) then view.panels_visible = not view.panels_visible end
  ui:separator()
  units.menu(view, ui)
  if ui:menu_item("Dark Theme", {selected = view.dark}) then view:set_theme(not view.dark) end
end

local function help_menu(view, ui)
  if ui:menu_item("Command Palette…", {shortcut = bindings.shown(view, "palette")}) then view:open_palette() end
  if ui:menu_item("Keys…", {shortcut = bindings.shown(view, "keys")}) then view.shows_keys = true end
  if ui:menu_item("Manual…") then view.shows_manual = true end
  if ui:menu_item("About…") then view.shows_about = true end
end

-- a menu that Escape closes
local function draw_menu(view, ui, name, draw)
  ui:menu(name, function(ui)
    draw(ui)
    for _, press in ipairs(view.ui.pressed) do
      if keys.shortcut(press) == "escape" then ui:close_popup() end
    end
  end)
end

--- Draws the menu bar.
function menus.draw(view, ui)
  local by_name, names = {}, {}
  for _, menu in ipairs(view.session:menus()) do by_name[menu.name] = menu.commands end
  for _, name in ipairs(order) do names[#names + 1] = name end
  for _, menu in ipairs(view.session:menus()) do
    local known = false
    for _, name in ipairs(order) do known = known or name == menu.name end
    if not known then names[#names + 1] = menu.name end
  end
  ui:menu_bar(function(ui)
    for _, name in ipairs(names) do
      if by_name[name] or own[name] then
        draw_menu(view, ui, name, function(ui)
          if own[name] and name ~= "File" then own[name](view, ui) end
          for _, command in ipairs(by_name[name] or {}) do draw_command(view, ui, command) end
          if name == "File" then own.File(view, ui) end
        end)
      end
    end
    draw_menu(view, ui, "View", function(ui) view_menu(view, ui) end)
    draw_menu(view, ui, "Help", function(ui) help_menu(view, ui) end)
  end)
end

return menus
