--- The run of a world with functions of scripts: in each step controllers, then tasks, then the step, then listeners and observers.
local calls = require "clench.dynamics.hook_calls"
local explained = require "clench.explained"
local error_value = require "clench.error_value"
local described = require "clench.described"
local line_of = require "clench.line_of"
local raise = require "clench.raise"
local task_order = require "clench.dynamics.task_order"

local call, each, is_due, tiny = calls.call, calls.each, calls.is_due, calls.tiny

-- removes the handles that have ended
local function clear(list)
  if not list then return end
  local kept = 0
  for i = 1, #list do
    local handle = list[i]
    if handle.status == "waiting" then
      kept = kept + 1
      list[kept] = handle
    elseif handle.thread and handle.status == "removed" then
      coroutine.close(handle.thread)
    end
  end
  for i = #list, kept + 1, -1 do list[i] = nil end
end

-- Length of the next step, if no bodies collide in it: steps end at multiples of the time step, and with the run.
local function length_of_step(world, last)
  local time, step = world.time, world.time_step
  return math.min((math.floor(time / step + 1e-6) + 1) * step, last) - time
end

local function call_controllers(world, list, last)
  each(list, function(handle)
    if is_due(handle, world.time) then call(handle, world, math.max(handle.rate and 1 / handle.rate or 0, length_of_step(world, last))) end
  end)
end

-- May a task go on?   returns also the result of its wait
local function may_go_on(handle, time)
  local order = handle.order
  if not order then return true end
  if time < order.begun then order.begun = time end  -- the world was restored to an earlier time
  local over = time >= order.begun + order.seconds - tiny
  if not order.condition then return over end
  local ok, met = xpcall(order.condition, function(problem)
    return explained(problem, "condition of task.wait_until", debug.traceback("", 2):sub(2))
  end)
  if not ok then
    handle.status = "failed"
    error(met, 0)
  end
  return met and true or over, met and true or false
end

local function go_on(handle, world)
  local free, result = may_go_on(handle, world.time)
  if not free then return end
  local first = not handle.order
  local ok, order
  if first then ok, order = coroutine.resume(handle.thread, handle.task) else ok, order = coroutine.resume(handle.thread, result) end
  if not ok then
    handle.status = "failed"
    error(explained(order, handle.name, debug.traceback(handle.thread, "", 0):sub(2), line_of(handle.thread)), 0)
  end
  if coroutine.status(handle.thread) == "dead" then
    if handle.status == "waiting" then handle.status = "done" end
    return
  end
  -- a yield without values waits for the next step
  if order ~= nil and getmetatable(order) ~= task_order then
    handle.status = "failed"
    error(setmetatable({place = line_of(handle.thread), kind = "input",
      sentence = ("%s: expected task.wait, task.wait_step, task.wait_until or a yield of nothing, got a yield of %s"):format(
        handle.name, described(order))}, error_value), 0)
  end
  handle.order = order or {seconds = 0}
  handle.order.begun = world.time
end

local function tell(list, events)
  for _, event in ipairs(events) do
    each(list, function(handle)
      if handle.event == event.kind then call(handle, event) end
    end)
  end
end

---@param hooks table  of stdlib/dynamics/hooks.lua; 1: that of the engine
---@param world world
---@param seconds number
---@param stepping userdata
---@param step fun(stepping, last: number): boolean  makes a step that ends at `last` at the latest; returns false if no time is left
---@param events fun(stepping, own): table[]
return function(hooks, world, seconds, stepping, step, events)
  if hooks.runs then raise "world:run: the world is already running: functions called during a run cannot run it" end
  hooks.runs = true
  local running <close> = setmetatable({}, {__close = function()
    for _, name in ipairs {"controllers", "tasks", "listeners", "observers"} do clear(hooks[name]) end
    hooks.runs = nil
  end})
  calls.observers(world, hooks.observers)
  local last = world.time + seconds  -- an observer may have restored another time
  -- as in Stepper::step: shorter remainders are ignored
  while last - world.time > 1e-6 * world.time_step do
    local before = world.time
    call_controllers(world, hooks.controllers, last)
    each(hooks.tasks, function(handle) go_on(handle, world) end)
    -- if a task restored another time, the run continues from there for the rest of its length
    if world.time ~= before then last = last + (world.time - before) end
    local listens = hooks.listeners and #hooks.listeners > 0
    -- events from before the first listener are dropped
    if listens and not hooks.listened then events(stepping, hooks[1]) end
    hooks.listened = listens
    if not step(stepping, last) then break end
    before = world.time
    if listens then tell(hooks.listeners, events(stepping, hooks[1])) end
    calls.observers(world, hooks.observers)
    last = last + (world.time - before)
    if #(hooks.tasks or {}) > 64 then clear(hooks.tasks) end
  end
end
