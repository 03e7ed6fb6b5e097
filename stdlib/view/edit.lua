--- Widgets whose value becomes a command at the end of an edit; until then it is stored separately from the world.
local edit = {}

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
