--- Lists of bodies and robots in the form of the text protocol: `ALL`, or a count followed by that number of indices, from 0.
--- A list is not longer than `ALL`, so that a short line cannot request an endless reply.
local lists = {}

---@param kind string  "body" or "robot"
---@param all table[]  the bodies or robots of the world
---@return table[] chosen
---@return string[] reply  for `ALL`: a line with their number
function lists.read(words, kind, all)
  if words:peek() == "ALL" then
    words:next()
    return all, {tostring(#all)}
  end
  local count = words:index("ALL or the number of indices")
  if count > #words - words.at then words.fail("%s: expected %d indices, got %d", words.command, count, #words - words.at) end
  local chosen = {}
  for i = 1, count do
    local index = words:index()
    chosen[i] = all[index + 1] or words.fail("Cannot find %s %d", kind, index)
    if i > #all then words.fail("%s: expected at most %d indices, got %d", words.command, #all, count) end
  end
  return chosen, {}
end

return lists
