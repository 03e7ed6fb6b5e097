-- stdlib/raise.lua
local error_value = require "clench.error_value"
local script_line = require "clench.script_line"

-- more is a name or a word that nobody reads to its end
local longest, kept_end = 1000, 250

-- as people read it: no control characters, and of a long text both ends
local function sentence(text)
  text = text:gsub("\0", "\\0"):gsub("%c", "?")
  if #text <= longest then return text end
  local first, last = utf8.offset(text, 0, longest - kept_end - 2), utf8.offset(text, 0, #text - kept_end + 1)
  return text:sub(1, first - 1) .. "..." .. text:sub(last)
end

--- Raises an error that begins with the file and line of the script that called into the standard library.
---@param text string
---@param kind? string  "input", unless given
return function(text, kind)
  error(setmetatable({place = script_line(), sentence = sentence(text), kind = kind or "input"}, error_value), 0)
end
