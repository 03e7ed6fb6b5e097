-- Simulation of worlds with mistakes: an error message, or steps with reported faults.
local clench = require "clench"
local test = require "test"

local box = clench.shapes.box {0.1, 0.1, 0.1}

local function ground(world) return world:add_obstacle(clench.shapes.box {4, 4, 0.2}, {pose = {xyz = {0, 0, -0.1}}}) end

local function room()
  local world = clench.world {}
  return world, ground(world)
end

local function add(world, x, z, mass) return world:add_object(box, {mass = mass or 1, pose = {xyz = {x, 0, z}}}) end

local function all_finite(t, world)
  local huge = math.huge
  for _, body in ipairs(world.objects) do
    for _, v in ipairs {body.pose.position, body.velocity.linear, body.velocity.angular} do
      t.ok(v:norm() < huge, body.name)
    end
  end
  for _, robot in ipairs(world.robots) do
    for i, q in ipairs(robot.dofs) do t.ok(math.abs(q) < huge and math.abs(robot.dof_velocities[i]) < huge, robot.name) end
  end
end

-- each warning is logged once per script: so this test is the first
test("overlaps and contradictory demands are reported once, after a run", function(t)
  local world = room()
  add(world, 0, 0.045)
  local told = "world:run: bodies overlap (body and body_2); they are pushed apart slowly; world.report.overlaps counts them"
  local said = table.concat(t.warnings(function() world:run(0.01) end), "\n")
  t.ok(said:find(told, 1, true), said)
  t.equal(t.warnings(function() world:run(0.01) end), {})

  -- between two approaching walls of unlimited force
  world = clench.world {gravity = {0, 0, 0}}
  local left = world:add_obstacle(box, {pose = {xyz = {-0.1001, 0, 0}}})
  world:add_obstacle(box, {pose = {xyz = {0.1001, 0, 0}}})
  world:add_object(box, {mass = 1})
  left.velocity = {linear = {0.1, 0, 0}}
  said = table.concat(t.warnings(function() world:run(0.01) end), "\n")
  t.ok(world.report.failures > 0)
  t.ok(said:find("world:run: in some steps contacts, limits and motors contradict each other, and the nearest solution was used; " ..
    "world.report.failures counts them", 1, true), said)
end)

test("a box placed exactly on the ground, or slightly into it, rests on it", function(t)
  for _, z in ipairs {0.05, 0.04999, 0.045} do
    local world = room()
    local body = add(world, 0, z)
    -- each step removes 0.02 of the overlap; below 1e-8 m/s the box counts as at rest
    world:run(1.2)
    t.close(body.pose.position.z, 0.05, 1e-4)
    t.close(body.velocity.linear:norm(), 0, 1e-9)
    t.equal(world.report.overlaps > 0, z < 0.05)
    t.equal(world.report.failures, 0)
  end
end)

test("a box teleported into another separates from it, or is reported as overlapping", function(t)
  local world = room()
  local a, b = add(world, 0, 0.0501), add(world, 0.3, 0.0501)
  world:run(0.05)
  t.equal(world.report.overlaps, 0)
  b.pose = {xyz = {0.095, 0, 0.0501}}
  world:run(0.3)
  t.ok(b.pose.position.x - a.pose.position.x > 0.1)
  local before = world.report.overlaps
  t.ok(before > 0)
  b.pose = a.pose
  world:run(0.05)
  t.ok(world.report.overlaps > before)
  all_finite(t, world)
end)

test("stacks of masses from 1e-12 to 1e10 kg count failures, and keep finite poses", function(t)
  for _, mass in ipairs {1e-12, 1e10} do
    local world = room()
    add(world, 0, 0.0501, mass)
    add(world, 0, 0.1503, 1e10)
    world:run(0.02)
    t.ok(world.report.steps >= 20)
    all_finite(t, world)
  end
  t.fails(function() add(room(), 0, 1, 1e-13) end, "mass")
end)

test("huge forces and speeds are rejected in one sentence or simulated", function(t)
  local world = room()
  local body = add(world, 0, 0.0501)
  t.fails(function() room().run(1) end, "world:run: expected a world before the colon, got 1; use world:run(...)")
  t.fails(function() body:apply_force({0, 0 / 0, 0}) end, "force[2]: expected a finite number, got")
  t.fails(function() body:apply_torque({0, 0, 1e300}) end, "torque: expected a number from -1e+15 to 1e+15")
  local hand = world:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
  for _, push in ipairs {"apply_force", "apply_torque"} do
    t.fails(function() hand[push](hand, {0, 0, 1}) end, "the base is fixed or moves with its set velocity, independent of forces, unless `floating` is true")
  end
  hand.floating = true
  hand:apply_force {0, 0, 0.1}
  world:remove(hand)
  t.fails(function() body.velocity = {linear = {0, 0, 1e7}} end, "linear velocity: expected a number from -1e+06 to 1e+06")
  for _ = 1, 5 do
    body:apply_force({1e6, 0, -1e6})
    body:apply_torque({1e6, 0, 0})
    world:run(0.001)
  end
  all_finite(t, world)
  body:apply_force({1e15, 0, 1e15})
  t.fails(function() world:run(1) end, "expected a position within 1e+09 m of the origin")
  all_finite(t, world)
end)

test("a fast body does not pass through the ground", function(t)
  for _, speed in ipairs {1e3, 1e6} do
    local world = room()
    local body = add(world, 0, 0.5)
    body.velocity = {linear = {0, 0, -speed}}
    world:run(0.01)
    t.ok(body.pose.position.z > 0)
    t.ok(world.report.impacts > 0)
  end
end)

test("bodies removed and collisions switched off during contact are handled", function(t)
  local world, floor = room()
  local low, high = add(world, 0, 0.0501), add(world, 0, 0.1502)
  world:run(0.05)
  world:remove(low)
  world:run(0.3)
  t.close(high.pose.position.z, 0.05, 1e-4)
  t.fails(function() low:apply_force({0, 0, 1}) end, "was removed")
  world:set_collision(false, high, floor)
  world:run(0.1)
  t.ok(high.pose.position.z < 0.02)
  t.equal(world.report.contacts, 0)
  world:set_collision(true, high, floor)
  world:run(0.1)
  all_finite(t, world)
  world:remove(floor)
  world:run(0.1)
  t.equal(world.report.contacts, 0)
end)

test("a run of zero duration makes no step, and invalid steps are rejected", function(t)
  local world = room()
  add(world, 0, 0.0501)
  world:run(0)
  t.equal(world.time, 0)
  t.equal(world.report.steps, 0)
  for _, step in ipairs {0, -1, 1e-9, 2} do
    t.fails(function() world.time_step = step end, "time step: expected a number from 1e-07 to 1 [s], got")
  end
  t.fails(function() world:run(-1) end, "world:run: seconds: expected a time from 0 to")
  t.fails(function() world:run(0 / 0) end, "world:run: seconds: expected a finite number")
  t.fails(function() world:move_bodies(0) end, "world:move_bodies: dt: expected a time from 1e-07 to")
  t.fails(function() world:solve_velocities(0) end, "world:solve_velocities: h: expected a time from 1e-12 to")
end)

test("steps of 1e-7 s are all computed, and bodies at rest stay at rest", function(t)
  local world = room()
  local body = add(world, 0, 0.0501)
  world:run(0.1)
  local z = body.pose.position.z
  world.time_step = 1e-7
  world:run(0.02)
  t.ok(world.report.steps >= 200000)
  t.close(world.time, 0.12, 1e-12)
  t.close(body.pose.position.z, z, 1e-6)
end)

-- two links side by side on a base, each turned by a position servo
local function tongs(world, kp)
  local link = [[<body name="%s" pos="%g 0 0.1"><joint name="%s_joint" axis="0 1 0" range="-1 1" limited="true"/>
    <geom type="box" size="0.01 0.02 0.05" pos="0 0 0.06" mass="0.1"/></body>]]
  local servo = [[<position name="%s" joint="%s_joint" kp="%g" ctrlrange="-1 1"/>]]
  return world:add_robot(test.path(".xml",
    [[<mujoco model="tongs"><compiler angle="radian"/><worldbody><body name="base"><geom type="box" size="0.05 0.05 0.05" mass="1"/>]]
    .. link:format("left", -0.03, "left") .. link:format("right", 0.03, "right") .. "</body></worldbody><actuator>"
    .. servo:format("left", "left", kp) .. servo:format("right", "right", kp) .. "</actuator></mujoco>"))
end

test("gains of 1e12 and of 1e-12 give finite numbers", function(t)
  for _, kp in ipairs {1e12, 1, 1e-12} do
    local world = clench.world {}
    local robot = tongs(world, kp)
    robot:set_targets {-0.5, 0.5}
    world:run(0.3)
    all_finite(t, world)
    t.equal(world.report.failures, 0)
    if kp == 1e12 then t.close(robot.dofs[1], -0.5, 1e-3) end
  end
end)

test("a robot with self-overlap is reported, and stays finite", function(t)
  local world = clench.world {}
  local robot = tongs(world, 10)
  robot.dofs = {0.9, -0.9}
  robot:set_targets {0.9, -0.9}
  world:run(0.1)
  t.ok(world.report.overlaps > 0)
  all_finite(t, world)
  robot:set_targets {-0.9, 0.9}
  world:run(0.5)
  all_finite(t, world)
end)
