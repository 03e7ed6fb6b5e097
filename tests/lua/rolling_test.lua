-- Round bodies roll as the closed formulas predict, on planes and on meshes.
local test, clench = require "test", require "clench"
local shapes = clench.shapes

local gravity, slope, radius = 9.81, math.rad(3), 0.05

-- A square plate whose upper side is z = 0; fine: a smaller surface of squares of 15 mm, divided into triangles.
local function plate(fine)
  if not fine then return shapes.move(shapes.box {2, 2, 0.1}, {0, 0, -0.05}) end
  local n, size, vertices, triangles = 40, 0.3, {}, {}
  for i = 0, n do
    for j = 0, n do vertices[#vertices + 1] = {size * (2 * i / n - 1), size * (2 * j / n - 1), 0} end
  end
  for i = 0, n - 1 do
    for j = 0, n - 1 do
      local a = i * (n + 1) + j + 1
      local b, c, d = a + n + 1, a + n + 2, a + 1
      triangles[#triangles + 1] = {a, b, c}
      triangles[#triangles + 1] = {a, c, d}
    end
  end
  return {vertices = vertices, triangles = triangles}
end

local function slope_world(shape, fine, turn)
  local world = clench.world()
  world.gravity = {0, 0, -gravity}
  local tilt = clench.pose {axis = {0, 1, 0}, angle = slope}
  world:add_obstacle(plate(fine), {name = "slope", material = "rubber", pose = tilt})
  local body = world:add_object(shape, {name = "roller", material = "rubber", mass = 0.1,
                                        pose = tilt * clench.pose {xyz = {0, 0, radius + 5e-5}} * turn})
  return world, body
end

local along_y = clench.pose {axis = {1, 0, 0}, angle = math.pi / 2}

-- I / (m r^2) of the solid capsule
local capsule_length = 0.1
local function capsule_inertia()
  local cylinder, ball = math.pi * radius ^ 2 * capsule_length, 4 / 3 * math.pi * radius ^ 3
  return (cylinder / 2 + 0.4 * ball) / (cylinder + ball)
end
local rollers = {
  {"ball", shapes.sphere {radius, subdivisions = 4}, 0.4},
  {"cylinder", shapes.cylinder {radius, 0.1}, 0.5},
  {"capsule", shapes.capsule {radius, capsule_length}, capsule_inertia()},
  {"wheel", shapes.cylinder {radius, 0.01}, 0.5},
}

for _, fine in ipairs {false, true} do
  for _, roller in ipairs(rollers) do
    local name, shape, inertia = table.unpack(roller)
    test(("a %s rolls down a slope of %s as its formula says"):format(name, fine and "many triangles" or "one face"),
      function(t)
        local world, body = slope_world(shape, fine, along_y)
        local start = body.pose.position
        local seconds = 0.8
        world:run(seconds)
        local way = (body.pose.position - start):norm()
        local expected = gravity * math.sin(slope) / (1 + inertia) * seconds ^ 2 / 2
        t.close(way, expected, 0.01 * expected)
        -- it neither turns sideways nor leaves the plate
        local away = body.pose.position - start
        t.close(away.y, 0, 1e-4)
      end)
  end
end

test("a wheel that rolls on a level mesh does not slow down", function(t)
  for _, roller in ipairs(rollers) do
    local world = clench.world()
    world.gravity = {0, 0, -gravity}
    world:add_obstacle(plate(true), {name = "floor", material = "rubber"})
    local body = world:add_object(roller[2], {name = "roller", material = "rubber", mass = 0.1,
                                              pose = clench.pose {xyz = {-0.2, 0, radius + 5e-5}} * along_y})
    local speed = 0.3
    body.velocity = {linear = {speed, 0, 0}, angular = {0, speed / radius, 0}}
    world:run(1)
    t.close(body.velocity.linear.x, speed, 2e-3 * speed)
    t.close(body.pose.position.x, -0.2 + speed, 2e-3 * speed)
  end
end)

test("a capsule on its side touches a plate at two points, and upright at one, with the plate's normal", function(t)
  local world = clench.world()
  local floor = world:add_obstacle(plate(false), {name = "floor"})
  local rod = world:add_object(shapes.capsule {0.01, 0.06}, {pose = clench.pose {xyz = {0.1, 0.2, 0.01 + 5e-5}} * along_y})
  local lying = world:contacts(floor, rod)
  t.equal(#lying, 2)
  for _, contact in ipairs(lying) do
    t.close(contact.gap, 5e-5, 1e-9)
    t.close(contact.normal.z, 1, 1e-9)
    t.close(math.abs(contact.point.y - 0.2), 0.03, 1e-6)
  end
  rod.pose = clench.pose {xyz = {0.1, 0.2, 0.04 + 5e-5}}
  local standing = world:contacts(floor, rod)
  t.equal(#standing, 1)
  t.equal(standing[1].feature.kind, "round")
  t.close(standing[1].point, {0.1, 0.2, 5e-5}, 1e-9)
end)

-- A floor, and a body 24 um above it, turned by rpy.
local function above_floor(shape, rpy, options)
  local world = clench.world()
  local floor = world:add_obstacle(plate(false), {name = "floor"})
  options.pose = {xyz = {0, 0, 0.2}, rpy = rpy}
  local body = world:add_object(shape, options)
  local gap = world:distance(floor, body)
  body.pose = clench.pose {xyz = {0, 0, 0.2 - gap + 2.4e-5}, rpy = rpy}
  return world, body, floor
end

local function energy(world, body)
  local spin = body.pose:inverse():rotate(body.velocity.angular)
  local turning = 0
  for i = 1, 3 do
    for j = 1, 3 do turning = turning + spin[i] * body.inertia[i][j] * spin[j] end
  end
  return body.mass * gravity * body.pose.position.z + 0.5 * body.mass * body.velocity.linear:dot(body.velocity.linear) +
         0.5 * turning
end

local wobbling = {
  can = {shapes.cylinder {0.03, 0.06}, {0.4, 0, 0}, {0, 0, 3}},
  ["falling can"] = {shapes.cylinder {0.03, 0.08}, {1.4, 0, 0}, {0, 0, 5}},
  coin = {shapes.cylinder {0.012, 0.002}, {math.pi / 2 + 0.5, 0.2, 0}, {0, 0, 30}},
  lid = {shapes.cylinder {0.0375, 0.0125}, {0.7, 0.2, 0}, {1, 0, 10}},
  capsule = {shapes.capsule {0.01, 0.06}, {0.5, 0, 0}, {0, 0, 8}},
}
for _, name in ipairs {"can", "falling can", "coin", "lid", "capsule"} do
  local case = wobbling[name]
  test(name .. ": what wobbles on a floor neither sinks in nor gains energy; what is flat comes to rest", function(t)
    local world, body, floor = above_floor(case[1], case[2], {mass = 0.05})
    body.velocity = {angular = case[3]}
    local most = 1.01 * energy(world, body)
    for _ = 1, 400 do
      world:run(0.01)
      t.equal(#world:colliding(body, floor), 0)
      t.ok(energy(world, body) <= most)
    end
    t.equal(world.report.failures, 0)
    if name == "coin" or name == "lid" then t.close(body.velocity.linear:norm(), 0, 1e-3) end
  end)
end

test("an ellipsoid that rocks and spins gains no energy, and loses little", function(t)
  for _, radii in ipairs {{0.04, 0.04, 0.01}, {0.05, 0.01, 0.01}, {0.04, 0.03, 0.02}} do
    local path = test.path(".xml", ([[<mujoco><worldbody><geom type="box" size="1 1 0.05" pos="0 0 -0.05"/>
      <body name="b" pos="0 0 0.3"><freejoint/><geom type="ellipsoid" size="%g %g %g" mass="0.2"/></body>
      </worldbody></mujoco>]]):format(table.unpack(radii)))
    local world = clench.load(path)
    local body, floor = world.objects[1], world.obstacles[1]
    local rpy = {0.3, 0, 0}
    body.pose = clench.pose {xyz = {0, 0, 0.3}, rpy = rpy}
    body.pose = clench.pose {xyz = {0, 0, 0.3 - world:distance(floor, body) + 2.4e-5}, rpy = rpy}
    body.velocity = {angular = {0, 0, 5}}
    local rest = body.mass * gravity * math.min(table.unpack(radii))
    local start = energy(world, body) - rest
    for _ = 1, 100 do
      world:run(0.01)
      local now = energy(world, body) - rest
      t.ok(now < 1.01 * start and now > 0.9 * start)
    end
    t.equal(world.report.impacts, 0)
  end
end)

test("a part deep in the floor is pushed out, regardless of other contacts", function(t)
  local deep = shapes.move(shapes.sphere {0.02}, {0.05, 0, -0.005})
  local shallow = shapes.move(shapes.sphere {0.02}, {-0.05, 0, 0.0199})
  for _, parts in ipairs {{deep, shallow}, {shallow, deep}} do
    local world = clench.world()
    world:add_obstacle(plate(false), {name = "floor"})
    local body = world:add_object(shapes.union(parts), {mass = 0.2})
    world:run(0.8)
    t.ok(body.pose.position.z > 0.01)
  end
end)

test("a body that rolls over an open surface has few impacts", function(t)
  for _, shape in ipairs {shapes.cylinder {0.02, 0.05}, shapes.sphere {0.02}} do
    local world = clench.world()
    world:add_obstacle {vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, triangles = {{1, 2, 3}, {1, 3, 4}}}
    local body = world:add_object(shape, {mass = 0.2, pose = {xyz = {-0.5, 0, 0.02003}, rpy = {math.pi / 2, 0, 0}}})
    body.velocity = {linear = {0.5, 0, 0}, angular = {0, 25, 0}}
    world:run(1)
    t.ok(world.report.impacts < 10)
    t.close(body.velocity.linear.x, 0.5, 1e-3)
  end
end)
