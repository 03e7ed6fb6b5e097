--- The tree of the world: robots with their links, objects, obstacles.
local selection = require "clench.view.selection"
local is_selected = selection.has

local function select(view, ui, thing) selection.click(view, thing, ui:key_down(340) or ui:key_down(344)) end

local function leaf(view, ui, body, label)
  if ui:tree(label or body.name, {leaf = true, selected = is_selected(view, body)}) then select(view, ui, body) end
end

local function draw(ui, view)
  local world = view.session.world
  if not world then return ui:text("No world is open.", {color = {0.5, 0.5, 0.5}}) end
  for _, robot in ipairs(world.robots) do
    local clicked = ui:tree(robot.name, {selected = is_selected(view, robot)}, function(ui)
      for _, body in ipairs(robot.bodies) do leaf(view, ui, body, (body.name:gsub("^" .. robot.name:gsub("%p", "%%%0") .. "_", ""))) end
    end)
    if clicked then select(view, ui, robot) end
  end
  for _, list in ipairs {{"Objects", world.objects}, {"Obstacles", world.obstacles}} do
    if #list[2] > 0 then
      ui:tree(list[1], {open = true}, function(ui)
        for _, body in ipairs(list[2]) do leaf(view, ui, body) end
      end)
    end
  end
end

return {name = "World", place = "left", draw = draw}
