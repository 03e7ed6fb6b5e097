--- Body properties of the selection: material, collisions, transparency, mass. Each change is one command for the complete selection.
local edit = require "clench.view.edit"
local script = require "clench.session.script"
local properties = {}

local gray = {0.5, 0.5, 0.5}

-- bodies of the selection; for a robot, all its links
local function bodies_of(selection)
  local list = {}
  for _, thing in ipairs(selection) do
    local parts = clench.type(thing) == "robot" and thing.bodies or {thing}
    table.move(parts, 1, #parts, #list + 1, list)
  end
  return list
end

local function draw_material(view, ui, bodies)
  local names, current = view.session.world.materials, edit.common(bodies, function(body) return body.material end)
  local index
  for i, name in ipairs(names) do
    if name == current then index = i end
  end
  ui:width(-90 * view.scale)
  local chosen, changed = ui:combo("material", index, names)
  ui:tooltip(index and "Material of all that is selected" or "The materials differ: a choice sets all of them.")
  if changed then view:run("body.material", {material = names[chosen]}) end
end

-- are collisions of the selection enabled? If two are selected: with each other
local function collide(world, selection)
  if #selection == 2 then return world:may_collide(selection[1], selection[2]) end
  return edit.common(selection, function(thing) return world:may_collide(thing) end) ~= false
end

local function draw_collisions(view, ui, selection)
  local on, changed = ui:checkbox(#selection == 2 and "collide with each other" or "collisions", collide(view.session.world, selection))
  if changed then view:run("body.collisions", {on = on}) end
end

local function set_transparency(view, bodies, value)
  edit.begin(view, "Transparency", function(session, before)
    -- a planner or a sensor may move bodies meanwhile
    local moved = script.of_change(session, before)
    local lines = {moved ~= "" and moved or nil}
    for _, body in ipairs(bodies) do lines[#lines + 1] = ("%s.transparency = %s"):format(script.name_of(body), script.literal(body.transparency)) end
    return table.concat(lines, "\n")
  end)
  for _, body in ipairs(bodies) do body.transparency = value end
  view.session:emit("changed", {gesture = true})
end

local function draw_transparency(view, ui, bodies)
  local current = edit.common(bodies, function(body) return body.transparency end)
  ui:width(-90 * view.scale)
  local value, changed, finished = ui:slider("transp. [%]", (current or 0) * 100, {min = 0, max = 100, format = "%.0f"})
  if not current then ui:text("The transparencies differ: a value sets all of them.", {color = gray, wrap = true}) end
  if changed then set_transparency(view, bodies, math.max(0, math.min(1, value / 100))) end
  if finished then edit.finish(view) end
end

local function draw_mass(view, ui, bodies)
  local mass = edit.common(bodies, function(body) return body.mass end)
  local key = "mass"
  for _, body in ipairs(bodies) do key = key .. " " .. body.name end
  ui:width(-90 * view.scale)
  local value = edit.number(view, ui, "mass [kg]", key, mass, {speed = 0.005, min = 0, max = 1e6, format = "%.4g"})
  if not mass then ui:text("The masses differ: a value sets all of them.", {color = gray, wrap = true}) end
  if value then view:run("body.mass", {mass = math.max(0, value)}) end
end

-- objects are dynamic, obstacles static; links of robots move with their joints
local function draw_dynamic(view, ui, bodies)
  for _, body in ipairs(bodies) do
    if body.robot then return end
  end
  local kind = edit.common(bodies, function(body) return body.kind end)
  local on, changed = ui:checkbox(kind and "dynamic" or "dynamic (differs)", kind == "object")
  ui:tooltip "On: an object, which moves while dynamics play and can be grasped. Off: an obstacle, which stays where it is.\nbody.kind = \"object\" or \"obstacle\""
  if changed then view:run("body.kind", {kind = on and "object" or "obstacle"}) end
end

--- Draws the properties of the selection.
function properties.draw(view, ui)
  local selection = view.session.selection
  local bodies = bodies_of(selection)
  local kind = edit.common(bodies, function(body) return body.kind end)
  ui:text(("%s%s"):format(kind or "several kinds", #bodies > 1 and (", %d bodies"):format(#bodies) or ""), {color = gray})
  draw_dynamic(view, ui, bodies)
  draw_material(view, ui, bodies)
  draw_mass(view, ui, bodies)
  draw_transparency(view, ui, bodies)
  draw_collisions(view, ui, selection)
end

return properties
