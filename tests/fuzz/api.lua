-- Random calls over the complete API. The same seed makes the same calls.
--   clench -q run tests/fuzz/api.lua SEED CALLS [SECONDS]
-- Runs in a writable folder with models, worlds and seeds to read. Each statement is written to calls.lua before it runs, so that repeat.lua can
-- repeat it after a crash. Coverage is printed as `COVERED <returned> <failed> <name>`, with everything that can be reached. The exit code is 3 if
-- call.lua found something.
local here = arg[0]:match "^(.*/)" or ""
local api = dofile(here .. "entries.lua")()
local values = dofile(here .. "values.lua")
local statements = dofile(here .. "statements.lua")
local call = dofile(here .. "call.lua")

local seed, calls, seconds = tonumber(arg[1]), tonumber(arg[2]), tonumber(arg[3] or 20)
math.randomseed(seed)
local random = math.random
local function one_of(list) return list[random(#list)] end

-- --- initial objects ---

api.names_of_things, api.members, api.materials, api.measures, api.files = {}, {}, {"wood", "rubber", "plastic"}, {}, {}
api.endings = {".wld", ".xml", ".lua", ".obj", ".stl", ".ply", ".cfg", ".urdf", ".egr", ".vgr", ".png", ".iv", ""}
for _, measure in ipairs(clench.measures()) do table.insert(api.measures, measure.name) end
for _, list in pairs(clench.catalog()) do
  for _, path in ipairs(list) do table.insert(api.files, path:match "models/.*" or path:match "worlds/.*") end
end
table.sort(api.files)
-- small files are chosen more often
for _, path in ipairs {"models/objects/cube.iv", "worlds/parallel_jaw_cube.wld", "models/hands/barrett/barrett.cfg"} do
  for _ = 1, 12 do table.insert(api.files, path) end
end

local pool = {}  -- source of objects by class, including base classes
local maker = values.maker(pool, api)
local made = statements.new(api, maker)
local count = 0  -- of entries of v

local function remember(class, source)
  while class do
    local list = pool[class] or {}
    pool[class] = list
    list[#list + 1] = source
    if #list > 60 then table.remove(list, 1) end
    class = api.parents[class]
  end
end

-- classes of the API only, as named by their metatables
local is_class = {}
for _, class in ipairs(api.classes) do is_class[class] = true end
-- an object that is a table: its metatable names its methods
local function note_members(value, source)
  local class = getmetatable(value)
  local methods = type(class) == "table" and rawget(class, "__index")
  if type(methods) ~= "table" then return end
  local names = {}
  for name, method in next, methods do
    if type(name) == "string" and name:find "^%l[%w_]*$" and type(method) == "function" then names[#names + 1] = name end
  end
  if #names == 0 then return end
  table.sort(names)
  table.insert(api.members, {source = source, names = names, name = "a method of a table: " .. table.concat(names, " ")})
  if #api.members > 12 then table.remove(api.members, 1) end
end

local function note(value, source, depth)
  local class = type(value) == "userdata" and getmetatable(value)
  if is_class[class] then
    remember(class, source)
    local ok, name = pcall(function() return (class == "body" or class == "robot") and value.name end)
    if ok and type(name) == "string" then
      table.insert(api.names_of_things, name)
      if #api.names_of_things > 40 then table.remove(api.names_of_things, 1) end
    end
  elseif type(value) == "table" and depth > 0 then
    note_members(value, source)
    local taken = 0
    for i, item in next, value do  -- pairs() would call a metamethod
      if taken >= 3 then break end
      if math.type(i) == "integer" then
        note(item, ("%s[%d]"):format(source, i), depth - 1)
        taken = taken + 1
      end
    end
  end
end

-- --- the run ---

local log = assert(io.open("calls.lua", "w"))
log:setvbuf "full"
local coverage = {}
for _, name in ipairs(api.names) do coverage[name] = {0, 0} end

local function run(text, step, target)
  -- results of odd arguments may be infinite
  local sensible = maker.hostile == 0 and step.entry ~= "something odd"
  log:write(("call(%s, %q, %s, %s)\n"):format((("%q"):format(text):gsub("\\\n", "\\n")), step.entry, target, sensible))
  log:flush()
  local ok, value = call.run(text, step.entry, target, sensible)
  for _, name in ipairs(statements.reached(text, step)) do
    local covered = coverage[name]
    if covered then covered[ok and 1 or 2] = covered[ok and 1 or 2] + 1 end
  end
  if not ok or not target then return end
  count = value == nil and target - 1 or target
  note(value, ("v[%d]"):format(target), 2)
end

-- the second takes ten times as long to load and to grasp as the first, the others forty times
local worlds = {{95, "worlds/parallel_jaw_cube.wld"}, {100, "worlds/tendon_cylinder.wld"}, {101, "worlds/three_finger_sphere.wld"},
                {102, "worlds/barrett_mug.wld"}, {103, "worlds/dlr_flask.wld"}}
local function any_world()
  local n = random(103)
  for _, world in ipairs(worlds) do
    if n <= world[1] then return world[2] end
  end
end

-- a world with a hand that holds something; earlier objects are no longer used, but stay alive in v
local function begin()
  for class in pairs(pool) do pool[class] = nil end
  api.names_of_things, api.members = {}, {}
  local n = count
  local function at(k) return ("v[%d]"):format(n + k) end
  local beginning = {
    ("%s = clench.load %q"):format(at(1), any_world()), ("%s = %s.robots[1]"):format(at(2), at(1)),
    ("%s = %s.objects[1]"):format(at(3), at(1)),
    ("%s.elastic_modulus = %s"):format(at(3), one_of {"nil", "1e5", "1e6", "1e6"}), ("%s = %s:autograsp()"):format(at(4), at(2)),
    ("%s = clench.grasp(%s, %s, {edges = %s})"):format(at(5), at(2), at(3), one_of {"8", "8", "4", "'exact'"}),
    ("%s = %s:contacts(%s)"):format(at(6), at(1), at(2)), ("%s = %s:wrench_space()"):format(at(7), at(5)),
    ("%s = clench.pose {xyz = {0, 0, 0.1}}"):format(at(8)), ("%s = %s.links"):format(at(9), at(2)),
  }
  if random(3) == 1 then
    beginning[#beginning + 1] = ("%s = %s:add_robot('models/arms/puma560/puma560.cfg', {pose = {xyz = {0, 0, 5}}})"):format(at(10), at(1))
  end
  maker:begin(0)
  for _, text in ipairs(beginning) do run(text, {entry = "the beginning", keys = {}}, tonumber(text:match "^v%[(%d+)%] =")) end
end

local stop = os.clock() + seconds
local next_beginning = 0
while call.number < calls and os.clock() < stop do
  if call.number >= next_beginning then
    begin()
    next_beginning = call.number + random(30, 150)
  end
  run(made:make(count + 1))
end
log:close()

for _, name in ipairs(api.names) do print(("COVERED %d %d %s"):format(coverage[name][1], coverage[name][2], name)) end
print("CALLS " .. call.number)
for n in pairs(call.v) do call.v[n] = nil end
collectgarbage()
os.exit(call.findings > 0 and 3 or 0, true)
