--- Quality, contact forces and the effort of each motor over the last changes.
local curves = require "clench.view.curves"
local dof_labels = require "clench.view.dof_labels"

local gray = {0.5, 0.5, 0.5}
-- of the motors, in turn: distinct for the color-blind, on a light and on a dark background
local colors = {{0, 0.45, 0.7}, {0.84, 0.37, 0}, {0, 0.62, 0.45}, {0.8, 0.47, 0.65}, {0.34, 0.71, 0.91}, {0.9, 0.62, 0}, {0.5, 0.5, 0.5}}

local function color_of(i) return colors[(i - 1) % #colors + 1] end

-- the motors whose curves are drawn: all, or the chosen one
local function shown_motors(view, hand)
  local list = {}
  for i = 1, #view.curves.efforts do
    if not view.shown_motor or view.shown_motor == i or view.shown_motor > #hand.dof_names then list[#list + 1] = i end
  end
  return list
end

-- the names of the motors in the colors of their curves, with their last values; a click shows one motor alone, or all again
local function draw_legend(view, ui, hand, height)
  local labels = dof_labels.of(hand)
  ui:child("motors", {height = height}, function(ui)
    for i, values in ipairs(view.curves.efforts) do
      ui:text("–––", {color = color_of(i)})
      ui:same_line(4)
      if ui:selectable(("%.3g  %s##motor%d"):format(values[#values], labels[i].text, i), view.shown_motor == i) then
        view.shown_motor = view.shown_motor ~= i and i or nil
        view.needs_frame = true
      end
      ui:tooltip "A click shows this curve alone, or all of them again."
    end
  end)
end

local function draw_efforts(view, ui, hand, height)
  local values, used = {}, {}
  for n, i in ipairs(shown_motors(view, hand)) do values[n], used[n] = view.curves.efforts[i], color_of(i) end
  ui:curves("##efforts", values, {height = height, colors = used})
end

local function draw_curve(view, ui, curve, height)
  local values = view.curves[curve[1]]
  local last = values[#values]
  ui:group(function(ui)
    ui:text(curve[2] .. (last and ("  %.4g"):format(last) or ""))
    ui:width(170 * view.scale)
    if #values < 2 then
      ui:text("Nothing has moved yet.", {color = gray})
    elseif curve[1] == "effort" then
      draw_efforts(view, ui, view.session.hand, height)
    else
      ui:plot("##" .. curve[1], values, {min = 0, height = height})
    end
  end)
  ui:same_line(16)
end

local function draw(ui, view)
  curves.sample(view)
  local height = 70 * view.scale
  for _, curve in ipairs(curves.list) do draw_curve(view, ui, curve, height) end
  if view.session.hand and #view.curves.effort > 1 then draw_legend(view, ui, view.session.hand, height + ui.line_height) end
end

return {name = "Plots", place = "bottom", draw = draw}
