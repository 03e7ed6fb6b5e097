-- Bodies that become obstacles and objects again, unbalanced wrenches and bounding boxes, by closed formulas.
local test, clench = require "test", require "clench"

local function cube_and_floor()
  local world = clench.world()
  local floor = world:add_obstacle(clench.shapes.box {1, 1, 0.1}, {name = "floor", pose = {xyz = {0, 0, -0.05}}})
  local cube = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "cube", mass = 0.5, pose = {xyz = {0, 0, 0.0501}}})
  return world, cube, floor
end

test("an obstacle that becomes an object falls as a new object does, and one that becomes an obstacle stays", function(t)
  local world = clench.world()
  local function add(kind, x, name) return world["add_" .. kind](world, clench.shapes.box {0.1, 0.1, 0.1}, {name = name, mass = 0.5, pose = {xyz = {x, 0, 1}}}) end
  local changed, object = add("obstacle", 0, "changed"), add("object", 1, "object")
  world:run(0.05)
  t.close(changed.pose.position.z, 1, 1e-12)
  changed.kind = "object"
  t.equal(#world.objects, 2)
  t.equal(changed.kind, "object")
  local fallen = object.pose.position.z
  object.pose = clench.pose {xyz = {1, 0, 1}}
  world:run(0.1)
  t.ok(changed.pose.position.z < 0.96)
  t.equal(changed.pose.position.z, object.pose.position.z)
  t.ok(fallen < 1)
  changed.kind = "obstacle"
  t.equal(changed.velocity.linear, clench.vec3(0, 0, 0))
  local stays = changed.pose
  world:run(0.1)
  t.equal(changed.pose, stays)
  t.ok(object.pose.position.z < stays.position.z)
end)

test("the kind is undone, copied, saved and read", function(t)
  local session = clench.session()
  session:open("worlds/barrett_glass_table.wld", {root = "."})
  local before = session.world:hash()
  local table_body
  for _, body in ipairs(session.world.obstacles) do table_body = table_body or body end
  local address = table_body.name
  session:run("body.kind", {body = address, kind = "object"})
  t.equal(table_body.kind, "object")
  t.ok(session.world:hash() ~= before)
  t.equal(session.world:clone():body(address).kind, "object")
  local snapshot = session.world:snapshot()
  table_body.kind = "obstacle"
  session.world:restore(snapshot)
  t.equal(table_body.kind, "object")
  for _, ending in ipairs {".wld", ".xml", ".lua"} do
    local path = test.path(ending)
    session.world:save(path)
    local again = ending == ".lua" and dofile(path) or clench.load(path, {root = "."})
    t.equal(again:body(address).kind, "object", ending)
    t.equal(#again.objects, #session.world.objects)
  end
  local repeated = assert(load(session:script() .. "\nreturn world", "=script", "t"))()
  t.equal(repeated:hash(), session.world:hash())
  session:undo()
  t.equal(table_body.kind, "obstacle")
  t.equal(session.world:hash(), before)
  session:redo()
  t.equal(table_body.kind, "object")
end)

test("the current object is another one after it has become an obstacle", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  session:run("body.kind", {body = "mug", kind = "obstacle"})
  t.equal(session.object, nil)
  session:undo()
  t.equal(session.object.name, "mug")
end)

test("bodies whose kind cannot change are named", function(t)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  local link, mug = world.robots[1].links[1], world.objects[1]
  t.fails(function() link.kind = "object" end, ("body '%s' is a part of robot 'barrett': its kind cannot change"):format(link.name))
  t.fails(function() mug.kind = "link" end, "kind: expected object, obstacle, got 'link'")
  t.fails(function() mug.kind = 3 end, "expected a string, got 3")
  mug:weld(world.robots[1].base)
  t.fails(function() mug.kind = "obstacle" end, "body 'mug' is welded to")
  mug.kind = "object"
end)

test("the unbalanced wrench is the weight in free air, zero at rest, and mass times acceleration while it slides", function(t)
  local net_wrench = require "clench.session.net_wrench"
  local world, cube = cube_and_floor()
  local free = net_wrench.of(cube)
  t.close((free.force - clench.vec3(0, 0, -0.5 * 9.81)):norm(), 0, 0.02)
  t.close(free.force.z, world.gravity.z * 0.5, 1e-12)
  t.close((free.point - cube.pose * cube.com):norm(), 0, 1e-15)
  world:run(0.3)
  local rest = net_wrench.of(cube)
  t.close(rest.force:norm(), 0, 1e-3)
  t.close(rest.torque:norm(), 0, 1e-3)
  cube.velocity = {linear = {0.5, 0, 0}}
  local step, before = world.time_step, 0.5
  for _ = 1, 5 do
    before = cube.velocity.linear.x
    world:run(step)
  end
  local acceleration = (cube.velocity.linear.x - before) / step
  t.ok(acceleration < -0.5)
  t.close(net_wrench.of(cube).force.x, 0.5 * acceleration, 0.02 * math.abs(acceleration))
end)

test("boxes contain the triangles of their branch: at each depth every vertex is in one, and their volume decreases", function(t)
  local mesh = clench.load("worlds/barrett_mug.wld", {root = "."}).objects[1].mesh
  local last
  for depth = 0, 2 do
    local boxes = mesh:bounding_boxes(depth)
    t.ok(#boxes <= 8 ^ depth and #boxes >= 1)
    if depth == 0 then t.equal(#boxes, 1) else t.ok(#boxes > 1) end
    local volume = 0
    for _, box in ipairs(boxes) do volume = volume + box.size.x * box.size.y * box.size.z end
    if last then t.ok(volume < last) end
    last = volume
    local inverse, half = {}, {}
    for i, box in ipairs(boxes) do inverse[i], half[i] = box.pose:inverse(), box.size * 0.5 end
    local outside = 0
    for k = 1, #mesh.vertices, 29 do
      local inside = false
      for i = 1, #boxes do
        local p = inverse[i] * mesh.vertices[k]
        inside = inside or math.abs(p.x) <= half[i].x + 1e-6 and math.abs(p.y) <= half[i].y + 1e-6 and math.abs(p.z) <= half[i].z + 1e-6
      end
      if not inside then outside = outside + 1 end
    end
    t.equal(outside, 0, depth)
  end
end)
