--- The event loop of a script: coroutines that wait for times, descriptors and jobs. A host with a separate event loop polls `descriptor()` and then calls
--- `run(0)`. The loop uses the clock; tasks in simulated time belong to `world:spawn`.
local class = require "clench.class"
local clock = clench.clock
local described = require "clench.described"
local explained = require "clench.explained"
local has_jobs = require "clench.has_jobs"
local loop_task = require "clench.loop_task"
local line_of = require "clench.line_of"
local poller = require "clench.poller"()
local raise = require "clench.raise"
local new_queue = require "clench.time_queue"

local loop = {}
local ready = {}           -- tasks to resume, in order
local timed = new_queue()  -- tasks that wait for a time
local for_jobs = {}        -- tasks that wait for a job, by task: true
local waiting_count = 0    -- number of waiting tasks
local watches = {}         -- by descriptor: {readable = handles, writable = handles}
local count = 0            -- number of tasks created; orders tasks of equal times
local running, in_run, stop_asked = nil, false, false
local run  -- defined below

local Task = class "task of clench.loop"

function Task:__tostring() return ("task of clench.loop (%s)"):format(self.status) end

local function drop(task)
  if task.is_waiting then waiting_count = waiting_count - 1 end
  task.is_waiting = false
  timed:remove(task)
  for_jobs[task] = nil
  if task.watch then task.watch:remove() end
  task.at, task.job, task.watch = nil, nil, nil
end

--- Ends a waiting task.
function Task:remove()
  if self == running then self.is_removed = true end  -- at its next wait
  if self.status ~= "waiting" then return end
  drop(self)
  self.status = "removed"
  if self.thread then coroutine.close(self.thread) end
end

local Watch = class "watch of clench.loop"

function Watch:__tostring() return ("watch of descriptor %d"):format(self.descriptor) end

local function update(descriptor)
  local of = watches[descriptor]
  poller:watch(descriptor, #of.readable > 0, #of.writable > 0)
  if #of.readable + #of.writable == 0 then watches[descriptor] = nil end
end

--- Ends the watch.
function Watch:remove()
  if self.is_removed then return end  -- the number may belong to another descriptor by now
  self.is_removed = true
  local of = watches[self.descriptor]
  local list = of and of[self.event] or {}
  for i, watch in ipairs(list) do
    if watch == self then
      table.remove(list, i)
      update(self.descriptor)
      break
    end
  end
end

local function check_time(what, seconds)
  if type(seconds) ~= "number" or not (seconds >= 0 and seconds < math.huge) then
    raise(("loop.%s: expected a time >= 0 in seconds, got %s"):format(what, described(seconds)))
  end
end

local function check_function(what, f)
  if type(f) ~= "function" then raise(("loop.%s: expected a function, got %s"):format(what, described(f))) end
end

local function check_event(what, event)
  if event ~= nil and event ~= "readable" and event ~= "writable" then
    raise(("loop.%s: expected 'readable' or 'writable', got %s"):format(what, described(event)))
  end
  return event or "readable"
end

-- is_wait: the watch belongs to a waiting coroutine, which continues when the descriptor is released
local function add_watch(descriptor, event, f, is_wait)
  local watch = setmetatable({descriptor = descriptor, event = event, fn = f, is_wait = is_wait}, Watch)
  watches[descriptor] = watches[descriptor] or {readable = {}, writable = {}}
  local list = watches[descriptor][event]
  list[#list + 1] = watch
  local ok, problem = pcall(update, descriptor)
  if not ok then
    list[#list] = nil
    if #watches[descriptor].readable + #watches[descriptor].writable == 0 then watches[descriptor] = nil end
    error(problem, 0)
  end
  return watch
end

local function new_task(f, name)
  count = count + 1
  return setmetatable({status = "waiting", name = name, number = count, thread = coroutine.create(f)}, Task)
end

-- Makes the loop's descriptor readable, for hosts that poll it.
local function add_ready(task)
  ready[#ready + 1] = task
  if not in_run then poller:set_timer(0) end
end

local function wake(task, ...)
  drop(task)
  task.values = table.pack(...)
  add_ready(task)
end

--- Time of a monotonic clock.
---@return number  [s]
---@effect reads
--- > clench.loop.time() <= clench.loop.time()  --> true
function loop.time() return clock() end

--- Starts a function as a coroutine of the loop. It runs from the next `run` on.
---@param f function  function that runs as a coroutine of the loop
---@return table task # `status`: "waiting", "running", "done", "failed" or "removed"; `task:remove()` ends it
---@effect edits
--- > words = {}
--- > clench.loop.spawn(function() clench.loop.sleep(0.02) words[#words + 1] = "late" end)
--- > clench.loop.spawn(function() words[#words + 1] = "soon" end)
--- > clench.loop.run()
--- > words  --> {"soon", "late"}
function loop.spawn(f)
  check_function("spawn", f)
  local task = new_task(f, "function of loop.spawn")
  add_ready(task)
  return task
end

-- Yields from the calling coroutine until `task` is woken; returns the values of `wake`.
local function pause(task)
  task.is_waiting = true
  waiting_count = waiting_count + 1
  if task.at then timed:add(task, task.at, task.number) end
  if task.job then for_jobs[task] = true end
  return coroutine.yield(task)
end

-- the task whose coroutine is running; nil in other coroutines and outside of the loop
local function calling() return running and coroutine.running() == running.thread and running or nil end

--- Waits for a time. In a function of `spawn` other coroutines run meanwhile; elsewhere the loop runs.
---@param seconds number  [s]
---@effect long
--- > clench.loop.sleep(-1)  --> error: expected a time >= 0 in seconds, got -1
function loop.sleep(seconds)
  check_time("sleep", seconds)
  local task = calling()
  if task then
    task.at = clock() + seconds
    pause(task)
    return
  end
  local over = false
  local timer = loop.after(seconds, function() over = true end)
  local _ <close> = setmetatable({}, {__close = function() timer:remove() end})
  while not over do run(seconds, function() return over end) end
end

-- loop.wait outside of the loop's coroutines: runs the loop until job or descriptor is ready
local function wait_outside(what, is_job, last, event)
  local is_ready = false
  local watch = not is_job and add_watch(what, event, function() is_ready = true end, true)
  local _ <close> = setmetatable({}, {__close = function() if watch then watch:remove() end end})
  local function is_over()
    is_ready = is_ready or is_job and what:wait(0)
    return is_ready
  end
  while not is_over() do
    local left = last and last - clock()
    if left and left <= 0 then return false end
    run(left, is_over)
  end
  return true
end

--- Waits for the end of a job, or until a descriptor is ready. In a function of `spawn` other coroutines run meanwhile; elsewhere the loop runs.
---@param what job|integer  a job, or the descriptor of a socket, a pipe, a terminal or a device
---@param timeout? number  maximum waiting time [s]
---@param event? "readable"|"writable"  event of a descriptor, "readable" by default
---@return boolean ready  false: timeout
---@effect long
--- > job = clench.job(function() return 3 end)
--- > clench.loop.wait(job, 10), job:result()  --> true, 3
--- > job = clench.job(function() while true do end end)
--- > clench.loop.wait(job, 0.01)  --> false
--- > job:stop()
--- > clench.loop.wait("job")  --> error: expected a job or a descriptor, got 'job'
function loop.wait(what, timeout, event)
  local is_job = clench.type(what) == "job"
  if not is_job and math.type(what) ~= "integer" then
    raise(("loop.wait: expected a job or a descriptor, got %s"):format(described(what)))
  end
  if timeout ~= nil then check_time("wait", timeout) end
  event = check_event("wait", event)
  local task = calling()
  if not task then return wait_outside(what, is_job, timeout and clock() + timeout, event) end
  if is_job and what:wait(0) then return true end
  task.at = timeout and clock() + timeout
  if is_job then
    task.job = what
  else
    task.watch = add_watch(what, event, function() wake(task, true) end, true)
  end
  return pause(task) == true
end

local function add_timer(name, seconds, f, period)
  check_time(name, seconds)
  check_function(name, f)
  local task
  task = new_task(function()
    repeat
      loop.sleep(math.max(0, task.next - clock()))
      f()
      task.next = math.max(task.next + (period or 0), clock())
    until not period
  end, "function of loop." .. name)
  task.next = clock() + seconds
  add_ready(task)
  return task
end

--- Calls a function once, after a delay.
---@param seconds number  delay [s]
---@param f function  function to call
---@return table task # `task:remove()` ends it
---@effect edits
--- > clench.loop.after(0.01, function() late = true end)
--- > clench.loop.run()
--- > late  --> true
function loop.after(seconds, f) return add_timer("after", seconds, f) end

--- Calls a function periodically.
---@param seconds number  period, and delay before the first call [s]
---@param f function  function to call
---@return table task # `task:remove()` ends it
---@effect edits
--- > calls = 0
--- > timer = clench.loop.every(0.01, function() calls = calls + 1 end)
--- > clench.loop.run(0.2)
--- > timer:remove()
--- > calls > 1  --> true
function loop.every(seconds, f)
  check_time("every", seconds)
  if seconds == 0 then raise "loop.every: expected a time > 0, got 0" end
  return add_timer("every", seconds, f, seconds)
end

--- Calls a function whenever a descriptor is ready.
---@param descriptor integer  descriptor of a socket, a pipe, a terminal or a device
---@param f fun(descriptor: integer)  called with the descriptor when it is ready
---@param event? "readable"|"writable"  event, "readable" by default
---@return table watch # `watch:remove()` ends it
---@effect edits
--- > clench.loop.on(-1, print)  --> error: expected a descriptor >= 0, got -1
--- > clench.loop.on(99999, print)  --> error: descriptor 99999 is not open
function loop.on(descriptor, f, event)
  if math.type(descriptor) ~= "integer" then raise(("loop.on: expected a descriptor, got %s"):format(described(descriptor))) end
  check_function("on", f)
  event = check_event("on", event)
  return add_watch(descriptor, event, f)
end

--- Ends all watches of a descriptor, to be called before it is closed. Coroutines that wait for it continue as if it were ready.
---@param descriptor integer  descriptor of a socket, a pipe, a terminal or a device
---@effect edits
--- > clench.loop.release(5)
--- > clench.loop.release "5"  --> error: expected a descriptor, got '5'
function loop.release(descriptor)
  if math.type(descriptor) ~= "integer" then raise(("loop.release: expected a descriptor, got %s"):format(described(descriptor))) end
  local of = watches[descriptor]
  for _, event in ipairs {"readable", "writable"} do
    for _, watch in ipairs(of and {table.unpack(of[event])} or {}) do
      if watch.is_wait then watch.fn(descriptor) end
      watch:remove()
    end
  end
end

--- The descriptor of the loop: readable if a time has come, a descriptor is ready, or a job has news. A host with a separate event loop polls it and calls
--- `run(0)`.
---@return integer
---@effect reads
--- > math.type(clench.loop.descriptor())  --> integer
function loop.descriptor() return poller:descriptor() end

--- Makes `run` return.
---@effect edits
--- > clench.loop.spawn(function() clench.loop.stop() end)
--- > clench.loop.run()
function loop.stop() stop_asked = true end

-- wakes, in order of time and number, tasks whose time has come or whose job has ended
local function wake_due()
  local now, due = clock(), {}
  for task in pairs(for_jobs) do
    if task.job:wait(0) then due[#due + 1] = {task = task, over = true, at = math.min(task.at or now, now)} end
  end
  for _, item in ipairs(due) do timed:remove(item.task) end
  repeat
    local task, at = timed:take(now)
    due[#due + 1] = task and {task = task, over = false, at = at}
  until not task
  table.sort(due, function(a, b)
    if a.at ~= b.at then return a.at < b.at end
    return a.task.number < b.task.number
  end)
  for _, item in ipairs(due) do wake(item.task, item.over) end
end

local function resume(task)
  if task.status ~= "waiting" then return end
  local before = running
  running, task.status, loop_task.thread = task, "running", task.thread
  local values = task.values or table.pack()
  task.values = nil
  local ok, problem = coroutine.resume(task.thread, table.unpack(values, 1, values.n))
  running, loop_task.thread = before, before and before.thread
  if not ok then
    task.status = "failed"
    error(explained(problem, task.name, debug.traceback(task.thread, "", 0):sub(2), line_of(task.thread)), 0)
  end
  if coroutine.status(task.thread) == "dead" then
    task.status = "done"
    return
  end
  task.status = "waiting"
  if task.is_removed then return task:remove() end
  -- a yield without values waits for the next round
  if problem ~= task then wake(task) end
end

local function call_watches(descriptor, event)
  local of = watches[descriptor]
  for _, watch in ipairs(of and {table.unpack(of[event])} or {}) do
    if not watch.is_removed then watch.fn(descriptor) end
  end
end

local function has_work() return #ready > 0 or waiting_count > 0 or next(watches) ~= nil or has_jobs() end

-- One round: resumes ready tasks, then waits at most `patience` seconds for events.
local function round(patience)
  wake_due()
  local now_ready = ready
  ready = {}
  for i, task in ipairs(now_ready) do
    local ok, problem = pcall(resume, task)
    if not ok or stop_asked then
      -- tasks that were not resumed precede those that became ready meanwhile
      local later = ready
      ready = table.move(now_ready, i + 1, #now_ready, 1, {})
      table.move(later, 1, #later, #ready + 1, ready)
    end
    if not ok then error(problem, 0) end
    if stop_asked then return end
  end
  if #ready > 0 then patience = 0 end
  local first = timed:first_time()
  if first then patience = math.min(patience, math.max(0, first - clock())) end
  local events = poller:wait(patience)
  for i = 1, #events, 2 do call_watches(events[i], events[i + 1]) end
  wake_due()
end

-- The descriptor becomes readable when the next task is due.
local function arm()
  local first = timed:first_time()
  poller:set_timer(#ready > 0 and 0 or first and math.max(0, first - clock()) or -1)
end

-- as loop.run, or until is_over() returns true
function run(seconds, is_over)
  if in_run then raise "loop.run: the loop runs already" end
  in_run, stop_asked = true, false
  local _ <close> = setmetatable({}, {__close = function()
    in_run = false
    arm()
  end})
  local last = seconds and clock() + seconds
  repeat
    local left = last and last - clock() or math.huge
    round(left > 0 and math.min(left, 3600) or 0)
  until stop_asked or last and clock() >= last or is_over and is_over() or not has_work()
end

--- Runs the loop until nothing is left to wait for, until a time limit, or until `stop`. An error of a coroutine ends the call; the other coroutines continue
--- at the next call. Unfinished jobs of the script count as something to wait for.
---@param seconds? number  time limit, 0 to run what is ready without waiting [s]
---@effect long
--- > clench.loop.run(0)
--- > clench.loop.run "1"  --> error: expected a time >= 0 in seconds, got '1'
function loop.run(seconds)
  if seconds ~= nil then check_time("run", seconds) end
  run(seconds)
end

return loop
