--- The text of an error of any type, even if it cannot be printed.
local show = require "clench.show"
local type, pcall, tostring, rawget = type, pcall, tostring, rawget
local getmetatable, format, sub = debug.getmetatable, string.format, string.sub

local longest = 4000  -- maximum length [characters]

local function words_of(value)
  local kind = type(value)
  if kind == "string" then return value end
  if kind == "number" then return tostring(value) end
  local meta = getmetatable(value)
  if type(meta) == "table" and rawget(meta, "__tostring") ~= nil then
    local ok, text = pcall(tostring, value)
    return ok and text or format("error object is a %s whose __tostring fails", kind)
  end
  return kind == "table" and "error object is the table " .. show(value) or format("error object is a %s value", kind)
end

---@param value any
---@return string
return function(value)
  local text = words_of(value)
  if #text <= longest then return text end
  return format("%s... (%d characters)", sub(text, 1, longest), #text)
end
