-- stdlib/in_utf8.lua
--- JSON and pages must be UTF-8: invalid bytes in names and messages are written as \xE9.
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

--- Converts a text, or the texts of a table in place, except keys.
local function in_utf8(value)
  if type(value) == "string" then return utf8.len(value) and value or escape_bytes(value) end
  if type(value) ~= "table" then return value end
  for key, item in pairs(value) do value[key] = in_utf8(item) end
  return value
end

return in_utf8
