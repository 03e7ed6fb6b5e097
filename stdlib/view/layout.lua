--- The arrangement of tool bar, panels and status bar around the picture.
local autosave = require "clench.view.autosave"
local bindings = require "clench.view.bindings"
local compare = require "clench.view.compare"
local context = require "clench.view.context"
local dialog = require "clench.view.dialog"
local error_text = require "clench.error_text"
local help = require "clench.view.help"
local leave = require "clench.view.leave"
local menus = require "clench.view.menus"
local printable = require "clench.printable"
local projections = require "clench.view.projections"
local selection = require "clench.view.selection"
local splitters = require "clench.view.splitters"
local layout = {}

local menu_height, bar_height, status_height = 24, 36, 28  -- at scale 1 [pixels]
local line_height = 28  -- of widgets at scale 1 [pixels]
local tall_share = 0.72  -- fraction of the height of its column
local user_panels = {}  -- panels that scripts have added, by name and in order

local own_panels = {"tree", "quality", "inspector", "jobs", "eigengrasps", "wrench_space", "friction", "virtual_contacts", "forces", "tendons", "author", "sensors", "display", "console", "time_line", "history", "gallery", "plots"}

--- The panels of a view: built-in ones, and those of the user.
function layout.panels()
  local list = {}
  for i, name in ipairs(own_panels) do list[i] = require("clench.view.panels." .. name) end
  return list
end

--- Adds a panel, or replaces one of the same name.
---@param panel {name: string, draw: fun(ui: ui, view: table), place?: string}
function layout.add(panel)
  for i, other in ipairs(user_panels) do
    if other.name == panel.name then
      user_panels[i] = panel
      return
    end
  end
  user_panels[#user_panels + 1] = panel
end

-- an error of a panel is shown in it
local function draw_panel(view, ui, panel)
  local ok, message = pcall(panel.draw, ui, view)
  if not ok then ui:text(printable(error_text(message), "\n\t"), {color = {0.84, 0.37, 0}, wrap = true}) end
end

local function placed(view, place)
  local list = {}
  for _, panels in ipairs {view.panels, user_panels} do
    for _, panel in ipairs(panels) do
      if (panel.place or "right") == place and not view.hidden[panel.name] then list[#list + 1] = panel end
    end
  end
  return list
end

-- panels in one window, each behind a tab
local function draw_tabs(view, ui, name, list, rect)
  local names, by_name = {}, {}
  for i, panel in ipairs(list) do names[i], by_name[panel.name] = panel.name, panel end
  rect.title = false
  ui:window(name, rect, function(ui)
    ui:tabs(name .. " tabs", names, function(ui, chosen) draw_panel(view, ui, by_name[chosen]) end)
  end)
end

-- the panel of a window that shows one at a time
local function front_of(view, place, list)
  for _, panel in ipairs(list) do
    if panel.name == view.front[place] then return panel end
  end
  return list[1]
end

-- panels in one window, one shown at a time: buttons in as many rows as they need
local function draw_strip(view, ui, place, list, rect)
  local front = front_of(view, place, list)
  rect.title = false
  ui:window(place, rect, function(ui)
    local left = 0
    for i, panel in ipairs(list) do
      local wide = (7.4 * #panel.name + 22) * view.scale
      if i > 1 and left + wide < rect.width then ui:same_line(4) else left = 0 end
      left = left + wide
      if ui:button(panel.name, {selected = panel == front}) then view.front[place] = panel.name end
    end
    ui:separator()
    draw_panel(view, ui, front)
  end)
end

-- panels below each other in a column, then those that share a window
local function draw_column(view, ui, place, x, y, width, height)
  local rows, tabs = {}, {}
  for _, panel in ipairs(placed(view, place)) do
    local list = panel.tab and tabs or rows
    list[#list + 1] = panel
  end
  local count = #rows + (#tabs > 0 and 1 or 0)
  local each = count > 0 and height / count or 0
  -- a tall panel reduces the space of the others
  local shared = height - #rows * each
  if #tabs > 0 and #rows > 0 and front_of(view, place, tabs).tall then
    shared = math.max(shared, height * tall_share)
    each = (height - shared) / #rows
  end
  for i, panel in ipairs(rows) do
    ui:window(panel.name, {x = x, y = y + (i - 1) * each, width = width, height = each}, function(ui) draw_panel(view, ui, panel) end)
  end
  if #tabs > 0 then draw_strip(view, ui, place, tabs, {x = x, y = y + #rows * each, width = width, height = shared}) end
end

local function draw_bottom(view, ui, x, y, width, height)
  local list = placed(view, "bottom")
  if #list > 0 then draw_tabs(view, ui, "bottom", list, {x = x, y = y, width = width, height = height}) end
end

local function command_button(view, ui, label, name)
  local command = view.session.commands[name]
  local enabled = not command.enabled or (command.enabled(view.session)) and true or false
  ui:disabled(not enabled, function(ui)
    if ui:button(label) then dialog.open(view, command) end
  end)
  ui:tooltip(("%s  %s\nsession:run(%q)"):format(command.label or name, bindings.shown(view, name), name))
  ui:same_line()
end

local function names_of(list)
  local names = {}
  for i, thing in ipairs(list) do names[i] = thing.name end
  return names
end

local function choose(view, ui, label, list, current, command, argument)
  local names, index = names_of(list), 0
  for i, thing in ipairs(list) do
    if thing == current then index = i end
  end
  ui:width(95 * view.scale)
  local chosen, changed = ui:combo(label, index, names)
  if changed then view:run(command, {[argument] = names[chosen]}) end
  ui:same_line()
end

local function draw_bar(view, ui, y, width)
  ui:window("tool bar", {x = 0, y = y, width = width, height = bar_height * view.scale, title = false, scroll = false}, function(ui)
    for _, tool in ipairs(view.tools) do
      if ui:button(tool .. "##tool", {selected = view.current_tool == tool}) then view.current_tool = tool end
      ui:tooltip(("%s  %s"):format(tool, bindings.shown(view, "tool " .. tool)))
      ui:same_line()
    end
    for _, entry in ipairs {{"Undo", "edit.undo"}, {"Redo", "edit.redo"}, {"Close hand", "grasp.autograsp"}, {"Open hand", "grasp.open"}} do
      if view.session.commands[entry[2]] then command_button(view, ui, entry[1], entry[2]) end
    end
    local world = view.session.world
    if world then
      choose(view, ui, "##hand", world.robots, view.session.hand, "grasp.select_hand", "hand")
      choose(view, ui, "##object", world.objects, view.session.object, "grasp.select_object", "object")
      selection.draw_bar(view, ui)
      context.draw(view, ui)
    end
  end)
end

local function draw_status(view, ui, y, width, height)
  ui:window("status bar", {x = 0, y = y, width = width, height = height, title = false, scroll = false}, function(ui)
    local world = view.session.world
    ui:text(view.status)
    ui:same_line()
    ui:text(("   %s   %s%s"):format(view.session.path or "Untitled", view.current_tool, view.session:is_modified() and "   modified" or ""),
            {color = {0.5, 0.5, 0.55}})
  end)
end

local function draw_question(view, ui)
  if view.ask then
    local ask = view.ask
    local open = ui:window(ask.title, {width = 0, modal = true, can_close = true}, function(ui)
      ui:width(320)
      local text, _, entered = ui:text_input("path", ask.text, {on_enter = true, focus = not ask.shown})
      ask.text, ask.shown = text, true
      if ui:button("Save##ask") or entered then
        local ok, message = pcall(ask.done, ask.text)
        if ok then view.ask = nil else ask.error = tostring(message) end
      end
      ui:same_line()
      if ui:button "Cancel##ask" then view.ask = nil end
      if ask.error then ui:text(ask.error, {color = {0.84, 0.37, 0}, wrap = true}) end
    end)
    if not open then view.ask = nil end
  end
  leave.draw(view, ui)
  autosave.draw(view, ui)
end

--- Gives bars and panels the scale of the text; within a frame.
function layout.follow_scale(view) view.scale = view.ui.line_height / line_height end

-- where the columns and the bottom row end, as far as they have panels [pixels]
local function edges_of(view, width, height)
  local top, bottom = (menu_height + bar_height) * view.scale, height - status_height * view.scale - splitters.size(view, "bottom")
  local left, right = splitters.size(view, "left"), width - splitters.size(view, "right")
  local edges = {left = {at = left, from = top, to = bottom}, right = {at = right, from = top, to = bottom}, bottom = {at = bottom, from = left, to = right}}
  for name in pairs(edges) do
    if #placed(view, name) == 0 then edges[name] = nil end
  end
  return edges
end

--- The part of the picture that no panel covers; all of it if too little is left.
---@return number x, number y, number width, number height [pixels]
function layout.uncovered(view)
  local width, height = view.ui.size[1], view.ui.size[2]
  if not view.panels_visible then return 0, 0, width, height end
  local edges = edges_of(view, width, height)
  local left, right = edges.left and edges.left.at or 0, edges.right and edges.right.at or width
  local top, bottom = (menu_height + bar_height) * view.scale, edges.bottom and edges.bottom.at or height - status_height * view.scale
  if right - left < splitters.min_picture or bottom - top < splitters.min_picture then return 0, 0, width, height end
  return left, top, right - left, bottom - top
end

--- Draws all panels.
function layout.draw(view, ui)
  local width, height = ui.size[1], ui.size[2]
  local menu, status = menu_height * view.scale, status_height * view.scale
  menus.draw(view, ui)
  draw_bar(view, ui, menu, width)
  local top = menu + bar_height * view.scale
  local left, right, below = splitters.size(view, "left"), splitters.size(view, "right"), splitters.size(view, "bottom")
  local bottom = height - status - below
  draw_column(view, ui, "left", 0, top, left, bottom - top)
  draw_column(view, ui, "right", width - right, top, right, bottom - top)
  draw_bottom(view, ui, 0, bottom, width, below)
  view.edges = edges_of(view, width, height)
  draw_status(view, ui, height - status, width, status)
  dialog.draw(view, ui)
  compare.draw(view, ui)
  projections.draw_windows(view, ui)
  draw_question(view, ui)
  help.draw(view, ui)
end

return layout
