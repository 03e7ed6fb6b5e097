--- Sliders for the amplitudes of the hand's eigengrasps; a drag is one step of undo.
local function reset(view, hand)
  view.session:begin_gesture("Go To Origin")
  hand:set_dofs(hand.eigengrasps.origin)
  view.session:end_gesture()
  view:changed()
end

local function draw(ui, view)
  local hand = view.session.hand
  if not hand then return ui:text("No hand is current.", {color = {0.5, 0.5, 0.5}}) end
  local set = hand.eigengrasps
  local amplitudes, limits = hand.amplitudes, set.limits
  for i = 1, set.count do
    local low, high = limits[i][1], limits[i][2]
    ui:width(-50)
    local value, changed, finished = ui:slider(("EG %d##eigengrasp"):format(i), amplitudes[i], {min = low, max = high, format = "%.3f"})
    if changed then
      if not view.session.gesture then view.session:begin_gesture("EigenGrasp " .. hand.name) end
      local goal = {}
      for k = 1, set.count do goal[k] = amplitudes[k] end
      goal[i] = value
      hand:set_amplitudes(goal)
      view:changed()
    end
    if finished then view.session:end_gesture() end
  end
  if ui:button "Go To Origin" then reset(view, hand) end
  ui:same_line()
  if ui:button "Close to Contacts" then view:run("grasp.autograsp", {hand = hand.name}) end
end

return {name = "EigenGrasps", place = "right", tab = true, draw = draw}
