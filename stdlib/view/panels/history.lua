--- The history of the session: a click undoes or redoes all commands up to a step.
local function draw(ui, view)
  local history = view.session.history
  local count = #history.done
  local undone, redone = 0, 0  -- numbers of steps, once the list is drawn: they change it
  for i, step in ipairs(history.done) do
    if ui:selectable(("%d  %s##done%d"):format(i, step.label, i), i == count) and step.before then undone = count - i end
  end
  for i = #history.undone, 1, -1 do
    if ui:selectable(("%s (undone)##undone%d"):format(history.undone[i].label, i), false) then redone = #history.undone - i + 1 end
  end
  for _ = 1, undone do view.session:undo() end
  for _ = 1, redone do view.session:redo() end
end

return {name = "History", place = "bottom", draw = draw}
