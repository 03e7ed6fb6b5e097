-- One part of a list of arguments, given as Lua source, replaced by a hostile one.
local random = math.random

-- positions of numbers, strings, tables and names of values; not of names of keys
local function parts(text)
  local list, at = {}, 1
  while at <= #text do
    local rest = text:sub(at)
    local word = rest:match '^"[^"\\]*"' or rest:match "^'[^'\\]*'" or rest:match "^[%a_][%w_.]*" or rest:match "^%-?%.?%d[%w.]*[+-]?%w*"
    local long = rest:match "^:rep%(%d+%)"
    if long then
      -- excludes texts of 2 GB, which the script itself makes
      at = at + #long
    elseif word then
      -- v[3].links[1]
      local more = word:find "^[%a_]" and rest:match("^[%w_.%[%]:]*", #word + 1)
      if more then word = word .. more end
      if not rest:find("^%s*=", #word + 1) then list[#list + 1] = {at, at + #word - 1} end
      at = at + #word
    else
      local inner = rest:match "^%b{}"
      if inner then list[#list + 1] = {at, at + #inner - 1} end
      at = at + 1
    end
  end
  return list
end

local function reads_as_arguments(text) return load("f(" .. text .. ")") end

--- The text with one part replaced, such that it still compiles; the same text if it has no parts.
---@param text string  arguments, as between the brackets of a call, or a text that `compiles` accepts
---@param hostile fun(part: string): string  replacement of a part
---@param compiles? fun(text: string): any  true for text that may be returned; default: lists of arguments
---@return string
return function(text, hostile, compiles)
  compiles = compiles or reads_as_arguments
  local list = parts(text)
  for _ = 1, #list > 0 and 6 or 0 do
    local part = list[random(#list)]
    local spoilt = text:sub(1, part[1] - 1) .. hostile(text:sub(part[1], part[2])) .. text:sub(part[2] + 1)
    if compiles(spoilt) then return spoilt end
  end
  return text
end
