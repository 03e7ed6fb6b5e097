local test, clench = require "test", require "clench"

-- a rubber ball of 20 mm on a wooden table
local function pressed(turn)
  local world = clench.world()
  local X = turn and clench.pose {rpy = turn} or clench.pose()
  local top = world:add_obstacle(clench.shapes.box {0.2, 0.2, 0.02}, {name = "top", material = "wood", pose = X * clench.pose {xyz = {0, 0, -0.01}}})
  local ball = world:add_object(clench.shapes.sphere {0.02, subdivisions = 5}, {
    name = "ball", material = "rubber", elastic_modulus = 1.5e6, pose = X * clench.pose {xyz = {0, 0, 0.02005}}})
  return world, top, ball
end

test("a contact is soft if a body is elastic and there is friction", function(t)
  local world, top, ball = pressed()
  local function kind() return world:contacts(top, ball)[1].kind end
  t.equal(kind(), "soft")
  ball.elastic_modulus = nil
  t.equal(kind(), "point")
  t.equal(world:contacts(top, ball)[1].patch, nil)
  t.equal(world:contacts(top, ball)[1]:fit_patch(), nil)
  top.elastic_modulus = 1e6
  t.equal(kind(), "soft")
  world:set_friction("rubber", "wood", {static = 0})
  t.equal(kind(), "frictionless")
end)

test("the patch is that of closed formulas, for either body and any pose", function(t)
  local delta = math.sqrt(5 * 0.003 / (1.5e6 * math.pi * 0.02))
  local limit
  for _, turn in ipairs {{0, 0, 0}, {1, 0.3, -2}, {-0.4, 1.5, 0.1}} do
    local world, top, ball = pressed(turn)
    for _, contact in ipairs {world:contacts(ball, top)[1], world:contacts(top, ball)[1]} do
      local patch = contact.patch
      t.close(patch.relative_radii, {0.02, 0.02}, 1e-5)
      local round = contact.body == ball and patch.curvatures.body or patch.curvatures.other
      t.close(round, {50, 50}, 0.02)
      t.close(patch:ellipse().semi_axes, {math.sqrt(2 * delta * 0.02), math.sqrt(2 * delta * 0.02)}, 1e-6)
      t.close(patch:torsion_limit {force = 5}, 5 * 8 * math.sqrt(2 * delta * 0.02) / 15, 1e-6)
      -- the same world, turned: equal up to rounding
      limit = limit or patch:torsion_limit()
      t.close(patch:torsion_limit(), limit, 1e-9)
      t.close(patch.directions[1]:dot(contact.normal), 0, 1e-9)
      t.ok((patch.point - contact.point):norm() < 1e-3)
      for _, p in ipairs(patch.points.body) do t.ok((p - patch.point):norm() < 1.5 * patch.radius) end
    end
  end
end)

test("a patch does not change when the bodies move or are removed", function(t)
  local world, top, ball = pressed()
  local contact = world:contacts(top, ball)[1]
  ball.pose = {xyz = {1, 1, 1}}
  ball.elastic_modulus = nil
  t.close(contact.patch.relative_radii[1], 0.02, 1e-5)
end)

test("corners and edges cause a warning once per contact, and once per hand and object", function(t)
  local world = clench.world()
  local top = world:add_obstacle(clench.shapes.box {0.2, 0.2, 0.02}, {name = "top", pose = {xyz = {0, 0, -0.01}}})
  local block = world:add_object(clench.shapes.box {0.03, 0.03, 0.03}, {
    name = "block", elastic_modulus = 1e6, pose = {xyz = {0, 0, 0.015 * math.sqrt(2) + 5e-5}, rpy = {math.pi / 4, 0, 0}}})
  local heard = {}
  clench.log.sink(function(level, message) heard[#heard + 1] = level .. ": " .. message end)
  local contact = world:contacts(top, block)[1]
  t.ok(contact.patch.at_edge and contact.patch.at_edge)
  clench.log.sink(nil)
  t.equal(#heard, 1)
  t.ok(heard[1]:find("warning: soft contact of top on block at .* a corner or an edge"), heard[1])
  t.ok(tostring(contact.patch):find "on a corner or an edge")

  local scene = clench.load "worlds/barrett_mug.wld"
  local hand, mug = scene.robots[1], scene.objects[1]
  hand:autograsp()
  mug.elastic_modulus = 1.5e6
  heard = {}
  clench.log.sink(function(_, message) heard[#heard + 1] = message end)
  clench.grasp(hand, mug, {soft = false})
  clench.grasp(hand, mug)
  clench.grasp(hand, mug)
  clench.log.sink(nil)
  t.equal(#heard, 1)
  t.ok(heard[1]:find "^grasp of mug by barrett: %d of %d contacts are soft ones on corners or edges", heard[1])
end)

test("coarse round links are not edges, and box-shaped ones are", function(t)
  local function sharp(file)
    local scene = clench.load(file)
    local hand, object = scene.robots[1], scene.objects[1]
    hand:autograsp()
    object.elastic_modulus = 1.5e6
    local count, list = 0, scene:contacts(hand, object)
    for _, contact in ipairs(list) do count = count + (contact.patch.at_edge and 1 or 0) end
    return count, #list
  end
  t.equal(sharp "worlds/dlr_flask.wld", 0)
  t.equal(sharp "worlds/human_flask.wld", 0)
  clench.log.sink(function() end)
  local edges, all = sharp "worlds/barrett_mug.wld"  -- the rims of its fingertips
  clench.log.sink(nil)
  t.equal(edges, all)
end)

test("options are read strictly", function(t)
  local world, top, ball = pressed()
  local contact = world:contacts(top, ball)[1]
  t.close(contact:fit_patch {radius = 0.005}.radius, 0.005, 0)
  t.close(world:contacts(top, ball)[1]:fit_patch {max_radius = 0.05}.relative_radii[1], 0.02, 1e-5)
  t.fails(function() contact:fit_patch {radius = 1e-6} end, "within radius 1e-06 [m] there is too little of a surface to fit")
  for _, radius in ipairs {5e-324, 1e-200, 1e-30, 1e-7, 10, 1e20, 1e300} do
    t.fails(function() contact:fit_patch {radius = radius} end, "there is too little of a surface to fit")
  end
  t.equal(contact.patch:ellipse {force = 100}.exceeds_layer, false)
  t.equal(contact.patch:ellipse {force = 1000}.exceeds_layer, true)
  t.fails(function() contact:fit_patch {radius = 0} end, "radius must be > 0, got 0")
  t.fails(function() contact:fit_patch {raduis = 1} end, "unknown key 'raduis', expected one of radius, max_radius, fit; did you mean 'radius'?")
  t.fails(function() contact.patch:ellipse {force = -1} end, "force must be >= 0, got -1")
  t.fails(function() contact.patch:ellipse {modulus = "sum"} end, "unknown modulus 'sum'")
  t.fails(function() contact.patch:torsion_limit {froce = 1} end, "unknown key 'froce'")
  t.fails(function() ball.soft_layer = 0 end, "body 'ball': soft layer: expected a number from 1e-09 to 1e+09 [m], got 0")
  t.fails(function() ball.poisson_ratio = 0.5 end, "Poisson's ratio: expected a number from 0 to 0.499999, got 0.5")
  t.fails(function() world:add_object(clench.shapes.box {1, 1, 1}, {poisson_ratio = -1}) end, "poisson_ratio must be 0 to 0.499999, got -1")
end)
