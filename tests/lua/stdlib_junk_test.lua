-- Every function and method of the standard library, called with invalid arguments: an error is a sentence about the caller's mistake, at the
-- caller's place, and never one of Lua about a line of the library.
local clench = require "clench"
local test = require "test"
local doc = require "clench.host.doc"
local packed_docs = require "clench.signature.packed_docs"

local world = clench.load "worlds/parallel_jaw_cube.wld"
local hand, object = world.robots[1], world.objects[1]

local function nothing() end

-- lists of arguments
local junk = {
  {n = 0}, {nil, n = 1}, {5}, {-1}, {0 / 0}, {math.huge}, {"x"}, {""}, {true}, {{}}, {{5}}, {{"x"}}, {{{}}}, {{x = 1}}, {nothing}, {world}, {hand},
  {clench}, {clench.vec3(0, 0, 0)}, {coroutine.create(print)}, {io.stdout}, {nil, 5, n = 2}, {5, 5}, {"x", "y"}, {{}, {}}, {nothing, nothing},
  {{1, 2, 3}, 5}, {{1, 2, 3}, {}}, {{1, 2, 3}, {x = 1}}, {{1, 2, 3}, "x"}, {hand, object}, {world, 5}, {5, 5, 5, 5, 5, 5},
}

-- fault of an error; nil for a proper sentence
local function fault(problem)
  local text = tostring(problem)
  if type(problem) == "table" and problem.kind == "internal" then return text end
  for _, words in ipairs {"attempt to", "bad argument", "stdlib/", "[string", "stack overflow", "invalid "} do
    if text:find(words, 1, true) then return text end
  end
end

-- closes objects that a call has opened, such as a simulated device, which would keep the loop running
local function call(fn, arguments)
  local ok, result = pcall(fn, table.unpack(arguments, 1, arguments.n or #arguments))
  local kind = ok and debug.getmetatable(result)
  if type(result) == "table" and kind and rawget(kind, "close") then pcall(result.close, result) end
  return ok, result
end

-- adds a fault to a list, once per function
local function try(list, name, fn, arguments)
  local ok, problem = call(fn, arguments)
  local wrong = not ok and fault(problem)
  if wrong and not list[name] then
    local shown = {}
    for i = 1, arguments.n or #arguments do shown[i] = require "clench.show"(arguments[i], 60) end
    list[name] = true
    list[#list + 1] = ("%s(%s): %s"):format(name, table.concat(shown, ", "), wrong)
  end
end

local public = {}
for _, entry in ipairs(packed_docs.functions(clench.entries().files)) do
  -- a test that is run reports its faults
  if entry.name ~= "test.run_file" then public[#public + 1] = {name = "clench." .. entry.name, fn = entry.fn} end
end

test("no function of the standard library answers invalid arguments with an error of Lua", function(t)
  t.ok(#public > 50, #public)
  local silent, list = clench.log.level "quiet", {}
  for _, entry in ipairs(public) do
    for _, arguments in ipairs(junk) do try(list, entry.name, entry.fn, arguments) end
  end
  clench.log.level(silent)
  t.equal(table.concat(list, "\n"), "")
end)

test("no method of objects returned by the standard library answers invalid arguments with an error of Lua", function(t)
  local recording, log = world:record(), world:log {quantities = {"energy"}}
  local task = world:spawn(function() end)
  world:run(0.05)
  local run = clench.plan.random {hand = hand, object = object, count = 1, seed = 1}
  local task_of_loop = clench.loop.spawn(function() end)
  local planner = clench.plan.online {hand = hand, object = object}
  local comparison = clench.study.compare(run.grasps, {world = world})
  local silent, list = clench.log.level "quiet", {}
  for name, value in pairs {planner = planner, comparison = comparison, recording = recording, log = log, handle = task, run = run, report = run.report, task_of_loop = task_of_loop} do
    local methods = 0
    for key, fn in pairs(debug.getmetatable(value).__index) do
      if type(fn) == "function" then
        methods = methods + 1
        for _, arguments in ipairs(junk) do
          try(list, name .. "." .. key, fn, arguments)
          try(list, name .. ":" .. key, fn, table.pack(value, table.unpack(arguments, 1, arguments.n or #arguments)))
        end
      end
    end
    t.ok(methods > 0, name)
  end
  clench.log.level(silent)
  t.equal(table.concat(list, "\n"), "")
end)

test("no option of the standard library answers invalid values with an error of Lua", function(t)
  local silent, list = clench.log.level "quiet", {}
  local values = {5, -1, 0 / 0, "x", true, {}, {5}, {{}}, nothing, world, clench.vec3(0, 0, 0)}
  for _, entry in ipairs(clench.entries().files) do
    for _, found in ipairs(packed_docs.functions {entry}) do
      local module = found.name:match "^[%w_]+"
      for i, param in ipairs(doc.parse(found.doc).params) do
        for key in param.type:gmatch "[{ ]([%a_][%w_]*)%??: " do
          -- one such value at a time, so that an accepted one begins no long search
          for _, value in ipairs(values) do
            local arguments = {n = i}
            for k = 1, i - 1 do arguments[k] = {1, 2, 3} end
            arguments[i] = {[key] = value, no_such_key = 1}
            if module == "plan" or module == "study" then arguments[i].hand, arguments[i].object = key ~= "hand" and hand or value, key ~= "object" and object or value end
            try(list, found.name, found.fn, arguments)
          end
        end
      end
    end
  end
  clench.log.level(silent)
  t.equal(table.concat(list, "\n"), "")
end)

test("messages name the caller's line", function(t)
  local recording = world:record()
  local function fails(sentence, fn) t.fails(fn, "stdlib_junk_test.lua:", sentence) end
  fails("stats.interval: successes: expected a whole number >= 0, got nothing", function() clench.stats.interval() end)
  fails("stats.interval: trials: expected a whole number >= 0, got nothing", function() clench.stats.interval(5) end)
  fails("stats.interval: trials: expected a whole number >= 0, got '10'", function() clench.stats.interval(5, "10") end)
  fails("recording:each: expected a function, got 5", function() recording:each(5) end)
  fails("recording:each: expected a function, got nothing", function() recording:each() end)
  fails("recording:each: expected a recording before the colon, got nothing; use recording:each(...)", function() recording.each() end)
  fails("recording:save: options: expected a table, got 5", function()
    world:run(0.05)
    recording:save("x.gif", 5)
  end)
  fails("recording:save: three must be a list of files, got 5", function() recording:save("x.html", {three = 5}) end)
  fails("recording:save: three[1] must be the name of a file, got 5", function() recording:save("x.html", {three = {5}}) end)
  local list = {{kind = "sphere", pose = clench.pose {}, radius = 0.02}}
  for _, planner in ipairs {"sample", "random", "antipodal", "primitive"} do
    fails(("plan.%s: on_grasp must be a function, got 5"):format(planner), function()
      clench.plan[planner] {hand = hand, object = object, on_grasp = 5, primitives = planner == "primitive" and list or nil}
    end)
  end
  fails("plan.primitive: thumb must be a vector {x, y, z}, got 5", function()
    clench.plan.primitive {hand = hand, object = object, primitives = list, thumb = 5}
  end)
  fails("test.run_file: path: expected a name, got true", function() test.run_file(true) end)
end)

test("a task that yields a value ends the run with the task's line", function(t)
  local other = clench.world {}
  for _, value in ipairs {5, "x", true, {}, {seconds = 1}, {seconds = math.huge}} do
    local line
    local task = other:spawn(function()
      line = debug.getinfo(1, "l").currentline + 1
      coroutine.yield(value)
    end)
    local message = t.fails(function() other:run(0.1) end, ": task of world:spawn: expected task.wait, task.wait_step, task.wait_until or a yield of nothing, got a yield of ")
    t.ok(message:find(("stdlib_junk_test.lua:%d: task"):format(line), 1, true), message)
    t.equal(task.status, "failed")
  end
  local times = {}
  local task = other:spawn(function()
    for _ = 1, 3 do
      times[#times + 1] = other.time
      coroutine.yield()
    end
  end)
  other:run(0.1)
  t.equal(task.status, "done")
  t.ok(times[1] < times[2] and times[2] < times[3])
end)

test("the state of an annealing in collision can be read", function(t)
  local other = clench.load "worlds/parallel_jaw_cube.wld"
  local held, body = other.robots[1], other.objects[1]
  body.pose = held.base.pose
  local search = clench.annealing {hand = held, object = body, energy = function() return 1 end, start = "hand", position = "complete"}
  t.equal(search.state.energy, search.energy)
  t.equal(search.energy, math.huge)
end)
