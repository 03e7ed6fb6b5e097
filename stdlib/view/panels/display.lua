--- Options of the picture: items shown in addition to the bodies.
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
end

return {name = "Display", place = "right", tab = true, draw = draw}
