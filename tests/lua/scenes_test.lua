local test, clench = require "test", require "clench"

local folder = test.folder()

local function write(name, text)
  local path = folder .. "/" .. name
  clench.files.save_text(path, text)
  return path
end

-- a table, an arm with its own friction, a door, a mug
local scene = write("scene.xml", [[
<mujoco model="kitchen"><compiler angle="radian"/><option gravity="0 0 -1.62"/>
<worldbody>
  <geom name="floor" type="plane" size="1 1 1"/>
  <body name="arm"><geom type="box" size="0.05 0.05 0.05" pos="0 0 0.05"/>
    <body name="upper" pos="0 0 0.2"><joint name="shoulder" axis="0 1 0" range="-1 1" damping="0.5" armature="0.01" frictionloss="0.1"/>
      <geom type="box" size="0.02 0.02 0.05" friction="0.7"/></body></body>
  <body name="door" pos="1 1 0.5"><joint name="hinge" range="0 1.5"/><geom type="box" size="0.2 0.01 0.4" pos="0.2 0 0"/></body>
  <body name="mug" pos="0.5 0 0.5"><freejoint/><geom type="box" size="0.03 0.03 0.04" mass="0.2" friction="1.2"/></body>
</worldbody>
<actuator><position name="servo" joint="shoulder" kp="100" ctrlrange="-1 1"/></actuator>
<keyframe><key name="home" qpos="0.1 0.5 0.5 0.1 0.6 1 0 0 0"/><key name="away" qpos="0 0 2 2 2 0 0 0 1"/></keyframe>
</mujoco>]])

test("a scene of MuJoCo is a world", function(t)
  local world = clench.load(scene)
  t.equal(#world.robots, 2)
  t.equal(world.objects[1].name, "mug")
  t.equal(world.obstacles[1].name, "floor")
  t.equal(world.gravity.z, -1.62)
  t.equal(world:friction("friction 1.2", "friction 0.7"), 1.2)
  -- on materials that every world has: the larger of the two coefficients
  t.equal(world:friction("friction 0.7", "rubber"), world:friction("rubber", "rubber"))
  t.equal(world:friction("friction 1.2", "frictionless"), 0.0)
  local joint = world:robot("arm").chains[1].joints[1]
  t.equal(joint.damping, 0.5)
  t.equal(joint.friction, 0.1)
  t.equal(joint.armature, 0.01)
  local servo = world:robot("arm").actuators[1]
  t.equal(servo.name, "servo")
  t.equal(servo.dof, 1)
  t.equal(servo.gain, 100.0)
  t.equal(servo.bias[2], -100.0)
  t.equal(#world:robot("door").actuators, 0)
  -- the base on the floor is fixed to it, and the door's frame overlaps it
  t.equal(#world:colliding(), 0)
end)

test("keyframes are named states", function(t)
  local world = clench.load(scene, {keyframe = "home"})
  t.equal(table.concat(world.keyframes, " "), "home away")
  t.equal(world:robot("arm").dofs[1], 0.1)
  t.equal(world:body("mug").pose.position.z, 0.6)
  world:set_keyframe "away"
  t.equal(world:robot("door").dofs[1], 0.0)
  t.equal(world:body("mug").pose.position.x, 2.0)
  world:remove(world:body "mug")
  world:set_keyframe "home"
  t.equal(world:robot("arm").dofs[1], 0.1)
  local copy = world:clone()
  copy:add_keyframe "home"
  t.equal(#copy.keyframes, 2)
  t.fails(function() world:set_keyframe "hme" end, "no keyframe 'hme' in this world, expected one of home, away")
  t.fails(function() clench.load(scene, {keyframe = "x"}) end, "no keyframe 'x'")
  t.fails(function() world:add_keyframe "" end, "keyframe: expected a name, got none")
  t.fails(function() world:add_keyframe("x", {{robot = world:robot "arm", dofs = {2}}}) end, "keyframe 'x': robot 'arm': DOF 1: expected a value in [-1, 1], got 2")
  t.fails(function() world:add_keyframe("x", {{body = world:robot("arm").base}}) end, "is a part of robot 'arm': place the robot")
  t.fails(function() world:add_keyframe("x", {{body = clench.load(scene):body "mug"}}) end, "belongs to another world")
  t.fails(function() world:add_keyframe("x", {{body = copy:body "floor", poes = 1}}) end, "belongs to another world")
  t.fails(function() world:add_keyframe("x", {{body = world:body "floor", poes = 1}}) end, "unknown key 'poes'")
end)

test("gravity is part of a world, and acts on joints", function(t)
  local world = clench.world()
  local before = world:hash()
  world.gravity = {0, 0, -1}
  t.equal(world:hash() == before, false)
  local moment = world:snapshot()
  world.gravity = {0, 0, 0}
  world:restore(moment)
  t.equal(world.gravity.z, -1.0)
  t.fails(function() world.gravity = {0, 2e6, 0} end, "gravity: expected a number from")
end)

test("saved scenes are read back equal", function(t)
  local world = clench.load(scene, {keyframe = "home"})
  world:save(folder .. "/saved.lua")
  t.equal(clench.load(folder .. "/saved.lua"):hash(), world:hash())
  -- once more from the scene that was read
  clench.load(folder .. "/saved.lua"):save(folder .. "/again.lua")
  t.equal(clench.load(folder .. "/again.lua"):hash(), world:hash())
  local said = {}
  clench.log.sink(function(level, text) if level == "warning" then said[#said + 1] = text end end)
  world:save(folder .. "/saved.wld")
  local text = clench.load(folder .. "/saved.wld")
  world:save(folder .. "/saved.xml", {format = "graspit"})
  local xml = clench.load(folder .. "/saved.xml")
  clench.log.sink()
  t.ok(table.concat(said, "\n"):find("the material of 'floor'", 1, true))
  for _, other in ipairs {text, xml} do
    t.equal(#other.robots, 2)
    t.equal(other.robots[2].name, "door")
    t.equal(other.robots[1].dofs[1], world.robots[1].dofs[1])
    t.equal(other.objects[1].pose, world.objects[1].pose)
  end
end)

test("clench check reports the bodies of a scene, and the parts of a single robot", function(t)
  local report = require "clench.report"
  local r = report.of(scene)
  local world = clench.load(scene)
  t.equal(r.kind, "world")
  t.equal(#r.parsed.objects, #world.objects)
  t.equal(#r.parsed.obstacles, #world.obstacles)
  t.equal(#r.parsed.robots, #world.robots)
  t.equal(table.concat(r.parsed.keyframes, " "), table.concat(world.keyframes, " "))
  t.equal(r.parsed.gravity[3], world.gravity.z)
  t.ok(table.concat(r.inferred, "\n"):find("no approach direction is given", 1, true), table.concat(r.inferred, "\n"))
  for _, sentence in ipairs(r.ignored) do t.ok(not sentence:find("keyframe", 1, true), sentence) end
  t.equal(r.parsed.is_scene, true)
  local turned = write("turned.xml", [[<mujoco><worldbody><body name="arm" pos="1 2 3" euler="90 0 0"><geom size="0.1"/>
<body name="upper"><joint range="-1 1"/><geom size="0.1" pos="0 0 0.3"/></body></body><geom size="0.1" pos="5 5 5"/></worldbody></mujoco>]])
  local approach = report.of(turned).parsed.robots[1].approach  -- in the base: its z axis, because nothing closes
  for i = 1, 3 do
    t.close(approach.point[i], 0, 1e-12)
    t.close(approach.direction[i], i == 3 and 1 or 0, 1e-12)
  end
  local alone = write("alone.xml", [[<mujoco><worldbody><body name="arm"><geom size="0.1"/><body name="upper">
<joint range="-1 1"/><geom size="0.1" pos="0 0 0.3"/></body></body></worldbody></mujoco>]])
  t.equal(report.of(alone).kind, "robot")

  -- meshes may be in another folder
  local meshed = write("meshed.xml", [[<mujoco><asset><mesh name="m" file="m.obj"/></asset><worldbody>
<body name="tin"><freejoint/><geom type="mesh" mesh="m"/></body></worldbody></mujoco>]])
  assert(os.execute("mkdir -p " .. folder .. "/meshes"))
  clench.convert("models/objects/cube.iv", folder .. "/meshes/m.obj")
  t.ok(report.of(meshed).error:find("no such file", 1, true), report.of(meshed).error)
  t.equal(report.of(meshed, {folder = folder .. "/meshes"}).error, nil)

  local broken = test.path(".xml", '<mujoco><worldbody><geom type="bxo"/></worldbody></mujoco>')
  t.ok(report.of(broken).error:find("did you mean 'box'?", 1, true), report.of(broken).error)
end)

test("a world of one body is reported in the singular", function(t)
  local world = clench.world {}
  world:add_object(clench.shapes.box {0.1, 0.1, 0.1})
  t.equal(tostring(world), "world of 1 body, 0 robots")
end)

test("a robot's new file may be a URDF or a world", function(t)
  t.fails(function() clench.convert(scene, folder .. "/made.foo") end,
          "made.foo: expected a robot to .urdf, or its world to .xml, .mjcf, .lua or .wld, got '.foo'")
end)

test("a scene is converted to a world, and its robots are kept with their actuators", function(t)
  t.equal(clench.convert(scene, folder .. "/made.lua"), "world")
  local world = clench.load(folder .. "/made.lua")
  t.equal(#world.robots, 2)
  t.equal(world.keyframes[1], "home")
  t.equal(#world:robot("arm").actuators, 1)
end)

test("gravity may be zero", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  hand:autograsp()
  local grasp = clench.grasp(hand, flask)
  local there = grasp:quality "gravity_effort"
  world.gravity = {0, 0, -2 * 9.81}
  t.close(grasp:quality "gravity_effort", 2 * there, 1e-6 * there)
  world.gravity = {0, 0, 0}
  t.close(grasp:quality "gravity_effort", 0, 1e-9)
  t.ok(grasp:quality "grasp_robustness" >= 0)
end)

test("one robot of a scene is selected by its first body", function(t)
  local world = clench.world()
  t.equal(#world:add_robot(scene, {body = "arm", pose = {xyz = {0, 0, 1}}}).links, 1)
  t.fails(function() world:add_robot(scene, {body = "mug"}) end, "body: expected the root of a tree of joints, got 'mug', expected one of arm, door")
  -- it is loaded and written in the same way
  t.equal(#clench.load(scene, {body = "door"}).robots, 1)
  t.equal(clench.convert(scene, folder .. "/arm.urdf", {body = "arm"}), "robot")
  t.equal(#clench.world():add_robot(folder .. "/arm.urdf").dofs, 1)
  t.fails(function() clench.load("worlds/dlr_flask.wld", {body = "arm"}) end, "dlr_flask.wld: body: expected a scene of MJCF, got another file")
  -- without a selection all are one robot, with a warning
  local told = table.concat(t.warnings(function() t.equal(#clench.world():add_robot(scene).dofs, 2) end), "\n")
  t.ok(told:find("scene.xml: these bodies are read as one robot: arm, door; the option 'body' reads one of them, and clench.load a world with all of them", 1, true), told)
end)

test("a robot with a free joint moves freely, also in a saved world", function(t)
  local drone = write("drone.xml", [[<mujoco><worldbody><body name="drone" pos="0 0 1"><freejoint/><geom size="0.1"/>
    <body><joint name="tilt" range="0 1"/><geom size="0.02" pos="0.2 0 0"/></body></body></worldbody></mujoco>]])
  local world = clench.load(drone)
  t.equal(world.robots[1].floating, true)
  world:run(0.1)
  t.close(world.robots[1].pose.position.z, 1 - 9.81 * 0.1 ^ 2 / 2, 1e-3)
end)

test("keyframes take lists of states, with DOFs by their names", function(t)
  local world = clench.load(scene)
  local arm = world:robot "arm"
  world:add_keyframe("bent", {{robot = arm, dofs = {shoulder = 0.5}}})
  world:set_keyframe "bent"
  t.close(arm.dofs[1], 0.5, 0)
  world:add_keyframe("nothing", {})
  t.fails(function() world:add_keyframe("one", {robot = arm, dofs = {0.5}}) end,
          "world:add_keyframe: expected a list of states, as in {{robot = hand, dofs = hand.dofs}}, got a table with names")
  t.fails(function() world:add_keyframe("one", {{robot = arm}}) end, "state 1: dofs: expected their values, got none")
  t.fails(function() world:add_keyframe("one", {{robot = arm, dofs = {shoulder = "up"}}}) end, "world:add_keyframe: state 1: shoulder: expected a number, got 'up'")
end)

test("a robot's or a body's file is a world with that content", function(t)
  t.equal(#clench.load("tests/data/two_finger/claw.cfg").robots, 1)
  t.equal(clench.load("models/objects/flask.iv", {root = "."}).objects[1].name, "flask")
end)
