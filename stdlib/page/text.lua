--- Text, data and scripts as parts of a page of HTML.
local in_utf8 = require "clench.in_utf8"
local printable = require "clench.printable"
local text = {}

local escapes = {["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;", ['"'] = "&quot;", ["'"] = "&#39;"}
function text.escaped(words) return (printable(in_utf8(words), "\n"):gsub("[&<>\"']", escapes)) end

-- makes the texts of a table printable, in place, except keys
local function shown(value)
  if type(value) == "string" then return printable(value, "\n") end
  if type(value) ~= "table" then return value end
  for key, item in pairs(value) do value[key] = shown(item) end
  return value
end

-- encodes a value as JSON within <script>: nothing in it ends the element or begins a comment
function text.json(value) return (clench.json.encode(shown(in_utf8(value))):gsub("[<>&]", function(c) return ("\\u%04x"):format(c:byte()) end)) end
function text.code(words) return (words:gsub("</([sS][cC][rR][iI][pP][tT])", "<\\/%1"):gsub("<!%-%-", "<\\!--")) end

return text
