-- Random calls over the whole API, which knows every function, method, field and operator from the bindings' own tables and
-- their types from the docs. The same seed makes the same calls.
--   clench -q run tests/fuzz/api.lua SEED CALLS [coverage]
-- It runs in a folder that may be written into, with models and worlds to read. Each statement stands in calls.lua there
-- before it runs, so that a crash leaves what repeat.lua repeats. The exit code is 3 when call.lua found something.
local here = arg[0]:match "^(.*/)" or ""
local parse_type = dofile(here .. "types.lua")
local known = dofile(here .. "known.lua")
local values = dofile(here .. "values.lua")
local call = dofile(here .. "call.lua")
local doc = require "clench.host.doc"

local seed, calls = tonumber(arg[1]), tonumber(arg[2])
math.randomseed(seed)
local random = math.random
local function one_of(list) return list[random(#list)] end

-- a type's own text, for fields that hold the same
local function key(kind)
  if kind.kind == "list" then return key(kind.of) .. "[]" end
  if kind.kind == "record" then
    local names = {}
    for i, field in ipairs(kind.fields) do names[i] = field.name or "" end
    return "{" .. table.concat(names, " ") .. "}"
  end
  return kind.name or kind.kind
end

-- --- what there is to call ---

local api = {classes = {}, words = {}, names = {}, materials = {"wood", "rubber", "plastic"}, types = {}, fields_by_type = {},
             files = {}, measures = {}, key = key,
             endings = {".wld", ".xml", ".lua", ".obj", ".stl", ".ply", ".cfg", ".urdf", ".egr", ".vgr", ".png", ".iv", ""}}
local steps = {functions = {}, methods = {}, fields = {}, setters = {}}

-- they end the run, or are a part of it
local left_out = {["clench.log.sink"] = true, ["clench.log.level"] = true}

local function parameters(entry)
  local list = {}
  for i, param in ipairs(doc.parse(entry.doc).params) do
    local name, optional = param.name:gsub("%?$", "")
    if name == "path" and entry.name:find "^save" then name = "to" end
    list[i] = {name = name, optional = optional > 0, type = parse_type(param.type)}
    table.insert(api.types, list[i].type)
  end
  return list
end

-- what stands in quotes in a doc: the words that the entry takes
local function words_of(entry)
  local words = {}
  for word in entry.doc:gmatch '"([^"\n]+)"' do words[#words + 1] = word end
  table.move(words, 1, #words, #api.words + 1, api.words)
  return words
end

local function step(entry, name, class)
  return {name = name, class = class, params = parameters(entry), words = words_of(entry)}
end

local function add_class(class)
  table.insert(api.classes, class.name)
  for _, entry in ipairs(class.methods) do
    table.insert(steps.methods, step(entry, entry.name, class.name))
  end
  for _, entry in ipairs(class.fields) do
    local kind = parse_type(doc.parse(entry.doc).type.type)
    local field = {class = class.name, name = entry.name, type = kind, words = words_of(entry)}
    table.insert(steps.fields, field)
    if entry.settable then table.insert(steps.setters, field) end
    local same = api.fields_by_type[key(kind)] or {}
    api.fields_by_type[key(kind)] = same
    table.insert(same, field)
  end
end

local function add_inherited(classes)
  local by_name = {}
  for _, class in ipairs(classes) do by_name[class.name] = class end
  for _, class in ipairs(classes) do
    local parent = by_name[class.parent]
    while parent do
      for _, kind in ipairs {"methods", "fields"} do
        for _, entry in ipairs(parent[kind]) do table.insert(class[kind], entry) end
      end
      parent = by_name[parent.parent]
    end
  end
end

local function read_api()
  local all = clench.entries()
  for _, library in ipairs(all.libraries) do
    for _, entry in ipairs(library.functions) do
      local name = library.name .. "." .. entry.name
      if not left_out[name] then table.insert(steps.functions, step(entry, name)) end
    end
  end
  for _, entry in ipairs(doc.packed_functions(all.files)) do
    table.insert(steps.functions, step(entry, "clench." .. entry.name))
  end
  add_inherited(all.classes)
  for _, class in ipairs(all.classes) do add_class(class) end
  for _, measure in ipairs(clench.measures()) do table.insert(api.measures, measure.name) end
  for _, list in pairs(clench.catalog()) do
    for _, path in ipairs(list) do table.insert(api.files, path:match "models/.*" or path:match "worlds/.*") end
  end
  table.sort(api.files)
  -- the small ones oftener
  for _, path in ipairs {"models/objects/cube.iv", "worlds/parallel_jaw_cube.wld", "models/hands/barrett/barrett.cfg"} do
    for _ = 1, 12 do table.insert(api.files, path) end
  end
end

-- --- statements ---

local pool = {}      -- source of objects by class
local maker
local count = 0      -- of v

local function remember(class, source)
  pool[class] = pool[class] or {}
  local list = pool[class]
  list[#list + 1] = source
  if #list > 60 then table.remove(list, 1) end
end

-- classes of the API alone, as their metatables say
local is_class = {}
local function note(value, source, depth)
  local class = type(value) == "userdata" and getmetatable(value)
  if is_class[class] then
    remember(class, source)
    if class == "body" or class == "robot" then
      local ok, name = pcall(function() return value.name end)
      if ok and type(name) == "string" then api.names[#api.names % 40 + 1] = name end
    end
  elseif type(value) == "table" and depth > 0 then
    local taken = 0
    for i, item in pairs(value) do
      if taken >= 3 then break end
      if math.type(i) == "integer" then note(item, ("%s[%d]"):format(source, i), depth - 1) taken = taken + 1 end
    end
  end
end

local function arguments(called)
  local parts = {}
  maker.words, maker.entry = called.words, called.name
  for _, param in ipairs(called.params) do
    if param.optional and random(3) == 1 and not called.name:find "render" then break end
    local name = param.name
    parts[#parts + 1] = maker:make(param.type, name)
  end
  -- one too many
  if random() < maker.hostility / 4 then parts[#parts + 1] = maker:make(one_of(api.types)) end
  return table.concat(parts, ", ")
end

local function any_object()
  local class = one_of(api.classes)
  return maker:object(class)
end

-- a step of a list; those that take a second are rarer
local function pick(list)
  local chosen = one_of(list)
  return known.heavy[chosen.name] and random(15) > 1 and pick(list) or chosen
end

local function of_class(list)
  for _ = 1, 20 do
    local step = pick(list)
    local object = maker:object(step.class)
    if object then return step, object end
  end
end

local operators = {"+", "-", "*", "/", "==", "<", "..", "//", "%", "^", "&"}
local odd = {
  function(a) return ("= #%s"):format(a) end,
  function(a) return ("= -%s"):format(a) end,
  function(a) return ("= tostring(%s)"):format(a) end,
  function(a) return ("= %s[%s]"):format(a, maker:make(one_of(api.types))) end,
  function(a) return ("= %s(%s)"):format(a, maker:make(one_of(api.types))) end,
  function(a) return ("= clench.json.encode(%s)"):format(a) end,
  function(a) return (":%s[%s] = %s"):format(a, maker:make(one_of(api.types)), maker:make(one_of(api.types))):sub(2) end,
  function(a) return ("do local x <close> = %s end"):format(a) end,
  function() return "collectgarbage()" end,
  function(a) return ("local f = %s.%s f(%s)"):format(a, one_of(steps.methods).name, arguments(one_of(steps.methods))) end,
}

-- a statement's text, the name of what it calls, and the number of v that it sets
local function statement()
  maker:begin(one_of {0, 0, 0, 0, 0.05, 0.05, 0.15, 0.4})
  local kind = random(100)
  local n = count + 1
  if kind <= 22 then
    local step = pick(steps.functions)
    return ("v[%d] = %s(%s)"):format(n, step.name, arguments(step)), step.name, n
  elseif kind <= 62 then
    local step, object = of_class(steps.methods)
    if step then return ("v[%d] = %s:%s(%s)"):format(n, object, step.name, arguments(step)), step.class .. ":" .. step.name, n end
  elseif kind <= 76 then
    local step, object = of_class(steps.fields)
    if step then return ("v[%d] = %s.%s"):format(n, object, step.name), step.class .. "." .. step.name, n end
  elseif kind <= 90 then
    local step, object = of_class(steps.setters)
    if step then
      maker.words, maker.entry = step.words, step.name
      local value = maker:make(step.type, step.name)
      return ("%s.%s = %s"):format(object, step.name, value), ("%s.%s ="):format(step.class, step.name), nil
    end
  end
  local a, b = any_object(), any_object()
  if not a then return ("v[%d] = clench.world()"):format(n), "clench.world", n end
  if kind <= 94 then
    if random(2) == 1 or not b then b = maker:make(one_of(api.types)) end
    if random(2) == 1 then a, b = b, a end
    return ("v[%d] = (%s) %s (%s)"):format(n, a, one_of(operators), b), "an operator", n
  end
  local text = one_of(odd)(a)
  if text:sub(1, 1) == "=" then return ("v[%d] %s"):format(n, text), "an operator", n end
  return text, "something odd", nil
end

-- --- the run ---

local log = assert(io.open("calls.lua", "w"))
log:setvbuf "full"
local coverage = {}

local function run(text, name, target)
  local sensible = maker.hostile == 0
  log:write(("call(%s, %q, %s, %s)\n"):format((("%q"):format(text):gsub("\\\n", "\\n")), name, target, sensible))
  log:flush()
  local ok, value = call.run(text, name, target, sensible)
  local covered = coverage[name] or {0, 0}
  coverage[name] = covered
  covered[ok and 1 or 2] = covered[ok and 1 or 2] + 1
  if not ok or not target then return end
  count = value == nil and target - 1 or target
  note(value, ("v[%d]"):format(target), 2)
end

read_api()
for _, class in ipairs(api.classes) do is_class[class] = true end
maker = values.maker(pool, api)
clench.log.level "quiet"

local worlds = {
  "worlds/parallel_jaw_cube.wld", "worlds/parallel_jaw_cube.wld", "worlds/parallel_jaw_cube.wld", "worlds/parallel_jaw_cube.wld",
  "worlds/parallel_jaw_cube.wld", "worlds/adaptive_cylinder.wld", "worlds/adaptive_cylinder.wld", "worlds/adaptive_cylinder.wld",
  "worlds/three_finger_sphere.wld", "worlds/barrett_mug.wld", "worlds/dlr_flask.wld",
}
-- a world with a hand that holds something; what went before is out of reach, but lives on in v
local function begin()
  for class in pairs(pool) do pool[class] = nil end
  api.names = {}
  local n = count
  local function at(k) return ("v[%d]"):format(n + k) end
  local beginning = {
    ("%s = clench.load %q"):format(at(1), one_of(worlds)), ("%s = %s.robots[1]"):format(at(2), at(1)),
    ("%s = %s.objects[1]"):format(at(3), at(1)),
    ("%s.elastic_modulus = %s"):format(at(3), one_of {"nil", "nil", "1e5", "1e6"}), ("%s = %s:autograsp()"):format(at(4), at(2)),
    ("%s = clench.grasp(%s, %s, {edges = %s})"):format(at(5), at(2), at(3), one_of {"8", "8", "4", "'exact'"}),
    ("%s = %s:contacts(%s)"):format(at(6), at(1), at(2)), ("%s = %s:wrench_space()"):format(at(7), at(5)),
    ("%s = clench.pose {xyz = {0, 0, 0.1}}"):format(at(8)), ("%s = %s.links"):format(at(9), at(2)),
  }
  maker:begin(0)
  for _, text in ipairs(beginning) do run(text, "the beginning", tonumber(text:match "^v%[(%d+)%] =")) end
end

-- seconds a batch
local stop = os.clock() + 6
local next_beginning = 0
while call.number < calls and os.clock() < stop do
  if call.number >= next_beginning then
    begin()
    next_beginning = call.number + random(20, 150)
  end
  run(statement())
end
log:close()

if arg[3] == "coverage" then
  local names = {}
  for name in pairs(coverage) do names[#names + 1] = name end
  table.sort(names)
  for _, name in ipairs(names) do print(("COVERED %d %d %s"):format(coverage[name][1], coverage[name][2], name)) end
end
print("CALLS " .. call.number)
for n in pairs(call.v) do call.v[n] = nil end
collectgarbage()
os.exit(call.findings > 0 and 3 or 0, true)
