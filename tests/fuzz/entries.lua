-- All callable entries: every function, method, field, setter and operator of the bindings' own tables and of the packed standard library, with the
-- types from their docs, and the keys of the tables that they take.
local here = debug.getinfo(1, "S").source:match "^@(.*/)" or ""
local parse_type = dofile(here .. "types.lua")
local known = dofile(here .. "known.lua")
local examples = dofile(here .. "examples.lua")
local doc = require "clench.host.doc"
local packed_docs = require "clench.signature.packed_docs"

-- a text that identifies a type, for fields with equal contents
local function key_of(kind)
  if kind.kind == "list" then return key_of(kind.of) .. "[]" end
  if kind.kind == "record" then
    local names = {}
    for i, field in ipairs(kind.fields) do names[i] = field.name or "" end
    return "{" .. table.concat(names, " ") .. "}"
  end
  return kind.name or kind.kind
end

-- the names of all fields of the records in a type
local function add_keys(kind, keys)
  if kind.kind == "list" or kind.kind == "map" then add_keys(kind.of, keys) end
  if kind.kind == "union" then
    for _, one in ipairs(kind.of) do add_keys(one, keys) end
  elseif kind.kind == "record" then
    for _, field in ipairs(kind.fields) do
      if field.name and not keys[field.name] then
        keys[field.name] = true
        keys[#keys + 1] = field.name
      end
      add_keys(field.type, keys)
    end
  end
end

-- quoted words in a doc: the words that the entry accepts
local function words_of(text)
  local words = {}
  for word in text:gmatch '"([^"\n]+)"' do words[#words + 1] = word end
  return words
end

local function parameters(step, text)
  local list = {}
  for i, param in ipairs(doc.parse(text).params) do
    local name, optional = param.name:gsub("%?$", "")
    if name == "path" and (step.name:find "save" or step.name:find "write" or step.name:find "append") then name = "to" end
    list[i] = {name = name, optional = optional > 0, type = parse_type(known.types[step.entry .. " " .. name] or param.type)}
    add_keys(list[i].type, step.keys)
  end
  return list
end

local function read(all)
  local api = {functions = {}, methods = {}, fields = {}, setters = {}, operators = {}, examples = {}, classes = {}, parents = {},
               words = {}, types = {}, fields_by_type = {}, key = key_of}

  local function add_examples(step, text)
    local steps = examples.steps(step, text)
    table.move(steps, 1, #steps, #api.examples + 1, api.examples)
  end

  -- `entry` is the name under which coverage is counted
  local function step(name, entry, class, text)
    local made = {name = name, entry = entry, class = class, words = words_of(text), keys = {}}
    made.params = parameters(made, text)
    table.move(made.words, 1, #made.words, #api.words + 1, api.words)
    for _, param in ipairs(made.params) do table.insert(api.types, param.type) end
    add_examples(made, text)
    return made
  end

  local function add_field(class, entry)
    local kind = parse_type(known.types[class.name .. "." .. entry.name] or doc.parse(entry.doc).type.type)
    local field = {name = entry.name, entry = class.name .. "." .. entry.name, class = class.name, type = kind, keys = {},
                   words = words_of(entry.doc)}
    table.insert(api.fields, field)
    add_examples(field, entry.doc)
    local same = api.fields_by_type[key_of(kind)] or {}
    api.fields_by_type[key_of(kind)] = same
    table.insert(same, field)
    if not entry.settable then return end
    local setter = setmetatable({entry = field.entry .. " =", keys = {}}, {__index = field})
    add_keys(kind, setter.keys)
    table.insert(api.setters, setter)
  end

  for _, library in ipairs(all.libraries) do
    for _, entry in ipairs(library.functions) do
      local name = library.name .. "." .. entry.name
      table.insert(api.functions, step(name, name, nil, entry.doc))
    end
    for _, entry in ipairs(library.fields) do
      table.insert(api.functions, {name = library.name .. "." .. entry.name, entry = library.name .. "." .. entry.name,
                                   constant = true, keys = {}})
    end
  end
  local packed = {}
  for _, entry in ipairs(packed_docs.functions(all.files)) do packed["clench." .. entry.name] = entry.doc end
  for name, text in pairs(known.packed) do packed[name] = packed[name] or text end
  local names = {}
  for name in pairs(packed) do names[#names + 1] = name end
  table.sort(names)
  for _, name in ipairs(names) do table.insert(api.functions, step(name, name, nil, packed[name])) end

  for _, class in ipairs(all.classes) do
    table.insert(api.classes, class.name)
    api.parents[class.name] = class.parent
    for _, entry in ipairs(class.methods) do
      table.insert(api.methods, step(entry.name, class.name .. ":" .. entry.name, class.name, entry.doc))
    end
    for _, entry in ipairs(class.fields) do add_field(class, entry) end
    for _, entry in ipairs(class.operators) do
      table.insert(api.operators, {name = entry.name, entry = class.name .. " " .. entry.name, class = class.name, keys = {}})
    end
  end
  return api
end

--- The API of this program: lists of steps {name, entry, class?, params, words, keys} by kind of use, and the names of everything that can be
--- reached, keys as "clench.load{root}".
return function()
  local api = read(clench.entries())
  api.names = {}
  for _, list in ipairs {api.functions, api.methods, api.fields, api.setters, api.operators} do
    for _, step in ipairs(list) do
      api.names[#api.names + 1] = step.entry
      for _, key in ipairs(step.keys) do api.names[#api.names + 1] = ("%s{%s}"):format(step.entry, key) end
    end
  end
  return api
end
