--- Functions that take part in a world's runs: functions called at steps, tasks and listeners, each called in order of creation.
local class = require "clench.class"
local raise = require "clench.raise"
local descriptions = require "clench.signature.descriptions"
local fitting = require "clench.signature.fitting"
local read_options = require "clench.options"
local described = require "clench.described"
local task_order = require "clench.dynamics.task_order"
local hooks = {}

local Handle = class "handle"

function Handle:__tostring() return ("%s (%s)"):format(self.name, self.status) end

-- takes it out of its list, with what its function holds
local function release(self)
  local list = self.set[self.list]
  for i, handle in ipairs(list) do
    if handle == self then table.remove(list, i) break end
  end
  if self.thread then coroutine.close(self.thread) end
end

--- Ends it, even while it runs.
function Handle:remove()
  if self.status ~= "waiting" then return end
  self.status = "removed"
  if not self.set.runs then release(self) end  -- otherwise the run does
end

local function check_function(subject, fn)
  if type(fn) ~= "function" then raise(("%s: expected a function, got %s"):format(subject, described(fn))) end
end

local function add(set, list, handle)
  handle.status, handle.set, handle.list = "waiting", set, list
  set[list] = set[list] or {}
  table.insert(set[list], setmetatable(handle, Handle))
  return handle
end

function hooks.on_step(set, fn, options)
  check_function("world:on_step", fn)
  local read = read_options("world:on_step", options or {})
  local rate = read:get "rate"
  read:done()
  return add(set, "controllers", {name = "function of world:on_step", fn = fn, rate = rate})
end

--- As on_step, but called before the first step and after each step.
function hooks.observe(set, fn, rate) return add(set, "observers", {name = "observer", fn = fn, rate = rate}) end

function hooks.on(set, event, fn)
  -- the names in messages are those of world:on
  local fault = fitting.fault(descriptions.of "world:on".parameters[1], event)
  if fault then raise(("world:on: event must be %s, got %s"):format(fault, described(event))) end
  check_function("world:on", fn)
  return add(set, "listeners", {name = ("listener of world:on '%s'"):format(event), fn = fn, event = event})
end

-- the functions of a task, which may be called only in its coroutine
local function new_task(handle)
  local task = {}
  local function pause(what, order)
    if coroutine.running() ~= handle.thread then raise(("task.%s: expected to be called in the task's own function"):format(what)) end
    return coroutine.yield(setmetatable(order, task_order))
  end
  local function check_time(what, seconds)
    if type(seconds) ~= "number" or not (seconds >= 0 and seconds < math.huge) then
      raise(("task.%s: expected a time >= 0 in seconds, got %s"):format(what, described(seconds)))
    end
  end
  function task.wait(seconds)
    check_time("wait", seconds)
    pause("wait", {seconds = seconds})
  end
  function task.wait_step() pause("wait_step", {seconds = 0}) end
  function task.wait_until(condition, timeout)
    check_function("task.wait_until", condition)
    if timeout ~= nil then check_time("wait_until", timeout) end
    return pause("wait_until", {condition = condition, seconds = timeout or math.huge})
  end
  return task
end

function hooks.spawn(set, fn)
  check_function("world:spawn", fn)
  local handle = add(set, "tasks", {name = "task of world:spawn"})
  handle.thread = coroutine.create(fn)
  handle.task = new_task(handle)
  return handle
end

--- Implemented in stdlib/dynamics/log.lua and recording.lua.
function hooks.log(set, options, _, world) return require "clench.dynamics.log"(hooks, set, options, world) end
function hooks.record(set, options, _, world) return require "clench.dynamics.recording"(hooks, set, options or {}, world) end

function hooks.push(set, _, _, world)
  set.stack = set.stack or {}
  table.insert(set.stack, world:snapshot())
  return #set.stack
end

function hooks.pop(set, _, _, world)
  local stack = set.stack or {}
  local last = table.remove(stack)
  if not last then raise "world:pop: the stack is empty" end
  world:restore(last)
  return #stack
end

return hooks
