--- The label of a widget for a text of any bytes: control characters and invalid UTF-8 are escaped, and "##", after which Dear ImGui shows nothing, is separated by spaces.
local in_utf8 = require "clench.in_utf8"
local printable = require "clench.printable"

---@param text string
---@param id string  distinguishes widgets of one text
---@return string
return function(text, id)
  local shown = printable(in_utf8(text)):gsub("##+", function(signs) return ("#"):rep(#signs, " ") end):gsub("#$", "# ")
  return ("%s##%s"):format(shown, id)
end
