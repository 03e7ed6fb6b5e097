-- Functions that run in parallel to the script: their states, results, events and ends.
local test, clench, show = require "test", require "clench", require "clench.show"

local function scene()
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  return world, world.robots[1], world.objects[1]
end

test("a job returns the results of its function, and all its events in order", function(t)
  local job = clench.job(function(n, word)
    local clench = require "clench"
    for i = 1, n do
      clench.this_job:event(i)
      clench.this_job:show {square = i * i}
    end
    return word, nil, n
  end, {args = {500, "done"}, name = "count"})
  t.equal(tostring(job):match "^job 'count', ", "job 'count', ")
  local events = {}
  while not job:wait(0.001) do for _, event in ipairs(job:events()) do events[#events + 1] = event end end
  for _, event in ipairs(job:events()) do events[#events + 1] = event end
  t.equal(#events, 500)
  for i = 1, 500 do t.equal(events[i], i) end
  t.equal(table.pack(job:result()), {n = 3, "done", nil, 500})
  t.equal(table.pack(job:result()), {n = 3, "done", nil, 500})  -- again
  t.equal(job.snapshot, {square = 250000})
  t.equal(job.state, "done")
  job:stop()
  t.equal(job.state, "done")  -- a finished job stays as it is
end)

test("a job works on copies, and gives results bit-identical to the script's", function(t)
  local world, hand, mug = scene()
  local before = world:hash()
  local job = clench.job(function(h, m)
    h:autograsp()
    return h.dofs, #h.world:contacts(h, m), h.world == m.world
  end, {args = {hand, mug}})
  local together = clench.job(function(scene)
    scene.hand:autograsp()
    return scene.hand.world == scene.mug.world, scene.hand.dofs
  end, {args = {{hand = hand, mug = mug}}})
  t.ok(job:wait(30) and together:wait(30))
  local shared = clench.job(function(h)
    local s = require("clench").this_job.shared
    return s.mug.world == h.world, s.word
  end, {args = {hand}, shared = {mug = mug, word = "both"}})
  t.ok(shared:wait(30))
  t.equal({shared:result()}, {true, "both"})
  local dofs = job:result()
  t.equal(world:hash(), before)
  local same, dofs_of_other = together:result()
  t.ok(same)  -- objects of one argument stay in one world
  hand:autograsp()
  t.equal(dofs_of_other, hand.dofs)
  t.equal(#dofs, #hand.dofs)
end)

test("errors of a job are raised when its result is requested", function(t)
  local job = clench.job(function() error "no luck" end, {name = "lottery"})
  job:wait(10)
  t.equal(job.state, "failed")
  t.fails(function() job:result() end, "job 'lottery'", "no luck")
  job = clench.job(function() require("clench").load "no/such.wld" end)
  job:wait(10)
  local ok, problem = pcall(job.result, job)
  t.ok(not ok)
  t.equal(problem.kind, "file")
  job = clench.job(function() error(42) end)
  job:wait(10)
  t.fails(function() job:result() end, "42")
  job = clench.job(function() return print end)
  job:wait(10)
  t.fails(function() job:result() end, "result 1: a function cannot be copied to another state")
  local outside = 1
  t.fails(function() clench.job(function() return outside end) end, "clench.job: function: it uses 'outside' of the lines around it")
  t.fails(function() clench.job(3) end, "task: expected a function or a module's name, got 3")
  t.fails(function() clench.job(function() end, {arg = {1}}) end, "unknown key 'arg'", "did you mean 'args'?")
  t.fails(function() clench.job(function() end, {args = {print}}) end, ".args[1]: a function cannot be copied to another state")
  t.fails(function() clench.job(function() end, {args = {hand = 3}}) end, "args: expected a list of arguments in their order, got the key 'hand'")
  job = clench.job(function(...) return select("#", ...) end, {args = table.pack(1, nil, nil)})
  job:wait(10)
  t.equal(job:result(), 3)
  t.fails(function() clench.job(function() end, {args = 3}) end, "args: expected a list, got 3")
  job = clench.job "no.such.module"
  job:wait(10)
  t.equal(job.state, "failed")
  t.fails(function() job:result() end, "no.such.module")
  t.equal(clench.this_job, nil)
end)

test("a job is stopped at once in any kind of work", function(t)
  local _, hand, mug = scene()
  local busy = {
    function() while true do end end,
    function() while true do pcall(function() while true do end end) end end,
    function() coroutine.wrap(function() while true do end end)() end,
    function() if debug.sethook then debug.sethook() end while true do end end,
    function(h, m) require("clench").plan.sample {hand = h, object = m, count = 1000000} end,
    function(h) h.world:run(1e6) end,
    function() require("clench").loop.sleep(1e6) end,
  }
  for i, f in ipairs(busy) do
    local job = clench.job(f, {args = {{hand = hand, mug = mug}}})
    if i == 5 then job = clench.job(function(s) return require("clench").plan.sample {hand = s.hand, object = s.mug, count = 1000000} end, {args = {{hand = hand, mug = mug}}}) end
    if i == 6 then job = clench.job(function(h) h.world:run(1e5) end, {args = {hand}}) end
    while job.state == "queued" do clench.loop.sleep(0.005) end
    clench.loop.sleep(0.05)
    t.equal(job.state, "running", i)
    local began = clench.clock()
    job:stop()
    t.ok(job:wait(20), i)
    t.equal(job.state, "stopped", i)
    t.fails(function() job:result() end, "was stopped")
  end
end)

test("a paused job waits", function(t)
  local job = clench.job(function()
    local clench = require "clench"
    while true do clench.this_job:event(1) end
  end)
  while #job:events() == 0 do end
  job:pause()
  t.equal(job.state, "paused")
  clench.loop.sleep(0.05)
  job:events()
  clench.loop.sleep(0.05)
  t.equal(#job:events(), 0)
  job:resume()
  clench.loop.sleep(0.05)
  t.ok(#job:events() > 0)
  job:pause()
  job:stop()
  t.ok(job:wait(10))
  t.equal(job.state, "stopped")
end)

test("a paused job leaves its core to queued ones, and takes one when it continues", function(t)
  local paused = {}
  for i = 1, clench.parallel.cores + 2 do
    paused[i] = clench.job(function() while true do end end)
    paused[i]:pause()
  end
  local job = clench.job(function() return 5 end)
  t.ok(job:wait(20))
  t.equal(job:result(), 5)
  for _, other in ipairs(paused) do
    other:resume()
    other:stop()
  end
  for _, other in ipairs(paused) do
    t.ok(other:wait(20))
    t.equal(other.state, "stopped")
  end
end)

test("progress of a job is a value", function(t)
  local job = clench.job(function()
    local clench = require "clench"
    local p <close> = clench.progress(4, "halves")
    p:step(2)
    clench.this_job:event "there"
    while true do end
  end)
  while #job:events() == 0 do end
  t.equal(job.progress, {fraction = 0.5, text = "halves"})
  job:stop()
end)

test("more jobs than cores are queued, jobs of jobs do not block them, and unreferenced ones continue", function(t)
  local jobs, sum = {}, 0
  for i = 1, 12 do
    jobs[i] = clench.job(function(n)
      local clench = require "clench"
      local inner = clench.job(function(x) return x * x end, {args = {n}})
      inner:wait()
      return (inner:result())
    end, {args = {i}})
  end
  for i = 1, 12 do
    t.ok(jobs[i]:wait(60))
    sum = sum + jobs[i]:result()
  end
  t.equal(sum, 650)
  -- a job that waits for its own job is stopped while others hold all cores
  local waits = clench.job(function()
    local clench = require "clench"
    clench.job(function() while true do end end):wait()
  end)
  while waits.state == "queued" do clench.loop.sleep(0.005) end
  clench.loop.sleep(0.05)
  local busy = {}
  for i = 1, 20 do busy[i] = clench.job(function() while true do end end) end
  clench.loop.sleep(0.1)
  waits:stop()
  t.ok(waits:wait(20))
  t.equal(waits.state, "stopped")
  for i = 1, 20 do busy[i]:stop() end
  for i = 1, 20 do t.ok(busy[i]:wait(20)) end
  local path = test.path()
  clench.job(function(name)
    local file <close> = io.open(name, "w")
    file:write "written"
  end, {args = {path}})
  collectgarbage()
  clench.loop.run(20)  -- until no job is left
  local file <close> = io.open(path)
  t.equal(file:read "a", "written")
end)

test("a program ends whatever its jobs do", function(t)
  local log = test.path ".log"
  os.execute(("readlink /proc/$PPID/exe > '%s'"):format(log))
  local file <close> = io.open(log)
  local program = file:read "l"
  local endless = "local clench = require 'clench' for i = 1, 6 do clench.job(function() while true do end end) end clench.loop.sleep(0.1) "
  local stuck = "local clench = require 'clench' clench.job(function() local s = ('a'):rep(30) return s:find(('a?'):rep(30) .. s) end) clench.loop.sleep(0.1) "
  for _, case in ipairs {{endless, 0}, {endless .. "os.exit(4)", 4}, {endless .. "os.exit(4, true)", 4}, {endless .. "error 'end'", 1}, {stuck, 0}} do
    local script = test.path(".lua", case[1])
    local _, _, code = os.execute(("timeout -s KILL 60 '%s' run '%s' 2> /dev/null"):format(program, script))
    t.equal(code, case[2], case[1])
  end
end)

test("a stopped job that catches the stop of the engine cannot let it work again", function(t)
  local job = clench.job(function()
    local clench = require "clench"
    clench.this_job:event "begins"
    while true do
      -- each call lasts many seconds
      local ok, problem = pcall(clench.render, clench.world(), {size = {4000, 4000}, samples = 60})
      if not ok and problem.kind ~= "stopped" then error(problem, 0) end
    end
  end)
  while #job:events() == 0 do clench.loop.sleep(0.01) end
  clench.loop.sleep(0.2)
  job:stop()
  local began = clench.clock()
  t.ok(job:wait(60))
  t.equal(job.state, "stopped")
  t.ok(clench.clock() - began < 10)
end)

test("a program is read while a job reads another one", function(t)
  local mark = test.path()
  local job = clench.job(function(name) return assert(io.popen(("echo on > '%s'; sleep 60"):format(name))):read "a" end, {args = {mark}})
  local last = clench.clock() + 30
  repeat
    clench.loop.sleep(0.05)  -- the job is reading soon after its program has begun
    local file <close> = io.open(mark)
  until file or clench.clock() > last
  clench.loop.sleep(0.2)
  local began = clench.clock()
  t.equal(assert(io.popen "echo yes"):read "a", "yes\n")
  t.ok(clench.clock() - began < 20)
  t.fails(function() io.popen("true", "x") end, "bad argument #2 to 'popen' (invalid mode)")
  job:stop()
  t.ok(job:wait(30))
end)

test("stopping a job ends the programs that it waits for", function(t)
  local function is_alive(mark)
    local file <close> = assert(io.popen "ps -ww -eo args")
    local lines = 0
    for line in file:lines() do
      lines = lines + 1
      if line:find(mark, 1, true) and not line:find "ps -ww" then return true end
    end
    t.ok(lines > 1, "ps shows no processes")
    return false
  end
  local mark = ("sleep 60.0%d"):format(os.time() % 100000)
  local waits = clench.job(function(command) return os.execute(command) end, {args = {mark .. "; true"}})
  local reads = clench.job(function(command) return assert(io.popen(command)):read "a" end, {args = {mark .. "; true"}})
  local function told(job)
    if job.state == "running" or job.state == "queued" then return job.state end
    return job.state .. ": " .. show(table.pack(pcall(job.result, job)), 300)
  end
  local last = clench.clock() + 30
  while not is_alive(mark) do
    t.ok(clench.clock() < last, ("no program was seen; %s; %s"):format(told(waits), told(reads)))
    clench.loop.sleep(0.01)
  end
  local began = clench.clock()
  waits:stop()
  reads:stop()
  t.ok(waits:wait(30) and reads:wait(30))
  t.ok(clench.clock() - began < 30)
  t.equal(waits.state .. reads.state, "stoppedstopped")
  t.equal(is_alive(mark), false)
end)

test("threads of jobs and of maps have a lower priority than the script on request", function(t)
  local function nice()
    local fields = {}
    for word in io.open "/proc/thread-self/stat":read "a":match "%) (.*)":gmatch "%S+" do fields[#fields + 1] = word end
    return math.tointeger(tonumber(fields[17]))
  end
  local own = nice()
  if own > 9 then t.skip "the tests themselves run at a higher niceness" end
  t.equal(clench.parallel.nice(10), 10)
  t.equal(clench.parallel.map(nice, {1})[1], 10)
  local inside = clench.job(nice)
  inside:wait(30)
  t.equal(inside:result(), 10)
  t.equal(clench.parallel.nice(0), 0)
  t.equal(nice(), own)
end)
