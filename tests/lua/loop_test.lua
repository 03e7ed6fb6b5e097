-- The event loop: coroutines that wait, their order and their ends.
local test, clench = require "test", require "clench"
local loop = clench.loop

test("coroutines wait for times, in order", function(t)
  local order = {}
  loop.spawn(function() order[#order + 1] = "a" loop.sleep(0.06) order[#order + 1] = "d" end)
  loop.spawn(function() order[#order + 1] = "b" loop.sleep(0.03) order[#order + 1] = "c" end)
  t.equal(order, {})
  loop.run()
  t.equal(table.concat(order), "abcd")
  -- equal times: in the order of creation
  order = {}
  for i = 1, 20 do loop.spawn(function() loop.sleep(0) order[#order + 1] = i coroutine.yield() order[#order + 1] = i end) end
  loop.run()
  for i = 1, 40 do t.equal(order[i], (i - 1) % 20 + 1) end
end)

test("a time queue returns its items in the order of times and numbers, also after removals", function(t)
  local queue, random, left = require "clench.time_queue"(), clench.random(5), {}
  local function check(now)
    local expected = {}
    for thing, at in pairs(left) do
      if at <= now then expected[#expected + 1] = {thing = thing, at = at} end
    end
    table.sort(expected, function(a, b) return a.at < b.at or a.at == b.at and a.thing < b.thing end)
    for _, item in ipairs(expected) do
      t.equal(queue:first_time(), item.at)
      t.equal(table.pack(queue:take(now)), {n = 2, item.thing, item.at})
      left[item.thing] = nil
    end
    t.equal(queue:take(now), nil)
  end
  for number = 1, 2000 do
    left[number] = random:integer(number // 10, number // 10 + 60)
    queue:add(number, left[number], number)
    if random:integer(1, 3) == 1 then
      local other = random:integer(1, number)
      queue:remove(other)
      left[other] = nil
    end
    if number % 50 == 0 then check(number // 10) end
  end
  check(math.huge)
  t.equal(queue:first_time(), nil)
end)

test("the cost of waiting grows at most linearly with the number of coroutines, for any times", function(t)
  local function cost(count)
    local random, began = clench.random(1), os.clock()
    for _ = 1, count do
      local seconds = 0.02 * random:uniform()
      loop.spawn(function() loop.sleep(seconds) end)
    end
    loop.run()
    return os.clock() - began
  end
  local few = math.min(cost(1000), cost(1000))
  t.ok(cost(10000) < 40 * few)  -- ten times as many; a factor of 100 if each turn visits all
end)

test("run ends in time, when it is stopped, and when nothing is left", function(t)
  local began = loop.time()
  loop.run(10)
  t.ok(loop.time() - began < 5)
  local count = 0
  local timer = loop.every(0.005, function() count = count + 1 end)
  loop.run(0.1)
  t.ok(count >= 2, count)
  t.equal(timer.status, "waiting")
  loop.after(0.02, loop.stop)
  loop.run()
  local before = count
  timer:remove()
  t.equal(timer.status, "removed")
  loop.run(0.05)
  t.equal(count, before)
  loop.run(0)
end)

test("sleep and wait run the loop if called outside of its coroutines", function(t)
  local heard = false
  loop.spawn(function() loop.sleep(0.01) heard = true end)
  local began = loop.time()
  loop.sleep(0.05)
  t.ok(heard and loop.time() - began >= 0.05)
  local job = clench.job(function() while true do end end)
  t.equal(loop.wait(job, 0.02), false)
  job:stop()
  t.equal(loop.wait(job, 20), true)
end)

test("a coroutine waits for jobs", function(t)
  local said = {}
  for i = 1, 3 do
    local job = clench.job(function(n) return n end, {args = {i}})
    loop.spawn(function()
      t.ok(loop.wait(job))
      said[i] = job:result()
    end)
  end
  loop.run(60)
  t.equal(said, {1, 2, 3})
end)

test("a coroutine that removes itself ends at its next wait", function(t)
  local task, went_on
  task = loop.spawn(function()
    task:remove()
    loop.sleep(0)
    went_on = true
  end)
  loop.run()
  t.equal(went_on, nil)
  t.equal(task.status, "removed")
end)

test("an error of a coroutine names it and its line, and the others continue", function(t)
  local after = false
  local broken = loop.spawn(function() loop.sleep(0) error "broken" end)
  loop.spawn(function() loop.sleep(0.01) after = true end)
  t.fails(function() loop.run() end, "loop_test.lua:", "broken", "in a function of loop.spawn")
  t.equal(broken.status, "failed")
  loop.run()
  t.ok(after)
  loop.spawn(function() loop.run() end)
  t.fails(function() loop.run() end, "loop.run: the loop runs already")
  loop.spawn(function() error {} end)
  t.fails(function() loop.run() end, "expected an error with a message, got the table {}")
end)

test("arguments of the loop are checked", function(t)
  t.fails(function() loop.spawn(3) end, "loop.spawn: expected a function, got 3")
  t.fails(function() loop.sleep(0 / 0) end, "loop.sleep: expected a time >= 0 in seconds, got nan")
  t.fails(function() loop.wait(1.5) end, "loop.wait: expected a job or a descriptor, got 1.5")
  t.fails(function() loop.wait(0, 1, "both") end, "expected 'readable' or 'writable', got 'both'")
  t.fails(function() loop.wait(99999, 1) end, "descriptor 99999 is not open")
  t.fails(function() loop.every(0, print) end, "expected a time > 0, got 0")
  t.fails(function() loop.after(1) end, "loop.after: expected a function, got nothing")
  t.fails(function() loop.on(1, print, 2) end, "expected 'readable' or 'writable', got 2")
  t.fails(function() loop.on(loop.descriptor(), print) end, "is the loop's own")
  t.fails(function() loop.run(-1) end, "loop.run: expected a time >= 0 in seconds, got -1")
end)
