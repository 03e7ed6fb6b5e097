-- stdlib/printable.lua
--- Replaces characters that a terminal or a page would obey by '?': control characters, line separators, and characters that embed, override
--- or isolate the direction of text.
local gsub, find = string.gsub, string.find

---@param text string
---@param kept? string  control characters that stay, such as "\n\t"
---@return string
return function(text, kept)
  text = gsub(text, "%c", function(c) return not (kept and find(kept, c, 1, true)) and "?" or nil end)
  -- U+0080 to U+009F; U+2028 to U+202E; U+2066 to U+2069
  text = gsub(text, "\xC2[\x80-\x9F]", "?")
  text = gsub(text, "\xE2\x80[\xA8-\xAE]", "?")
  return (gsub(text, "\xE2\x81[\xA6-\xA9]", "?"))
end
