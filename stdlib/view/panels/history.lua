--- The history of the session: a click undoes or redoes all commands up to a step.
local function draw(ui, view)
  local history = view.session.history
  local count = #history.done
  for i, step in ipairs(history.done) do
    if ui:selectable(("%d  %s##done%d"):format(i, step.label, i), i == count) then
      for _ = i + 1, count do if step.before then view.session:undo() end end
    end
  end
  for i = #history.undone, 1, -1 do
    if ui:selectable(("%s (undone)##undone%d"):format(history.undone[i].label, i), false) then
      for _ = i, #history.undone do view.session:redo() end
    end
  end
end

return {name = "History", place = "bottom", draw = draw}
