-- The parts of the fuzzers in tests/fuzz: generated calls, and detected faults.
local test = require "test"
local parse = dofile "tests/fuzz/types.lua"
local judge = dofile "tests/fuzz/judge.lua"
local mutate = dofile "tests/fuzz/mutate.lua"
local values = dofile "tests/fuzz/values.lua"
local crash = dofile "tests/fuzz/crash.lua"
local statements = dofile "tests/fuzz/statements.lua"
local spoil = dofile "tests/fuzz/spoil.lua"

-- the list that api.lua prints before it begins, with one object of each class
local function prepared_api()
  local api = dofile "tests/fuzz/entries.lua" ()
  api.members = {}
  api.names_of_things, api.materials, api.measures, api.files, api.endings = {"cube"}, {"wood"}, {"epsilon"}, {"cube.iv"}, {".obj"}
  local pool = {}
  for _, class in ipairs(api.classes) do pool[class] = {"v[1]"} end
  return api, values.maker(pool, api)
end

test("a type of the docs becomes a tree", function(t)
  local kind = parse '{a: number, b?: vec3[], c?: "x"|"y"}|string'
  t.equal(kind.kind, "union")
  t.equal(kind.of[2], {kind = "name", name = "string"})
  local fields = kind.of[1].fields
  t.equal(fields[1], {name = "a", optional = false, type = {kind = "name", name = "number"}})
  t.equal(fields[2], {name = "b", optional = true, type = {kind = "list", of = {kind = "name", name = "vec3"}}})
  t.equal(fields[3].type.of[2], {kind = "literal", text = "y"})
  t.equal(parse "number[][]".of.of.name, "number")
  t.equal(parse "(number|false)[]".of.kind, "union")
  t.equal(parse "fun(level: string, text: string)".name, "function")
end)

test("the fuzzer knows every entry of the API, and of the standard library", function(t)
  local api, all, known = prepared_api(), clench.entries(), {}
  for _, name in ipairs(api.names) do known[name] = true end
  for _, library in ipairs(all.libraries) do
    for _, kind in ipairs {"functions", "fields"} do
      for _, entry in ipairs(library[kind]) do t.ok(known[library.name .. "." .. entry.name], entry.name) end
    end
  end
  for _, class in ipairs(all.classes) do
    for _, entry in ipairs(class.methods) do t.ok(known[class.name .. ":" .. entry.name], entry.name) end
    for _, entry in ipairs(class.operators) do t.ok(known[class.name .. " " .. entry.name], entry.name) end
    for _, entry in ipairs(class.fields) do
      t.ok(known[class.name .. "." .. entry.name], entry.name)
      t.equal(known[class.name .. "." .. entry.name .. " ="], entry.settable or nil)
    end
  end
  for name in pairs(clench.shapes) do t.ok(known["clench.shapes." .. name], name) end
  t.ok(known["clench.wrench_space{contacts}"] and known["world:add_object{mass}"] and known["world_settings.camera ={eye}"])
end)

test("statements reach every entry and every key, and Lua can parse them", function(t)
  local api, maker = prepared_api()
  math.randomseed(1)
  local made, left = statements.new(api, maker, true), {}
  for _, name in ipairs(api.names) do left[name] = true end
  for n = 1, 400000 do
    local text, step = made:make(n)
    if n % 10 == 0 then t.ok(load(text), text) end
    for _, name in ipairs(statements.reached(text, step)) do left[name] = nil end
    if n % 1000 == 0 and not next(left) then break end
  end
  for name in pairs(left) do t.ok(false, name .. " is never reached") end
end)

test("the examples of the pages are statements that run unchanged", function(t)
  local examples, made = dofile "tests/fuzz/examples.lua", 0
  local env = {example = examples.runner(_G)}
  for _, step in ipairs(prepared_api().examples) do
    if step.entry:find "^clench%.vec3" or step.entry:find "^vec3[:.]" or step.entry == "robot.dofs" then
      local chunk = assert(load("return " .. examples.source(step), "=fuzz", "t", env))
      local ok, message = pcall(chunk)
      -- an example may show an error
      t.ok(ok or not tostring(message):find "attempt to", step.entry .. ": " .. tostring(message))
      made = made + 1
    end
  end
  t.ok(made > 10, made .. " examples")
end)

test("every class of the dynamics, of planning and of studies has statements from examples", function(t)
  local from = {}
  for _, step in ipairs(prepared_api().examples) do from[step.class or step.entry:match "^clench%.%l+"] = true end
  for _, name in ipairs {"world_dynamics", "world_control", "robot_dynamics", "joint_dynamics", "motion", "energy", "annealing", "clench.plan",
                         "clench.study"} do
    t.ok(from[name], name)
  end
end)

test("a spoiled list of arguments has one part exchanged, and no key's name", function(t)
  math.randomseed(1)
  local seen = {}
  for _ = 1, 200 do seen[spoil("{radius = 0.1, from = {1, v[2].x}}, 'a', true", function() return "HOSTILE" end)] = true end
  for _, text in ipairs {"{radius = HOSTILE, from = {1, v[2].x}}, 'a', true", "{radius = 0.1, from = HOSTILE}, 'a', true",
                         "{radius = 0.1, from = {HOSTILE, v[2].x}}, 'a', true", "{radius = 0.1, from = {1, HOSTILE}}, 'a', true",
                         "{radius = 0.1, from = {1, v[2].x}}, HOSTILE, true", "{radius = 0.1, from = {1, v[2].x}}, 'a', HOSTILE",
                         "HOSTILE, 'a', true"} do
    t.ok(seen[text], text)
    seen[text] = nil
  end
  t.equal(next(seen), nil)
  t.equal(spoil("", error), "")
end)

test("a message of a library, of Lua or without a subject is detected, and a sentence is not", function(t)
  t.equal(judge.message "fuzz:1: hand:autograsp: speed: expected a number, got nil", nil)
  t.equal(judge.message "no such file: cube.iv", nil)
  for _, text in ipairs {"std::bad_alloc", "clench.load: vector::_M_range_check", "not enough memory", "it failed",
                         "stdlib/report.lua:7: attempt to index a nil value", ("x: "):rep(500), "no body: 'a\27[2J'",
                         "a.xml:3:\nno"} do
    t.ok(judge.message(text), text)
  end
  t.equal(judge.message "fuzz:1: attempt to call a nil value", nil)
end)

test("a value that is not finite is detected, at any depth", function(t)
  t.equal(judge.value({1, {x = 2, y = {3, clench.vec3(1, 2, 3)}}}, "f"), nil)
  t.equal(judge.value({1, {x = 0 / 0}}, "f"), "f")
  t.equal(judge.value({{-math.huge}}, "f"), "f")
  t.equal(judge.value(math.huge, "measures:quality"), nil)
  t.equal(judge.value(0 / 0, "measures:quality"), "measures:quality")
end)

test("findings of one cause have one signature", function(t)
  local one = judge.signature("message", "fuzz:1: a: expected 3, got 'x'")
  t.equal(one, judge.signature("message", "fuzz:1: a: expected 17.5, got 'yz'"))
  t.equal(crash("src/a.cpp:3:9: runtime error: 1e+30 is outside\n", 1), crash("/x/src/a.cpp:3:9: runtime error: 1e+30 is outside\n", 1))
  t.equal(crash("", 137), "no end")
  t.equal(crash("", 139), "exit code 139")
end)

test("the same seed changes a text in the same way, and most changes change it", function(t)
  local text, changed = ("v 1 2 3\nf 1 2 3\n"):rep(20), 0
  for seed = 1, 200 do
    math.randomseed(seed)
    local a = mutate(text, "v 4 5 6")
    math.randomseed(seed)
    t.equal(mutate(text, "v 4 5 6"), a)
    if a ~= text then changed = changed + 1 end
  end
  t.ok(changed > 150)
  t.equal(type(mutate("x", "")), "string")
end)
