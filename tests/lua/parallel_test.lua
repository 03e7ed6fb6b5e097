-- Work in many threads: values that can be passed, values that cannot, and results that do not depend on threads.
local test, clench = require "test", require "clench"

test("results are in the order of their items, with any number of threads", function(t)
  local items = {}
  for i = 1, 40 do items[i] = i end
  local function work(x) return {x * x, math.random(1000000)} end
  local one, failed = clench.parallel.map(work, items, {threads = 1})
  t.equal(failed, 0)
  for i = 1, 40 do t.equal(one[i][1], i * i) end
  for _, threads in ipairs {2, 7, 100} do
    local again = clench.parallel.map(work, items, {threads = threads})
    t.equal(clench.json.encode(again), clench.json.encode(one))
  end
  t.equal(#clench.parallel.map(work, {}), 0)
end)

test("values are passed unchanged", function(t)
  local values = {true, 7, -0.1, "a\0b", {x = {y = 1}}, clench.vec3(1, 2, 3), clench.pose {xyz = {1, 2, 3}, rpy = {1, 0, 0}}}
  local back = clench.parallel.map(function(x) return x end, values)
  for i = 1, 4 do t.ok(back[i] == values[i] and math.type(back[i]) == math.type(values[i])) end
  t.equal(back[5].x.y, 1)
  t.ok(back[6] == values[6] and back[7] == values[7])
end)

test("worlds, robots, meshes, snapshots and grasps are passed as copies", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  hand:autograsp()
  local grasp = clench.grasp(hand, flask)
  local before = world:hash()
  local got = clench.parallel.map(function(item)
    local same = item.hand.world:hash()
    item.hand:open()
    item.world:restore(item.moment)
    local again = item.grasp:apply(item.world)
    return {hash = same, epsilon = again:quality "epsilon", triangles = item.mesh.triangle_count, grasp = again,
            one_world = item.hand.world == item.world and item.flask.world == item.world}
  end, {{world = world, hand = hand, flask = flask, mesh = flask.mesh, moment = world:snapshot(), grasp = grasp}})[1]
  t.equal(got.error, nil)
  t.equal(got.hash, before)
  t.equal(got.epsilon, grasp:quality "epsilon")
  t.equal(got.triangles, flask.mesh.triangle_count)
  t.ok(got.one_world)
  t.equal(got.grasp.epsilon, grasp.epsilon)
  t.equal(world:hash(), before)
end)

test("every item gets the shared worlds in their original state", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand = world.robots[1]
  local function work(_, shared)
    local before = shared.hand.world:hash()
    shared.hand:autograsp()
    return before
  end
  for _, before in ipairs(clench.parallel.map(work, {1, 2, 3, 4}, {threads = 2, shared = {hand = hand}})) do
    t.equal(before, world:hash())
  end
end)

test("an error is a row, and the other items are completed", function(t)
  local results, failed = clench.parallel.map(function(x)
    if x == 2 then error "bad two" end
    if x == 3 then error {} end
    if x == 4 then return print end
    return x
  end, {1, 2, 3, 4, 5})
  t.equal(failed, 3)
  t.equal(results[1], 1)
  t.ok(results[2].error:find "bad two")
  t.equal(results[2].kind, nil)
  t.ok(results[3].error:find "table")
  t.ok(results[4].error:find "the result: a function cannot be copied to another state")
  t.equal(results[4].kind, "input")
  t.equal(results[5], 5)
end)

test("values that cannot be passed are rejected in one sentence", function(t)
  local outside = 1
  t.fails(function() clench.parallel.map(function() return outside end, {1}) end, "it uses 'outside' of the lines around it")
  t.fails(function() clench.parallel.map(print, {1}) end, "expected one written in Lua")
  t.fails(function() clench.parallel.map(3, {1}) end, "a function or a module's name")
  t.fails(function() clench.parallel.map("no_such_module", {1}) end, "no_such_module")
  t.fails(function() clench.parallel.map("clench.stats", {1}) end, "expected one that returns a function")
  local function id(x) return x end
  t.fails(function() clench.parallel.map(id, {{close = print}}) end, "items[1].close: a function cannot be copied to another state")
  t.fails(function() clench.parallel.map(id, 5) end, "items: expected a list")
  t.fails(function() clench.parallel.map(id, {1}, {threads = 0}) end, "threads must be 1 to 1024, got 0")
  t.fails(function() clench.parallel.map(id, {1}, {thread = 2}) end, "unknown key 'thread'")
  local cycle = {}
  cycle.self = cycle
  t.fails(function() clench.parallel.map(id, {cycle}) end, "more than 100 deep")
end)

test("each is called in order, and its error ends the rest", function(t)
  local seen = {}
  clench.parallel.map(function(x) return x end, {5, 6, 7}, {each = function(result, i) seen[i] = result end})
  t.equal(table.concat(seen, " "), "5 6 7")
  t.fails(function()
    clench.parallel.map(function(x) return x end, {5, 6, 7}, {each = function() error "enough" end})
  end, "enough")
end)

test("states share the memory limit of the caller", function(t)
  local file = io.open "/proc/meminfo"
  local total = file and file:read "a":match "MemTotal:%s+(%d+) kB"
  if file then file:close() end
  if not total then t.skip "the machine does not say how much memory it has" end
  local half = tonumber(total) * 1024 // 2  -- less than the limit of three quarters for one, more than each of two
  local results, failed = clench.parallel.map(function(size) return #(io.tmpfile():read(size) or "") end, {half, half}, {threads = 2})
  t.equal(failed, 2)
  for _, result in ipairs(results) do t.ok(result.error:find("not enough memory", 1, true), result.error) end
end)

test("maps within maps and jobs share the cores, with the same results at any number of threads", function(t)
  local function outer(i, shared)
    local function inner(x) return {x * x, math.random(1000000)} end
    local items = {}
    for k = 1, 5 do items[k] = 10 * i + k end
    local results = require("clench").parallel.map(inner, items, {threads = shared.threads})
    return results
  end
  local items = {1, 2, 3, 4, 5, 6}
  local one = clench.json.encode((clench.parallel.map(outer, items, {threads = 1, shared = {threads = 1}})))
  for _, threads in ipairs {{2, 2}, {6, 3}, {1, 5}} do
    local again = clench.parallel.map(outer, items, {threads = threads[1], shared = {threads = threads[2]}})
    t.equal(clench.json.encode(again), one)
  end
  -- more jobs than cores, each waiting for a map
  local jobs = {}
  for k = 1, 2 * clench.parallel.cores + 3 do
    jobs[k] = clench.job(function() return require("clench").parallel.map(function(x) return x + 1 end, {1, 2, 3}, {threads = 3}) end)
  end
  for _, job in ipairs(jobs) do
    t.ok(job:wait(100))
    t.equal(job:result(), {2, 3, 4})
  end
end)

test("on two levels, no more threads compute at once than there are cores", function(t)
  local function outer()
    local function inner()
      local clock = require("clench").clock
      local first = clock()
      repeat until clock() > first + 0.02
      return {first, clock()}
    end
    return (require("clench").parallel.map(inner, {1, 2, 3, 4}, {threads = 4}))
  end
  local edges = {}
  for _, spans in ipairs(clench.parallel.map(outer, {1, 2, 3, 4, 5, 6}, {threads = 6})) do
    for _, span in ipairs(spans) do
      edges[#edges + 1] = {span[1], 1}
      edges[#edges + 1] = {span[2], -1}
    end
  end
  t.equal(#edges, 48)
  table.sort(edges, function(a, b) return a[1] < b[1] or a[1] == b[1] and a[2] < b[2] end)
  local now, most = 0, 0
  for _, edge in ipairs(edges) do
    now = now + edge[2]
    most = math.max(most, now)
  end
  t.ok(most >= 1 and most <= math.max(2, clench.parallel.cores), most)
end)

test("a map continues while endless jobs use all cores", function(t)
  local endless, count = {}, math.max(2, clench.parallel.cores)
  for i = 1, count do endless[i] = clench.job(function() while true do end end) end
  t.equal((clench.parallel.map(function(x) return x + 1 end, {1, 2, 3}, {threads = 2})), {2, 3, 4})
  for _, job in ipairs(endless) do job:stop() end
  for _, job in ipairs(endless) do t.ok(job:wait(60)) end
end)

test("a map within a paused job pauses, too", function(t)
  local path = test.path ".txt"
  local job = clench.job(function(name)
    local function write(i, shared)
      local file = io.open(shared, "a")
      file:write(i, "\n")
      file:close()
      local last = require("clench").clock() + 0.002
      repeat until require("clench").clock() > last
    end
    local items = {}
    for i = 1, 100000 do items[i] = i end
    require("clench").parallel.map(write, items, {threads = 2, shared = name})
  end, {args = {path}})
  local function size()
    local file = io.open(path)
    local bytes = file and file:seek "end" or 0
    if file then file:close() end
    return bytes
  end
  while size() == 0 do clench.loop.sleep(0.005) end
  job:pause()
  -- it pauses within the next turns of its threads
  local before, after = -1, size()
  while before ~= after do
    clench.loop.sleep(0.3)
    before, after = after, size()
  end
  t.equal(job.state, "paused")
  job:resume()
  while size() == after do clench.loop.sleep(0.005) end
  job:stop()
  t.ok(job:wait(30))
end)
