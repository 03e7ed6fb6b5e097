-- stdlib/printable.lua
--- Text from files, such as names, for a terminal or a page: what these would obey rather than show stands as '?'. Control characters,
--- line separators, and characters that embed, override or isolate the direction of text are such.
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
