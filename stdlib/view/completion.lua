--- Tab in the console: completes the name before the cursor, and lists the possible continuations if there are several.
local completion = {}

local max_listed = 100  -- continuations in a list

-- the longest common beginning of words
local function common(words)
  local first, length = words[1], #words[1]
  for _, word in ipairs(words) do
    while word:sub(1, length) ~= first:sub(1, length) do length = length - 1 end
  end
  -- a character of UTF-8 is not cut
  while length > 0 and (first:byte(length + 1) or 0) & 0xC0 == 0x80 do length = length - 1 end
  return first:sub(1, length)
end

-- files that come with Clench, and recent ones, whose paths have this beginning
local function files(view, typed)
  local list, seen = {}, {}
  local function add(path)
    if path:sub(1, #typed) == typed and not seen[path] then seen[path], list[#list + 1] = true, path end
  end
  view.catalog = view.catalog or clench.catalog()
  for _, paths in pairs(view.catalog) do
    for _, path in ipairs(paths) do add(path) end
  end
  for _, path in ipairs(view.recent) do add(path) end
  table.sort(list)
  return list
end

local function list(view, words)
  local more = #words > max_listed and ("  and %d more"):format(#words - max_listed) or ""
  view:print(table.concat(words, "  ", 1, math.min(#words, max_listed)) .. more, "input")
  view.needs_frame = true
end

--- The text that Tab inserts at the cursor.
---@param view table  its field `complete` finds the continuations: that of the console of Clench
---@param before string  the line before the cursor
---@param names table<string, any>  what the line sees before the globals of Lua
---@return string
function completion.of(view, before, names)
  if not view.complete then return "" end
  local words = table.pack(view.complete(before, names))
  local typed = table.remove(words, 1)
  if typed:sub(1, 1) == "\1" then
    typed = typed:sub(2)
    words = files(view, typed)
  end
  if #words == 0 then return "" end
  if #words > 1 then list(view, words) end
  return common(words):sub(#typed + 1)
end

return completion
