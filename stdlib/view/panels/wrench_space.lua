--- The wrench space of the current grasp, projected to three of its coordinates.
local coordinates = {"fx", "fy", "fz", "tx", "ty", "tz"}

local function picture_of(view, fixed, size)
  local session = view.session
  local grasp = clench.grasp(session.hand, session.object)
  local projection = grasp:wrench_space {norm = view.wrench_norm}:project {fixed = fixed}
  return projection:render {size = {size, size}, quality = "draft"}
end

local function key_of(view, fixed)
  local parts = {tostring(view.stamp), view.wrench_norm}
  for _, name in ipairs(coordinates) do parts[#parts + 1] = fixed[name] and name .. fixed[name] or "" end
  return table.concat(parts, " ")
end

local function draw(ui, view)
  local session = view.session
  if not (session.hand and session.object) then return ui:text("A hand and an object are needed.", {color = {0.5, 0.5, 0.5}}) end
  if #session.world:contacts(session.hand, session.object) == 0 then
    return ui:text("The hand does not touch the object, so there is no wrench space.", {color = {0.5, 0.5, 0.5}, wrap = true})
  end
  view.wrench_fixed = view.wrench_fixed or {tx = 0, ty = 0, tz = 0}
  view.wrench_norm = view.wrench_norm or "L1"
  local count = 0
  for i, name in ipairs(coordinates) do
    local on, changed = ui:checkbox(name, view.wrench_fixed[name] ~= nil)
    if changed then view.wrench_fixed[name] = on and 0 or nil end
    if view.wrench_fixed[name] then count = count + 1 end
    if i % 3 ~= 0 then ui:same_line() end
  end
  ui:tooltip "Coordinates that are held at 0; three must be left."
  for _, norm in ipairs {"L1", "Linf"} do
    if ui:radio(norm .. "##norm", view.wrench_norm == norm) then view.wrench_norm = norm end
    ui:same_line()
  end
  ui:spacing()
  if count ~= 3 then return ui:text("Fix exactly three coordinates.") end
  local key = key_of(view, view.wrench_fixed)
  if view.wrench_key ~= key then
    view.wrench_key = key
    local ok, picture = pcall(picture_of, view, view.wrench_fixed, 200)
    view.wrench_picture, view.wrench_error = ok and picture or nil, not ok and tostring(picture):gsub("^.-%.lua:%d+: ", "") or nil
    view.wrench_changed = true
  end
  if view.wrench_picture then
    ui:image("wrench space", view.wrench_picture, {width = 200, height = 200, changed = view.wrench_changed})
    view.wrench_changed = false
  else
    ui:text(view.wrench_error, {wrap = true})
  end
end

return {name = "Wrench Space", place = "right", tab = true, draw = draw}
