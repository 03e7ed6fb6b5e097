-- Scenes of MuJoCo move as in MuJoCo.
local clench, test = require "clench", require "test"

local function load(xml)
  return clench.load(test.path(".xml", "<mujoco>" .. xml .. "</mujoco>"))
end

test("a free joint's damping slows a fall", function(t)
  local world = load [[<worldbody><body name="ball" pos="0 0 10"><joint type="free" damping="2"/>
    <geom size="0.1" mass="1"/></body></worldbody>]]
  world:run(0.5)
  -- m v' = -m g - d v
  local g, m, d, time = 9.81, 1, 2, 0.5
  t.close(10 - world:body "ball".pose.position.z, g * m / d * (time - m / d * (1 - math.exp(-d * time / m))), 5e-3)
  t.equal(world:body "ball".free_damping, 2.0)
end)

test("a link comes to rest on its fixed parent", function(t)
  local world = load [[<worldbody><body name="stand"><geom type="box" size="0.02 0.05 0.02" pos="0.3 0 -0.05"/>
    <body name="plank"><joint name="j" axis="0 1 0"/><geom type="box" size="0.2 0.05 0.0001" pos="0.2 0 0"/></body></body></worldbody>]]
  world:run(0.5)
  t.close(world.robots[1].dofs[1], 0.0933, 5e-3)
end)

test("geoms without collision bits fall through the floor", function(t)
  local world = load [[<worldbody><geom type="plane" size="1 1 1"/><body name="base" pos="0 0 1">
    <body name="arm"><joint name="j" axis="0 1 0"/><geom type="capsule" size="0.02" fromto="0.1 0 0 1.5 0 0"
    contype="0" conaffinity="0"/></body></body></worldbody>]]
  world:run(0.6)
  t.ok(world.robots[1].dofs[1] > 1, "it stands at " .. world.robots[1].dofs[1])
end)

test("a fixed tendon's range couples two joints", function(t)
  local world = load [[<worldbody><body name="base"><geom size="0.02"/><body name="m" pos="0.05 0 0">
    <joint name="a" axis="0 1 0" range="-90 90"/><geom type="capsule" size="0.01" fromto="0 0 0 0.05 0 0"/>
    <body name="d" pos="0.06 0 0"><joint name="b" axis="0 1 0" range="-90 90" damping="0.0001"/>
    <geom type="capsule" size="0.01" fromto="0 0 0 0.05 0 0"/></body></body></body></worldbody>
    <tendon><fixed name="t" limited="true" range="-0.1 0.1"><joint joint="a" coef="1"/><joint joint="b" coef="-1"/></fixed></tendon>
    <actuator><position joint="a" kp="50" kv="1"/></actuator>]]
  world:run(0.5)
  local robot = world.robots[1]
  t.close(robot.dofs[1] - robot.dofs[2], -0.1, 1e-3)
  local tendon = robot.joint_tendons[1]
  t.equal(tendon.name, "t")
  t.close(tendon.length, robot.dofs[1] - robot.dofs[2], 1e-12)
  t.equal(tendon.arms, {1.0, -1.0})
  t.equal(tendon.range, {-0.1, 0.1})
end)

test("contacts that a file switches off stay off in a saved world", function(t)
  local world = load [[<option><flag contact="disable"/></option><worldbody><geom type="plane" size="1 1 1"/>
    <body name="ball" pos="0 0 0.2"><freejoint/><geom size="0.1"/></body></worldbody>]]
  world:run(0.5)
  t.ok(world:body "ball".pose.position.z < -0.5)
  local file = test.folder() .. "/saved.lua"
  world:save(file)
  local again = clench.load(file)
  again:run(0.1)
  t.ok(again:body "ball".pose.position.z < world:body "ball".pose.position.z)
end)

test("resistance to free motion and gravity compensation are saved", function(t)
  local world = clench.world()
  world:add_object("models/objects/cube.iv", {free_damping = 1.5, free_friction = 0.25, free_armature = 0.125,
    gravity_compensation = 0.5, name = "mug"})
  local file = test.folder() .. "/saved.lua"
  world:save(file)
  local mug = clench.load(file):body "mug"
  t.equal(mug.free_damping, 1.5)
  t.equal(mug.free_friction, 0.25)
  t.equal(mug.free_armature, 0.125)
  t.equal(mug.gravity_compensation, 0.5)
end)
