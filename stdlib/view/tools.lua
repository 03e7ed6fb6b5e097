--- Tools of the picture: effects of clicks and drags on the picture. "Camera" moves the camera, "Select" selects, "Translate" and "Rotate" drag the
--- selection until it touches something, "Measure" measures distances and angles. The middle and right buttons and the wheel always move the camera.
local boxes = require "clench.view.boxes"
local camera = require "clench.view.camera"
local context = require "clench.view.context"
local drags = require "clench.view.drags"
local edit = require "clench.view.edit"
local error_text = require "clench.error_text"
local frames = require "clench.view.frames"
local handles = require "clench.view.handles"
local is_stopped = require "clench.is_stopped"
local joint_handles = require "clench.view.joint_handles"
local manipulator = require "clench.view.manipulator"
local measure = require "clench.view.measure"
local navigation = require "clench.view.navigation"
local outline = require "clench.view.outline"
local replay = require "clench.view.replay"
local selection = require "clench.view.selection"
local stereo = require "clench.view.stereo"
local tools = {}

local contact_reach = 8  -- distance within which a click hits a contact [pixels]

tools.names = {"Camera", "Select", "Translate", "Rotate", "Measure"}

--- How each tool is used.
tools.hints = {
  Camera = "Camera: drag to turn, double click to look at a point",
  Select = "Select: click on a body; Shift adds, a second click selects the robot",
  Translate = "Translate: drag a body, or an arrow of the selection; Ctrl snaps, Shift keeps one axis",
  Rotate = "Rotate: drag a body, or a ring of the selection; Ctrl snaps, Shift keeps one axis",
  Measure = "Measure: click on a point",
}

--- Chooses a tool; the status bar shows its use.
function tools.choose(view, name) view.current_tool, view.status = name, tools.hints[name] end

local function hit_under(view, c, x, y)
  local world = view.session.world
  if not world then return nil end
  local origin, direction = camera.ray(c, view.ui.size, x, y)
  local hit = replay.world(view):raycast(origin, direction)
  return hit and replay.to_live(view, hit)
end

--- The hit under a pixel: body, point and normal; nil if there is none.
function tools.pick(view, x, y) return hit_under(view, stereo.under(view, x), x, y) end

-- the target of a drag of a body: its robot, or the robot that carries that robot's mount; otherwise the body itself
local function movable(body) return body.robot or body end

-- the number of the listed contact within a few pixels
local function contact_at(view, x, y)
  local best, least = nil, contact_reach
  for i, contact in ipairs(view.quality and view.quality.contacts or {}) do
    local at_x, at_y = camera.project(stereo.under(view, x), view.ui.size, contact.point)
    local distance = at_x and math.sqrt((at_x - x) ^ 2 + (at_y - y) ^ 2) or math.huge
    if distance < least then best, least = i, distance end
  end
  return best
end

-- a click selects a body, and marks the contact that it hits
local function select_at(view, x, y, adds)
  local hit = tools.pick(view, x, y)
  view.highlighted = contact_at(view, x, y)
  if not view.highlighted then view.listed = nil end
  selection.click(view, hit and (adds and hit.body or selection.meant(view, hit.body)), adds)
end

--- Handles over the picture for the current tool and selection: name, pixel x and y.
---@return table[] handles
function tools.handles(view)
  if not view.session.world or view.replay then return {} end
  local list = joint_handles.handles(view)
  return #list > 0 and list or manipulator.handles(view)
end

local function shift_down(ui) return ui:key_down(340) or ui:key_down(344) end
local function ctrl_down(ui) return ui:key_down(341) or ui:key_down(345) end

local function begin_drag(view, x, y)
  local handle = handles.at(tools.handles(view), x, y)
  if handle and handle.kind == "joint" then return joint_handles.begin(view, handle, x, y) end
  if handle then return drags.begin(view, handle.target, handle, nil, x, y) end
  local hit = hit_under(view, view.camera, x, y)
  if not hit then return nil end
  local target = movable(hit.body)
  local drag = drags.begin(view, target, nil, hit.point, x, y)
  if drag then drag.is_free = true end
  return drag
end

local function begin_press(view, mouse)
  local tool = view.current_tool
  if view.seeks then return {kind = "seek"} end
  if view.ui:key_down(342) or tool == "Camera" then return {kind = mouse.left.double and "seek" or "camera"} end
  if tool == "Measure" then return {kind = "measure"} end
  if tool == "Select" then return {kind = "select", x = mouse.x, y = mouse.y} end
  if view.replay then return {kind = "camera"} end  -- recorded states cannot be changed
  local drag = stereo.with(view, stereo.under(view, mouse.x), function() return begin_drag(view, mouse.x, mouse.y) end)
  return drag and {kind = "drag", drag = drag, from_x = mouse.x} or {kind = "camera"}
end

local function is_part(thing, robot) return thing ~= nil and clench.type(thing) == "body" and thing.robot == robot end

local function move_drag(view, press, mouse)
  local drag, ui = press.drag, view.ui
  -- the dragged body or robot is selected, unless a part of it is
  local selected = view.session.selection[1]
  if not press.moved and drag.is_free and not drag.group and selected ~= drag.target and not is_part(selected, drag.target) then
    view:run("world.select", {addresses = {view:address(drag.target)}})
  end
  press.moved = true
  local move = drag.move or function(...) drags.move(view, drag, ...) end
  -- by the camera of the eye in whose picture the drag began
  local ok, problem = pcall(stereo.with, view, stereo.under(view, press.from_x), function() move(mouse.x, mouse.y, ctrl_down(ui), shift_down(ui)) end)
  if ok then return end
  -- a motion that starts in collision is rejected
  if is_stopped(problem) then error(problem, 0) end
  view.status = error_text(problem)
end

local function end_press(view, press, mouse)
  if press.kind == "drag" then edit.end_gesture(view, press.drag.gesture) end
  if press.opens_menu and view.panels_visible then context.open(view, mouse.x, mouse.y) end
  if press.kind == "seek" then navigation.seek_pixel(view, mouse.x, mouse.y) end
  if press.kind == "measure" then measure.click(view, mouse.x, mouse.y) end
  -- a click with the Translate or Rotate tool selects: a link shows the handles of its joints
  local is_click = press.kind == "drag" and press.drag.is_free and not press.moved
  if press.kind == "select" or is_click then select_at(view, mouse.x, mouse.y, shift_down(view.ui)) end
end

--- Applies the mouse input of this frame to the picture.
function tools.update(view)
  local ui = view.ui
  local mouse = ui.mouse
  if not view.press and ui.wants_mouse then return end
  if mouse.wheel ~= 0 then
    view.camera = camera.zoomed(view.camera, 0.9 ^ mouse.wheel)
    view.camera_moved = true
  end
  if not view.session.world then return end
  if mouse.left.clicked then view.press = begin_press(view, mouse) end
  if mouse.right.clicked or mouse.middle.clicked then view.press = {kind = "camera", opens_menu = mouse.right.clicked} end
  local press = view.press
  -- a command has ended the drag
  if press and press.kind == "drag" and press.drag.gesture ~= view.session.gesture then press, view.press = nil, nil end
  if not press then return end
  -- the motion of the frame of a press led to the place of the press
  local begins = mouse.left.clicked or mouse.right.clicked or mouse.middle.clicked
  local moved = not begins and (mouse.dx ~= 0 or mouse.dy ~= 0)
  if press.kind == "camera" and moved then
    press.opens_menu = false
    navigation.drag(view, mouse, ctrl_down(ui), shift_down(ui))
  elseif press.kind == "drag" and moved then
    move_drag(view, press, mouse)
  end
  if mouse.left.released or mouse.right.released or mouse.middle.released then
    view.press = nil
    end_press(view, press, mouse)
  end
end

-- a contact that was clicked in the list
local function draw_highlight(view, ui)
  local contact = view.quality and view.highlighted and view.quality.contacts[view.highlighted]
  if not contact then return end
  local x, y = camera.project(view.camera, ui.size, contact.point)
  if x then ui:circle(x, y, 12, {color = {0.84, 0.37, 0, 1}, width = 3}) end
end

local function draw_handles(view, ui, hovered)
  local list = tools.handles(view)
  if #list > 0 then handles.draw(ui, list, hovered) end
end

-- the handle that is dragged or under the mouse, in the picture in which the mouse is
local function hovered_handle(view, ui)
  if view.press then return view.press.drag and view.press.drag.handle end
  if ui.wants_mouse then return nil end
  local mouse = ui.mouse
  local handle = stereo.with(view, stereo.under(view, mouse.x), function() return handles.at(tools.handles(view), mouse.x, mouse.y) end)
  return handle and handle.name
end

local function draw_axes(view, ui)
  if not view.shows_axes then return end
  for _, thing in ipairs(view.session.selection) do
    local there = replay.shown(view, thing)
    if there then frames.draw(view, ui, there.pose) end
  end
end

--- Outlines the selection, and draws its axes, the manipulator and the highlighted contact.
function tools.draw(view, ui)
  local hovered = hovered_handle(view, ui)
  stereo.over(view, ui, function()
    draw_highlight(view, ui)
    draw_handles(view, ui, hovered)
    outline.draw(view, ui)
    boxes.draw(view, ui)
    measure.draw(view, ui)
    draw_axes(view, ui)
    replay.draw(view, ui)
  end)
end

return tools
