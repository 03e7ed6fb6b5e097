-- Values of a type as Lua source: mostly as in typical scripts, some of them hostile. `v` is the script's table of all objects made so far.
local known = dofile((debug.getinfo(1, "S").source:match "^@(.*/)" or "") .. "known.lua")
local examples = dofile((debug.getinfo(1, "S").source:match "^@(.*/)" or "") .. "examples.lua")
local values = {}

local random = math.random
local function one_of(list) return list[random(#list)] end
local function quoted(text) return ("%q"):format(text):gsub("\\\n", "\\n") end

local hostile_numbers = {
  "0/0", "1/0", "-1/0", "1e308", "-1e308", "1.7e308", "1e300", "1e200", "1e154", "-1e154", "1e100", "1e30", "1e18", "1e12",
  "1e9", "1e6", "-1e6", "1e-3", "1e-7", "1e-12", "1e-30", "1e-160", "1e-300", "1e-308", "1e-320", "5e-324", "0", "-0.0", "-1",
  "1", "2", "0.5", "3.7", "-3", "2^31", "2^31-1", "-2^31", "2^32", "2^53", "2^63", "2^64", "math.maxinteger", "math.mininteger",
  "2147483647", "-2147483648", "4294967296", "65536", "1000000", "100000", "1e15", "math.pi", "-math.pi", "1e-9",
}
local hostile_texts = {
  "''", "' '", "'\\0'", "'a\\0b'", "'a\\nb'", "'\\r'", "'\\27[31m'", "'\\xff\\xfe'", "('x'):rep(70000)", "('/'):rep(5000)",
  "'%s%n%d'", "'{}'", "'{0}{1}'", "'..'", "'.'", "'/'", "'/dev/null'", "'/dev/full'", "'/proc/self/mem'", "'nan'", "'1e999'",
  "'0x'", "'<a>&\"'", "'é'", "'\\u{10FFFF}'",
  "('('):rep(3000)", "('[1,'):rep(2000)", "'#'", "'name with blanks'", "'base'", "'con'", "'\\\\'", "';'",
}
local hostile_anything = {
  "nil", "true", "false", "{}", "print", "cyclic", "deep", "many", "texts", "clench", "v", "angry", "lying",
  "{{}}", "{1}", "{'x'}", "{nil, 1}", "{x = 1}", "{1, 2, 3}", "{1, 2, '3'}", "{0/0, 0, 0}", "{[2^53] = 1}", "{{1}, {2, 3}}",
  "function() end", "function() error {} end", "coroutine.create(print)", "io.stdout", "clench.json.null",
}

--- globals of the chunks in addition to `v`
function values.environment()
  local cyclic, deep = {}, {}
  cyclic[1], cyclic.cyclic, cyclic.xyz = cyclic, cyclic, cyclic
  for _ = 1, 300 do deep = {deep} end
  local many, texts = {}, {}
  for i = 1, 20000 do many[i], texts[i] = i % 7, "x" .. i end
  local function raise() error "never asked" end
  local env = {
    v = {}, clench = clench, math = math, print = function() end, io = {stdout = io.stdout}, error = error, tostring = tostring,
    coroutine = coroutine, collectgarbage = collectgarbage, cyclic = cyclic, deep = deep,
    many = many, texts = texts, angry = setmetatable({}, {__index = raise, __len = raise, __pairs = raise, __tostring = raise}),
    lying = setmetatable({}, {__len = function() return 1 << 40 end, __index = function() return 1 end}),
  }

  -- further globals of examples; their files lie in the current folder
  local named = 0
  local function temporary()
    named = named % 9 + 1
    return "t" .. named
  end
  local function open(path, mode) return io.open(type(path) == "string" and path:match "^t%d[%w.]*$" or "t0", mode == "r" and "r" or "w") end
  local os_names = {tmpname = temporary, remove = function() return true end, clock = os.clock, time = os.time}
  env.example = examples.runner(setmetatable({
    io = {open = open, stdout = io.stdout}, os = os_names, require = function() return clench end, string = string, table = table,
    ipairs = ipairs, pairs = pairs, next = next, select = select, type = type, tonumber = tonumber, pcall = pcall, assert = assert,
    setmetatable = setmetatable, getmetatable = getmetatable,
  }, {__index = env}))
  return env
end

local function number()
  local kind = random(10)
  if kind <= 3 then return tostring(random(0, 12)) end
  if kind <= 6 then return ("%.4g"):format(random() * 2 - 1) end
  if kind <= 9 then return ("%.4g"):format(10 ^ (random() * 6 - 4)) end
  return tostring(random(-3, 300))
end

local Maker = {}
Maker.__index = Maker

--- A maker of values.
---@param pool table<string, string[]>  source of existing objects, by class
---@param api table  words, files, fields of a type, as listed by api.lua
function values.maker(pool, api)
  return setmetatable({pool = pool, api = api, hostility = 0, hostile = 0, words = {}, entry = ""}, Maker)
end

--- From now on each part of a value is hostile with this probability; `hostile` counts the hostile parts.
function Maker:begin(hostility) self.hostility, self.hostile = hostility, 0 end

--- A hostile replacement of `part`; for a number mostly another number.
function Maker:hostile_value(name, part)
  self.hostile = self.hostile + 1
  if part and tonumber(part) and random(4) > 1 then return one_of(hostile_numbers) end
  local kind = random(10)
  if kind <= 5 then return one_of(hostile_numbers) end
  if kind <= 7 then return one_of(hostile_texts) end
  local classes = self.api.classes
  local stale = kind == 8 and self.pool[one_of(classes)]
  if stale and #stale > 0 then return one_of(stale) end
  if kind == 9 and name then return quoted(one_of(self.api.words)) end
  return one_of(hostile_anything)
end

function Maker:number(name)
  if random() < self.hostility then
    self.hostile = self.hostile + 1
    return one_of(hostile_numbers)
  end
  return (known.numbers[name] or number)()
end

function Maker:text(name)
  local api = self.api
  local files = known.files[self.entry]
  if files and (name == "path" or name == "body" or name == "from") and random(6) > 1 then return quoted(one_of(files)) end
  local endings = known.endings[self.entry]
  if name == "to" and endings and random(8) > 1 then return quoted("x" .. random(5) .. one_of(endings)) end
  if name == "path" or name == "from" or name == "adapter" then return quoted(one_of(api.files)) end
  if name == "to" then return quoted("x" .. random(5) .. one_of(api.endings)) end
  if name == "root" or name == "folder" then return one_of {"'models'", "'.'"} end
  if name == "material" or name == "a" or name == "b" then return quoted(one_of(api.materials)) end
  if name == "measure" then return quoted(one_of(api.measures)) end
  if name == "name" or name == "link" then return quoted(one_of(#api.names_of_things > 0 and api.names_of_things or api.words)) end
  if random(5) > 1 and #self.words > 0 then return quoted(one_of(self.words)) end
  return quoted(one_of(random(3) == 1 and #api.names_of_things > 0 and api.names_of_things or api.words))
end

function Maker:object(class)
  local pool = self.pool[class]
  if pool and #pool > 0 then return pool[random(math.max(1, #pool - 12), #pool)] end
end

local function list_length(self, kind, name)
  if random() < self.hostility / 2 then return one_of {0, 1, 40, 300} end
  if known.lengths[name] and kind.of.kind ~= "list" then return known.lengths[name] end
  return one_of {1, 2, 2, 3, 3, 3, 4, 4, 6, 6, 6}
end

local makers = {}
function makers.number(self, name) return self:number(name) end
function makers.integer(self, name)
  local text = self:number(name)
  return text:find "^%-?%d+%.%d" and tostring(random(0, 8)) or text
end
function makers.boolean() return one_of {"true", "false"} end
function makers.string(self, name) return self:text(name) end
makers["function"] = function()
  return one_of {"function() end", "function(...) return ... end", "function() error 'mine' end"}
end
function makers.any(self)
  return self:make(one_of(self.api.types))
end
makers.table = makers.any
function makers.userdata() return "clench.json.null" end
local function three(self) return ("{%s, %s, %s}"):format(self:number(), self:number(), self:number()) end
function makers.vec3(self)
  return self:object "vec3" and random(3) == 1 and self:object "vec3" or three(self)
end
function makers.pose(self)
  return self:object "pose" and random(2) == 1 and self:object "pose"
    or ("{xyz = %s, rpy = %s}"):format(three(self), three(self))
end
makers["nil"] = function() return "nil" end
makers["false"] = function() return "false" end
makers["true"] = function() return "true" end

local function record(self, kind)
  local parts = {}
  -- all optional fields, some of them, or only one
  local way, only = random(6), random(#kind.fields + 1)
  for i, field in ipairs(kind.fields) do
    if not field.optional or way == 1 or way <= 3 and random(3) == 1 or way > 3 and i == only or field.name == "size" then
      local value = self:make(field.type, field.name)
      parts[#parts + 1] = field.name and ("%s = %s"):format(field.name, value) or value
    end
  end
  if random() < self.hostility / 3 then
    parts[#parts + 1] = ("%s = %s"):format(one_of {"nosuch", "['\\0']", "[1]", "[0]", "[-1]"}, self:hostile_value())
  end
  return "{" .. table.concat(parts, ", ") .. "}"
end

local function list(self, kind, name)
  local parts = {}
  for i = 1, list_length(self, kind, name) do parts[i] = self:make(kind.of, name) end
  return "{" .. table.concat(parts, ", ") .. "}"
end

-- a field of some object with the same type
local function field_of_type(self, kind)
  local fields = self.api.fields_by_type[self.api.key(kind)]
  local field = fields and one_of(fields)
  local object = field and self:object(field.class)
  return object and object .. "." .. field.name
end

-- lists whose length is the number of an object's parts
local lists_of = {values = "dofs", dofs = "dofs", amplitudes = "amplitudes"}

--- Source of a value of the type, for the parameter or field `name`.
function Maker:make(kind, name)
  if random() < self.hostility then return self:hostile_value(name) end
  local source = known.sources[self.entry .. " " .. (name or "")] or known.sources[name]
  if source and random(8) > 1 and not (name == "body" and kind.kind == "name") then return source(self) end
  if kind.kind == "union" then return self:make(one_of(kind.of), name) end
  if kind.kind == "literal" then return quoted(kind.text) end
  local whole = lists_of[name] and random(4) > 1 and self:object "robot"
  if whole then return whole .. "." .. lists_of[name] end
  if (kind.kind == "list" or kind.kind == "record") and random(3) == 1 then
    local field = field_of_type(self, kind)
    if field then return field end
  end
  if kind.kind == "record" then return record(self, kind) end
  if kind.kind == "list" then return list(self, kind, name) end
  if kind.kind == "map" then return ("{fx = %s}"):format(self:make(kind.of)) end
  local maker = makers[kind.name]
  return maker and maker(self, name) or not maker and self:object(kind.name) or "nil"
end

return values
