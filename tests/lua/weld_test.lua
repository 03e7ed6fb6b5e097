-- Objects welded to another body for a time.
local test, clench = require "test", require "clench"

local function ball(world, x, mass, options)
  local all = {mass = mass, pose = {xyz = {x, 0, 0}}}
  for key, value in pairs(options or {}) do all[key] = value end
  return world:add_object(clench.shapes.sphere {radius = 0.02}, all)
end

local function close(t, a, b, tolerance) t.close((a - b):norm(), 0, tolerance) end

test("two objects welded in flight keep momentum and turn about their common center", function(t)
  local world = clench.world {gravity = {0, 0, 0}}
  local a, b = ball(world, 0, 1), ball(world, 0.1, 3)
  a.velocity = {linear = {0, 2, 0}}
  local before = world:momentum()
  a:weld(b)
  local after = world:momentum()
  close(t, after.linear, before.linear, 1e-14)
  close(t, after.angular, before.angular, 1e-14)
  t.ok(world:energy().kinetic < 2)
  -- about the center, 75 mm from a: L = mu r v, with the inertia of two balls and of their masses about it
  local mu, ball_inertia = 1 * 3 / 4, 0.4 * 4 * 0.02 ^ 2
  t.close(a.velocity.angular.z, -mu * 0.1 * 2 / (mu * 0.1 ^ 2 + ball_inertia), 0.02)
  local apart = (b.pose.position - a.pose.position):norm()
  world:run(1)
  t.close((b.pose.position - a.pose.position):norm(), apart, 1e-13)
  close(t, world:momentum().linear, before.linear, 1e-12)
  -- the center continues straight
  local center = (a.pose.position + 3 * b.pose.position) / 4
  close(t, center, clench.vec3(0.075, 0.5, 0), 1e-3)
  a:unweld()
  local velocity = a.velocity.linear
  world:run(0.5)
  close(t, a.velocity.linear, velocity, 1e-12)
  t.ok((b.pose.position - a.pose.position):norm() > apart + 0.01)
end)

test("a dumb-bell of two welded objects falls and rests like a single body", function(t)
  for _, engine in ipairs {"clench", "ode"} do
    local world = clench.world {dynamics = {engine = engine}}
    world:add_obstacle(clench.shapes.box {2, 2, 0.1}, {pose = {xyz = {0, 0, -0.05}}})
    local low = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {mass = 1, pose = {xyz = {0, 0, 0.06}}})
    -- beyond the edge of the lower one, but the common center is not
    local high = world:add_object(clench.shapes.box {0.1, 0.1, 0.02}, {mass = 0.2, pose = {xyz = {0.09, 0, 0.12}}})
    high:weld(low)
    local relative = low.pose:inverse() * high.pose
    world:run(1)
    t.close(low.pose.position.z, 0.05, 1e-4)
    t.close(low.velocity.linear:norm(), 0, engine == "ode" and 1e-6 or 1e-12)
    close(t, (low.pose:inverse() * high.pose).position, relative.position, 1e-13)
    t.equal(world.report.failures, 0)
    local weight = 0
    for _, pressed in ipairs(world:average_contacts(low)) do weight = weight + pressed.force.z end
    t.close(weight, 1.2 * 9.81, 1e-3)
    high:unweld()
    world:run(0.3)
    t.ok(high.pose.position.z < 0.11, engine)  -- it tips off
  end
end)

test("a body welded to a finger moves with it and loads it, and one welded to an obstacle moves with that", function(t)
  local world = clench.world()
  local hand = world:add_robot "models/hands/barrett/barrett.cfg"
  hand.gravity_compensation = false
  local link = hand.chains[3].links[1]
  local load = ball(world, 0, 0.1)
  local before = hand:bias_forces()[4]
  load.pose = {xyz = (link.bounds_in_world.low + link.bounds_in_world.high) / 2 + clench.vec3(0, 0, 0.1)}
  load:weld(link)
  -- the weight of 0.1 kg on an arm of some centimeters
  t.ok(math.abs(hand:bias_forces()[4] - before) > 0.01)
  local relative = link.pose:inverse() * load.pose
  hand:set_targets({0, 0, 0, 0.3})
  world:run(1)
  t.ok(hand.dofs[4] > 0.1)
  close(t, (link.pose:inverse() * load.pose).position, relative.position, 1e-12)

  local table_top = world:add_obstacle(clench.shapes.box {0.2, 0.2, 0.02}, {pose = {xyz = {1, 0, 0}}})
  local cup = ball(world, 1, 0.1)
  cup.pose = {xyz = {1, 0, 0.1}}
  cup:weld(table_top)
  table_top.velocity = {linear = {0.1, 0, 0}, angular = {0, 0, 1}}
  world:run(0.5)
  t.close(cup.pose.position.x, 1.05, 1e-12)
  close(t, cup.velocity.linear, clench.vec3(0.1, 0, 0), 1e-12)
  t.close(cup.velocity.angular.z, 1, 1e-12)
  cup:unweld()
  world:run(0.1)
  t.ok(cup.velocity.linear.z < -0.9)
end)

test("welds are in snapshots, clones and fingerprints, and end with their bodies", function(t)
  local world = clench.world {gravity = {0, 0, 0}}
  local a, b, c = ball(world, 0, 1), ball(world, 0.1, 1), ball(world, 0.2, 1)
  local hash, free = world:hash(), world:snapshot()
  c:weld(b)
  b:weld(a)  -- c is welded to it
  t.ok(world:hash() ~= hash)
  local clone = world:clone()
  a.velocity = {angular = {0, 0, 1}}
  clone.objects[1].velocity = {angular = {0, 0, 1}}
  world:run(0.5)
  clone:run(0.5)
  t.equal(world:hash(), clone:hash())
  -- 0.2 m from the axis, which passes through the middle one
  t.close((c.pose.position - a.pose.position):norm(), 0.2, 1e-13)
  world:restore(free)
  t.equal(a.welded_to, nil)
  t.equal(c.welded_to, nil)
  t.equal(world:hash(), hash)
  c:weld(b)
  world:remove(b)
  t.equal(c.welded_to, nil)
  world:run(0.01)
end)

test("impossible welds are reported", function(t)
  local world = clench.world()
  local a, b, c = ball(world, 0, 1, {name = "a"}), ball(world, 0.1, 1, {name = "b"}), ball(world, 0.2, 1, {name = "c"})
  local wall = world:add_obstacle(clench.shapes.box {1, 1, 0.1}, {name = "wall"})
  t.fails(function() wall:weld(a) end, "expected an object to weld, got 'wall'")
  t.fails(function() a:weld(a) end, "'a' cannot be welded to itself")
  t.fails(function() a:weld() end, "body:weld: to: expected")
  a:weld(b)
  t.fails(function() a:weld(c) end, "'a' is welded to 'b' already")
  b:weld(c)
  t.fails(function() c:weld(a) end, "'a' is welded to 'c' already")
  t.fails(function() c:unweld() end, "'c' is not welded")
  t.fails(function() a.velocity = {linear = {1, 0, 0}} end, "it is welded, and moves with the other body")
end)

-- a rod that hangs from an axis along y, with a servo
local function servo(t, force_range)
  local path = test.path(".xml", ([[<mujoco><worldbody><body name="base"><geom type="box" size=".01 .01 .01"/><body name="rod" pos="0 0 1">
<joint name="j" axis="0 1 0" range="-170 170"/><geom type="box" size="0.02 0.02 0.2" pos="0 0 -0.25" mass="1.5"/></body></body></worldbody>
<actuator><position joint="j" kp="40" kv="2" %s/></actuator></mujoco>]]):format(force_range))
  local world = clench.load(path)
  return world, world.robots[1]
end

test("motors compensate the weight of links, and not that of bodies welded to them", function(t)
  local world, robot = servo(t, "")
  robot:set_dofs {1}
  robot:set_targets {1}
  world:run(0.1)
  t.close(robot.dofs[1], 1, 1e-9)
  local load = world:add_object(clench.shapes.box {0.05, 0.05, 0.05}, {mass = 2, pose = clench.pose {axis = {0, 1, 0}, angle = 1, xyz = {-0.5 * math.sin(1), 0, 1 - 0.5 * math.cos(1)}}})
  load:weld(robot.links[1])
  -- it swings at 8 rad/s with a fifth of the critical damping; it falls asleep before the last 4e-6 N m are in balance
  world:run(15)
  local q = robot.dofs[1]
  t.ok(q < 0.9)
  -- the spring of the servo balances the weight
  t.close(40 * (1 - q), 2 * 9.81 * 0.5 * math.sin(q), 1e-5)
  t.close(robot.dof_efforts[1], 40 * (1 - q), 1e-5)
  robot.gravity_compensation = false
  world:run(15)
  q = robot.dofs[1]
  t.close(40 * (1 - q), (2 * 0.5 + 1.5 * 0.25) * 9.81 * math.sin(q), 1e-5)
end)

test("a motor too weak for a body welded to its link lets it sink", function(t)
  local world, robot = servo(t, 'forcerange="-1 1"')
  robot:set_dofs {1}
  robot:set_targets {1}
  world:add_object(clench.shapes.box {0.05, 0.05, 0.05}, {mass = 10, pose = {xyz = {-0.42, 0, 0.73}}}):weld(robot.links[1])
  world:run(0.5)
  t.ok(robot.dofs[1] < 0.5)
end)

test("a welded body gets the velocity of its partner at once", function(t)
  local world = clench.world {gravity = {0, 0, 0}}
  local a, b, c = ball(world, 0.2, 1), ball(world, 0.1, 1), ball(world, 0, 1)
  a:weld(b)
  b:weld(c)
  c.velocity = {linear = {0, 0, 1}, angular = {0, 1, 0}}
  close(t, a.velocity.linear, clench.vec3(0, 0, 0.8), 1e-15)
  close(t, b.velocity.linear, clench.vec3(0, 0, 0.9), 1e-15)
  close(t, a.velocity.angular, clench.vec3(0, 1, 0), 0)
  local momentum, energy = world:momentum(), world:energy().kinetic
  world:run(0.1)
  close(t, world:momentum().linear, momentum.linear, 1e-12)
  close(t, world:momentum().angular, momentum.angular, 1e-12)
  t.close(world:energy().kinetic, energy, 1e-4)
  c.pose = {xyz = {0, 0, 1}}
  close(t, a.velocity.linear, clench.vec3(0, 0, 0), 0)
  -- on the link and on the base of a robot
  world = servo(t, "")
  local robot = world.robots[1]
  local on_link, on_base = ball(world, 0, 1), ball(world, 1, 1)
  on_link.pose = {xyz = {0, 0, 0.5}}
  on_link:weld(robot.links[1])
  on_base:weld(robot.base)
  robot.dof_velocities = {2}
  close(t, on_link.velocity.linear, clench.vec3(-1, 0, 0), 1e-15)
  robot.velocity = {linear = {0, 1, 0}}
  close(t, on_link.velocity.linear, clench.vec3(-1, 1, 0), 1e-15)
  close(t, on_base.velocity.linear, clench.vec3(0, 1, 0), 1e-15)
end)
