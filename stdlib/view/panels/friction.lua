--- Coefficients of static friction of all pairs of materials.
local function draw(ui, view)
  local world = view.session.world
  if not world then return ui:text("No world is open.", {color = {0.5, 0.5, 0.5}}) end
  local names = world.materials
  ui:table("friction", {"a", "b", "static"}, {}, function(ui)
    for i, a in ipairs(names) do
      for j = i, #names do
        local b = names[j]
        local friction = world:friction(a, b)
        ui:next_column() ui:text(a)
        ui:next_column() ui:text(b)
        ui:next_column()
        ui:width(-1)
        local value, _, finished = ui:drag(("##%s %s"):format(a, b), friction.static, {speed = 0.005, min = 0, max = 10, format = "%.3g"})
        if value ~= friction.static then view.friction_edit = {a = a, b = b, mu = value} end
        if finished and view.friction_edit then
          view:run("world.friction", view.friction_edit)
          view.friction_edit = nil
        end
      end
    end
  end)
end

return {name = "Friction", place = "right", tab = true, draw = draw}
