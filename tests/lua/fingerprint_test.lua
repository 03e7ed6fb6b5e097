-- Identity by content: changes that affect a fingerprint, and changes that do not.
local test, clench = require "test", require "clench"

test("equal surfaces have equal fingerprints, for any order of their triangles", function(t)
  local world = clench.world()
  local box = clench.shapes.box {0.1, 0.2, 0.3}
  local function fingerprint(shape) return world:add_object(shape).mesh.fingerprint end
  local first = fingerprint(box)
  t.equal(#first, 16)
  local random = clench.random(5)
  for _ = 1, 20 do
    -- vertices and triangles in another order, triangles with another first corner
    local order, numbers, vertices, triangles = {}, {}, {}, {}
    for i = 1, #box.vertices do table.insert(order, random:integer(1, #order + 1), i) end
    for new, old in ipairs(order) do vertices[new], numbers[old] = box.vertices[old], new end
    for _, corners in ipairs(box.triangles) do
      local first_corner, turned = random:integer(0, 2), {}
      for k = 0, 2 do turned[k + 1] = numbers[corners[(first_corner + k) % 3 + 1]] end
      table.insert(triangles, random:integer(1, #triangles + 1), turned)
    end
    t.equal(fingerprint {vertices = vertices, triangles = triangles}, first)
  end
  t.ok(fingerprint(clench.shapes.mirror(clench.shapes.move(box, {0.01, 0, 0}), "x")) ~= first)
  t.ok(fingerprint(clench.shapes.box {0.1, 0.2, 0.3000001}) ~= first)
  -- the format does not matter if it keeps every digit
  local path = test.path()
  for _, ending in ipairs {".obj", ".ply", ".off"} do
    world:add_object(box).mesh:save(path .. ending)
    t.equal(world:add_object(path .. ending, {unit = "m"}).mesh.fingerprint, first, ending)
    os.remove(path .. ending)
  end
  -- a round solid differs from its triangles
  local ball = clench.shapes.sphere {0.05}
  t.ok(fingerprint(ball) ~= fingerprint {vertices = ball.vertices, triangles = ball.triangles})
end)

test("a body's fingerprint changes only with its properties", function(t)
  local a, b = clench.world(), clench.world()
  b:add_object(clench.shapes.box {1, 1, 1})  -- materials and bodies in another order
  b:set_friction("chalk", "cheese", {static = 1, kinetic = 1})
  local one = a:add_object("models/objects/mug.iv", {name = "one"})
  local two = b:add_object("models/objects/mug.iv", {name = "two", pose = {xyz = {1, 2, 3}}})
  t.equal(one.fingerprint, two.fingerprint)
  local seen = {[one.fingerprint] = "nothing"}
  for _, change in ipairs {
    {"mass", function(x) x.mass = 2 * x.mass end}, {"com", function(x) x.com = x.com + clench.vec3(0.01, 0, 0) end},
    {"material", function(x) x.material = "rubber" end}, {"elastic_modulus", function(x) x.elastic_modulus = 1e6 end},
    {"restitution", function(x) x.restitution = 0.5 end}} do
    change[2](two)
    t.equal(seen[two.fingerprint], nil, change[1])
    seen[two.fingerprint] = change[1]
  end
end)

test("a robot's fingerprint is that of its mechanism, and finds its copy in a clone", function(t)
  local world = clench.load "worlds/dlr_flask.wld"
  local hand = world.robots[1]
  local before = hand.fingerprint
  hand:autograsp()
  hand.pose = clench.pose {xyz = {1, 0, 0}}
  t.equal(hand.fingerprint, before)
  local copy = world:clone()
  t.equal(hand:in_world(copy).fingerprint, before)
  t.ok(hand:in_world(copy).world == copy and hand:in_world(copy):in_world(world) == hand)
  local flask = world.objects[1]
  t.equal(flask:in_world(copy).name, flask.name)
  copy:remove(flask:in_world(copy))
  t.fails(function() flask:in_world(copy) end, "body:in_world: expected a clone of its world, got one without 'flask' in its place")
  t.fails(function() hand:in_world(clench.world()) end, "expected a clone of its world")
  t.fails(function() hand:in_world(3) end, "expected a world, got 3")
  hand.bodies[3].mass = 2 * hand.bodies[3].mass
  t.ok(hand.fingerprint ~= before)
  local seen = {}
  for _, name in ipairs {"barrett/barrett.cfg", "parallel_jaw/parallel_jaw.cfg", "dlr/dlr.cfg"} do
    local ok, robot = pcall(function() return clench.world():add_robot("models/hands/" .. name) end)
    if ok then
      t.equal(seen[robot.fingerprint], nil, name)
      seen[robot.fingerprint] = name
      t.equal(clench.world():add_robot("models/hands/" .. name, {name = "other"}).fingerprint, robot.fingerprint)
    end
  end
  t.equal(clench.type(hand), "robot")
  t.equal({clench.type(clench.vec3(1, 2, 3)), clench.type(world), clench.type {}, clench.type(nil), clench.type(1), clench.type(print)},
          {"vec3", "world", "table", "nil", "number", "function"})
end)

-- a hand that holds a box, its grasp, and the world
local function held_box()
  local world = clench.world()
  local hand = world:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
  local box = world:add_object(clench.shapes.box {0.02, 0.02, 0.1}, {name = "box"})
  return clench.grasp(hand, box), world, hand, box
end

local function warnings_of(f, ...)
  local texts = {}
  for i, one in ipairs((clench.log.collect(f, ...))) do texts[i] = one.text end
  return texts
end

test("grasps contain the identity of hand, object, settings and engine in all of Clench's list formats", function(t)
  local grasp, world, hand, box = held_box()
  t.equal(grasp.hand_fingerprint, hand.mechanism_fingerprint)
  t.equal(grasp.object_fingerprint, box.mesh.fingerprint)
  t.equal(grasp.engine_version, clench.version)
  t.equal(clench.grasp(hand, box, grasp.options).settings_fingerprint, grasp.settings_fingerprint)
  for _, options in ipairs {{edges = 12}, {rho = 1}, {soft = false}, {normal_force = 4}, {modulus = "larger"}} do
    t.ok(clench.grasp(hand, box, options).settings_fingerprint ~= grasp.settings_fingerprint)
  end
  grasp.labels = {planner = "mine"}
  local list, path = clench.grasps(), test.path()
  list:add(grasp)
  for _, ending in ipairs {".jsonl", ".csv", ".npz"} do
    list:save(path .. ending)
    local again = clench.grasps(path .. ending)[1]
    for _, field in ipairs {"hand_fingerprint", "object_fingerprint", "settings_fingerprint", "engine_version"} do
      t.equal(again[field], grasp[field], field .. ending)
    end
    t.equal(warnings_of(again.apply, again, world), {})
  end
  list:save(path .. "small.npz", {compress = true})
  t.equal(clench.grasps(path .. "small.npz")[1].hand_fingerprint, hand.mechanism_fingerprint)
  t.ok(table.concat(warnings_of(list.save, list, path .. ".yaml")):find("fingerprints", 1, true))
end)

test("grasp:apply warns once of another hand or object, but not of masses, materials and limits", function(t)
  local grasp, world, hand, box = held_box()
  box.mass, box.material, hand.bodies[2].mass = 2, "rubber", 3
  hand.pose = clench.pose {xyz = {1, 0, 0}}
  t.equal(warnings_of(grasp.apply, grasp, world:clone()), {})
  local other = clench.world()
  other:add_robot("models/hands/parallel_jaw/parallel_jaw.cfg", {name = hand.name})
  local slimmer = other:add_object(clench.shapes.box {0.02, 0.019, 0.1}, {name = "box"})
  t.equal(warnings_of(grasp.apply, grasp, other), {("grasp of box by %s: it was measured on another object, of another surface"):format(hand.name)})
  t.equal(warnings_of(grasp.apply, grasp, other), {})
  t.equal(grasp:apply(other).object_fingerprint, slimmer.mesh.fingerprint)
  local barrett = other:add_robot("models/hands/barrett/barrett.cfg", {name = "barrett"})
  local jaws = clench.grasp(barrett, slimmer)
  t.ok(jaws.hand_fingerprint ~= grasp.hand_fingerprint)
end)
