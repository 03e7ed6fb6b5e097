--- Stereoscopic pictures: those of two eyes side by side, or in red and cyan for glasses. What the camera points at is in the plane of the screen.
local camera = require "clench.view.camera"
local check = require "clench.view.check"
local described = require "clench.described"
local raise = require "clench.raise"
local stereo = {}

stereo.kinds = {"side by side", "anaglyph"}
stereo.max_distance = 10  -- maximum distance of the eyes [m]
local share = 1 / 30  -- distance of the eyes by default, as a fraction of the distance from camera to target
local factor = 1.25  -- by which a key changes it

--- Checks the stereo of a view or of a screenshot.
---@param value {kind: string, eye_distance?: number}|false|nil  eye_distance [m]
---@return table?  nil: off
function stereo.checked(subject, value)
  if not value then return nil end
  check.options(subject, value, {"kind", "eye_distance"})
  local known = false
  for _, kind in ipairs(stereo.kinds) do known = known or kind == value.kind end
  if not known then raise(("%s: kind: expected 'side by side' or 'anaglyph', got %s"):format(subject, described(value.kind))) end
  local distance = value.eye_distance
  if distance ~= nil and not (type(distance) == "number" and distance >= 0 and distance <= stereo.max_distance) then
    raise(("%s: eye_distance: expected a number from 0 to %g, got %s"):format(subject, stereo.max_distance, described(distance)))
  end
  return value
end

--- The distance of the eyes of a view [m].
function stereo.eye_distance(view)
  local c = view.camera
  return view.stereo and view.stereo.eye_distance or (c.eye - c.target):norm() * share
end

-- A camera aside of another one. A perspective one looks in the same direction, and its picture is shifted back; an orthographic one, whose picture
-- would not change, turns towards the target.
local function beside(c, distance)
  local right, up = camera.axes(c)
  local shift = right * distance
  local eye = {eye = c.eye + shift, target = c.target, up = up, field_of_view = c.field_of_view, orthographic = c.orthographic, aside = c.aside}
  if c.orthographic then return eye end
  eye.target, eye.aside = c.target + shift, (c.aside or 0) + distance / camera.height(c)
  return eye
end

--- The cameras of the left and the right eye.
---@param distance number  of the eyes [m]
function stereo.eyes(c, distance) return beside(c, -distance / 2), beside(c, distance / 2) end

-- the camera whose picture on the whole screen is the same in one half as that of another camera on this half
local function on_screen(c, size, middle)
  return {eye = c.eye, target = c.target, up = c.up, field_of_view = c.field_of_view, orthographic = c.orthographic,
          aside = (c.aside or 0) + (middle - size[1] / 2) / size[2]}
end

--- The pictures of which the screen consists: for each, its camera and options of ui:show, the camera on the whole screen, and its left edge and width.
---@return {camera: table, part: string?, channels: string?, seen: table, x: number, width: number}[]
function stereo.panes(view)
  local kind = stereo.checked("view.stereo", view.stereo)
  local size, c = view.ui.size, view.camera
  if not kind then return {{camera = c, seen = c, x = 0, width = size[1]}} end
  local left, right = stereo.eyes(c, stereo.eye_distance(view))
  if kind.kind == "anaglyph" then
    return {{camera = left, channels = "red", seen = left, x = 0, width = size[1]}, {camera = right, channels = "cyan", seen = right, x = 0, width = size[1]}}
  end
  local half = size[1] // 2
  return {{camera = left, part = "left", seen = on_screen(left, size, half / 2), x = 0, width = half},
          {camera = right, part = "right", seen = on_screen(right, size, (half + size[1]) / 2), x = half, width = size[1] - half}}
end

local function is_halved(view) return view.stereo and view.stereo.kind == "side by side" end

--- The camera of the picture at a pixel. In an anaglyph, which has two there, that of the view.
---@param x number  [pixels]
function stereo.under(view, x)
  if not is_halved(view) then return view.camera end
  local panes = stereo.panes(view)
  return panes[x < panes[2].x and 1 or 2].seen
end

--- The camera of one eye, "left" or "right", on the whole screen; by default that of the view, or of the left half.
function stereo.of(view, eye)
  if eye ~= nil and eye ~= "left" and eye ~= "right" then raise("view:project: eye: expected 'left' or 'right', got " .. described(eye)) end
  if not view.stereo or not eye and not is_halved(view) then return view.camera end
  return stereo.panes(view)[eye == "right" and 2 or 1].seen
end

--- The rectangle that a camera fills, given the part of the screen without panels: that part, or half of the screen [pixels].
function stereo.rectangle(view, x, y, width, height)
  if not is_halved(view) then return x, y, width, height end
  return (view.ui.size[1] - view.ui.size[1] // 2) / 2, y, view.ui.size[1] // 2, height
end

--- Calls a function while the camera of the view is another one.
function stereo.with(view, c, f)
  local before = view.camera
  view.camera = c
  local _ <close> = setmetatable({}, {__close = function() view.camera = before end})
  return f()
end

--- Draws lines and labels over the picture: in stereo for each eye, over its half or in its colors, so that they have the depth of what they mark.
---@param draw fun()
function stereo.over(view, ui, draw)
  if not view.stereo then return draw() end
  for _, pane in ipairs(stereo.panes(view)) do
    stereo.with(view, pane.seen, function()
      ui:channels(pane.channels or "all", function() ui:clip(pane.x, 0, pane.width, view.ui.size[2], draw) end)
    end)
  end
end

--- Chooses a kind of stereo; nil: off.
function stereo.choose(view, kind)
  view.stereo = kind and {kind = kind, eye_distance = view.stereo and view.stereo.eye_distance} or nil
  view.needs_frame = true
end

--- Sets the distance of the eyes [m]; nil: it follows the distance from camera to target.
function stereo.set_distance(view, distance)
  view.stereo = {kind = view.stereo.kind, eye_distance = distance and math.max(0, math.min(stereo.max_distance, distance))}
  view.needs_frame = true
end

--- Makes the distance of the eyes larger or smaller by one step.
---@param steps integer  1 or -1
function stereo.step(view, steps)
  if not view.stereo then
    view.status = "Stereo is off; View/Stereo turns it on."
    return
  end
  stereo.set_distance(view, stereo.eye_distance(view) * factor ^ steps)
  view.status = ("Eyes %.1f mm apart"):format(1000 * stereo.eye_distance(view))
end

--- Draws the entries of the menu View/Stereo.
function stereo.draw_menu(view, ui)
  ui:menu("Stereo", function(ui)
    if ui:menu_item("Stereo Off", {selected = not view.stereo}) then stereo.choose(view, nil) end
    if ui:menu_item("Side by Side", {selected = is_halved(view)}) then stereo.choose(view, "side by side") end
    if ui:menu_item("Anaglyph", {selected = view.stereo ~= nil and not is_halved(view)}) then stereo.choose(view, "anaglyph") end
  end)
end

return stereo
