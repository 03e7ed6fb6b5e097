-- Poses from axes, random rotations, hands placed by their approach, rays.
local clench = require "clench"
local test = require "test"

local function near(t, a, b) t.ok((a - b):norm() < 1e-12, ("%s is not %s"):format(a, b)) end

test("a pose from an axis and an angle turns about that axis", function(t)
  local random = clench.random(3)
  for _ = 1, 20 do
    local axis, angle = random:direction(), random:uniform(-3, 3)
    local pose = clench.pose {axis = axis * random:uniform(0.1, 10), angle = angle}
    near(t, pose:rotate(axis), axis)
    t.close(pose:angle(), math.abs(angle), 1e-12)
    local across = axis:cross(random:direction()):unit()
    t.close(axis:dot(across:cross(pose:rotate(across))), math.sin(angle), 1e-12)
  end
end)

test("a pose from two axes has the first exactly, and the other in the plane of both", function(t)
  local random, axes = clench.random(4), {x_axis = {1, 0, 0}, y_axis = {0, 1, 0}, z_axis = {0, 0, 1}}
  for _, pair in ipairs {{"x_axis", "y_axis"}, {"z_axis", "x_axis"}, {"z_axis", "y_axis"}} do
    local a, b = random:direction(), random:direction()
    local pose = clench.pose {xyz = {1, 2, 3}, [pair[1]] = a * 5, [pair[2]] = b}
    near(t, pose:rotate(axes[pair[1]]), a)
    local second = pose:rotate(axes[pair[2]])
    t.ok(second:dot(b) > 0 and math.abs(second:dot(a:cross(b))) < 1e-12)
    near(t, pose.position, clench.vec3(1, 2, 3))
    -- the same whichever is written first, and right-handed
    near(t, pose:rotate {1, 0, 0}:cross(pose:rotate {0, 1, 0}), pose:rotate {0, 0, 1})
  end
end)

test("what is no axis is refused", function(t)
  t.fails(function() clench.pose {axis = {0, 0, 1}} end, "angle: expected a number, got nil")
  t.fails(function() clench.pose {angle = 1} end, "axis: expected a vec3")
  t.fails(function() clench.pose {axis = {0, 0, 0}, angle = 1} end, "axis: expected a direction, got zero")
  t.fails(function() clench.pose {x_axis = {0, 0, 1}} end, "expected two of x_axis, y_axis and z_axis, got 1")
  t.fails(function() clench.pose {x_axis = {0, 0, 1}, y_axis = {0, 0, 2}} end, "expected two directions that are not parallel")
  t.fails(function() clench.pose {axis = {1, 0, 0}, angle = 0, rpy = {0, 0, 0}} end, "expected one of rpy")
end)

test("a camera looks at its target with y up", function(t)
  local eye, target = clench.vec3(1, 2, 3), clench.vec3(-1, 0, 1)
  local pose = clench.look_at(eye, target)
  near(t, pose:rotate {0, 0, -1}, (target - eye):unit())
  t.ok(pose:rotate {0, 1, 0}.z > 0 and math.abs(pose:rotate {1, 0, 0}.z) < 1e-12)
  local world = clench.world()
  world.camera = {pose = pose, focal_distance = (target - eye):norm()}
  near(t, clench.vec3(world.camera.target), target)
  t.fails(function() clench.look_at(eye, eye) end, "expected eye and target apart")
  t.fails(function() clench.look_at({0, 0, 1}, {0, 0, 0}) end, "up not along the view")
end)

test("random rotations are spread evenly: no direction is preferred", function(t)
  local random, sum, count = clench.random(5), clench.vec3(0, 0, 0), 4000
  for _ = 1, count do sum = sum + random:rotation():rotate {0, 0, 1} end
  -- each component of the mean has the variance 1 / (3 count); six deviations
  t.ok((sum / count):norm() < 6 * math.sqrt(1 / count))
end)

test("a hand is placed by its approach, before a point or as a pose says", function(t)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  local hand, mug = world.robots[1], world.objects[1]
  local direction = clench.vec3(1, -2, 0.5)
  hand:place_approach(mug.pose.position, direction, 0.07)
  near(t, hand.approach.direction, direction:unit())
  near(t, hand.approach.point + 0.07 * direction:unit(), mug.pose.position)
  local frame = clench.pose {xyz = {0.1, 0.2, 0.3}, axis = {1, 1, 0}, angle = 1}
  hand:place_approach(frame)
  near(t, hand.approach.frame.position, frame.position)
  near(t, hand.approach.frame:rotate {1, 0, 0}, frame:rotate {1, 0, 0})
  t.fails(function() hand:place_approach(frame, {0, 0, 1}) end, "direction: a pose has its own")
  t.fails(function() hand:place_approach {0, 0, 0} end, "direction: expected a vec3")
  t.fails(function() hand:place_approach({0, 0, 0}, {0, 0, 0}) end, "expected a direction, got (0, 0, 0)")
end)

test("rays and bounds follow the bodies", function(t)
  local world = clench.world()
  t.equal(world:raycast({0, 0, 1}, {0, 0, -1}), nil)
  local box = world:add_object(clench.shapes.box {0.1, 0.2, 0.4}, {pose = {xyz = {0, 0, 0.5}, rpy = {0, clench.rad(90), 0}}})
  local hit = world:raycast({0, 0, 1}, {0, 0, -3})
  t.ok(hit.body == box and hit.triangle >= 1 and hit.triangle <= 12)
  t.close(hit.distance, 0.45, 1e-12)
  near(t, hit.normal, clench.vec3(0, 0, 1))
  near(t, hit.point, clench.vec3(0, 0, 0.55))
  local bounds = box.bounds_in_world
  near(t, bounds.low, clench.vec3(-0.2, -0.1, 0.45))
  near(t, bounds.high, clench.vec3(0.2, 0.1, 0.55))
  t.fails(function() world:raycast({0, 0, 0}, {0, 0, 0}) end, "direction: expected a direction, got zero")
  t.fails(function() world:raycast({0, 0, 0}, {0, 0, 1}, -1) end, "reach: expected a number >= 0 [m], got -1")
end)
