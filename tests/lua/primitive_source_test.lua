-- Sources of the primitives of the primitive planner if a script gives none.
local clench = require "clench"
local test = require "test"
local primitive_source = require "clench.plan.primitive_source"
local read = require "clench.options"("plan.primitive", {})

local cube = "#Inventor V2.1 ascii\nCube { width 20 height 30 depth 40 }\n"
local faces = "#Inventor V2.1 ascii\nCoordinate3 { point [ 0 0 0, 10 0 0, 0 20 0, 0 0 40 ] }\nIndexedFaceSet { coordIndex [ 0, 2, 1, -1, 0, 1, 3, -1, 0, 3, 2, -1, 1, 2, 3, -1 ] }\n"
local sphere = "#Inventor V2.1 ascii\nSphere { radius 15 }\n"

local function write(path, content)
  os.execute(("mkdir -p '%s'"):format(path:match "^(.*)/"))
  clench.files.save_text(path, content)
  return path
end

local function find(path, root, options)
  local object = clench.world {}:add_object(path, options)
  return primitive_source(read, object, root)
end

test("primitives next to the object's file come first", function(t)
  local list, source = find "models/objects/mug.iv"
  t.equal(source:match "[^/]*/[^/]*/[^/]*/[^/]*$", "models/objects/primitives/mug.iv")
  t.ok(#list > 1)
  local folder = test.folder()
  write(folder .. "/a.iv", cube)
  write(folder .. "/primitives/a.iv", sphere)
  list, source = find(folder .. "/a.iv")
  t.equal(source, folder .. "/primitives/a.iv")
  t.equal(list[1].kind, "sphere")
end)

test("primitives below the root, as in GraspIt!, come second", function(t)
  local folder = test.folder()
  local object = write(folder .. "/objects/a.iv", faces)
  t.equal(select(2, find(object, folder)), "bounding box")
  write(folder .. "/primitives/a.iv", sphere)
  t.equal(select(2, find(object, folder)), folder .. "/primitives/a.iv")
  write(folder .. "/models/objects/primitives/a.iv", sphere)
  t.equal(select(2, find(object, folder)), folder .. "/models/objects/primitives/a.iv")
  t.equal(select(2, find(object)), "bounding box")
  -- the root in a path of the original
  object = write(folder .. "/models/objects/deep/a.iv", faces)
  t.equal(select(2, find(object)), folder .. "/models/objects/primitives/a.iv")
end)

test("primitives in the object's own file come third, its bounding box last", function(t)
  local folder = test.folder()
  local path = write(folder .. "/a.iv", cube)
  local list, source = find(path)
  t.equal(source, path)
  t.close(list[1].size, {0.02, 0.03, 0.04}, 1e-9)
  path = write(folder .. "/b.iv", faces)
  list, source = find(path)
  t.equal(source, "bounding box")
  t.equal(#list, 1)
  t.equal(list[1].kind, "box")
  t.close(list[1].size, {0.01, 0.02, 0.04}, 1e-9)
  t.close(list[1].pose.position, {0.005, 0.01, 0.02}, 1e-9)
  local object = clench.world {}:add_object(clench.shapes.box {0.1, 0.2, 0.3})
  list, source = primitive_source(read, object)
  t.equal(source, "bounding box")
  t.close(list[1].size, {0.1, 0.2, 0.3}, 1e-12)
  -- a file is in millimeters, and the object is not
  t.equal(select(2, find(write(folder .. "/c.iv", cube), nil, {unit = "cm"})), "bounding box")
end)

test("an unreadable file of primitives is an error, and so is an object without a surface", function(t)
  local folder = test.folder()
  local path = write(folder .. "/a.iv", cube)
  write(folder .. "/primitives/a.iv", "nonsense")
  t.fails(function() find(path) end, "plan.primitive: a.iv:1: expected a header")
  local frame = test.path(".xml", "<root><mass>100</mass></root>")
  t.fails(function() find(frame) end, "plan.primitive: object: '", "has no surface; give its shape by the option primitives")
end)

test("the report names the source of the primitives", function(t)
  local world = clench.load "worlds/parallel_jaw_cube.wld"
  local hand, object = world.robots[1], world.objects[1]
  local run = clench.plan.primitive {hand = hand, object = object, density = 1, count = 1}
  t.ok(run.report.primitives == "bounding box" or run.report.primitives:find "cube.iv", run.report.primitives)
  t.ok(tostring(run.report):find("primitives: " .. run.report.primitives, 1, true))
  t.ok(run.report.candidates > 0)
  local list = {{kind = "sphere", pose = clench.pose {}, radius = 0.02}}
  t.equal(clench.plan.primitive {hand = hand, object = object, primitives = list, density = 1, count = 1}.report.primitives, "list")
  t.fails(function() clench.plan.primitive {hand = hand, object = object, root = 5} end, "plan.primitive: root must be a folder, got 5")
end)
