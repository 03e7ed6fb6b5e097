-- The on-line planner of a session: periods in the background, the hand shaped by the nearest grasp, the real hand that follows.
local test, clench = require "test", require "clench"
local loop = clench.loop

local function opened()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local hand = session.hand:in_world(session.world:clone())
  hand:place_approach(session.object.pose.position, {0, 0, -1}, 0.15)
  session:run("body.move", {body = "barrett", pose = hand.pose})
  return session
end

local function run_until(t, is_over)
  local last = loop.time() + 300
  while not is_over() and loop.time() < last do loop.run(0.02) end
  t.ok(is_over())
end

-- the only grasp that the planner has found, near the present pose of the hand
local function add_solution(session)
  local state, hand, object = session.online, session.hand, session.object
  local copy = hand.world:clone()
  local there = hand:in_world(copy)
  local before = there.dofs
  there:approach_object {reach = 0.2}
  there:autograsp()
  local grasp = clench.grasp(there, object:in_world(copy))
  grasp.pregrasp = {pose = grasp.pose, dofs = before}
  state.planner.solutions = {{grasp = grasp, number = 1}}
  state.planner.finish = function() end  -- what the search finds meanwhile is not of interest
  return grasp
end

test("periods in a job find the grasps that the same period in place finds, and move nothing", function(t)
  local session = opened()
  local world, hand, mug = session.world, session.hand, session.object
  local before = world:hash()
  local here, there = clench.plan.online {hand = hand, object = mug, seed = 2}, clench.plan.online {hand = hand, object = mug, seed = 2}
  local last
  for _ = 1, 3 do
    here:search(200)
    local job = there:start(200)
    job:wait()
    last = job.snapshot
    there:finish(job)
  end
  t.equal(world:hash(), before)
  t.ok(here.tested > 0)
  t.equal(there.tested, here.tested)
  t.equal(#last.dofs, #hand.dofs)
  local a, b = here:grasps(), there:grasps()
  t.equal(#a, #b)
  for i = 1, #a do
    t.equal(a[i].pose, b[i].pose)
    t.equal(a[i].dofs, b[i].dofs)
  end
  local other = clench.job(function() return 3 end)
  other:wait()
  t.fails(function() there:finish(other) end, "planner:finish: expected a job of planner:start, got a job")
  t.fails(function() there:start "many" end, "planner:start: steps: expected an integer >= 0, got 'many'")
  t.fails(function() there:search(-1) end, "planner:search: steps: expected an integer >= 0, got -1")
end)

test("the nearest grasp is measured from the hand, and its preshape opens with the distance", function(t)
  local session = opened()
  session:run("online.start", {steps = 50})
  local planner, hand = session.online.planner, session.hand
  t.equal(planner:nearest(), nil)
  t.equal(planner:preshape(), nil)
  local grasp = add_solution(session)
  local nearest = planner:nearest()
  local wanted = session.object.pose * grasp.pose
  t.close(nearest.distance, (wanted.position - hand.pose.position):norm(), 1e-12)
  t.close(nearest.angle, 0, 1e-6)
  hand.pose = wanted
  t.close(planner:nearest().closeness, 0, 1e-6)
  for i, value in ipairs(planner:preshape()) do t.close(value, grasp.dofs[i], 1e-9) end
  hand.pose = clench.pose {xyz = {0, 0, 0.1}} * wanted
  for i, value in ipairs(planner:preshape()) do t.close(value, (grasp.dofs[i] + grasp.pregrasp.dofs[i]) / 2, 1e-9) end
  hand.pose = clench.pose {xyz = {0, 0, 0.5}} * wanted
  for i, value in ipairs(planner:preshape()) do t.close(value, grasp.pregrasp.dofs[i], 1e-9) end
  session:run "online.stop"
end)

test("the search runs in the loop, and stops with its hand", function(t)
  local session = opened()
  local events, said = 0, {}
  session:subscribe("progress", function(event) if event.online then events = events + 1 end end)
  session:subscribe("diagnostic", function(d) said[#said + 1] = d.text end)
  local before = session.world:hash()
  session:run("online.start", {steps = 60, seed = 2})
  run_until(t, function() return session.online.planner.periods >= 3 and session.online.search end)
  t.equal(session.world:hash(), before)
  t.ok(events > 2 and session.online.planner.tested > 0)
  t.close(session.online.object_distance, session.world:distance(session.hand, session.object), 1e-9)
  t.equal(session.online.status, "planning")
  t.fails(function() session:run("online.start", {energy = "nonsense"}) end, "nonsense")
  t.ok(session.online)
  session:run "world.new"
  run_until(t, function() return session.online == nil end)
  t.ok(said[#said]:find "no longer in the world", said[#said])
  t.fails(function() session:run "online.plan" end, "online.plan: the command cannot run now: the on-line planner is not running")
end)

test("grasping shapes the simulated hand as one step of undo, and the script repeats it", function(t)
  local session = opened()
  session:run("online.start", {steps = 50})
  local hand = session.hand
  add_solution(session)
  local before, start = session.world:hash(), hand.dofs
  session:run "online.grasp"
  local done = #session.history.done
  run_until(t, function() return session.gesture ~= nil end)
  session:end_gesture()
  t.equal(#session.history.done, done + 1)
  local wanted = session.online.planner:preshape()
  local moved = false
  for i, value in ipairs(hand.dofs) do
    moved = moved or math.abs(value - start[i]) > 1e-3
    t.ok(value <= wanted[i] + 2e-3, i)  -- contact may stop it earlier
  end
  t.ok(moved)
  local again = assert(load(session:script() .. "\nreturn world", "=script", "t"))()
  t.equal(again:hash(), session.world:hash())
  session:undo()
  t.equal(session.world:hash(), before)
  loop.run(0.5)  -- the same preshape is not applied again
  t.equal(session.world:hash(), before)
  session:run("online.settings", {shape_hand = false})
  hand.pose = clench.pose {xyz = {0, 0, 0.05}} * hand.pose
  local shifted = session.world:hash()
  loop.run(0.5)
  t.equal(session.world:hash(), shifted)
  session:run "online.open"
  t.equal(session.online.status, "open")
  local periods = session.online.planner.periods
  loop.run(0.6)
  t.ok(session.online.planner.periods <= periods + 1)
  session:run "online.stop"
  t.equal(#session.online_grasps, 1)
end)

test("auto shapes the hand while a grasp is near", function(t)
  local session = opened()
  session:run("online.start", {steps = 50, auto = true, shape_hand = false})
  add_solution(session)
  run_until(t, function() return session.online.status == "grasping" end)
  session.hand.pose = clench.pose {xyz = {0.3, 0, 0}} * session.hand.pose
  run_until(t, function() return session.online.status == "planning" end)
  session:run "online.stop"
end)

test("the real hand follows the simulated one while it is shaped", function(t)
  local session = opened()
  t.fails(function() session:run("online.start", {shape_real = true}) end, "the real hand is not connected")
  t.equal(session.online, nil)
  local device <close> = clench.devices.simulated.barrett {}
  session:run("sensors.connect_hand", {path = device.path})
  run_until(t, function() return session.sensors.hand.reading end)
  session:run("online.start", {steps = 50, shape_real = true})
  add_solution(session)
  session:run "online.grasp"
  local function is_there()
    local reading = session.sensors.hand.reading
    if not reading or not session.gesture then return false end
    for i, value in ipairs(session.hand.dofs) do
      if math.abs(reading[i] - value) > 0.01 then return false end
    end
    return true
  end
  run_until(t, is_there)
  session:run("online.settings", {shape_real = false})
  run_until(t, function() return session.sensors.hand.task == nil end)
  session:run "online.stop"
  session:run("sensors.disconnect", {device = "hand"})
end)
