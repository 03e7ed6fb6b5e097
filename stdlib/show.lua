--- A value as text for people: tables with their contents, keys sorted, a few levels deep.
---@param value any
---@param width? integer  about how many characters, default 400; what does not fit is counted
---@return string
local type, tostring, next, rawlen, rawget = type, tostring, next, rawlen, rawget
local getmetatable, format, find, concat, sort = debug.getmetatable, string.format, string.find, table.concat, table.sort
local printable = require "clench.printable"
local pcall, tointeger, max = pcall, math.tointeger, math.max

local function text_of(value)
  local ok, text = pcall(tostring, value)
  return ok and text or format("<%s whose text fails: %s>", type(value), text)
end

-- by type, then by value
local function before(a, b)
  local ta, tb = type(a), type(b)
  if ta ~= tb then return ta < tb end
  if ta == "number" or ta == "string" then return a < b end
  return text_of(a) < text_of(b)
end

local function name_of(key)
  if type(key) == "string" and find(key, "^[%a_][%w_]*$") then return key end
  return "[" .. (type(key) == "string" and format("%q", key) or text_of(key)) .. "]"
end

local show

-- a table says its own text if it has one, except for lists that ask us
local function has_own_text(value)
  local meta = getmetatable(value)
  return type(meta) == "table" and rawget(meta, "__tostring") ~= nil and rawget(meta, "__contents") == nil
end

-- what a library of clench reads from; any other table is shown as it is, and none of its code runs
local function contents_of(value)
  local meta = getmetatable(value)
  local name = type(meta) == "table" and rawget(meta, "__name")
  local index = type(name) == "string" and find(name, "^clench") and rawget(meta, "__index")
  return type(index) == "table" and index or value
end

local function show_table(value, width, depth, path)
  value = contents_of(value)
  if path[value] then return "<itself>" end
  if depth >= 5 then return "{...}" end
  path[value] = true
  local parts, used, left = {}, 0, 0
  local function add(text)
    parts[#parts + 1] = text
    used = used + #text + 2
  end
  local size = rawlen(value)
  for i = 1, size do
    if used > width then left = left + size - i + 1 break end
    add(show(rawget(value, i), width - used, depth + 1, path))
  end
  local keys = {}
  for key in next, value do
    local i = type(key) == "number" and tointeger(key)
    if not (i and i >= 1 and i <= size) then keys[#keys + 1] = key end
  end
  sort(keys, before)
  for i, key in next, keys do
    if used > width then left = left + #keys - i + 1 break end
    add(name_of(key) .. " = " .. show(rawget(value, key), width - used, depth + 1, path))
  end
  path[value] = nil
  if left > 0 then add("... " .. left .. " more") end
  return "{" .. concat(parts, ", ") .. "}"
end

function show(value, width, depth, path)
  local kind = type(value)
  if kind == "string" then return depth > 0 and format("%q", value):gsub("\\\n", "\\n") .. "" or value end
  if kind == "table" and not has_own_text(value) then return show_table(value, max(width, 8), depth, path) end
  return text_of(value)
end

return function(value, width) return printable(show(value, width or 400, 0, {}), "\n\t") end
