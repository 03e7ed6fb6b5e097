--- The menu of a right click, in the picture and in the tree: commands for the body under the mouse, or for the complete selection if it is selected.
local contains = require "clench.contains"
local dialog = require "clench.view.dialog"
local navigation = require "clench.view.navigation"
local selection = require "clench.view.selection"
local context = {}

local body_commands = {"body.collisions", "body.material", "body.transparency", "body.color", "body.mass", "body.remove"}
local hand_commands = {"grasp.autograsp", "grasp.open", "grasp.save_posture", "grasp.restore_posture"}

-- a part of a robot that is selected counts as selected
local function is_chosen(view, thing) return selection.has(view, thing) or clench.type(thing) == "body" and thing.robot and selection.has(view, thing.robot) end

local function run(view, name, thing)
  if not is_chosen(view, thing) then selection.set(view, {thing}) end
  dialog.open(view, view.session.commands[name])
end

local function label_of(view, name) return view.session.commands[name].label or name end

local function entry(view, ui, name, thing, enabled)
  if ui:menu_item(label_of(view, name), {enabled = enabled and (view.session:can_run(name))}) then run(view, name, thing) end
end

local function draw_robot(view, ui, robot)
  if ui:menu_item("Current Hand", {selected = view.session.hand == robot}) then view:run("grasp.select_hand", {hand = view:address(robot)}) end
  for _, name in ipairs(hand_commands) do
    if ui:menu_item(label_of(view, name), {enabled = (view.session:can_run(name))}) then view:run(name, {hand = view:address(robot)}) end
  end
  ui:separator()
end

--- Entries for a body or robot.
---@param point? vec3  clicked point of its surface [m]
function context.draw_thing(view, ui, thing, point)
  local is_robot = clench.type(thing) == "robot"
  local robot = is_robot and thing or thing.robot
  ui:text(thing.name, {color = {0.5, 0.5, 0.55}})
  ui:separator()
  if ui:menu_item("Select This") then selection.set(view, {thing}) end
  if not is_robot and robot and ui:menu_item("Select Robot") then selection.set(view, {robot}) end
  local has = selection.has(view, thing)
  if ui:menu_item(has and "Take from Selection" or "Add to Selection") then selection.click(view, thing, true) end
  local center = point or (is_robot and thing.base or thing).pose.position
  if ui:menu_item("Seek This") then navigation.seek(view, center) end
  ui:separator()
  if robot then draw_robot(view, ui, robot) end
  if not is_robot and thing.kind == "object" and ui:menu_item("Current Object", {selected = view.session.object == thing}) then
    view:run("grasp.select_object", {object = view:address(thing)})
  end
  for _, name in ipairs(body_commands) do
    entry(view, ui, name, thing, name ~= "body.remove" or is_robot or robot == nil or is_chosen(view, robot))
  end
end

local function draw_empty(view, ui)
  if ui:menu_item("Look at the Grasp") then view:home() end
  if ui:menu_item("Look at Everything") then view:home(true) end
  if ui:menu_item("Orthographic", {selected = view.camera.orthographic ~= nil}) then view:toggle_orthographic() end
  if ui:menu_item("Set Home") then navigation.set_home(view) end
  if ui:menu_item("Select Nothing", {enabled = #view.session.selection > 0}) then selection.set(view, {}) end
end

--- Opens the menu of a pixel of the picture in the next frame.
function context.open(view, x, y)
  local hit = view:pick(x, y)
  view.context = {thing = hit and hit.body, point = hit and hit.point, frames = 0}
  view.needs_frame = true
end

--- Is the menu of the picture about to appear? Its first frame measures it and shows nothing.
function context.appears(view) return view.context ~= nil and view.context.frames < 2 end

--- Draws the menu of the picture, if it is open; within a window.
function context.draw(view, ui)
  local menu = view.context
  if menu and menu.thing and not contains(view.session.world.bodies, menu.thing) then view.context, menu = nil, nil end  -- it was removed
  if not menu then return end
  if menu.frames == 0 then ui:open_popup "picture menu" end
  menu.frames = menu.frames + 1
  local is_open = false
  ui:popup("picture menu", function(ui)
    is_open = true
    if menu.thing then context.draw_thing(view, ui, menu.thing, menu.point) else draw_empty(view, ui) end
  end)
  if not is_open then view.context = nil end
end

--- The menu of the last widget, which represents a body or robot.
function context.of_widget(view, ui, thing)
  ui:context_menu("menu of " .. view:address(thing), function(ui) context.draw_thing(view, ui, thing) end)
end

return context
