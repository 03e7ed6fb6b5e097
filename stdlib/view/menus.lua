--- The menu bar: menus of the session's commands, in the order of GraspIt!, with submenus and sections, and those of the view itself.
local ask_path = require "clench.view.ask_path"
local bindings = require "clench.view.bindings"
local dialog = require "clench.view.dialog"
local keys = require "clench.view.keys"
local label = require "clench.view.label"
local menu_tree = require "clench.view.menu_tree"
local navigation = require "clench.view.navigation"
local preferences = require "clench.view.preferences"
local stereo = require "clench.view.stereo"
local tools = require "clench.view.tools"
local units = require "clench.view.units"
local menus = {}

local order = {"File", "Edit", "Element", "Grasp", "Dynamics", "Jobs"}

-- an entry of the view itself, as an item of a menu
local function item(section, label, name, f)
  return {section = section, draw = function(view, ui)
    if ui:menu_item(label, {shortcut = name and bindings.shown(view, name)}) then f(view) end
  end}
end

local function draw_recent(view, ui)
  ui:disabled(#view.recent == 0, function(ui)
    ui:menu("Open Recent", function(ui)
      for i, path in ipairs(view.recent) do
        if ui:menu_item(label(path, "recent" .. i)) then preferences.open_recent(view, path) end
      end
    end)
  end)
end

local function ask_view(view)
  ask_path.open(view, "Save View", "view.png", "world.save_image", function(path) view:screenshot {path = path, panels = false} end)
end

local function ask_script(view)
  ask_path.open(view, "Save Session as Script", "session.lua", {endings = {".lua"}, writes = true, ending = ".lua"}, function(path) view:save_script(path) end)
end

local function draw_tools(view, ui)
  for _, tool in ipairs(view.tools) do
    if ui:menu_item(tool, {shortcut = bindings.shown(view, "tool " .. tool), selected = view.current_tool == tool}) then tools.choose(view, tool) end
  end
end

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

-- entries of the view itself, by menus
local own = {
  File = {{section = 1, draw = draw_recent}, item(5, "Save View…", nil, ask_view), item(5, "Save Session as Script…", nil, ask_script),
          item(1000, "Exit", "exit", function(view) view.wants_exit = true end)},
  Element = {{section = 1, draw = draw_tools}},
  View = {{section = 0, draw = view_menu}},
  Help = {{section = 0, draw = help_menu}},
}

local function draw_command(view, ui, command)
  local enabled, reason = view.session:can_run(command.name)
  if ui:menu_item(command.label or command.name, {shortcut = bindings.shown(view, command.name), enabled = enabled}) then dialog.open(view, command) end
  ui:tooltip(reason or ("session:run(%q)"):format(command.name))
end

-- entries in the order of their sections, with a line between two sections
local function draw_items(view, ui, items)
  local section
  for _, entry in ipairs(menu_tree.sorted(items)) do
    if section and entry.section ~= section then ui:separator() end
    section = entry.section
    if entry.draw then
      entry.draw(view, ui)
    elseif entry.command then
      draw_command(view, ui, entry.command)
    else
      ui:menu(entry.name, function(ui) draw_items(view, ui, entry.items) end)
    end
  end
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

-- names of the menus in the order of the bar: those of the view are the last ones
local function names_of(view)
  local names, known = {table.unpack(order)}, {View = true, Help = true}
  for _, name in ipairs(order) do known[name] = true end
  for _, menu in ipairs(view.session:menus()) do
    local name = menu.name:match "^[^/]+"
    if name and not known[name] then
      names[#names + 1], known[name] = name, true
    end
  end
  names[#names + 1], names[#names + 2] = "View", "Help"
  return names
end

-- the entries of a menu: of two in one section that of the view comes last
local function items_of(view, name)
  local items = {}
  for _, node in ipairs(menu_tree.of(view.session)) do
    if node.name == name then items = node.items end
  end
  return table.move(own[name] or {}, 1, #(own[name] or {}), #items + 1, items)
end

--- Draws the menu bar.
function menus.draw(view, ui)
  ui:menu_bar(function(ui)
    for _, name in ipairs(names_of(view)) do
      draw_menu(view, ui, name, function(ui) draw_items(view, ui, items_of(view, name)) end)
    end
  end)
end

return menus
