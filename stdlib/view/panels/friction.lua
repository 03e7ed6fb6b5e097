--- Coefficients of static and kinetic friction of all pairs of materials; an edit is one command.
local edit = require "clench.view.edit"

local options = {speed = 0.005, min = 0, max = 10, format = "%.3g"}

local function cell(view, ui, a, b, kind, current)
  ui:next_column()
  ui:width(-1)
  return edit.number(view, ui, ("##%s %s %s"):format(kind, a, b), ("friction %s %s %s"):format(kind, a, b), current, options)
end

local function draw(ui, view)
  local world = view.session.world
  if not world then return ui:text("No world is open.", {color = {0.5, 0.5, 0.5}}) end
  local names = world.materials
  ui:table("friction", {"materials", "static", "kinetic"}, {}, function(ui)
    for i, a in ipairs(names) do
      for j = i, #names do
        local b = names[j]
        local static, kinetic = world:friction(a, b)
        ui:next_column() ui:text(a == b and a or a .. ", " .. b)
        local new_static = cell(view, ui, a, b, "static", static)
        local new_kinetic = cell(view, ui, a, b, "kinetic", kinetic)
        if new_static or new_kinetic then
          view:run("world.friction", {a = a, b = b, mu = math.max(0, new_static or static), kinetic = math.max(0, new_kinetic or kinetic)})
        end
      end
    end
  end)
end

return {name = "Friction", place = "right", tab = true, draw = draw}
