--- Measures of the current grasp, computed again when something has moved.
local function refresh(view)
  local session = view.session
  if not (session.hand and session.object) then return nil end
  local contacts = session.world:contacts(session.hand, session.object)
  if #contacts == 0 then return {contacts = contacts} end
  local ok, measures = pcall(function()
    local grasp = clench.grasp(session.hand, session.object)
    return {epsilon = grasp:quality "epsilon", volume = grasp:quality "volume"}
  end)
  return {contacts = contacts, measures = ok and measures or nil, error = not ok and tostring(measures) or nil}
end

local function draw(ui, view)
  local session = view.session
  if view.quality_stamp ~= view.stamp then view.quality, view.quality_stamp = refresh(view), view.stamp end
  local quality = view.quality
  if not quality then return ui:text("A hand and an object are needed.", {color = {0.5, 0.5, 0.5}}) end
  ui:text(("%s on %s"):format(session.hand.name, session.object.name))
  if quality.measures then
    ui:text(("epsilon  %.4f"):format(quality.measures.epsilon))
    ui:text(("volume   %.4f"):format(quality.measures.volume))
  elseif quality.error then
    ui:text(quality.error, {wrap = true})
  end
  ui:separator()
  ui:text(("%d contacts"):format(#quality.contacts))
  for i, contact in ipairs(quality.contacts) do
    local force = contact.force
    local text = force and ("%d  %s  %.2f N"):format(i, contact.link and contact.link.name or "", force:norm()) or ("%d"):format(i)
    if ui:selectable(text .. "##contact" .. i, view.highlighted == i) then view.highlighted = view.highlighted ~= i and i or nil end
  end
end

return {name = "Grasp Quality", place = "left", draw = draw}
