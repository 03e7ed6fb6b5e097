--- "a.lua:3: ", the innermost line of a script in a suspended or failed coroutine; "" if there is none.
---@param thread thread
---@return string
return function(thread)
  local level = 0
  while true do
    local at = debug.getinfo(thread, level, "Sl")
    if not at then return "" end
    if at.currentline > 0 and at.source:sub(1, 8) ~= "@stdlib/" then return ("%s:%d: "):format(at.short_src, at.currentline) end
    level = level + 1
  end
end
