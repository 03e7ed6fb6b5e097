--- Options of the picture: items shown in addition to the bodies, and stereo.
local edit = require "clench.view.edit"
local stereo = require "clench.view.stereo"
local units = require "clench.view.units"

local switches = {
  {"contacts", "friction cones", true}, {"transparent_objects", "transparent objects", true}, {"approach", "approach directions", false},
  {"patches", "patches of soft contacts", false}, {"ground", "floor", true},
}

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

local function draw(ui, view)
  for _, switch in ipairs(switches) do
    local key, label, default = switch[1], switch[2], switch[3]
    local value = view.display[key]
    if value == nil then value = default end
    local on, changed = ui:checkbox(label, value)
    if changed then view.display[key] = on end
  end
  ui:tooltip "A floor lies under the lowest point."
  draw_axes(ui, view)
  draw_stereo(ui, view)
end

return {name = "Display", place = "right", tab = true, tall = true, draw = draw}
