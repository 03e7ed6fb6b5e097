--- Completion in the console: possible continuations of the name before the cursor, from the live values; keys of options; and in strings names of measures, of
--- bodies and of files.
--- No code of the user runs: tables are read raw, and of userdata only clench's fields are read.
local match, gmatch, gsub, sub, find = string.match, string.gmatch, string.gsub, string.sub, string.find
local rawget, next, type, pcall, tonumber, sort, unpack = rawget, next, type, pcall, tonumber, table.sort, table.unpack
local getmetatable, globals, string_library = debug.getmetatable, _G, string
local entries, measures, pairs, ipairs = clench.entries, clench.measures, pairs, ipairs
local doc, session, packed_docs = require "clench.host.doc", require "clench.host.session", require "clench.signature.packed_docs"

local keywords = {"and", "break", "do", "else", "elseif", "end", "false", "for", "function", "goto", "if", "in", "local",
                  "nil", "not", "or", "repeat", "return", "then", "true", "until", "while"}

local about -- descriptions of clench's entries, loaded on first use
local function described()
  if about then return about end
  about = {classes = {}, libraries = {}, modules = {}, called = {}}
  local all = entries()
  local function add_called(name, entry)
    about.called[name] = about.called[name] or {}
    about.called[name][#about.called[name] + 1] = entry
  end
  for _, class in ipairs(all.classes) do
    about.classes[class.name] = class
    for _, method in ipairs(class.methods) do add_called(method.name, method) end
  end
  for _, entry in ipairs(packed_docs.functions(all.files)) do add_called(match(entry.name, "[%w_]+$"), entry) end
  for _, library in ipairs(all.libraries) do
    local fields = about.libraries[library.name] or {}
    about.libraries[library.name] = fields
    for _, field in ipairs(library.fields) do fields[field.name] = true end
    for _, entry in ipairs(library.functions) do add_called(entry.name, entry) end
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

-- visits the fields and methods of a class and of its parents
local function each_member(class, visit)
  while class do
    for _, field in ipairs(class.fields) do visit(field.name, true, field) end
    for _, method in ipairs(class.methods) do visit(method.name, false, method) end
    class = class.parent and described().classes[class.parent]
  end
end

-- value[key], without running code of the user; nil if there is no such value
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

-- adds the names that may follow "value." or "value:"
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
      -- a module of clench that loads its parts lists them on request
      if rawget(meta, "__pairs") then pcall(function() for key in pairs(value) do add(key) end end) end
    end
  end
end

local scope -- names that the caller's lines see before the globals, instead of the session's locals; nil: none

-- calls visit(name, value) for each name that is not global
local function each_local(visit)
  if not scope then return session.each(visit) end
  for name, value in next, scope do visit(name, value) end
end

-- the value of a path such as "world.robots[1]"; nil if there is none
local function resolve(path)
  local first, rest = match(path, "^([%a_][%w_]*)(.*)$")
  if not first then return nil end
  local value = rawget(globals, first)
  each_local(function(name, kept) if name == first then value = kept end end)
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

-- open items at the end of a line: the position of an open string, and the open brackets, each {mark, position}
local function open_at_end(line)
  local quote, from, brackets, at = nil, nil, {}, 1
  while at <= #line do
    local mark = sub(line, at, at)
    if quote then
      if mark == "\\" then at = at + 1 elseif mark == quote then quote = nil end
    elseif find(mark, "[\"']") then
      quote, from = mark, at
    elseif find(line, "^%-%-", at) then
      break
    elseif find(mark, "[({%[]") then
      brackets[#brackets + 1] = {mark, at}
    elseif find(mark, "[)}%]]") then
      brackets[#brackets] = nil
    end
    at = at + 1
  end
  return quote and from, brackets
end

-- the call whose argument begins at the end of a text, as in "world:body " or "f(x, ": base, name
local function call_before(text, brackets)
  local path = match(text, "([%a_][%w_%.:%[%]]*)%s*%(?%s*$")
  if not path and #brackets > 0 and brackets[#brackets][1] == "(" then
    path = match(sub(text, 1, brackets[#brackets][2] - 1), "([%a_][%w_%.:%[%]]*)%s*$")
  end
  if path then return match(path, "^(.-)[.:]?([%w_]+)$") end
end

-- adds possible values of a field, as in "mug.material = ": the words of its type, and the materials of its world
local function add_values_of(text, add)
  local base, name = match(text, "([%a_][%w_%.%[%]]*)%.([%a_][%w_]*)%s*=%s*$")
  local owner = base and resolve(base)
  if owner == nil then return false end
  if name == "material" then
    local world = get(owner, "world")
    for _, material in ipairs(world and get(world, "materials") or {}) do add(material) end
    return true
  end
  local found = false
  each_member(described().classes[name_of(owner)], function(field, is_field, entry)
    if not is_field or field ~= name then return end
    for word in gmatch(doc.parse(entry.doc).type.type, '"([^"]*)"') do
      add(word)
      found = true
    end
  end)
  return found
end

local lists = {body = "bodies", robot = "robots", link = "links"} -- the list that contains the name, by method

-- adds possible names for a string; returns false if the string is a file name
local function string_words(text, from, brackets, add)
  if add_values_of(sub(text, 1, from - 1), add) then return true end
  local base, name = call_before(sub(text, 1, from - 1), brackets)
  if name == "quality" then
    for _, measure in ipairs(measures()) do add(measure.name) end
  elseif name == "help" then
    for called in next, described().called do add(called) end
  elseif lists[name] then
    for _, item in ipairs(get(resolve(base), lists[name]) or {}) do add(item.name) end
  elseif name == "set_keyframe" then
    for _, keyframe in ipairs(get(resolve(base), "keyframes") or {}) do add(keyframe) end
  else
    return false
  end
  return true
end

-- adds keys of the options of a function, by its doc; if it takes values of DOFs by name, also the names of `owner`'s DOFs
local function add_keys_of(name, owner, add)
  for _, entry in ipairs(described().called[name] or {}) do
    for _, param in ipairs(doc.parse(entry.doc).params) do
      if find(param.type, "table<string, number>", 1, true) then
        for _, dof in ipairs(get(owner, "dof_names") or {}) do add(dof) end
      end
      for options in gmatch(param.type, "%b{}") do
        for key in gmatch(gsub(sub(options, 2, -2), "%b{}", ""), "([%a_][%w_]*)%??:") do add(key) end
      end
    end
  end
end

local function words_of(line)
  local from, brackets = open_at_end(line)
  if from then
    local typed, seen, words = sub(line, from + 1), {}, {}
    local known = string_words(line, from, brackets, function(word)
      if not seen[word] and sub(word, 1, #typed) == typed then words[#words + 1] = word end
      seen[word] = true
    end)
    if not known then return "\1" .. typed end
    sort(words)
    return typed, unpack(words)
  end
  local path = match(line, "[%a_][%w_%.:%[%]]*$") or ""
  local before = sub(line, -#path - 1, -#path - 1)
  if before == "." or before == ":" then return "" end -- the value is known only by running the line
  local base, mark, typed = match(path, "^(.*)([.:])([%w_]*)$")
  if not mark then typed = path end
  local seen, words = {}, {}
  local function add(word)
    if not seen[word] and sub(word, 1, #typed) == typed and find(word, "^[%a_][%w_]*$") then
      seen[word] = true
      words[#words + 1] = word
    end
  end
  local innermost = brackets[#brackets]
  if mark then
    local value = resolve(base)
    if value ~= nil then add_members(value, mark == ":", add) end
  elseif innermost and innermost[1] == "{" and find(line, "[{,;]%s*[%w_]*$") then
    brackets[#brackets] = nil
    local base, name = call_before(sub(line, 1, innermost[2] - 1), brackets)
    add_keys_of(name, base and resolve(base), add)
  end
  if not mark and #words == 0 then
    each_local(add)
    for key in next, globals do if type(key) == "string" then add(key) end end
    for _, keyword in ipairs(keywords) do add(keyword) end
  end
  sort(words)
  return typed, unpack(words)
end

local complete = {}

--- returns the typed word, then its possible completions, sorted; or "\1" and the beginning of a file name
---@param line string  up to the cursor
---@param names? table<string, any>  what the line sees before the globals; by default the locals of the console's session
function complete.words(line, names)
  scope = names
  return words_of(line)
end

return complete
