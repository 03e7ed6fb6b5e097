--- The tree of the world: robots with their links, objects, obstacles.
local context = require "clench.view.context"
local selection = require "clench.view.selection"
local is_selected = selection.has

local function select(view, ui, thing) selection.click(view, thing, ui:key_down(340) or ui:key_down(344)) end

-- the last item of the selection, if it has just been selected
local function newly_selected(view)
  local list = view.session.selection
  local last = list[#list]
  if last == view.revealed then return nil end
  view.revealed = last
  view.needs_frame = true  -- which shows the scrolled tree
  return last
end

local function leaf(view, ui, body, new, label)
  if ui:tree(label or body.name, {leaf = true, selected = is_selected(view, body)}) then select(view, ui, body) end
  if body == new then ui:reveal() end
  context.of_widget(view, ui, body)
end

local function draw(ui, view)
  local world = view.session.world
  if not world then return ui:text("No world is open.", {color = {0.5, 0.5, 0.5}}) end
  local new = newly_selected(view)
  local owner = new and (clench.type(new) == "robot" and new or new.robot)
  for _, robot in ipairs(world.robots) do
    local is_open = false
    local clicked = ui:tree(robot.name, {selected = is_selected(view, robot), unfold = new ~= nil and owner == robot and new ~= robot}, function(ui)
      is_open = true
      if robot == new then ui:reveal() end
      context.of_widget(view, ui, robot)
      for _, body in ipairs(robot.bodies) do leaf(view, ui, body, new, (body.name:gsub("^" .. robot.name:gsub("%p", "%%%0") .. "_", ""))) end
    end)
    if clicked then select(view, ui, robot) end
    if not is_open and robot == new then ui:reveal() end
    if not is_open then context.of_widget(view, ui, robot) end
  end
  for _, list in ipairs {{"Objects", world.objects, "object"}, {"Obstacles", world.obstacles, "obstacle"}} do
    if #list[2] > 0 then
      ui:tree(list[1], {open = true, unfold = new ~= nil and owner == nil and new.kind == list[3]}, function(ui)
        for _, body in ipairs(list[2]) do leaf(view, ui, body, new) end
      end)
    end
  end
end

return {name = "World", place = "left", draw = draw}
