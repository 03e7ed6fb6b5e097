-- Planners in the background and in the loop: results byte-identical to those in the foreground, stops, and an unchanged world.
local test, clench = require "test", require "clench"

local function barrett_mug()
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  return world, world.robots[1], world.objects[1]
end

local function options_of(planner)
  local world, hand, mug = barrett_mug()
  local options = {hand = hand, object = mug, seed = 4}
  for key, value in pairs(({
    sample = {count = 2, refine = 1}, random = {count = 20, threads = 2}, anneal = {steps = 3000}, antipodal = {count = 5},
    loop = {steps = 6000, loop_steps = 2000, energy = "contact", max_energy = 500}, guided = {steps = 2500, child_steps = 30},
    primitive = {density = 1, primitives = {{kind = "cylinder", pose = clench.pose {rpy = {math.pi / 2, 0, 0}}, radius = 0.04, height = 0.09}}},
  })[planner]) do options[key] = value end
  return options, world
end

test("any planner in the background gives byte-identical results, and sends its grasps", function(t)
  for _, planner in ipairs {"sample", "random", "anneal", "antipodal", "loop", "guided", "primitive"} do
    local expected = clench.plan[planner](options_of(planner))
    local options, world = options_of(planner)
    local before = world:hash()
    local job = clench.plan.start(planner, options)
    t.ok(job:wait(120), planner)
    local run = job:result()
    t.equal(clench.json.encode(run.grasps), clench.json.encode(expected.grasps))
    t.ok(#job:events() >= #expected.grasps, planner)
    t.equal(world:hash(), before)
    local function without_times(report) return (tostring(report):gsub("in [%d.e+-]+ s[^\n]*", "")) end
    t.equal(without_times(run.report), without_times(expected.report))
    t.equal(run.report.stopped, nil)
  end
end)

test("a planner in a coroutine of the loop lets others run, and the script can use its world meanwhile", function(t)
  local world, hand, mug = barrett_mug()
  local contact = clench.energy.contact {hand = hand, object = mug}
  local function anneal() return {hand = hand, object = mug, steps = 2500, seed = 2, energy = function() return contact() end} end
  local expected = clench.plan.anneal(anneal())
  local given, mine, seen, run = hand.dofs, hand.dofs, 0, nil
  mine[2] = mine[2] + 0.01
  clench.loop.spawn(function() run = clench.plan.anneal(anneal()) end)
  clench.loop.spawn(function()
    t.equal(hand.dofs, given)
    hand.dofs = mine
    while not run do
      t.equal(hand.dofs, mine)
      seen = seen + 1
      coroutine.yield()
    end
  end)
  clench.loop.run()
  t.ok(seen > 1)
  t.equal(hand.dofs, mine)
  t.equal(clench.json.encode(run.grasps), clench.json.encode(expected.grasps))
end)

test("a stopped search has sent the grasps that it had found", function(t)
  local options = options_of "random"
  options.count = 1000000
  local job, grasps = clench.plan.start("random", options), {}
  while #grasps == 0 do
    clench.loop.sleep(0.02)
    for _, grasp in ipairs(job:events()) do grasps[#grasps + 1] = grasp end
  end
  local began = clench.clock()
  job:stop()
  t.ok(job:wait(20))
  t.equal(job.state, "stopped")
  t.ok(clench.clock() - began < 5)
  t.ok(grasps[1].hand_name == options.hand.name and grasps[1].epsilon > 0)
end)

test("errors of a planner in the background are those of the planner itself", function(t)
  t.fails(function() clench.plan.start(3) end, "plan.start: planner: expected a name, got 3")
  t.fails(function() clench.plan.start "smple" end, "did you mean 'sample'?")
  t.fails(function() clench.plan.start "online" end, "'online' is not a search that ends")
  t.fails(function() clench.plan.start "sample" end, "plan.start: options: expected a table, got nothing")
  t.fails(function() clench.plan.start("sample", {on_grasp = print}) end, "plan.start: on_grasp: a function of the script cannot run in the background")
  local job = clench.plan.start("sample", {})
  job:wait(20)
  t.fails(function() job:result() end, "job 'plan.sample'", "plan.sample: hand must be a robot, got nothing")
end)
