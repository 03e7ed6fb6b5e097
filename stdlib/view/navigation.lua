--- Navigation: mouse and keys move the camera, as in GraspIt! or in Blender; seek, home and bookmarks.
local camera = require "clench.view.camera"
local navigation = {}

navigation.styles = {"Original", "Blender"}
navigation.bookmark_count = 4

local orbit_speed = math.pi / 400  -- [rad per pixel]
local zoom_speed = 0.005  -- logarithm of the distance per pixel

-- effect of a drag, by style: orbit, pan or zoom
local function action_of(view, mouse, ctrl, shift)
  if view.navigation == "Blender" and mouse.middle.down then return shift and "pan" or ctrl and "zoom" or "orbit" end
  if mouse.left.down and mouse.middle.down then return "zoom" end
  if mouse.middle.down or mouse.left.down and ctrl then return "pan" end
  return "orbit"
end

--- Moves the camera according to the mouse in this frame.
function navigation.drag(view, mouse, ctrl, shift)
  local action = action_of(view, mouse, ctrl, shift)
  if action == "pan" then
    view.camera = camera.panned(view.camera, view.ui.size, mouse.dx, mouse.dy)
  elseif action == "zoom" then
    view.camera = camera.zoomed(view.camera, math.exp(mouse.dy * zoom_speed))
  else
    view.camera = camera.orbited(view.camera, mouse.dx * orbit_speed, mouse.dy * orbit_speed)
  end
end

--- Turns the camera to a point, which becomes the center of rotation, and moves it nearer by a quarter of the distance.
---@param point vec3  [m]
function navigation.seek(view, point)
  view.camera = camera.zoomed(camera.centered(view.camera, point), 0.75)
  view.needs_frame = true
end

--- Seeks the point under a pixel.
---@return boolean found
function navigation.seek_pixel(view, x, y)
  local hit = view:pick(x, y)
  view.seeks = nil
  if not hit then
    view.status = "There is nothing under the mouse to seek."
    return false
  end
  navigation.seek(view, hit.point)
  return true
end

--- Stores the camera as a bookmark.
---@param number integer  from 1 to 4
function navigation.store(view, number)
  view.bookmarks[number] = view.camera
  view.status = ("Bookmark %d stored"):format(number)
end

--- Restores the camera of a bookmark.
function navigation.recall(view, number)
  if not view.bookmarks[number] then
    view.status = ("Bookmark %d is empty; Shift+F%d stores it."):format(number, number)
    return
  end
  view.camera, view.needs_frame = view.bookmarks[number], true
end

--- Makes the present camera the one that Home restores, until another world is opened.
function navigation.set_home(view)
  view.home_camera = view.camera
  view.status = "Home is here now"
end

--- Seeks what lies under the mouse, unless that is a panel.
function navigation.seek_mouse(view)
  if not view.ui.wants_mouse then navigation.seek_pixel(view, view.ui.mouse.x, view.ui.mouse.y) end
end

--- Draws the entries of the View menu.
---@param shown fun(name: string): string  the key of an action, for display
function navigation.draw_menu(view, ui, shown)
  if ui:menu_item("Set Home") then navigation.set_home(view) end
  if ui:menu_item("Seek", {shortcut = shown "seek", selected = view.seeks or false}) then view.seeks = true end
  ui:menu("Bookmarks", function(ui)
    for i = 1, navigation.bookmark_count do
      if ui:menu_item("Store Bookmark " .. i, {shortcut = shown("store " .. i)}) then navigation.store(view, i) end
    end
    ui:separator()
    for i = 1, navigation.bookmark_count do
      if ui:menu_item("Recall Bookmark " .. i, {shortcut = shown("recall " .. i), enabled = view.bookmarks[i] ~= nil}) then navigation.recall(view, i) end
    end
  end)
  ui:menu("Navigation", function(ui)
    for _, style in ipairs(navigation.styles) do
      if ui:menu_item(style, {selected = view.navigation == style}) then view.navigation = style end
    end
  end)
end

return navigation
