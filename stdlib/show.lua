--- Converts a value to text for readers: tables with their contents, sorted by keys, up to five levels deep.
---@param value any
---@param width? integer  approximate number of characters, 400 by default; omitted items are counted
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

-- does a table have a text from __tostring? Lists of clench, which have __contents, are shown here
local function has_own_text(value)
  local meta = getmetatable(value)
  return type(meta) == "table" and rawget(meta, "__tostring") ~= nil and rawget(meta, "__contents") == nil
end

-- the contents of a library of clench; any other table is shown raw, and none of its code runs
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
