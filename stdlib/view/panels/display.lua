--- Options of the picture: items shown in addition to the bodies, and stereo.
local boxes = require "clench.view.boxes"
local edit = require "clench.view.edit"
local stereo = require "clench.view.stereo"
local units = require "clench.view.units"
local wrenches = require "clench.view.wrenches"

local switches = {
  {"contacts", "friction cones", true}, {"transparent_objects", "transparent objects", true}, {"approach", "approach directions", false},
  {"patches", "patches of soft contacts", false}, {"ground", "floor", true},
}

local styles = {"faces", "wireframe", "points"}

-- coordinate frames of the selection
local function draw_axes(ui, view)
  local on, changed = ui:checkbox("axes of the selection", view.shows_axes == true)
  if changed then view.shows_axes = on end
  ui:tooltip "x vermilion, y green, z blue"
end

-- two pictures, and the distance of their eyes in the user's unit
local function draw_stereo(ui, view)
  local names, index = {"off", table.unpack(stereo.kinds)}, 1
  for i, kind in ipairs(names) do
    if view.stereo and view.stereo.kind == kind then index = i end
  end
  ui:width(120 * view.scale)
  local chosen, changed = ui:combo("stereo", index, names)
  if changed then stereo.choose(view, chosen > 1 and names[chosen] or nil) end
  if not view.stereo then return end
  local factor, unit, format = units.of(view, "m")
  ui:width(120 * view.scale)
  local distance = edit.number(view, ui, ("eye distance [%s]"):format(unit), "eye distance", stereo.eye_distance(view) * factor,
                               {speed = 0.0005 * factor, min = 0, max = stereo.max_distance * factor, format = format})
  if distance then stereo.set_distance(view, distance / factor) end
  ui:tooltip "Keys + and - change it."
  if ui:button("Automatic", {selected = not view.stereo.eye_distance}) then stereo.set_distance(view, nil) end
  ui:tooltip "The eye distance is 1/30 of the distance from the camera to its target."
end

-- forces and torques that do not cancel, of the selected bodies
local function draw_wrenches(ui, view)
  local on, changed = ui:checkbox("unbalanced wrenches", view.shows_wrenches == true)
  if changed then
    view.shows_wrenches = on
    view:changed()
  end
  ui:tooltip "Of the selected bodies, by their weight and the contact forces of the last step: the net force, 5 mm/N, and the net torque, 50 mm/(N m), at most 200 mm long\nsession:run(\"body.net_wrench\", {body = …})"
  for _, wrench in ipairs(wrenches.of(view) or {}) do ui:text(("%.4g N, %.3g N m"):format(wrench.force:norm(), wrench.torque:norm()), {color = {0.5, 0.5, 0.5}}) end
end

local function draw_boxes(ui, view)
  local on, changed = ui:checkbox("bounding boxes", view.box_depth ~= nil)
  if changed then view.box_depth = on and 0 or nil end
  ui:tooltip "Of the selection: boxes of the tree that collision queries descend\nbody.mesh:bounding_boxes(depth)"
  if not view.box_depth then return end
  ui:width(120 * view.scale)
  local depth, moved = ui:slider("depth", view.box_depth, {min = 0, max = boxes.max_depth, format = "%.0f"})
  if moved then view.box_depth = math.floor(math.max(0, math.min(boxes.max_depth, depth)) + 0.5) end
  ui:text(("%d boxes"):format(boxes.count(view, view.box_depth)), {color = {0.5, 0.5, 0.5}})
end

local function draw_style(ui, view)
  local index = 1
  for i, style in ipairs(styles) do
    if view.display.style == style then index = i end
  end
  ui:width(120 * view.scale)
  local chosen, changed = ui:combo("bodies as", index, styles)
  if changed then view.display.style = chosen > 1 and styles[chosen] or nil end
end

local function draw(ui, view)
  draw_style(ui, view)
  for _, switch in ipairs(switches) do
    local key, label, default = switch[1], switch[2], switch[3]
    local value = view.display[key]
    if value == nil then value = default end
    local on, changed = ui:checkbox(label, value)
    if changed then view.display[key] = on end
  end
  ui:tooltip "A floor lies under the lowest point."
  draw_axes(ui, view)
  draw_wrenches(ui, view)
  draw_boxes(ui, view)
  draw_stereo(ui, view)
end

return {name = "Display", place = "right", tab = true, tall = true, draw = draw}
