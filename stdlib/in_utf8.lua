-- stdlib/in_utf8.lua
--- JSON and pages are UTF-8: bytes of names and messages that are none stand as \xE9.
local function escape_bytes(text)
  local parts, at = {}, 1
  while true do
    local ok, bad = utf8.len(text, at)
    parts[#parts + 1] = text:sub(at, ok and #text or bad - 1)
    if ok then return table.concat(parts) end
    parts[#parts + 1] = ("\\x%02X"):format(text:byte(bad))
    at = bad + 1
  end
end

--- A text, or a table whose texts are changed in place, keys excepted.
local function in_utf8(value)
  if type(value) == "string" then return escape_bytes(value) end
  if type(value) ~= "table" then return value end
  for key, item in pairs(value) do value[key] = in_utf8(item) end
  return value
end

return in_utf8
