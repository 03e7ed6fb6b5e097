-- Random statements over the complete API, each with the entry that it reaches.
local here = debug.getinfo(1, "S").source:match "^@(.*/)" or ""
local known = dofile(here .. "known.lua")
local spoil = dofile(here .. "spoil.lua")
local examples = dofile(here .. "examples.lua")
local random = math.random
local function one_of(list) return list[random(#list)] end

local Statements = {}
Statements.__index = Statements

---@param api table    of entries.lua
---@param maker table  of values.lua
---@param even? boolean  whether slow entries are as frequent as others
---@return table statements
local function new(api, maker, even) return setmetatable({api = api, maker = maker, even = even, decks = {}}, Statements) end

-- draws steps like cards from a shuffled deck, so that all of them are used
local function pick(self, list)
  local deck = self.decks[list] or {}
  self.decks[list] = deck
  if #deck == 0 then
    for i, step in ipairs(list) do
      local rarity = not self.even and known.rarity(step)
      if not rarity or random(rarity) == 1 then table.insert(deck, random(#deck + 1), step) end
    end
  end
  return table.remove(deck)
end

-- source of an object; creates one if the class has none, and often a new one if a motion may have invalidated it
local function object_of(self, class)
  local source = self.maker:object(class)
  local anew = known.stale[class] and random(2) == 1 and known.stale[class](self.maker)
  if anew then return "(" .. anew .. ")" end
  local provider = known.providers[class]
  if source or not provider then return source end
  local from = provider:match "^([%a_]+)[.:]"
  if from == "clench" then return "(" .. provider .. ")" end
  local object = object_of(self, from)
  return object and ("(%s)%s"):format(object, provider:sub(#from + 1))
end

local function sensible_arguments(self, step)
  local maker = self.maker
  maker.words, maker.entry = step.words, step.entry
  local whole = known.arguments[step.entry]
  if whole and random(4) > 1 then return whole(maker) end
  local list = {}
  for _, param in ipairs(step.params) do
    -- a picture is small only if its size is given
    if param.optional and random(4) == 1 and not step.name:find "render" then break end
    list[#list + 1] = maker:make(param.type, param.name)
  end
  -- one argument too many
  if random() < maker.hostility / 4 then list[#list + 1] = maker:make(one_of(self.api.types)) end
  return table.concat(list, ", ")
end

-- `one`: makes one part of sensible arguments hostile
local function arguments(self, step, one)
  local text = sensible_arguments(self, step)
  return one and spoil(text, function(part) return self.maker:hostile_value(nil, part) end) or text
end

local makers = {}

function makers.functions(self, n, one)
  local step = pick(self, self.api.functions)
  if step.constant then return ("v[%d] = %s"):format(n, step.name), step, n end
  return ("v[%d] = %s(%s)"):format(n, step.name, arguments(self, step, one)), step, n
end

local function with_object(self, list)
  for _ = 1, 30 do
    local step = pick(self, list)
    local object = step and object_of(self, step.class)
    if object then return step, object end
  end
end

function makers.methods(self, n, one)
  local step, object = with_object(self, self.api.methods)
  if step then return ("v[%d] = (%s):%s(%s)"):format(n, object, step.name, arguments(self, step, one)), step, n end
end

function makers.fields(self, n)
  local step, object = with_object(self, self.api.fields)
  if step then return ("v[%d] = (%s).%s"):format(n, object, step.name), step, n end
end

function makers.setters(self, _, one)
  local step, object = with_object(self, self.api.setters)
  if not step then return end
  local maker = self.maker
  maker.words, maker.entry = step.words, step.entry
  local value = maker:make(step.type, step.name)
  if one then value = spoil(value, function(part) return maker:hostile_value(nil, part) end) end
  return ("%s.%s = %s"):format(object, step.name, value), step
end

local signs = {__add = "+", __sub = "-", __mul = "*", __div = "/", __eq = "=="}
local unary = {__unm = "-%s", __len = "#%s", __tostring = "tostring(%s)", __json = "clench.json.encode(%s)"}
local partners = {__mul = {"2", "0.5"}, __div = {"2", "0.5"}}

function makers.operators(self, n)
  local step, a = with_object(self, self.api.operators)
  if not step then return end
  local maker = self.maker
  maker.words, maker.entry = {}, step.entry
  if unary[step.name] then return ("v[%d] = " .. unary[step.name]):format(n, a), step, n end
  if step.name == "__call" then return ("v[%d] = (%s)(%s)"):format(n, a, maker:number()), step, n end
  if step.name == "__index" then return ("v[%d] = %s[%s]"):format(n, a, maker:number()), step, n end
  local b = partners[step.name] and step.class == "vec3" and one_of(partners[step.name]) or object_of(self, step.class)
  if random() < maker.hostility + 0.1 then b = maker:make(one_of(self.api.types)) end
  if random(2) == 1 and not partners[step.name] then a, b = b, a end
  return ("v[%d] = (%s) %s (%s)"):format(n, a, signs[step.name], b), step, n
end

local odd = {entry = "something odd", keys = {}}
local odd_signs = {"+", "-", "*", "/", "==", "<", "..", "//", "%", "^", "&"}
function makers.odd(self, n)
  local maker, api = self.maker, self.api
  local a = maker:object(one_of(api.classes)) or "clench.vec3(0, 0, 1)"
  local function any() return maker:make(one_of(api.types)) end
  local method = one_of(api.methods)
  local text = one_of {
    function() return ("v[%d] = (%s) %s (%s)"):format(n, a, one_of(odd_signs), any()) end,
    function() return ("v[%d] = #%s"):format(n, a) end,
    function() return ("v[%d] = -%s"):format(n, a) end,
    function() return ("v[%d] = (%s)[%s]"):format(n, a, any()) end,
    function() return ("v[%d] = (%s)(%s)"):format(n, a, any()) end,
    function() return ("do local o = %s o[%s] = %s end"):format(a, any(), any()) end,
    function() return ("do local x <close> = %s end"):format(a) end,
    function() return "collectgarbage()" end,
    -- a method of another class, or with a dot
    function() return ("v[%d] = (%s):%s(%s)"):format(n, a, method.name, arguments(self, method)) end,
    function() return ("do local f = (%s).%s f(%s) end"):format(a, method.name, arguments(self, method)) end,
  }()
  return text, odd, text:find "^v%[" and n or nil
end

function makers.examples(self, n, one)
  local step = pick(self, self.api.examples)
  local hostile = one and function(part) return self.maker:hostile_value(nil, part) end
  return ("v[%d] = %s"):format(n, examples.source(step, hostile)), step, n
end

-- methods of tables returned by the standard library, which no table of entries lists: recordings, logs, searches
function makers.members(self, n)
  local members = self.api.members
  if #members == 0 then return end
  local member = one_of(members)
  local list = {}
  for i = 1, random(0, 2) do list[i] = self.maker:make(one_of(self.api.types)) end
  return ("v[%d] = (%s):%s(%s)"):format(n, member.source, one_of(member.names), table.concat(list, ", ")), {entry = member.name, keys = {}}, n
end

local kinds = {{24, "functions"}, {52, "methods"}, {60, "fields"}, {70, "setters"}, {74, "operators"}, {78, "odd"}, {84, "members"},
               {100, "examples"}}

--- A statement, the step that it reaches, and the number of v that it sets, `n` or nil.
---@param n integer
---@return string text, table step, integer? target
function Statements:make(n)
  self.maker:begin(one_of {0, 0, 0, 0, 0, 0, 0, 0.1, 0.4})
  local one, kind = random(3) > 1, random(100)
  for _, choice in ipairs(kinds) do
    if kind <= choice[1] then
      local text, step, target = makers[choice[2]](self, n, one)
      if text then return text, step, target end
      break
    end
  end
  return ("v[%d] = clench.world()"):format(n), {entry = "clench.world", keys = {}}, n
end

--- The names in a statement's coverage: its entry, and the keys of the entry that appear in its text.
function Statements.reached(text, step)
  local names, said = {step.entry}, {}
  for key in text:gmatch "([%a_][%w_]*)%s*=[^=]" do said[key] = true end
  for _, key in ipairs(step.keys) do
    if said[key] then names[#names + 1] = ("%s{%s}"):format(step.entry, key) end
  end
  return names
end

return {new = new, reached = Statements.reached}
