-- The parts of the fuzzers in tests/fuzz: what they make up, and what they find wrong.
local test = require "test"
local parse = dofile "tests/fuzz/types.lua"
local judge = dofile "tests/fuzz/judge.lua"
local mutate = dofile "tests/fuzz/mutate.lua"
local values = dofile "tests/fuzz/values.lua"
local crash = dofile "tests/fuzz/crash.lua"

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

test("every type in the docs makes a value that Lua reads", function(t)
  local doc = require "clench.host.doc"
  local api = {classes = {"vec3"}, words = {"L1"}, names = {"cube"}, materials = {"wood"}, types = {parse "number"}, fields_by_type = {},
               files = {"cube.iv"}, measures = {"epsilon"}, endings = {".obj"}, key = function() return "" end}
  local maker = values.maker({vec3 = {"v[1]"}}, api)
  local count = 0
  for _, class in ipairs(clench.entries().classes) do
    for _, entry in ipairs(class.methods) do
      for _, param in ipairs(doc.parse(entry.doc).params) do
        maker:begin(count % 3 * 0.2)
        local text = maker:make(parse(param.type), (param.name:gsub("%?", "")))
        t.ok(load("return " .. text), text)
        count = count + 1
      end
    end
  end
  t.ok(count > 50)
end)

test("a message of a library, of Lua or without a subject is found, a sentence is not", function(t)
  t.equal(judge.message "fuzz:1: hand:autograsp: speed: wanted a number, got nil", nil)
  t.equal(judge.message "no such file: cube.iv", nil)
  for _, text in ipairs {"std::bad_alloc", "clench.load: vector::_M_range_check", "not enough memory", "it failed",
                         "stdlib/report.lua:7: attempt to index a nil value", ("x: "):rep(5000)} do
    t.ok(judge.message(text), text)
  end
  t.equal(judge.message "fuzz:1: attempt to call a nil value", nil)
end)

test("a value that is not finite is found, wherever it stands", function(t)
  t.equal(judge.value({1, {x = 2, y = {3, clench.vec3(1, 2, 3)}}}, "f"), nil)
  t.equal(judge.value({1, {x = 0 / 0}}, "f"), "f")
  t.equal(judge.value({{-math.huge}}, "f"), "f")
  t.equal(judge.value(math.huge, "grasp:quality"), nil)
  t.equal(judge.value(0 / 0, "grasp:quality"), "grasp:quality")
end)

test("findings of one cause have one signature", function(t)
  local one = judge.signature("message", "fuzz:1: a: wanted 3, got 'x'")
  t.equal(one, judge.signature("message", "fuzz:1: a: wanted 17.5, got 'yz'"))
  t.equal(crash("src/a.cpp:3:9: runtime error: 1e+30 is outside\n", 1), crash("/x/src/a.cpp:3:9: runtime error: 1e+30 is outside\n", 1))
  t.equal(crash("", 137), "no end")
  t.equal(crash("", 139), "exit code 139")
end)

test("the same seed changes a text alike, and most changes change it", function(t)
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
