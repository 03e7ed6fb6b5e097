-- stdlib/described.lua
--- A value in the form for error messages, on one short line: 3, 'abc', a table of 2, nothing.
local module_name = require "clench.module_name"
local printable = require "clench.printable"

---@param value any
---@return string
return function(value)
  if type(value) == "number" then
    -- integral numbers have no decimal point, whatever their size
    local whole = math.tointeger(value)
    if value ~= value then return "nan" end
    return whole and ("%d"):format(whole) or ("%.10g"):format(value)
  end
  if type(value) == "string" then
    local text = printable(value)
    return #text > 120 and "'" .. text:sub(1, 117) .. "...'" or "'" .. text .. "'"
  end
  if value == nil then return "nothing" end
  if type(value) == "boolean" then return tostring(value) end
  local name = module_name(value)
  if name then return name .. ", whose functions are called with '.' and not ':'" end
  if type(value) == "table" then
    local count = rawlen(value)
    return count > 0 and "a table of " .. count or next(value) ~= nil and "a table with names" or "an empty table"
  end
  local meta = type(value) == "userdata" and debug.getmetatable(value)
  return "a " .. (meta and meta.__name or type(value))
end
