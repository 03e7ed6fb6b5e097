-- Jobs, the loop, a session's planner and pictures at the same time: for the thread sanitizer, and for bit-identical results.
local test, clench = require "test", require "clench"
local loop = clench.loop

test("four jobs, coroutines, a planner and pictures give the same results in parallel as separately", function(t)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  local hand = world.robots[1]
  local function close(h, steps)
    for i = 1, steps do
      h:open()
      h:autograsp()
      require("clench").this_job:event(i)
      require("clench").this_job:show(h.dofs)
    end
    return h.dofs, h.world:hash()
  end
  local function in_threads(h)
    local function work(_, shared)
      shared.hand:open()
      shared.hand:autograsp()
      return shared.hand.dofs
    end
    local results = require("clench").parallel.map(work, {1, 2, 3}, {threads = 3, shared = {hand = h}})
    return results[3], h.world:hash()
  end
  local session = clench.session(world:clone())
  local planner = session:run("planner.sample", {count = 1, candidates = 8, refine = 0, verify = false})
  local jobs = {clench.job(close, {args = {hand, 3}}), clench.job(close, {args = {hand, 2}}), clench.job(in_threads, {args = {hand}}), clench.job(in_threads, {args = {hand}})}
  local ticks, drawn = 0, 0
  local timer = loop.every(0.002, function() ticks = ticks + 1 end)
  local events = 0
  local function is_over()
    for _, job in ipairs(jobs) do
      events = events + #job:events()
      local shown = job.snapshot
      t.ok(shown == nil or #shown == #hand.dofs)
      if not job:wait(0) then return false end
    end
    return planner:wait(0)
  end
  local has_renderer = pcall(clench.render, world, {size = {64, 64}, quality = "draft"})
  while not is_over() or ticks < 3 do
    loop.run(0.01)
    if has_renderer then clench.render(world, {size = {64, 64}, quality = "draft"}) end
    drawn = drawn + 1
  end
  timer:remove()
  loop.run(0.01)
  for _, job in ipairs(jobs) do events = events + #job:events() end
  t.equal(events, 5)
  t.ok(drawn > 0)
  hand:open()
  hand:autograsp()
  for i, job in ipairs(jobs) do
    local dofs = job:result()
    t.equal(dofs, hand.dofs, i)
  end
  t.equal(planner.state, "done")
end)
