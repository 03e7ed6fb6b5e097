-- Steps of any length, with other events in the world, and after settings have changed between steps.
local test, clench = require "test", require "clench"

local function floor(world, options)
  options = options or {}
  options.pose = {xyz = {0, 0, -0.05}}
  return world:add_obstacle(clench.shapes.box {20, 20, 0.1}, options)
end

local function box(world, gap, options)
  options = options or {}
  options.mass, options.pose = 1, {xyz = {0, 0, 0.05 + gap}}
  return world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, options)
end

test("a fast rolling ball has no impacts", function(t)
  for _, speed in ipairs {0.5, 1, 2, 5} do
    local world = clench.world()
    floor(world)
    local ball = world:add_object(clench.shapes.sphere {radius = 0.05}, {mass = 1, pose = {xyz = {-5, 0, 0.05 + 2.5e-5}}})
    ball.velocity = {linear = {speed, 0, 0}, angular = {0, speed / 0.05, 0}}
    world:run(1)
    t.equal({world.report.steps, world.report.impacts}, {1000, 0})
    -- the radius of the ball that the mesh represents is not exactly 0.05 m: it slips for a moment
    t.close(ball.velocity.linear.x, speed, 2e-4 * speed)
  end
end)

test("small forces move free bodies, with any time step", function(t)
  for step, angle in pairs {[1e-3] = 2e-5, [1e-4] = 5e-5, [1e-5] = 5e-4} do
    local world = clench.world {dynamics = {time_step = step}}
    world.gravity = {9.81 * math.sin(angle), 0, -9.81 * math.cos(angle)}
    floor(world, {material = "frictionless"})
    local block = box(world, 2.5e-5, {material = "frictionless"})
    world:run(500 * step)
    t.close(block.velocity.linear.x, 9.81 * math.sin(angle) * 500 * step, 1e-3 * 9.81 * math.sin(angle) * 500 * step)
  end
  local world = clench.world()
  floor(world, {material = "frictionless"})
  local block = box(world, 2.5e-5, {material = "frictionless"})
  world:run(0.1)
  world:on_step(function() block:apply_force {9e-5, 0, 0} end)
  world:run(2)
  t.close(block.velocity.linear.x, 1.8e-4, 1e-7)
end)

test("tendons stop at their targets, regardless of impacts elsewhere", function(t)
  local world = clench.world {gravity = {0, 0, 0}}
  local hand = world:add_robot "models/hands/tendon_gripper/tendon_gripper.cfg"
  for _, body in ipairs(hand.bodies) do world:set_collision(false, body) end
  for _, z in ipairs {-0.05, 0.0713} do world:add_obstacle(clench.shapes.box {0.1, 0.1, 0.1}, {pose = {xyz = {5, 0, z}}}) end
  local ball = world:add_object(clench.shapes.sphere {radius = 0.01}, {mass = 0.01, pose = {xyz = {5, 0, 0.0106}}})
  ball.restitution, ball.velocity = 1, {linear = {0, 0, 0.97}}
  local low, high = hand.dof_limits[1][1], hand.dof_limits[1][2]
  for k = 1, 10 do
    local target = low + (0.2 + 0.04 * k) * (high - low)
    hand:set_targets {target}
    for _ = 1, 60 do
      world:run(1e-3)
      t.ok(hand.dofs[1] <= target + 1e-12, hand.dofs[1] - target)
    end
  end
  t.ok(world.report.impacts > 100)
end)

test("contacts use the current threshold", function(t)
  local world = clench.world {gravity = {0, 0, 0}}
  floor(world)
  box(world, 2e-4)
  world:run(0.01)
  t.equal(world.report.contacts, 0)
  world.contact_threshold = 1e-3
  world:run(0.01)
  t.equal(world.report.contacts, 4)
end)

test("setting a posture keeps the targets of motors", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand = world.robots[1]
  world.gravity = {0, 0, 0}
  hand:set_targets {dof2 = hand.dofs[2] + 0.2}
  local start = hand.dofs[2]
  hand.pose = hand.pose
  world:run(1)
  -- its motor is still settling; without its target it would not have moved at all
  t.close(hand.dofs[2], start + 0.2, 5e-3)
  hand:set_targets {dof2 = start}
  hand:set_dofs(hand.dofs)
  world:run(1)
  t.close(hand.dofs[2], start + 0.2, 5e-3)
end)

test("an adapter and a hand move with the arm that carries them, also after the hand's DOFs are set", function(t)
  local world = clench.load("worlds/puma_barrett_glass.wld", {root = "."})
  local arm, hand = world.robots[1], world.robots[2]
  world:set_collision(false)
  local speeds = {}
  for i = 1, #arm.dofs do speeds[i] = 1 end
  arm.dof_velocities = speeds
  local M, kinetic = arm:mass_matrix(), 0
  for i = 1, #speeds do
    for j = 1, #speeds do kinetic = kinetic + 0.5 * M[i][j] end
  end
  t.close(world:energy().kinetic, kinetic, 1e-9 * kinetic)
  local base = hand.base.velocity
  t.ok(base.linear:norm() > 0.1)
  hand:set_dofs(hand.dofs)
  t.close((hand.base.velocity.linear - base.linear):norm(), 0, 1e-12)
end)

test("bodies welded in a row move with the first", function(t)
  local world = clench.world {gravity = {0, 0, 0}}
  world:set_collision(false)
  local row = {}
  for i = 1, 5 do
    row[i] = world:add_object(clench.shapes.box {0.01, 0.01, 0.01}, {mass = 1, pose = {xyz = {0.1 * i, 0, 0}}})
    if i > 1 then row[i]:weld(row[i - 1]) end
  end
  row[1].velocity = {angular = {0, 0, 2}}
  for i = 2, 5 do t.close(row[i].velocity.linear.y, 2 * 0.1 * (i - 1), 1e-12) end
end)

test("contacts that existed before a listener was added are not events", function(t)
  local world = clench.world()
  floor(world)
  local block = box(world, 2.5e-5)
  world:run(0.1)
  local events = {}
  for _, kind in ipairs {"contact", "contact_lost"} do world:on(kind, function(event) events[#events + 1] = event.kind end) end
  world:run(0.05)
  t.equal(events, {})
  block.pose = clench.pose {xyz = {0, 0, 1}}
  world:run(0.01)
  t.equal(events, {"contact_lost"})
  block.pose = clench.pose {xyz = {0, 0, 0.05 + 2.5e-5}}
  world:run(0.01)
  t.equal(events, {"contact_lost", "contact"})
end)

test("a box on the floor overlaps nothing", function(t)
  local world = clench.world()
  floor(world)
  local block = box(world, 0)
  t.equal(t.warnings(function() world:run(0.5) end), {})
  t.equal(world.report.overlaps, 0)
  t.ok(math.abs(block.pose.position.z - 0.05) < 1e-4)
end)

test("a thousand bodies that collide in one step, and fast rotation, do not stop time", function(t)
  local world = clench.world()
  floor(world)
  for i = 0, 1099 do
    world:add_object(clench.shapes.box {0.02, 0.02, 0.02}, {mass = 0.1, pose = {xyz = {-0.9 + 0.03 * (i % 50), -0.9 + 0.03 * (i // 50), 0.0108}}})
  end
  world:run(0.02)
  t.close(world.time, 0.02, 1e-12)
  t.equal(world.report.contacts, 4400)
  world = clench.world()
  floor(world)
  local top = box(world, 2.5e-5, {material = "frictionless"})
  top.velocity = {angular = {0, 0, 1e5}}
  world:run(0.5)
  t.close(world.time, 0.5, 1e-12)
  t.equal(world.report.impacts, 0)
end)

test("a fast rotating hand gains no energy", function(t)
  local world = clench.world {gravity = {0, 0, 0}}
  local hand = world:add_robot "models/hands/barrett/barrett.cfg"
  hand.floating = true
  hand.velocity = {angular = {600, 400, 300}}
  local before = world:energy().kinetic
  world:run(0.2)
  t.close(world:energy().kinetic / before, 1, 0.2)
end)

test("aligned boxes separate along their line of motion after a face-to-face impact", function(t)
  for _, distance in ipairs {0.1, 0.26, 0.48, 0.5} do
    for axis = 1, 3 do
      local world = clench.world {gravity = {0, 0, 0}, dynamics = {time_step = 0.00025}}
      local function along(x)
        local out = {0, 0, 0}
        out[axis] = x
        return out
      end
      local shape = clench.shapes.box {0.1, 0.1, 0.1}
      local a = world:add_object(shape, {mass = 1, pose = {xyz = along(-distance / 2 - 0.05)}})
      world:add_object(shape, {mass = 5, pose = {xyz = along(distance / 2 + 0.05)}})
      a.velocity = {linear = along(1)}
      world:run(distance + 0.001)
      -- both continue together, except for the gap that opens
      t.close(a.velocity.linear, along(1 / 6), 5e-3)
      t.close(a.velocity.angular, {0, 0, 0}, 1e-3)
    end
  end
end)
