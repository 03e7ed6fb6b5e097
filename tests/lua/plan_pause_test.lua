-- Planners that pause: they find to the byte what they find without, end when they are cancelled, and leave the world alone meanwhile.
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

test("pauses change no byte of what any planner finds", function(t)
  for _, planner in ipairs {"sample", "random", "anneal", "antipodal", "loop", "guided", "primitive"} do
    local expected = clench.plan[planner](options_of(planner))
    local options, world = options_of(planner)
    local before = world:hash()
    local search, pauses = clench.plan.start(planner, options), 0
    t.ok(not search.done and search.run == nil)
    while not search:resume(0) do
      pauses = pauses + 1
      t.equal(world:hash(), before)
    end
    t.ok(pauses > 0, planner)
    t.equal(clench.json.encode(search.run.grasps), clench.json.encode(expected.grasps))
    t.equal(search.run.report.stopped, nil)
    t.ok(search:resume())
  end
end)

test("while an energy of the script is paused, its world is the script's", function(t)
  local world, hand, mug = barrett_mug()
  local contact, expected = clench.energy.contact {hand = hand, object = mug}, nil
  local function anneal() return {hand = hand, object = mug, steps = 2500, seed = 2, energy = function() return contact() end} end
  expected = clench.plan.anneal(anneal())
  local given, mine = hand.dofs, hand.dofs
  mine[2] = mine[2] + 0.01
  local search = clench.plan.start("anneal", anneal())
  t.ok(not search:resume(0))
  t.equal(hand.dofs, given)
  hand.dofs = mine
  while not search:resume(0) do t.equal(hand.dofs, mine) end
  t.equal(hand.dofs, mine)
  t.equal(clench.json.encode(search.run.grasps), clench.json.encode(expected.grasps))
end)

test("a search pauses where its script asks for it, and its time stands still meanwhile", function(t)
  local options, search = options_of "sample", nil
  options.count, options.seconds = 100000, 1
  options.on_grasp = function() search:pause() end
  search = clench.plan.start("sample", options)
  t.ok(not search:resume())
  local elapsed, began = search.elapsed, clench.clock()
  while clench.clock() - began < 0.3 do end
  t.equal(search.elapsed, elapsed)
  options.on_grasp = nil
  while not search:resume() do end
  t.ok(search.elapsed > 0.9 and search.run.report.seconds < 1.6)
end)

test("a search that is cancelled gives what it had found, paused or running", function(t)
  local options = options_of "random"
  options.count = 1000000
  local search = clench.plan.start("random", options)
  search:resume(0.2)
  local run = search:cancel()
  t.ok(search.done and #run.grasps > 0 and run.report.stopped and search:cancel() == run)
  options.on_grasp = function() search:cancel() end
  search = clench.plan.start("random", options)
  t.ok(search:resume())
  t.ok(#search.run.grasps > 0)
  t.equal(search.run.report.candidates, 64)
end)

test("errors of a paused planner are told as always", function(t)
  t.fails(function() clench.plan.start(3) end, "plan.start: planner: expected a name, got 3")
  t.fails(function() clench.plan.start "smple" end, "did you mean 'sample'?")
  t.fails(function() clench.plan.start "online" end, "'online' is no search that ends")
  local search = clench.plan.start("sample", {})
  t.fails(function() search:resume() end, "plan.sample: hand must be a robot, got nothing")
  t.ok(search.done)
  t.fails(function() search:resume "x" end, "search:resume: seconds must be a number >= 0, got 'x'")
  local options, own = options_of "random", nil
  options.on_grasp = function() own:resume() end
  own = clench.plan.start("random", options)
  t.fails(function() own:resume() end, "search:resume: the search is running")
end)
