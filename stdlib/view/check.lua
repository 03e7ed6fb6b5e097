--- Checks of arguments of views and their methods.
local classes = require "clench.classes"
local described = require "clench.described"
local raise = require "clench.raise"
local suggest = require "clench.suggest"
local check = {}

local function expected(subject, name, what, value) raise(("%s: %s: expected %s, got %s"):format(subject, name, what, described(value))) end

--- Finite numbers.
---@param names string  "x y"
function check.numbers(subject, names, ...)
  local i = 0
  for name in names:gmatch "%S+" do
    i = i + 1
    local value = select(i, ...)
    if type(value) ~= "number" or value - value ~= 0 then expected(subject, name, "a finite number", value) end
  end
end

--- A text in UTF-8 that is not empty.
---@param max? integer  length [bytes]
function check.text(subject, name, value, max)
  if type(value) ~= "string" or value == "" or not utf8.len(value) then expected(subject, name, "a text in UTF-8", value) end
  if max and #value > max then expected(subject, name, ("at most %d bytes"):format(max), value) end
end

--- An integer within bounds; nil is allowed.
function check.integer(subject, name, value, min, max)
  if value == nil then return end
  local whole = type(value) == "number" and math.tointeger(value)
  if not whole or whole < min or whole > max then expected(subject, name, ("an integer from %d to %d"):format(min, max), value) end
end

--- A point, as a vector or three numbers.
---@return vec3
function check.point(subject, name, value)
  if clench.type(value) == "vec3" then return value end
  if type(value) ~= "table" or #value ~= 3 then expected(subject, name, "a point", value) end
  check.numbers(subject, name .. "[1] " .. name .. "[2] " .. name .. "[3]", table.unpack(value))
  return clench.vec3(table.unpack(value))
end

--- A table with no other keys than these; without options, an empty one.
---@param known string[]
---@return table
function check.options(subject, options, known)
  if options == nil then return {} end
  if type(options) ~= "table" then raise(("%s: expected a table of options, got %s"):format(subject, described(options))) end
  local is_known = {}
  for _, name in ipairs(known) do is_known[name] = true end
  for key in pairs(options) do
    if not is_known[key] then raise(("%s: unknown key '%s'%s"):format(subject, tostring(key), suggest(tostring(key), known))) end
  end
  return options
end

--- A session of clench.session.
function check.session(subject, value)
  if not classes.session or debug.getmetatable(value) ~= classes.session then expected(subject, "session", "a session", value) end
end

return check
