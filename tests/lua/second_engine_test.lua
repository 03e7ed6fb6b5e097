-- ODE as a second engine: hands that close without contacts move as with Clench's solver.
local test, clench = require "test", require "clench"

local function closed(path, engine, seconds)
  local world = clench.world {dynamics = {engine = engine}}
  world.gravity = {0, 0, 0}
  local hand = world:add_robot(path)
  world:set_collision(false)
  hand:autograsp {dynamic = true}
  world:run(seconds)
  return hand.dofs, world.report
end

test("hands whose joints start at their limits close as with Clench's solver, with every step solved", function(t)
  for _, path in ipairs {"human/human20.cfg", "human/human16.cfg", "shadow/shadow.cfg", "barrett/barrett.cfg"} do
    local ours = closed("models/hands/" .. path, "clench", 0.2)
    local ode, report = closed("models/hands/" .. path, "ode", 0.2)
    t.equal(report.failures, 0)
    t.equal(report.fallbacks, 0)
    for i, value in ipairs(ours) do t.close(ode[i], value, 1e-8) end
  end
end)

local function stack(boxes, dynamics)
  local world, S = clench.world {dynamics = dynamics}, clench.shapes
  world:add_obstacle(S.box {4, 4, 0.1}, {pose = {xyz = {0, 0, -0.05}}})
  for i = 1, boxes do
    world:add_object(S.box {0.1, 0.1, 0.1}, {mass = 1, pose = {xyz = {0, 0, 0.0501 + 0.1001 * (i - 1)}}})
  end
  return world
end

local function moved(world, boxes)
  local most = 0
  for i = 1, boxes do
    local p = world.objects[i].pose.position
    most = math.max(most, clench.vec3(p.x, p.y, p.z - (0.0501 + 0.1001 * (i - 1))):norm())
  end
  return most
end

test("a stack of boxes is at rest in every engine, with every cone", function(t)
  for boxes, seconds in pairs {[2] = 1, [4] = 0.5} do
    for _, dynamics in ipairs {{engine = "ode"}, {cone = "pyramid"}, {}} do
      local world = stack(boxes, dynamics)
      world:run(seconds)
      t.equal(world.report.failures, 0)
      t.ok(moved(world, boxes) < 1e-4, moved(world, boxes))
    end
  end
end)

test("a stack at rest costs a pyramid no iterations", function(t)
  local world = stack(4, {cone = "pyramid"})
  world:run(0.2)
  local before = world.report.iterations
  world:run(0.2)
  t.equal(world.report.iterations, before)
end)

test("overlapping boxes leave a finite report in every engine", function(t)
  for _, dynamics in ipairs {{engine = "ode"}, {cone = "pyramid", edges = 4}, {}} do
    local world, S, random = clench.world {dynamics = dynamics}, clench.shapes, clench.random(1)
    world:add_obstacle(S.box {4, 4, 0.1}, {pose = {xyz = {0, 0, -0.05}}})
    for i = 1, 2 do
      local x, y = random:uniform(-0.02, 0.02), random:uniform(-0.02, 0.02)
      world:add_object(S.box {0.1, 0.1, 0.1}, {mass = 1, pose = {xyz = {x, y, 0.06 + 0.09 * (i - 1)}, rpy = {random:uniform(-1, 1), random:uniform(-1, 1), 0}}})
    end
    world:run(0.2)
    t.ok(world.report.max_residual < 1, world.report.max_residual)
  end
end)

test("a run names what ODE does not simulate, once", function(t)
  local path = test.path(".xml", [[<mujoco model="m"><worldbody><body name="base"><geom size="0.1"/>
    <body name="a" pos="0 0 1"><joint name="a" type="slide" range="0 1"/><geom size="0.1"/></body>
    <body name="b" pos="0 0 2"><joint name="b" type="slide" range="0 1"/><geom size="0.1"/></body></body></worldbody>
    <tendon><fixed name="t" damping="1"><joint joint="a" coef="1"/><joint joint="b" coef="1"/></fixed></tendon></mujoco>]])
  local world = clench.world {dynamics = {engine = "ode"}}
  local robot = world:add_robot(path)
  local function said() return table.concat(t.warnings(function() world:run(0.002) end), "\n") end
  t.ok(said():find(("the engine \"ode\" does not simulate the joint tendons of '%s'"):format(robot.name), 1, true))
  t.equal(said():find("does not simulate", 1, true), nil)
end)
