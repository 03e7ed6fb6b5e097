--- Edits by widgets. The value of some becomes a command at the end of the edit, and until then is stored separately from the world; others change the world while they are dragged.
local edit = {}

--- Begins the gesture of a widget that changes the world, unless it is open. Any other open gesture, such as a playback, is ended.
---@param label string  label of the undo step
---@param lines? fun(session: table, before: table): string  as of session:begin_gesture
function edit.begin(view, label, lines)
  local own = view.edit_gesture
  if own and own.label == label and own.gesture == view.session.gesture then return end
  view.edit_gesture = {label = label, gesture = view.session:begin_gesture(label, lines)}
end

--- Ends a gesture, if it is still open. A change that cannot be logged, such as a removal by a script, is reverted, and the error is shown.
function edit.end_gesture(view, gesture)
  local ok, problem = pcall(view.session.end_gesture, view.session, gesture)
  if not ok then view:fail(problem) end
end

--- Ends the gesture of a widget, if it is still open.
function edit.finish(view)
  local own = view.edit_gesture
  view.edit_gesture = nil
  if own then edit.end_gesture(view, own.gesture) end
end

--- At the end of a frame: ends the gesture of a widget that has vanished while it was dragged.
function edit.check_release(view)
  if view.ui.mouse.left.released then edit.finish(view) end
end

--- A number that is dragged or typed.
---@param key string  identifies the value from frame to frame
---@param current number?  value in the world; nil: values differ
---@param options {speed?: number, min?: number, max?: number, format?: string}
---@return number? value  when the edit has finished
function edit.number(view, ui, label, key, current, options)
  local kept = view.edits[key]
  local shown = kept or current or 0
  local value, changed, finished = ui:drag(label, shown, options)
  if changed then view.edits[key] = value end
  if not finished or view.edits[key] == nil then return nil end
  value, view.edits[key] = view.edits[key], nil
  return value
end

--- The value common to all items of a list; nil if they differ.
---@param f fun(thing: any): any
function edit.common(list, f)
  local first = list[1] and f(list[1])
  for i = 2, #list do
    if f(list[i]) ~= first then return nil end
  end
  return first
end

return edit
