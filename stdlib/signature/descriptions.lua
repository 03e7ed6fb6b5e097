--- Descriptions of entries, as parsed by `signature`, with the options that @like takes from other entries.
local packed_docs = require "clench.signature.packed_docs"
local packed_text = require "clench.packed_text"
local raise = require "clench.raise"
local signature = require "clench.signature.grammar"
local descriptions = {}

-- docs of the entries in C++ by name, loaded on first use
local docs
local function doc_of_engine(name)
  if not docs then
    docs = {}
    local all = clench.entries()
    for _, library in ipairs(all.libraries) do
      for _, entry in ipairs(library.functions) do docs[library.name .. "." .. entry.name] = entry.doc end
    end
    for _, class in ipairs(all.classes) do
      for _, entry in ipairs(class.methods) do docs[class.variable .. ":" .. entry.name] = entry.doc end
    end
  end
  return docs[name]
end

-- "clench.plan.sample" is in plan/sample.lua, "clench.csv.read" in csv.lua
local function doc_of_stdlib(name)
  local module = name:match "^clench%.([%w_.]+)$"
  if not module then return nil end
  local path, parent = module:gsub("%.", "/"), module:match "^(.*)%." or module
  for _, path in ipairs {path .. ".lua", parent:gsub("%.", "/") .. ".lua"} do
    local text = packed_text(path)
    for _, entry in ipairs(text and packed_docs.of {path = path, text = text} or {}) do
      if "clench." .. entry.name == name then return entry.doc end
    end
  end
end

local function find(list, name)
  for _, item in ipairs(list) do
    if item.name == name then return item end
  end
end

local function options_of(name)
  local found = descriptions.of(name)
  for _, item in ipairs(found and found.parameters or {}) do
    if item.fields then return item.fields end
  end
  raise(("signature: @like %s: there is no such entry with options"):format(name), "internal")
end

-- inserts the options of another entry, unless the parameter has an option of that name
local function add_like(item, like)
  local at, from = like.at, options_of(like.entry)
  local names = like.names
  if not names then
    names = {}
    for i, option in ipairs(from) do names[i] = option.name end
  end
  for _, name in ipairs(names) do
    local option = find(from, name)
    if not option then raise(("signature: @like %s: it has no option %s"):format(like.entry, name), "internal") end
    if not find(item.fields, name) then
      table.insert(item.fields, at, option)
      at = at + 1
    end
  end
end

--- As signature.parse, with @like resolved.
---@param doc string
---@return table
function descriptions.parse(doc)
  local parsed = signature.parse(doc)
  for _, item in ipairs(parsed.parameters) do
    -- from the last one, so that the other positions stay valid
    for i = #(item.like or {}), 1, -1 do add_like(item, item.like[i]) end
    item.like = nil
  end
  return parsed
end

local known = {}

--- The description of an entry; nil if there is no entry of that name.
---@param name string  "clench.plan.sample", "world:on_step"
---@return table?
function descriptions.of(name)
  if known[name] == nil then
    local doc = doc_of_stdlib(name) or doc_of_engine(name)
    known[name] = doc and descriptions.parse(doc) or false
  end
  return known[name] or nil
end

return descriptions
