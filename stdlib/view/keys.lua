--- Names of keys, as in shortcuts ("ctrl+g"), and their codes in GLFW.
local raise = require "clench.raise"
local keys = {}

local codes = {
  space = 32, ["'"] = 39, [","] = 44, ["-"] = 45, ["."] = 46, ["/"] = 47, [";"] = 59, ["="] = 61, ["["] = 91, ["\\"] = 92, ["]"] = 93, ["`"] = 96, ["+"] = 334,
  escape = 256, enter = 257, tab = 258, backspace = 259, insert = 260, delete = 261, right = 262, left = 263, down = 264, up = 265,
  pageup = 266, pagedown = 267, home = 268, ["end"] = 269,
}
for i = 0, 9 do codes[tostring(i)] = 48 + i end
for i = 0, 25 do codes[string.char(97 + i)] = 65 + i end
for i = 1, 12 do codes["f" .. i] = 289 + i end
local names = {}
for name, code in pairs(codes) do names[code] = name end
names[333] = "-"  -- of the numeric keypad

keys.modifiers = {ctrl = 341, alt = 342, shift = 340}

--- The codes of a shortcut: its modifiers, then its key.
---@param shortcut string  "ctrl+shift+z"
---@return integer[] codes
function keys.codes(shortcut)
  local list = {}
  local rest = shortcut
  for modifier in shortcut:gmatch "(%l+)%+" do
    list[#list + 1] = keys.modifiers[modifier] or raise(("view: unknown modifier '%s' in '%s'"):format(modifier, shortcut))
    rest = rest:sub(#modifier + 2)
  end
  list[#list + 1] = codes[rest] or raise(("view: unknown key '%s'"):format(rest))
  return list
end

--- A shortcut as pressed keys spell it, with its modifiers in order; raises an error if it is invalid.
---@param shortcut string  "shift+ctrl+z"
---@return string  "ctrl+shift+z"
function keys.normal(shortcut)
  local press = {}
  for _, code in ipairs(keys.codes(shortcut)) do
    local is_modifier = false
    for name, held in pairs(keys.modifiers) do
      if code == held then press[name], is_modifier = true, true end
    end
    if not is_modifier then press.key = code end
  end
  return keys.shortcut(press)
end

--- The shortcut of a pressed key: "ctrl+g"; nil for keys without a name.
---@param press table  one of ui.pressed
function keys.shortcut(press)
  local name, shift = names[press.key], press.shift
  if not name then return nil end
  if name == "=" and shift then name, shift = "+", false end
  return (press.ctrl and "ctrl+" or "") .. (press.alt and "alt+" or "") .. (shift and "shift+" or "") .. name
end

--- A shortcut for display: "Ctrl+Shift+Z".
function keys.shown(shortcut)
  if shortcut == "shift+/" then return "?" end
  return shortcut and (shortcut:gsub("(%l)(%l*)", function(first, rest) return first:upper() .. rest end)) or ""
end

return keys
