-- Errors have a kind as a value, and can be used like their text.
local test, clench = require "test", require "clench"

local function error_of(fn, ...)
  local ok, message = pcall(fn, ...)
  assert(not ok, "expected an error")
  return message
end

test("an error has a kind", function(t)
  local world = clench.load("worlds/dlr_flask.wld")
  local hand, flask = world.robots[1], world.objects[1]
  hand:autograsp()
  local grasp = clench.grasp(hand, flask)
  hand:open()
  local kinds = {
    {"input", clench.pose, {xzy = {1, 2, 3}}},
    {"input", function() return hand.no_such_field end},
    {"input", function() clench.shapes.box {-1, 1, 1} end},
    {"file", clench.load, "worlds/no_such.wld"},
    {"file", clench.load, "README.md"},
    {"file", function() world:save "no_such_folder/w.wld" end},
    {"file", clench.files.eigengrasps, "models/objects/mug.iv"},
    {"stale", function() grasp:quality "gravity_effort" end},
    {"limit", function() clench.render(world, {size = {8000, 8000}, samples = 256}) end},
  }
  for i, case in ipairs(kinds) do
    local message = error_of(table.unpack(case, 2))
    t.equal(message.kind, case[1], ("%d: %s"):format(i, message))
  end
  world:remove(flask)
  t.equal(error_of(function() return flask.mass end).kind, "stale")
end)

test("a faulty file is an error of the file, wherever it is detected", function(t)
  for _, text in ipairs {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 x\n3 0 1 2\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "OFF\n0 0 0\n"} do
    local path = test.path(".off", text)
    t.equal(error_of(function() clench.world():add_object(path) end).kind, "file")
  end
end)

test("an error can be printed, concatenated and searched like its text", function(t)
  local message = error_of(clench.rad, "x")
  t.equal(tostring(message), message.text)
  t.equal(message .. "!", message.text .. "!")
  t.equal("so: " .. message, "so: " .. message.text)
  t.equal(#message, #message.text)
  t.ok(message:find("clench.rad", 1, true) and message:match "expected a number" and message:gsub("expected", ""))
  t.equal(("%s"):format(message), message.text)
  t.ok(message.place:find "^[^\n]*errors_test%.lua:%d+: $", message)
  t.equal(message.place .. message.sentence, message.text)
end)

test("an error names the script's line, however deep in the library it is raised", function(t)
  local hand = clench.load("worlds/dlr_flask.wld").robots[1]
  local function line_of(fn) return error_of(fn).place:match "errors_test%.lua:(%d+): $" end
  local here = debug.getinfo(1, "l").currentline
  t.equal(line_of(function() hand:autograsp {velocities = "fast"} end), tostring(here + 1))
  t.equal(line_of(function() clench.study.robustness(hand) end), tostring(here + 2))
  t.equal(line_of(function() clench.plan.anneal {hand = hand, object = hand.world.objects[1], energy = "nothing"} end), tostring(here + 3))
  t.equal(line_of(function() clench.csv.read "no/such.csv" end), tostring(here + 4))
  local function energy() clench.rad "x" end  -- an error of a script's own function has that function's line
  local raised = error_of(function() clench.plan.anneal {hand = hand, object = hand.world.objects[1], steps = 10, energy = energy} end)
  t.ok(raised.place:find(("errors_test.lua:%d: "):format(here + 5), 1, true), raised)
  t.ok(raised.sentence:find "^clench%.rad: ", raised)
end)

test("an error that is raised again, and one from a coroutine, keep their kind", function(t)
  local function again() error(error_of(clench.load, "no.wld")) end
  t.equal(error_of(again).kind, "file")
  local ok, message = coroutine.resume(coroutine.create(function() clench.load "no.wld" end))
  t.ok(not ok and message.kind == "file")
  t.equal(select(2, xpcall(clench.load, function(m) return m.kind end, "no.wld")), "file")
end)

test("progress iterates over a loop, and shows nothing without a terminal", function(t)
  local seen = {}
  for i, name in clench.progress({"a", "b", "c"}, "names") do seen[i] = name end
  t.equal(table.concat(seen), "abc")
  local count = 0
  for i in clench.progress(5) do count = count + i end
  t.equal(count, 15)
  local p <close> = clench.progress(4)
  p:step(3)
  p:step(3)
  t.equal(p.done, 4.0)
  t.fails(function() p:step(-1) end, "expected a number >= 0")
  t.fails(function() clench.progress("many") end, "expected a number")
end)

test("a module's function called with a colon gives a hint", function(t)
  local dot = "whose functions are called with '.' and not ':'"
  t.fails(function() return clench:load "worlds/dlr_flask.wld" end, "clench.load: path: expected a string, got clench, " .. dot)
  t.fails(function() return clench.stats:mean {1, 2} end, "stats.mean: expected a list of numbers, got clench.stats, " .. dot)
  t.fails(function() return clench.plan:sample {} end, "got clench.plan, " .. dot)
  t.fails(function() return clench.csv:read "a.csv" end, "got clench.csv, " .. dot)
  t.fails(function() return clench.load(setmetatable({}, {__name = "clenched"})) end, "got an empty table")
end)

test("internal modules of the standard library accept or reject foreign values", function(t)
  local raise, suggest = require "clench.raise", require "clench.suggest"
  t.equal(suggest("abc", 3), "")
  t.equal(suggest(nil, {"abc"}), "")
  t.equal(suggest("abcd", {"abce", {}}), "; did you mean 'abce'?")
  t.fails(function() raise() end, "expected a string, got nothing")
  t.fails(function() raise("x", "odd") end, "expected a kind of errors, got 'odd'")
end)

test("diagnostics have place and subject as values, and equal problems of a file are one", function(t)
  local path = test.path(".urdf", [[<robot name="r">
<link name="a"/> <link name="b"/> <link name="c"/>
<joint name="j" type="revolute"> <parent link="a"/> <child link="b"/>
<limit lower="1" upper="0" effort="1" velocity="1"/> </joint>
<joint name="k" type="revolute"> <parent link="b"/> <child link="c"/>
<limit lower="2" upper="0" effort="1" velocity="1"/> </joint>
</robot>
]])
  local list, robot = clench.log.collect(function() return clench.world():add_robot(path) end)
  t.equal(#robot.dofs, 2)
  local exchanged, guessed
  for _, d in ipairs(list) do
    exchanged = d.text:find "exchanged" and d or exchanged
    guessed = d.text:find "no approach direction" and d or guessed
  end
  t.equal(exchanged, {severity = "warning", about = "repaired", file = path:match "[^/]*$", line = 4, subject = "joint 'j'",
    text = "lower 1 exceeds upper 0; they are exchanged", count = 2})
  if guessed then t.equal({guessed.severity, guessed.about, guessed.line}, {"note", "inferred"}) end
  -- the report has the same values
  local again
  for _, d in ipairs(require "clench.report".of(path).diagnostics) do again = d.text == exchanged.text and d or again end
  t.equal(again, exchanged)
  -- equal problems at several places of a file
  local body = test.path(".xml", "<root><geometryFile>x.off</geometryFile><foo/><foo/><mass>1</mass></root>")
  local off = io.open(body:match "^(.*/)" .. "x.off", "w")
  off:write "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
  off:close()
  local unknown
  for _, d in ipairs((clench.log.collect(function() return clench.world():add_object(body) end))) do
    unknown = d.text:find "unknown element <foo>" and d or unknown
  end
  t.equal({unknown.count, unknown.line, unknown.about}, {2, 1, "ignored"})
end)

test("data that a written file does not hold are a diagnostic of that file", function(t)
  local path, written = test.path ".obj", test.path ".obj"
  clench.log.collect(clench.convert, "models/objects/cube.iv", path)
  local body = test.path(".xml", ("<root><geometryFile>%s</geometryFile><mass>500</mass></root>"):format(path))
  local lost
  for _, d in ipairs((clench.log.collect(clench.convert, body, written))) do lost = d.text:find "does not hold" and d or lost end
  local name = written:match "[^/]*$"
  t.equal({lost.severity, lost.about, lost.file, lost.line}, {"warning", nil, name, nil})
  t.ok(lost.text:find(name .. " does not hold", 1, true) == 1, lost.text)
end)

test("logged messages are collected as values", function(t)
  local path = test.path(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nfoo 1\nfoo 2\n")
  local level, told = clench.log.level(), 0
  clench.log.sink(function() told = told + 1 end)
  clench.log.level "error"
  local list, name, more = clench.log.collect(function(a, b)
    clench.log.warning "twice"
    clench.log.warning "twice"
    return clench.world():add_object(a, {unit = "m"}).name, b
  end, path, 5)
  t.equal(more, 5)
  t.ok(name)
  t.equal(list[1], {severity = "warning", text = "twice", count = 2})
  local unknown
  for _, d in ipairs(list) do unknown = d.text:find "is unknown" and d or unknown end
  t.equal({unknown.severity, unknown.line, unknown.about}, {"warning", 9, "ignored"})
  t.ok(path:find(unknown.file, 1, true))
  -- the sink and the level are restored, also after an error
  t.fails(function() clench.log.collect(error, "broken") end, "broken")
  t.equal(clench.log.level(), "error")
  clench.log.error "heard"
  t.equal(told, 1)
  clench.log.sink(nil)
  clench.log.level(level)
end)
