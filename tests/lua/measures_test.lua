local test, clench = require "test", require "clench"

local function product(a, b)
  local out = {}
  for i = 1, #a do
    out[i] = {}
    for j = 1, #b[1] do
      local sum = 0
      for k = 1, #b do sum = sum + a[i][k] * b[k][j] end
      out[i][j] = sum
    end
  end
  return out
end

local function transposed(a)
  local out = {}
  for j = 1, #a[1] do
    out[j] = {}
    for i = 1, #a do out[j][i] = a[i][j] end
  end
  return out
end

-- by elimination with the largest pivot: the determinant of a, and the solution x of a x = b
local function eliminate(a, b)
  local n, determinant = #a, 1
  for k = 1, n do
    local pivot = k
    for i = k + 1, n do
      if math.abs(a[i][k]) > math.abs(a[pivot][k]) then pivot = i end
    end
    if pivot ~= k then
      a[k], a[pivot], b[k], b[pivot], determinant = a[pivot], a[k], b[pivot], b[k], -determinant
    end
    determinant = determinant * a[k][k]
    for i = 1, n do
      local factor = i ~= k and a[i][k] / a[k][k] or 0
      for j = 1, n do a[i][j] = a[i][j] - factor * a[k][j] end
      for j = 1, #b[1] do b[i][j] = b[i][j] - factor * b[k][j] end
    end
  end
  for i = 1, n do
    for j = 1, #b[1] do b[i][j] = b[i][j] / a[i][i] end
  end
  return determinant, b
end

local function closed(name, options)
  clench.log.level "quiet"
  local world = clench.load("worlds/" .. name .. ".wld", {root = "."})
  world.robots[1]:autograsp()
  local grasp = clench.grasp(world.robots[1], world.objects[1], options)
  clench.log.level "warning"
  return grasp
end

test("manipulability is the volume of object motions of unit DOF motions, by plain elimination", function(t)
  for _, name in ipairs {"dlr_flask", "human_flask"} do
    local grasp = closed(name, {soft = false})
    local map = grasp:grasp_map()
    for i = 4, 6 do
      for j = 1, #map[i] do map[i][j] = map[i][j] / grasp.rho end
    end
    local _, moves = eliminate(product(map, transposed(map)), product(map, grasp:hand_jacobian()))
    local square = product(moves, transposed(moves))
    local none = {}
    for i = 1, 6 do none[i] = {0} end
    local volume = math.sqrt(eliminate(square, none))
    t.ok(volume > 0)
    t.close(grasp:quality "manipulability", volume, 1e-6 * volume)
    t.ok(grasp:quality "hand_min_singular_value" > 0 and grasp:quality "hand_isotropy" < 1)
  end
end)

test("all measures of grasps of many contacts are computed in time, and do not depend on the way of the query", function(t)
  for _, name in ipairs {"human_flask", "shadow_bottle", "tendon_cylinder"} do
    local grasp, again = closed(name), closed(name)
    local all = grasp:quality_all()
    t.ok(all.epsilon and all.grasp_robustness >= all.contact_robustness)
    for _, measure in ipairs {"epsilon_exact", "epsilon", "volume", "gravity_effort"} do
      t.equal(again:quality(measure), all[measure])
    end
  end
end)

test("a measure that cannot be computed does not affect the others, and a grasp can be printed", function(t)
  local grasp = closed("dlr_flask", {edges = 100})
  local all = grasp:quality_all()
  t.ok(all.epsilon > 0 and all.volume == nil)
  t.ok(tostring(grasp):find "grasp of 8 contacts, epsilon 0.0")
  t.fails(function() grasp:quality "volume" end, "more than 1000000 facets")
end)

test("measures that depend on the world reject a changed world", function(t)
  local grasp = closed "dlr_flask"
  local epsilon = grasp:quality "epsilon"
  grasp.hand:open()
  t.equal(grasp:quality "epsilon", epsilon)
  for _, measure in ipairs {"manipulability", "joint_margin", "clearance", "gravity_effort"} do
    t.fails(function() grasp:quality(measure) end, "joints of the hand have moved since it was measured; measure it anew")
  end
  grasp = closed "dlr_flask"
  grasp.object.material = "rubber"
  t.fails(function() grasp:contact_forces {} end, "friction has changed since it was measured; measure it anew")
  grasp = closed "dlr_flask"
  grasp.object.com = grasp.object.com + clench.vec3(0.01, 0, 0)
  t.fails(function() grasp:contact_forces {} end, "the object's center of mass has changed since it was measured; measure it anew")
end)

test("resistance accepts directions of any length, and thin ellipsoids", function(t)
  local grasp = closed "dlr_flask"
  local once = grasp:resistance {wrench = {0, 0, -1, 0, 0, 0}}
  for _, size in ipairs {1e-12, 1e-9, 1e9} do
    t.close(grasp:resistance {wrench = {0, 0, -size, 0, 0, 0}} * size, once, 1e-8 * once)
  end
  local thin = grasp:resistance {ellipsoid = {1, 1, 1, 1e-7, 1e-7, 1e-7}}
  t.close(grasp:resistance {ellipsoid = {1, 1, 1, 1e-13, 1e-13, 1e-13}}, thin, 1e-5 * thin)
  t.fails(function() grasp:resistance {wrenches = {}} end, "wrenches: expected at least one, got none")
end)

test("torque limits are used on request", function(t)
  local grasp = closed "dlr_flask"
  local load = {0, 0, -200, 0, 0, 0}
  local function status(more)
    more.load = load
    return grasp:contact_forces(more).status
  end
  t.equal(status {torque_limits = true}, "infeasible")
  t.equal(status {torque_limits = false}, "optimal")
  t.equal(status {torque_limits = false, arms = true}, "optimal")
  t.equal(status {arms = true}, "optimal")
  local high = {}
  for i = 1, #grasp.hand.dofs do high[i] = 1e6 end
  t.equal(status {unilateral = true}, status {unilateral = true, torque_limits = high})
end)

test("an empty list of wrenches resists nothing, and values that are not lists are rejected", function(t)
  local grasp = closed "dlr_flask"
  local none = {0, 0, 0, 0, 0, 0}
  t.fails(function() grasp:resistance {wrench = none} end, "wrench: expected a wrench that is not zero: there is nothing to resist")
  t.fails(function() grasp:resistance {wrenches = {{1, 0, 0, 0, 0, 0}, none}} end, "wrenches[2]: expected a wrench that is not zero")
  t.fails(function() grasp:resistance {wrenches = {}} end, "wrenches: expected at least one, got none")
  t.fails(function() grasp:resistance {wrenches = none} end, "wrenches[1]: expected a list of 6 numbers, got 0")
  t.fails(function() grasp:resistance {wrench = {0 / 0, 0, 0, 0, 0, 0}} end, "wrench[1]: expected a finite number, got nan")
  t.fails(function() grasp:contact_forces {torque_limits = 1} end, "torque_limits: expected true or a list of numbers, got 1")
  t.fails(function() grasp:equilibrium {torque_limits = "none"} end, "torque_limits: expected true or a list of numbers, got 'none'")
end)

test("measures of position, direction and normals are in quality_all", function(t)
  local grasp = closed "dlr_flask"
  local all = grasp:quality_all()
  local mu = 0
  for _, contact in ipairs(grasp.contacts) do mu = math.max(mu, contact.mu) end
  t.close(all.contact_position_tolerance, all.epsilon * grasp.rho / math.sqrt(1 + mu ^ 2), 1e-12)
  t.ok(all.orthogonality >= 0 and all.orthogonality <= math.pi / 4 + 1e-12)
  t.ok(all.coplanarity >= 0 and all.coplanarity <= math.sqrt(1 / 3) + 1e-12)
end)

test("penetration detects a bar through a cylinder, crossed bars, a plate, and cubes without inner corners", function(t)
  local shapes = clench.shapes
  local bar = shapes.box {0.01, 0.01, 0.1}
  local function depth(inner, outer, xyz, rpy)
    local world = clench.world()
    local a = world:add_obstacle(inner)
    local b = world:add_object(outer, {pose = {xyz = xyz or {0, 0, 0}, rpy = rpy or {0, 0, 0}}})
    t.equal(#world:colliding(a, b), 1)
    return (world:penetration(a, b))
  end
  t.close(depth(bar, shapes.cylinder {0.03, 0.08}, nil, {0, math.pi / 2, 0}), 0.03, 0.0003)
  t.close(depth(bar, shapes.box {0.1, 0.01, 0.01}, {0, 0.008, 0}), 0.002, 5e-6)
  t.close(depth(bar, shapes.box {0.06, 0.06, 0.005}, nil, {0.3, 0.2, 0.1}), 0.0025, 5e-6)
  local cube = shapes.box {0.06, 0.06, 0.06}
  t.close(depth(cube, cube, {0.05, 0, 0}), 0.01, 2e-5)
end)
