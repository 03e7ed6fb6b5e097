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
    -- the same in either order, and right-handed
    near(t, pose:rotate {1, 0, 0}:cross(pose:rotate {0, 1, 0}), pose:rotate {0, 0, 1})
  end
end)

test("a single axis is reached by the smallest rotation", function(t)
  local random = clench.random(3)
  for k, name in ipairs {"x_axis", "y_axis", "z_axis"} do
    local own = {0, 0, 0}
    own[k] = 1
    for i = 1, 50 do
      local d = i == 1 and -1 * clench.vec3(table.unpack(own)) or i == 2 and clench.vec3(table.unpack(own)) or clench.vec3(random:uniform() - 0.5, random:uniform() - 0.5, random:uniform() - 0.5)
      local pose, unit = clench.pose {[name] = d}, d / d:norm()
      t.close((pose:rotate(own) - unit):norm(), 0, 1e-12)
      -- no rotation to this axis is smaller than the angle between the two
      t.close(pose:angle(), math.acos(math.max(-1, math.min(1, unit:dot(own)))), 1e-7)
    end
  end
end)

test("values that are not axes are rejected", function(t)
  t.fails(function() clench.pose {axis = {0, 0, 1}} end, "angle: expected a number, got nil")
  t.fails(function() clench.pose {angle = 1} end, "axis: expected a vec3")
  t.fails(function() clench.pose {axis = {0, 0, 0}, angle = 1} end, "axis: expected a direction, got zero")
  t.fails(function() clench.pose {x_axis = {1, 0, 0}, y_axis = {0, 1, 0}, z_axis = {0, 0, 1}} end, "expected one or two of x_axis, y_axis and z_axis, got all three")
  t.fails(function() clench.pose {x_axis = {0, 0, 0}} end, "x_axis: expected a direction, got zero")
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
  t.fails(function() clench.look_at(eye, eye) end, "expected different eye and target")
  t.fails(function() clench.look_at({0, 0, 1}, {0, 0, 0}) end, "up in another direction than the view")
end)

test("random rotations are uniform: no direction is preferred", function(t)
  local random, sum, count = clench.random(5), clench.vec3(0, 0, 0), 4000
  for _ = 1, count do sum = sum + random:rotation():rotate {0, 0, 1} end
  -- each component of the mean has the variance 1 / (3 count); six deviations
  t.ok((sum / count):norm() < 6 * math.sqrt(1 / count))
end)

test("a hand is placed by its approach, in front of a point or at a pose", function(t)
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
  t.fails(function() hand:place_approach(frame, {0, 0, 1}) end, "direction: not allowed with a pose")
  t.fails(function() hand:place_approach {0, 0, 0} end, "direction: expected a vec3")
  t.fails(function() hand:place_approach(nil) end, "target: expected a vec3")
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

local function closed_on_flask()
  local world = clench.load "worlds/dlr_flask.wld"
  return world, world.robots[1], world:body "flask"
end

test("DOFs are set, driven and closed by their names, and the others stay", function(t)
  local _, hand = closed_on_flask()
  local before = hand.dofs
  hand:set_dofs {dof4 = 0.3}
  for d, value in ipairs(hand.dofs) do t.equal(value, d == 4 and 0.3 or before[d]) end
  t.equal(hand.named_dofs.dof4, 0.3)
  hand.named_dofs = {dof4 = before[4], dof1 = 0.01}
  t.equal(hand.dofs[1], 0.01)
  hand.dofs = before
  hand:move_dofs {dof2 = before[2] + 0.01}
  t.equal(hand.dofs[2], before[2] + 0.01)
  hand:set_dofs(hand.named_dofs)
  t.fails(function() hand:set_dofs {dof4 = "x"} end, "set_dofs: dof4: expected a number, got 'x'")
  t.fails(function() hand:set_dofs {0, dof4 = 1} end, "table with the key 'dof4'")
  t.fails(function() hand:set_dofs {dof4 = 45} end,
          "robot 'dlr': DOF 4 must lie in [-0.3491, 1.309] rad, got 45; degrees? clench.rad(45) is 0.7854")
end)

test("a hand closes by some of its DOFs, or in stages", function(t)
  local world, hand = closed_on_flask()
  hand:open()
  local open = world:snapshot()
  local thumb = hand:autograsp {dofs = {1, "dof2", 3}}
  -- the second of each finger's three swings it sideways, and closes nothing
  for d, stop in ipairs(thumb.stops) do t.equal(stop == "not_driven", d > 3 or d == 2) end
  local after_thumb = hand.dofs
  local rest = hand:autograsp {dofs = {4, 5, 6, 7, 8, 9, 10, 11, 12}}
  local two_calls = hand.dofs
  world:restore(open)
  local staged = hand:autograsp {stages = {{1, 2, 3}, {4, 5, 6, 7, 8, 9, 10, 11, 12}}}
  for d, value in ipairs(hand.dofs) do t.equal(value, two_calls[d]) end
  for d, stop in ipairs(staged.stops) do t.equal(stop, d > 3 and rest.stops[d] or thumb.stops[d]) end
  t.equal(staged.queries, thumb.queries + rest.queries)
  t.equal(after_thumb[1], two_calls[1])
  t.fails(function() hand:autograsp {dofs = {13}} end, "dofs[1]: expected a DOF from 1 to 12, got 13")
  t.fails(function() hand:autograsp {dofs = {"dof13"}} end, "has no DOF 'dof13'; did you mean 'dof1'")
  t.fails(function() hand:autograsp {dofs = {true}} end, "dofs[1]: expected number or name of a DOF, got true")
  t.fails(function() hand:autograsp {dofs = {}} end, "expected at least one DOF, got none")
  t.fails(function() hand:autograsp {stages = {}} end, "expected at least one stage, got none")
  t.fails(function() hand:autograsp {stages = {1}} end, "stages[1]: expected a list of DOFs, got 1")
  t.fails(function() hand:autograsp {dofs = {1}, stages = {{1}}} end, "expected dofs or stages, got both")
end)

test("an arm finds a posture for a pose of its last link, and of the hand that it carries", function(t)
  local world = clench.world {}
  local arm = world:add_robot "models/arms/ur5/ur5.cfg"
  local hand = world:add_robot "models/hands/barrett/barrett.cfg"
  hand:mount_on(arm)
  local random = clench.random(8)
  arm.dofs = arm:random_posture(random)
  local target = hand.approach.frame
  arm.dofs = arm:random_posture(random)
  local frame = hand.pose:inverse() * hand.approach.frame
  local found = arm:ik(hand.base, target, {frame = frame})
  t.ok(found.reached)
  arm.dofs = found.dofs
  t.ok((hand.approach.point - target.position):norm() < 2e-6)
  local far = arm:ik(arm.links[#arm.links], {xyz = {5, 0, 0}}, {orientation = "none", starts = 3})
  t.ok(not far.reached and far.distance > 3 and far.starts == 3)
  -- the product of a Jacobian and the speeds of the DOFs is the velocity of the point
  local J, step = arm:jacobian(hand.base, {0, 0, 0.1}), 1e-7
  local p = hand.pose * clench.vec3(0, 0, 0.1)
  local q = arm.dofs
  q[2] = q[2] + step
  arm.dofs = q
  local v = (hand.pose * clench.vec3(0, 0, 0.1) - p) / step
  t.ok((v - clench.vec3(J[1][2], J[2][2], J[3][2])):norm() < 1e-5)
  t.fails(function() arm:ik("elbow", {}) end, "has no link 'elbow'")
  t.fails(function() arm:ik(3, {}) end, "link: expected a body or the name of a link, got 3")
  t.fails(function() arm:ik(hand.base, {}, {orientation = "ful"}) end, "did you mean 'full'?")
  t.fails(function() arm:ik(hand.base, {}, {tolerance = 0}) end, "tolerance")
  local other = clench.world {}:add_robot "models/arms/ur5/ur5.cfg"
  t.fails(function() arm:ik(other.base, {}) end, "belongs to another world")
end)

test("random postures are within the limits and cover them", function(t)
  local hand = clench.load "worlds/dlr_flask.wld".robots[1]
  local random = clench.random(2)
  local least, most = {}, {}
  for _ = 1, 200 do
    for d, value in ipairs(hand:random_posture(random)) do
      least[d], most[d] = math.min(least[d] or value, value), math.max(most[d] or value, value)
    end
  end
  for d, range in ipairs(hand.dof_limits) do
    t.ok(range[1] <= least[d] and most[d] <= range[2])
    -- the probability that 200 draws miss a twentieth at one end is 1 in 28,000
    t.ok(most[d] - least[d] >= 0.9 * (range[2] - range[1]))
  end
  t.equal(tostring(hand:random_posture(clench.random(5))), tostring(hand:random_posture(clench.random(5))))
end)
