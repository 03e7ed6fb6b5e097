--- The arrangement of tool bar, panels and status bar around the picture.
local ask_path = require "clench.view.ask_path"
local autosave = require "clench.view.autosave"
local bindings = require "clench.view.bindings"
local compare = require "clench.view.compare"
local context = require "clench.view.context"
local dialog = require "clench.view.dialog"
local guarded = require "clench.view.guarded"
local help = require "clench.view.help"
local leave = require "clench.view.leave"
local menus = require "clench.view.menus"
local projections = require "clench.view.projections"
local selection = require "clench.view.selection"
local splitters = require "clench.view.splitters"
local status = require "clench.view.status"
local tools = require "clench.view.tools"
local layout = {}

local menu_height, bar_height, status_height = 24, 36, 28  -- at scale 1 [pixels]
local line_height = 28  -- of widgets at scale 1 [pixels]
local min_bar = 1050  -- width of the complete tool bar at scale 1 [pixels]
local tall_share = 0.72  -- fraction of the height of its column
local user_panels = {}  -- panels that scripts have added, by name and in order

local own_panels = {"tree", "quality", "inspector", "jobs", "eigengrasps", "wrench_space", "friction", "virtual_contacts", "forces", "tendons", "author", "sensors", "online", "display", "console", "time_line", "history", "gallery", "plots"}

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

-- a function that draws its part guarded
local function guarding(draw)
  return function(ui) guarded(ui, draw) end
end

local function draw_panel(view, ui, panel) guarded(ui, panel.draw, view) end

local function placed(view, place)
  local list = {}
  for _, panels in ipairs {view.panels, user_panels} do
    for _, panel in ipairs(panels) do
      if (panel.place or "right") == place and not view.hidden[panel.name] then list[#list + 1] = panel end
    end
  end
  return list
end

-- Panels in one window, each behind a tab. The open one is view.front[place], which a click or a script changes.
local function draw_tabs(view, ui, place, list, rect)
  local names, by_name = {}, {}
  for i, panel in ipairs(list) do names[i], by_name[panel.name] = panel.name, panel end
  local open = view.open_tabs
  if not open or open.ui ~= ui then open = {ui = ui} end  -- another screen opens its first tab
  view.open_tabs = open
  local wanted = by_name[view.front[place]] and view.front[place] ~= open[place] and view.front[place] or nil
  if wanted then view.needs_frame = true end
  rect.title = false
  ui:window(place, rect, function(ui)
    ui:tabs(place .. " tabs", names, function(ui, shown)
      open[place] = shown
      if not wanted then view.front[place] = shown end
      draw_panel(view, ui, by_name[shown])
    end, wanted)
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

-- heights of the parts of a column: those of the user, or equal ones, or less for the parts above a tall panel
local function heights_of(view, place, rows, tabs, height)
  local heights = {}
  local count = #rows + (#tabs > 0 and 1 or 0)
  for i = 1, count do heights[i] = height / count end
  if count == 2 and view.shares[place] then
    heights[1] = height * view.shares[place]
    heights[2] = height - heights[1]
  elseif #tabs > 0 and #rows > 0 and front_of(view, place, tabs).tall then
    heights[count] = math.max(height / count, height * tall_share)
    for i = 1, #rows do heights[i] = (height - heights[count]) / #rows end
  end
  return heights
end

-- Panels below each other in a column, then those that share a window. Two parts have a gap between them; returns this edge.
local function draw_column(view, ui, place, x, y, width, height)
  local rows, tabs = {}, {}
  for _, panel in ipairs(placed(view, place)) do
    local list = panel.tab and tabs or rows
    list[#list + 1] = panel
  end
  local heights = heights_of(view, place, rows, tabs, height)
  local gap, at = #heights == 2 and splitters.gap or 0, y
  for i, panel in ipairs(rows) do
    ui:window(panel.name, {x = x, y = at, width = width, height = heights[i] - (i == 1 and gap or 0)}, function(ui) draw_panel(view, ui, panel) end)
    at = at + heights[i]
  end
  if #tabs > 0 then draw_strip(view, ui, place, tabs, {x = x, y = at, width = width, height = heights[#heights]}) end
  return gap > 0 and {at = y + heights[1] - gap, from = x, to = x + width, top = y, height = height} or nil
end

local function draw_bottom(view, ui, x, y, width, height)
  local list = placed(view, "bottom")
  if #list > 0 then draw_tabs(view, ui, "bottom", list, {x = x, y = y, width = width, height = height}) end
end

local function command_button(view, ui, label, name)
  dialog.button(view, ui, label, name, {text = ("%s  %s"):format(view.session.commands[name].label or name, bindings.shown(view, name))})
  ui:same_line()
end

local function names_of(list)
  local names = {}
  for i, thing in ipairs(list) do names[i] = thing.name end
  return names
end

local function choose(view, ui, text, list, current, command, argument)
  local names, index = names_of(list), 0
  for i, thing in ipairs(list) do
    if thing == current then index = i end
  end
  ui:width(95 * view.scale)
  local chosen, changed = ui:combo("##" .. argument, index, names)
  ui:tooltip(("%s\nsession:run(%q, {%s = %q})"):format(text, command, argument, current and current.name or "…"))
  if changed then view:run(command, {[argument] = names[chosen]}) end
  ui:same_line()
end

local function draw_bar(view, ui, y, width)
  -- one pixel of overlap: the menu bar is as high as its text, rounded
  ui:window("tool bar", {x = 0, y = y - 1, width = width, height = bar_height * view.scale + 1, title = false, scroll = false}, guarding(function(ui)
    for _, tool in ipairs(view.tools) do
      if ui:button(tool .. "##tool", {selected = view.current_tool == tool}) then tools.choose(view, tool) end
      ui:tooltip(("%s\n%s\nview:tool %q"):format(bindings.shown(view, "tool " .. tool), tools.hints[tool] or tool, tool))
      ui:same_line()
    end
    -- in a narrow window these are in the menus only
    for _, entry in ipairs(width < min_bar * view.scale and {} or {{"Undo", "edit.undo"}, {"Redo", "edit.redo"}, {"Close hand", "grasp.autograsp"}, {"Open hand", "grasp.open"}}) do
      if view.session.commands[entry[2]] then command_button(view, ui, entry[1], entry[2]) end
    end
    local world = view.session.world
    if world then
      choose(view, ui, "Current hand, which commands of the menu Grasp move", world.robots, view.session.hand, "grasp.select_hand", "hand")
      choose(view, ui, "Current object, which the hand grasps", world.objects, view.session.object, "grasp.select_object", "object")
      selection.draw_bar(view, ui)
      context.draw(view, ui)
    end
  end))
end

local function draw_status(view, ui, y, width, height)
  ui:window("status bar", {x = 0, y = y, width = width, height = height, title = false, scroll = false}, guarding(function(ui) status.draw(view, ui) end))
end

local function draw_questions(view, ui)
  ask_path.draw(view, ui)
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
  local menu, below_all = menu_height * view.scale, status_height * view.scale
  menus.draw(view, ui)
  draw_bar(view, ui, menu, width)
  local top = menu + bar_height * view.scale
  local left, right, below = splitters.size(view, "left"), splitters.size(view, "right"), splitters.size(view, "bottom")
  local bottom = height - below_all - below
  local within_left = draw_column(view, ui, "left", 0, top, left, bottom - top)
  local within_right = draw_column(view, ui, "right", width - right, top, right, bottom - top)
  draw_bottom(view, ui, 0, bottom, width, below)
  view.edges = edges_of(view, width, height)
  view.edges["within left"], view.edges["within right"] = within_left, within_right
  draw_status(view, ui, height - below_all, width, below_all)
  dialog.draw(view, ui)
  compare.draw(view, ui)
  projections.draw_windows(view, ui)
  draw_questions(view, ui)
  help.draw(view, ui)
end

return layout
