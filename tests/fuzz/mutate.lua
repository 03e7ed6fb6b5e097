-- Randomly changed texts: bytes, words, numbers, lines and brackets are exchanged, dropped, doubled, or taken from another text.
local random = math.random
local function one_of(list) return list[random(#list)] end

local pieces = {
  "nan", "inf", "-inf", "1e308", "-1e308", "1e999", "1e-320", "0", "-0", "-1", "1e9", "1e30", "1e200", "2147483648", "-2147483649",
  "4294967296", "9223372036854775808", "99999999999999999999", "0x10", "1.5", "1e", "+", "-", ".", "1,2", "1;2", "{", "}", "[", "]",
  "(", ")", "<", ">", "</", "/>", "\"", "'", "#", "\\", "/", "..", "../..", "&amp;", "&#0;", "&#x110000;", "<!--", "-->", "<![CDATA[",
  "<?xml ?>", "<!DOCTYPE a [<!ENTITY b 'c'>]>&b;", "\0", "\n", "\r", "\r\n", "\t", "\27[2J", "\xff\xfe", "\xef\xbb\xbf", "é", ":",
  ";", ",", "=", "|", "*", "%s%n", "{}", "null", "true", "NULL", "DEF", "USE", "end", "name", ("a"):rep(5000), ("9"):rep(600),
  ("("):rep(2000),
  ("<a>"):rep(500), ("{ "):rep(700), ("1 "):rep(3000), ("[1,"):rep(1500), "/dev/zero", "/etc/passwd", "/proc/self/maps",
}

-- a count or a number of a binary file
local fours = {"\xff\xff\xff\xff", "\0\0\0\0", "\0\0\0\x80", "\xff\xff\xff\x7f", "\0\0\xc0\x7f", "\0\0\x80\x7f"}

local function splice(s, first, last, with) return s:sub(1, first - 1) .. with .. s:sub(last + 1) end

-- first and last character of a word, a number or a line
local function span(s, pattern)
  local from = random(#s)
  local first, last = s:find(pattern, from)
  if not first then first, last = s:find(pattern) end
  return first, last
end

local function any_part(s, most)
  local from = random(#s)
  return s:sub(from, from + random(0, most))
end

local word, number, line = "[^%s%[%]{}<>\"',=]+", "%-?%d[%d.eE+-]*", "[^\n]*\n?"

local changes = {
  function(s) local at = random(#s) return splice(s, at, at, string.char(random(0, 255))) end,
  function(s) local at = random(#s) return splice(s, at, at, string.char(s:byte(at) ~ (1 << random(0, 7)))) end,
  function(s) local at = random(#s) return splice(s, at, at + random(0, 15), "") end,
  function(s) local at = random(#s) return splice(s, at, at - 1, one_of(pieces)) end,
  function(s) local a, b = span(s, word) return a and splice(s, a, b, one_of(pieces)) or s end,
  function(s) local a, b = span(s, word) return a and splice(s, a, b, "") or s end,
  function(s) local a, b = span(s, number) return a and splice(s, a, b, one_of(pieces)) or s end,
  function(s) local a, b = span(s, number) return a and splice(s, a, b, tostring(random(-20, 200))) or s end,
  function(s)
    local a, b = span(s, number)
    return a and splice(s, a, b, ("%.6g"):format((tonumber(s:sub(a, b)) or 1) * 10 ^ random(-20, 20))) or s
  end,
  function(s) local a, b = span(s, word) local c, d = span(s, word) return a and splice(s, a, b, s:sub(c, d)) or s end,
  function(s) local a, b = span(s, line) return splice(s, a, b, "") end,
  function(s) local a, b = span(s, line) return splice(s, a, a - 1, s:sub(a, b)) end,
  function(s) local at = random(#s) return splice(s, at, at - 1, any_part(s, 200)) end,
  function(s, other) local at = random(#s) return splice(s, at, at + random(0, 40), any_part(other, 200)) end,
  function(s, other)
    local a, b = span(s, word)
    local c, d = span(other, word)
    return a and c and splice(s, a, b, other:sub(c, d)) or s
  end,
  function(s) return s:sub(1, random(#s)) end,
  function(s) return s .. any_part(s, 60):rep(random(2, 40)) end,
  function(s) local at = random(#s) return splice(s, at, at + 3, one_of(fours)) end,
}

--- The text after one to five changes; words are taken from `other` too.
---@param s string
---@param other string
---@return string
return function(s, other)
  if other == "" then other = " " end
  for _ = 1, one_of {1, 1, 1, 2, 2, 3, 5} do
    if s ~= "" then s = one_of(changes)(s, other) end
    if #s > 200000 then s = s:sub(1, 200000) end
  end
  return s
end
