-- Every entry that calls a function of the script: the error if that function fails without a message, yields, or returns a wrong value.
local test = require "test"

local world_file = "worlds/dlr_flask.wld"
local scene

-- one world for all searches, which restore it
local function hand_and_object()
  scene = scene or clench.load(world_file)
  return scene.robots[1], scene.objects[1]
end

local function grasp_of_scene()
  local world = hand_and_object().world:clone()
  world.robots[1]:autograsp()
  return clench.grasp(world.robots[1], world.objects[1])
end

local function run(world) world:run(0.01) end

-- {name in messages, call(fn)}; `wrong`: message for a wrong value; `by_text`: called in another state, from its source
local entries = {
  {"function of world:on_step", function(fn)
    local world = clench.world()
    world:on_step(fn)
    run(world)
  end},
  {"listener of world:on 'contact'", function(fn)
    local world = clench.world {gravity = {0, 0, -9.81}}
    world:add_obstacle(clench.shapes.box {1, 1, 0.1}, {name = "floor", pose = {xyz = {0, 0, -0.05}}})
    world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "box", mass = 1, pose = {xyz = {0, 0, 0.051}}})
    world:on("contact", fn)
    world:run(0.1)
  end},
  {"task of world:spawn", function(fn)
    local world = clench.world()
    world:spawn(fn)
    run(world)
  end, yields = "expected task.wait, task.wait_step, task.wait_until or a yield of nothing, got a yield of 1"},
  {"condition of task.wait_until", function(fn)
    local world = clench.world()
    world:spawn(function(task) task.wait_until(fn) end)
    run(world)
  end},
  {"function 'x' of world:log", function(fn)
    local world = clench.world()
    world:log {quantities = {x = fn}}
    run(world)
  end, wrong = "world:log: x: expected a function that returns a number"},
  {"recording:each", function(fn)
    local world = clench.world()
    local recording = world:record {rate = 100}
    run(world)
    recording:each(fn)
  end},
  {"clench.log.sink", function(fn)
    clench.log.sink(fn)
    local back <close> = setmetatable({}, {__close = function() clench.log.sink() end})
    clench.log.error "a message"
  end},
  {"clench.log.debug: argument 1", function(fn)
    local level <close> = setmetatable({clench.log.level "debug"}, {__close = function(self) clench.log.level(self[1]) end})
    local sink <close> = setmetatable({clench.log.sink(function() end)}, {__close = function() clench.log.sink() end})
    clench.log.debug(setmetatable({}, {__tostring = fn}))
  end, wrong = "clench.log.debug: argument 1: expected a string from __tostring, got another value"},
  {"clench.json.encode: value.a: __json", function(fn) clench.json.encode {a = setmetatable({}, {__json = fn})} end,
    wrong = "clench.json.encode: value.a: expected a number, string, boolean, table or clench value, got a function"},
  {"clench.parallel.map: items[1]", function(fn)
    local results = clench.parallel.map(fn, {1})
    if results[1].error then error(results[1].error, 0) end
  end, wrong = "the result: a function cannot be copied to another state", by_text = true},
  {"clench.parallel.map: each", function(fn) clench.parallel.map(function(x) return x end, {1}, {each = fn}) end},
  {"energy", function(fn)
    local hand, object = hand_and_object()
    clench.annealing {hand = hand, object = object, energy = fn}
  end, wrong = "energy: expected a function that gives a number, got a function"},
  {"energy", function(fn)
    local hand, object = hand_and_object()
    clench.plan.anneal {hand = hand, object = object, steps = 5, energy = fn}
  end, wrong = "energy: expected a function that gives a number, got a function"},
  {"plan.sample: on_grasp", function(fn)
    local hand, object = hand_and_object()
    clench.plan.sample {hand = hand, object = object, count = 1, candidates = 8, refine = 0, threads = 1, on_grasp = fn}
  end},
  {"study.robustness: close", function(fn) clench.study.robustness(grasp_of_scene(), {samples = 1, position = 1e-4, close = fn}) end},
  {"callback.lua", function(fn)
    callback_of_file = fn
    local path = test.folder() .. "/callback.lua"
    clench.files.save_text(path, "callback_of_file()\nreturn callback_of_file()")
    local file <close> = setmetatable({}, {__close = function() callback_of_file = nil end})
    clench.load(path)
  end, wrong = "callback.lua: expected a script that returns a world, got a function"},
}

-- {name, fn, expected message}; the functions use no upvalues
local faults = {
  {"nil", function() error(nil) end, ": expected an error with a message, got nil"},
  {"an empty table", function() error {} end, ": expected an error with a message, got the table {}"},
  {"a table", function() error {code = 5} end, ": expected an error with a message, got the table {code = 5}"},
  {"false", function() error(false) end, ": expected an error with a message, got false"},
  {"a function", function() error(print) end, ": expected an error with a message, got a function"},
  {"a table that has no text", function() error(setmetatable({}, {__tostring = function() error(nil) end})) end,
    ": expected an error with a message, got a table whose __tostring fails"},
  {"a yield", function() coroutine.yield(1) end, ": expected a function that does not yield, got a yield", yields = true},
}

for _, entry in ipairs(entries) do
  local name, call = entry[1], entry[2]
  for _, fault in ipairs(faults) do
    test(("an error of %s is explained by '%s'"):format(fault[1], name), function(t)
      local said = fault.yields and entry.yields or name .. fault[3]
      local message = t.fails(function() call(fault[2]) end, said)
      if not entry.by_text then t.ok(message:find "callbacks_test.lua:%d+: ", "expected the line of the error, got " .. message) end
    end)
  end
  test(("an error of '%s' that has a message keeps it"):format(name), function(t)
    t.fails(function() call(function() error "the message" end) end, "the message")
  end)
  test(("a wrong value that '%s' returns is named"):format(name), function(t)
    local function call_with_value() call(function() return print end) end
    if entry.wrong then t.fails(call_with_value, entry.wrong) else call_with_value() end
  end)
end

test("the value of an error without a message is its cause", function(t)
  local world = clench.world()
  world:on_step(function() error {code = 5} end)
  local _, problem = pcall(run, world)
  t.equal(problem.cause, {code = 5})
end)

test("a callback of an engine call cannot yield in a coroutine", function(t)
  local world = clench.world()
  local recording = world:record {rate = 100}
  run(world)
  local thread = coroutine.create(function() recording:each(function() coroutine.yield() end) end)
  local _, problem = coroutine.resume(thread)
  t.ok(tostring(problem):find("recording:each: expected a function that does not yield, got a yield", 1, true))
end)
