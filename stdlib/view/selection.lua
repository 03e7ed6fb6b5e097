--- Changes of the selection by clicks in the picture and in the tree: a click selects; with Shift it adds to or removes from the selection.
local contains = require "clench.contains"
local selection = {}

--- Is a body or robot selected?
function selection.has(view, thing) return contains(view.session.selection, thing) end

--- Replaces the selection.
function selection.set(view, things)
  local addresses = {}
  for i, thing in ipairs(things) do addresses[i] = view:address(thing) end
  view:run("world.select", {addresses = addresses})
end

--- A click on a thing.
---@param thing body|robot|nil  nil: a click on nothing, which clears the selection unless `adds`
---@param adds boolean  true: it is added to the selection, or removed if it is selected already
function selection.click(view, thing, adds)
  if not adds then return selection.set(view, {thing}) end
  if not thing then return end
  local list, was_there = {}, false
  for _, other in ipairs(view.session.selection) do
    if other == thing then was_there = true else list[#list + 1] = other end
  end
  if not was_there then list[#list + 1] = thing end
  selection.set(view, list)
end

--- The target of a click on a body in the picture: the body; its robot if the body is selected already.
function selection.meant(view, body)
  if body.robot and view.session.selection[1] == body then return body.robot end
  return body
end

--- The material common to the selection; nil if nothing is selected, or if materials differ.
function selection.material(view)
  local material
  for _, thing in ipairs(view.session.selection) do
    for _, body in ipairs(clench.type(thing) == "robot" and thing.bodies or {thing}) do
      if material and body.material ~= material then return nil end
      material = body.material
    end
  end
  return material
end

--- Draws the choice of material and the switch of collisions, which act on the selection, for the tool bar.
function selection.draw_bar(view, ui)
  local world, list = view.session.world, view.session.selection
  local names, index, current = world.materials, 0, selection.material(view)
  for i, name in ipairs(names) do
    if name == current then index = i end
  end
  ui:disabled(#list == 0, function(ui)
    ui:width(90 * view.scale)
    local chosen, changed = ui:combo("##material", index, names)
    if changed and names[chosen] then view:run("body.material", {material = names[chosen]}) end
  end)
  ui:tooltip "Material of the selection"
  ui:same_line()
  local on = world:may_collide(list[1], #list == 2 and list[2] or nil)
  if ui:button("Collisions", {selected = on}) then view:run "body.collisions" end
  ui:tooltip "Collisions of the selection: of a pair, of each body with everything, or of the complete world"
end

return selection
