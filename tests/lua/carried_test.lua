-- Bodies pressed against a moving body move with it, or slide straight; forces, energies and runs with impacts and snapshots.
local test, clench = require "test", require "clench"

local function table_top(world, options)
  options.pose = {xyz = {0, 0, -0.05}}
  return world:add_obstacle(clench.shapes.box {2, 2, 0.1}, options)
end

test("a box stays at its place on a turntable", function(t)
  for _, step in ipairs {1e-3, 2e-3} do
    local world = clench.world {dynamics = {time_step = step}}
    world:set_friction("wood", "wood", {static = 1, kinetic = 1})
    local disc = table_top(world, {material = "wood"})
    local low = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {mass = 1, material = "wood", pose = {xyz = {0.5, 0, 0.05003}}})
    local high = world:add_object(clench.shapes.box {0.06, 0.06, 0.06}, {mass = 0.5, material = "wood", pose = {xyz = {0.51, 0, 0.13006}}})
    local hat = world:add_object(clench.shapes.box {0.02, 0.02, 0.02}, {mass = 0.1, pose = {xyz = {0.5, 0, 0.11}}})
    hat:weld(low)
    disc.velocity = {angular = {0, 0, 2}}
    for _, box in ipairs {low, high} do box.velocity = {linear = {0, 2 * box.pose.position.x, 0}, angular = {0, 0, 2}} end
    world:run(0.5)
    local function places() return {disc.pose:inverse() * low.pose.position, disc.pose:inverse() * high.pose.position} end
    local before = places()
    world:run(2)
    -- along the tangent it would move 2 mm outwards with steps of 1 ms; the solver leaves 1e-12 m/s
    for i, place in ipairs(places()) do t.ok((place - before[i]):norm() < 1e-10, place - before[i]) end
    t.equal(world.report.failures, 0)
  end
end)

test("a soft ball turns with its support, in both engines", function(t)
  for _, engine in ipairs {"clench", "ode"} do
    local world = clench.world {dynamics = {engine = engine}}
    local disc = table_top(world, {})
    local ball = world:add_object(clench.shapes.sphere {radius = 0.05}, {mass = 1, pose = {xyz = {0, 0, 0.05003}}})
    ball.elastic_modulus = 1e5
    world:run(0.1)
    disc.velocity = {angular = {0, 0, 1}}
    world:run(2)
    t.equal(world:contacts(ball)[1].kind, "soft")
    t.close(ball.velocity.angular.z, 1, 1e-6)
    disc.velocity = {angular = {0, 0, 0}}
    world:run(0.5)
    t.close(ball.velocity.angular.z, 0, 1e-6)
  end
end)

test("a held object keeps its pose in the hand while the hand turns", function(t)
  local world = clench.load "worlds/barrett_mug.wld"
  local hand, mug = world.robots[1], world.objects[1]
  local gravity = world.gravity
  world.gravity = {0, 0, 0}
  hand:autograsp {dynamic = true}
  world:run(2)
  world.gravity = gravity
  hand.velocity = {angular = {0, 1, 0}}
  world:run(1)
  local held = hand.pose:inverse() * mug.pose
  world:run(2)
  local now = hand.pose:inverse() * mug.pose
  -- a third of a turn; 150 micrometers along the tangents
  t.ok((now.position - held.position):norm() < 1e-9, now.position - held.position)
  t.ok((held:inverse() * now):angle() < 1e-8)
end)

test("a rod that turns by more than its own width in a step hits bodies in its path", function(t)
  for _, speed in ipairs {1000, 2 * math.pi / 1e-3} do  -- [rad/s]: the last is a complete turn per step
    local world = clench.world()
    world.gravity = {0, 0, 0}
    local rod = world:add_object(clench.shapes.box {1, 0.005, 0.005}, {mass = 0.2})
    local block = world:add_object(clench.shapes.box {0.01, 0.01, 0.01}, {mass = 0.05, pose = {xyz = {0, 0.4, 0}}})
    rod.velocity = {angular = {0, 0, speed}}
    world:run(0.01)
    t.ok(world.report.impacts > 0 and block.velocity.linear:norm() > 1, block.velocity.linear)
  end
end)

test("forces between bodies at rest do not depend on impacts elsewhere", function(t)
  local world = clench.world()
  table_top(world, {})
  local box = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {mass = 1, pose = {xyz = {0, 0, 0.05003}}})
  world:add_object(clench.shapes.sphere {radius = 0.02}, {mass = 0.1, pose = {xyz = {0.8, 0, 0.1}}, restitution = 1})
  world:run(0.1)
  local impacts = world.report.impacts
  world:on_step(function() t.close(world:average_contacts(box)[1].force.z, 9.81, 1e-9) end)
  world:run(1)
  t.ok(world.report.impacts > impacts + 2)
end)

test("an elastic ball keeps its bounce height", function(t)
  for _, step in ipairs {1e-3, 2e-3} do
    local world = clench.world {dynamics = {time_step = step}}
    table_top(world, {})
    local ball = world:add_object(clench.shapes.sphere {radius = 0.02}, {mass = 1, pose = {xyz = {0, 0, 0.32}}, restitution = 1})
    local top = 0
    world:run(9.5)
    world:on_step(function() top = math.max(top, ball.pose.position.z) end)
    world:run(1)
    -- 20 bounces; an error of half a step of gravity at each would be 20 mm. It stops 0.02 mm above the table, a fraction of a step early
    t.close(top, 0.32, 2 * step * step * 9.81 + 1e-3 * 0.3)
  end
end)

test("a listener that restores a snapshot does not make a run endless", function(t)
  local world = clench.world()
  table_top(world, {})
  world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {mass = 1, pose = {xyz = {0, 0, 0.06}}})
  local start, steps, back = world:snapshot(), 0, 0
  world:on_step(function() steps = steps + 1 end)
  world:on("contact", function()
    back = back + 1
    world:restore(start)
  end)
  world:run(0.2)
  t.ok(back >= 3 and steps >= 200 and steps <= 200 + 2 * back, {back, steps})
end)

test("setting targets and target velocities keeps the forces", function(t)
  local world = clench.load "worlds/parallel_jaw_cube.wld"
  for _, object in ipairs(world.objects) do world:remove(object) end
  world.gravity = {0, 0, 0}
  local jaw = world.robots[1]
  local q = jaw.dofs
  local function offset(set)
    jaw:set_forces {20}
    set()
    world:run(1)
    return jaw.dofs[1] - q[1]
  end
  local pushed = offset(function() end)
  t.ok(math.abs(pushed) > 1e-7)
  t.close(offset(function() jaw:set_targets(q) end), pushed, 1e-9)
  jaw:set_target_velocities {0}
  local before = jaw.dofs[1]
  world:run(0.1)
  t.ok(jaw.dofs[1] ~= before)
end)

test("energy includes that of springs of tendons", function(t)
  local world = clench.load "worlds/tendon_cylinder.wld"
  for _, list in ipairs {world.objects, world.obstacles} do
    for _, body in ipairs(list) do world:remove(body) end
  end
  world.gravity = {0, 0, 0}
  local hand = world.robots[1]
  local link = hand.links[#hand.links]
  world:run(0.2)
  local push = world:on_step(function() link:apply_force {0, 0.5, 0.5} end)
  world:run(1)
  push:remove()
  local bent, most = world:energy().potential, 0
  t.ok(bent > 1e-3, bent)
  world:on_step(function()
    local energy = world:energy()
    most = math.max(most, energy.kinetic + energy.potential)
  end)
  world:run(0.2)
  t.ok(most < 1.001 * bent, {most, bent})
end)

test("a body welded to a fixed one stops at once", function(t)
  local world = clench.world()
  local top = table_top(world, {})
  local box = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {mass = 1, pose = {xyz = {0, 0, 0.3}}})
  box.velocity = {linear = {0, 0, 1}}
  box:weld(top)
  t.equal(box.velocity.linear:norm(), 0.0)
  t.equal(world:energy().kinetic, 0.0)
end)

test("a body without restitution does not bounce, also if a force decelerates it before the impact", function(t)
  local world = clench.world {gravity = {0, 0, 0}}
  table_top(world, {})
  local ball = world:add_object(clench.shapes.sphere {radius = 0.02}, {mass = 1, pose = {xyz = {0, 0, 0.03}}})
  ball.velocity = {linear = {0, 0, -1}}
  local after
  world:on_step(function()
    if ball.velocity.linear.z > -0.5 then after = after or ball.velocity.linear.z end
    ball:apply_force {0, 0, 20}
  end)
  world:run(0.015)
  t.close(after, 0, 1e-9)
end)

test("a cube that slips between two pads slides straight along gravity", function(t)
  -- equal faces with aligned edges, tilted by almost nothing
  for _, case in ipairs {{}, {way = {0, 0.6, -0.8}}, {time_step = 1e-4}, {engine = "ode"}} do
    local way = clench.vec3(case.way or {0, 0, -1})
    local options = {time_step = case.time_step, engine = case.engine}
    for _, force in ipairs {9.9, 9.75, 9.5} do
      local world = clench.load "tests/data/mjcf/pads.xml"
      world.dynamics = options
      local pads, cube = world.robots[1], world.objects[1]
      world.gravity = {0, 0, 0}
      pads.controller = "effort"
      pads:set_forces {force, force}
      world:run(0.5)
      world.gravity = 9.81 * way
      local fastest = 0
      world:on_step(function() fastest = math.max(fastest, cube.velocity.angular:norm()) end)
      world:run(0.5)
      -- mu = 0.5 at both pads
      local acceleration = math.max(0, 9.81 - force)
      -- the pads need a step or two to build up their force; a load on few of the corners turns the cube by 0.1 to 10 rad/s
      t.ok((cube.velocity.linear - 0.5 * acceleration * way):norm() < 1e-4, cube.velocity.linear)
      t.ok(fastest < 1e-3, fastest)
      t.equal(world.report.failures, 0)
    end
  end
end)

test("a body thrown at a thin plate does not pass through", function(t)
  local random = clench.random(7)
  for _, speed in ipairs {50, 300} do
    for i = 1, 20 do
      local world = clench.world {gravity = {0, 0, 0}}
      world:add_obstacle(clench.shapes.box {1, 1, 0.001})
      local function side() return random:uniform(0.01, 0.05) end
      local box = world:add_object(clench.shapes.box {side(), side(), side()},
                                   {mass = 0.1, pose = clench.pose {xyz = {0, 0, 0.2}, quat = random:rotation().quat}})
      local function part() return random:uniform(-0.1, 0.1) * speed end
      box.velocity = {linear = {part(), part(), -speed}, angular = {part(), part(), part()}}
      world:run(0.02 + 0.4 / speed)
      -- one of its corners strikes first, and the others follow at the same speed
      t.ok(box.pose.position.z > 0.004, box.pose.position)
      t.equal(world.report.failures, 0)
    end
  end
end)

test("a body on a plate whose velocity changes moves along, with forces according to Newton", function(t)
  for _, way in ipairs {clench.vec3(0, 0, 2), clench.vec3(0, 0, -2), clench.vec3(2, 0, 0)} do
    local world = clench.world()
    local plate = table_top(world, {})
    world:set_friction("wood", "wood", 0.6)
    plate.material = "wood"
    for i = 0, 1 do
      world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {mass = 1.5, material = "wood", pose = {xyz = {0, 0, 0.05005 + 0.10005 * i}}})
    end
    local low, high = world.objects[1], world.objects[2]
    world:run(0.1)
    local before, checked = plate.pose:inverse() * high.pose.position, 0
    local begun = world.time
    world:on_step(function()
      if world.time > begun + 0.01 then
        local force = clench.vec3(0, 0, 0)
        for _, contact in ipairs(world:contacts(plate, low)) do force = force + contact.force end
        t.close(math.abs(force.z), 3 * (9.81 + way.z), 1e-6)
        checked = checked + 1
      end
      plate.velocity = {linear = (world.time - begun) * way}
    end)
    world:run(0.2)
    t.ok(checked > 100)
    -- without that it would lag by the displacement of a step, 400 micrometers
    t.ok((plate.pose:inverse() * high.pose.position - before):norm() < 1e-9)
    t.equal(world.report.overlaps, 0)
  end
end)

test("a body pressed on a table by a force bounces as with the equivalent gravity, and comes to rest", function(t)
  local function run(force, gravity)
    local world = clench.world {gravity = {0, 0, -gravity}}
    local box = world:add_object(clench.shapes.box {0.05, 0.05, 0.05}, {mass = 0.2, restitution = 0.8, pose = {xyz = {0, 0, 0.03}}})
    table_top(world, {})
    local function press() box:apply_force {0, 0, -force} end
    press()
    world:on_step(press)
    local highest = {}
    for k = 1, 20 do
      highest[k] = 0
      for _ = 1, 50 do
        world:run(0.001)
        highest[k] = math.max(highest[k], box.pose.position.z)
      end
    end
    return highest, box.velocity.linear.z
  end
  local pressed, speed = run(10, 0)
  local heavy = run(0, 50)
  t.equal(speed, 0)
  -- rounding moves impacts within a step: 0.4 m/s may differ by a step's gain of 0.05, and so may heights
  for k, z in ipairs(heavy) do t.close(pressed[k], z, 0.4 * 0.05 / 50) end
end)

test("contacts are those of the last step, also for a ball whose facets are farther away", function(t)
  for _, subdivisions in ipairs {2, 3, 5} do
    local world = clench.world()
    table_top(world, {})
    local ball = world:add_object(clench.shapes.sphere {radius = 0.02, subdivisions = subdivisions},
                                  {mass = 0.5, pose = clench.pose {xyz = {0, 0, 0.02003}, rpy = {0.3, 0.2, 0.1}}})
    world:run(0.2)
    local contacts = world:contacts(ball)
    t.equal(#contacts, 1)
    t.close(contacts[1].force:norm(), 0.5 * 9.81, 1e-9)
    t.close(contacts[1].point, clench.vec3(0, 0, 0), 1e-4)
    -- after it is moved its facets count again
    ball.pose = {xyz = {0, 0, 0.025}}
    t.equal(world:contacts(ball), {})
  end
end)

test("an askew body between pads, slightly overlapping, is aligned and not squeezed through", function(t)
  local shapes = {capsule = clench.shapes.capsule {0.004, 0.04}, cylinder = clench.shapes.cylinder {0.004, 0.04}}
  for _, step in ipairs {5e-4, 1e-3, 5e-3} do
    for name, shape in pairs(shapes) do
      for _, overlap in ipairs {0, 5e-5, 5e-4} do
        local world = clench.load "tests/data/mjcf/pads.xml"
        world.dynamics, world.gravity = {time_step = step}, {0, 0, 0}
        world:remove(world.objects[1])
        local pads = world.robots[1]
        local body = world:add_object(shape, {mass = 0.045, pose = clench.pose {xyz = {0, 0, 1}, rpy = {0.7, 0.02, 0}}})
        local half = body.bounds_in_world.high.x
        pads:set_dofs {0.05 - half + overlap, 0.05 - half + overlap}
        pads.controller = "effort"
        pads.gains = {{kp = 0, kd = 0}, {kp = 0, kd = 0}}
        pads:set_forces {1, 1}
        local nearest = 1
        world:on_step(function() nearest = math.min(nearest, 0.1 - pads.dofs[1] - pads.dofs[2]) end)
        world:run(0.5)
        -- aligned, the pads are 8 mm apart; a squeezed body would leave no gap
        t.ok(nearest > 0.006, ("%s, step %g, overlap %g: %g"):format(name, step, overlap, nearest))
        t.ok(0.1 - pads.dofs[1] - pads.dofs[2] > 0.0075, pads.dofs)
      end
    end
  end
end)
