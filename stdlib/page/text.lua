--- Words, data and scripts as parts of a page of HTML.
local in_utf8 = require "clench.in_utf8"
local text = {}

local escapes = {["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;", ['"'] = "&quot;", ["'"] = "&#39;"}
function text.escaped(words) return (in_utf8(words):gsub("[&<>\"']", escapes):gsub("[%c]", function(c) return c == "\n" and c or " " end)) end

-- what a text is within <script>: nothing in it ends the element or begins a comment
function text.json(value) return (clench.json.encode(in_utf8(value)):gsub("[<>&]", function(c) return ("\\u%04x"):format(c:byte()) end)) end
function text.code(words) return (words:gsub("</([sS][cC][rR][iI][pP][tT])", "<\\/%1"):gsub("<!%-%-", "<\\!--")) end

return text
