--- Completion in the console: what the name before the cursor may become, from the live values it is looked up in.
--- Nothing of the user's runs: tables are read raw, and of userdata only clench's own fields are asked.
local match, sub, find = string.match, string.sub, string.find
local rawget, next, type, pcall, tonumber, sort, unpack = rawget, next, type, pcall, tonumber, table.sort, table.unpack
local getmetatable, globals, string_library = debug.getmetatable, _G, string
local entries, pairs, ipairs = clench.entries, pairs, ipairs

local keywords = {"and", "break", "do", "else", "elseif", "end", "false", "for", "function", "goto", "if", "in", "local",
                  "nil", "not", "or", "repeat", "return", "then", "true", "until", "while"}

local about -- what clench says of itself, asked when first needed
local function described()
  if about then return about end
  about = {classes = {}, libraries = {}, modules = {}}
  local all = entries()
  for _, class in ipairs(all.classes) do about.classes[class.name] = class end
  for _, library in ipairs(all.libraries) do
    local fields = about.libraries[library.name] or {}
    about.libraries[library.name] = fields
    for _, field in ipairs(library.fields) do fields[field.name] = true end
  end
  for _, file in ipairs(all.files) do
    local module = match(file.path, "^([%w_]+)/init%.lua$") or match(file.path, "^([%w_]+)%.lua$")
    if module then about.modules[module] = true end
  end
  return about
end

local function name_of(value)
  local meta = getmetatable(value)
  local name = type(meta) == "table" and rawget(meta, "__name")
  return type(name) == "string" and name or nil, type(meta) == "table" and meta or nil
end

-- visits a class's fields and methods, its parents' too
local function each_member(class, visit)
  while class do
    for _, field in ipairs(class.fields) do visit(field.name, true) end
    for _, method in ipairs(class.methods) do visit(method.name, false) end
    class = class.parent and described().classes[class.parent]
  end
end

-- value[key], without running a stranger's code; nil when there is no such thing
local function get(value, key)
  local name, meta = name_of(value)
  if type(value) == "table" then
    local found = rawget(value, key)
    if found ~= nil then return found end
    if name and find(name, "^clench") then
      local ok, member = pcall(function() return value[key] end)
      return ok and member or nil
    end
    local index = meta and rawget(meta, "__index")
    if type(index) == "table" then return rawget(index, key) end
  elseif type(value) == "userdata" then
    local known = false
    each_member(described().classes[name], function(field, is_field) known = known or is_field and field == key end)
    if not known then return nil end
    local ok, member = pcall(function() return value[key] end)
    return ok and member or nil
  end
end

-- adds the names that may follow value. or value:
local function add_members(value, calls, add)
  local name, meta = name_of(value)
  if type(value) == "string" then
    if calls then for key in next, string_library do add(key) end end
  elseif type(value) == "userdata" then
    each_member(described().classes[name], function(key, is_field) if is_field ~= calls then add(key) end end)
  elseif type(value) == "table" then
    local function add_keys(from)
      for key, item in next, from do
        if type(key) == "string" and (not calls or type(item) == "function") then add(key) end
      end
    end
    add_keys(value)
    local index = meta and rawget(meta, "__index")
    if type(index) == "table" then add_keys(index) end
    if not calls and name and find(name, "^clench") then
      for key in next, described().libraries[name] or {} do add(key) end
      if name == "clench" then for key in next, described().modules do add(key) end end
      -- a module of ours that loads its parts lists them when asked
      if rawget(meta, "__pairs") then pcall(function() for key in pairs(value) do add(key) end end) end
    end
  end
end

-- the value that "world.robots[1]" is; nil when it is none
local function resolve(path)
  local first, rest = match(path, "^([%a_][%w_]*)(.*)$")
  if not first then return nil end
  local value = rawget(globals, first)
  while rest ~= "" and value ~= nil do
    local key, left = match(rest, "^%.([%a_][%w_]*)(.*)$")
    if not key then
      local index
      index, left = match(rest, "^%[(%d+)%](.*)$")
      key = tonumber(index)
      if not key then return nil end
    end
    value, rest = get(value, key), left
  end
  return value
end

local complete = {}

--- returns the word as it is typed, then what it may become, sorted
---@param line string  up to the cursor
function complete.words(line)
  local path = match(line, "[%a_][%w_%.:%[%]]*$") or ""
  local before = sub(line, -#path - 1, -#path - 1)
  if before == "." or before == ":" then return "" end -- of a value that only running the line could tell
  local base, mark, typed = match(path, "^(.*)([.:])([%w_]*)$")
  if not mark then typed = path end
  local seen, words = {}, {}
  local function add(word)
    if not seen[word] and sub(word, 1, #typed) == typed and find(word, "^[%a_][%w_]*$") then
      seen[word] = true
      words[#words + 1] = word
    end
  end
  if mark then
    local value = resolve(base)
    if value ~= nil then add_members(value, mark == ":", add) end
  else
    for key in next, globals do if type(key) == "string" then add(key) end end
    for _, keyword in ipairs(keywords) do add(keyword) end
  end
  sort(words)
  return typed, unpack(words)
end

return complete
