--- The history of the session: a click undoes or redoes all commands up to a step.

-- undoes all later steps; an open playback is ended first and becomes one of them
local function return_to(session, step)
  session:end_gesture()
  local done = session.history.done
  while done[#done] ~= step and session:undo() do end
end

local function draw(ui, view)
  local history = view.session.history
  local count = #history.done
  local chosen, redone  -- a step to return to, or a number of steps to repeat, once the list is drawn: they change it
  for i, step in ipairs(history.done) do
    if ui:selectable(("%d  %s##done%d"):format(i, step.label, i), i == count) then chosen = step end
  end
  for i = #history.undone, 1, -1 do
    if ui:selectable(("%s (undone)##undone%d"):format(history.undone[i].label, i), false) then redone = #history.undone - i + 1 end
  end
  if chosen then return_to(view.session, chosen) end
  for _ = 1, redone or 0 do view.session:redo() end
end

return {name = "History", place = "bottom", draw = draw}
