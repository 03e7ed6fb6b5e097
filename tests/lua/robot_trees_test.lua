local test, clench = require "test", require "clench"

local gripper_file = "tests/data/urdf/gripper.urdf"
local function gripper(options)
  options = options or {}
  options.package = options.package or "tests/data/urdf"
  local world = clench.world()
  return world:add_robot(gripper_file, options), world
end

test("names of a URDF reach the script", function(t)
  local hand = gripper()
  t.equal(hand.dof_names, {"left_slide"})
  t.equal(hand.dof_info[1].name, "left_slide")
  t.equal(hand.dof_info[1].max_velocity, 0.1)
  t.equal(hand:link "camera".name, "gripper_camera")
  t.equal(hand:link "mount" == hand.base, true)
  t.equal(hand.chains[2].parent.name, "gripper_palm")
  t.equal(hand.chains[2].joints[1].name, "left_slide")
end)

test("two robots of one file have links with separate names", function(t)
  local first, world = gripper()
  local second = world:add_robot(gripper_file, {package = "tests/data/urdf", pose = {xyz = {1, 0, 0}}})
  t.equal(second.name, "gripper_2")
  t.equal(second:link "palm".name, "gripper_2_palm")
  t.ok(first:link "palm" ~= second:link "palm")
end)

test("a Lua world keeps the options with which a robot was read, including closing and approach", function(t)
  local hand, world = gripper {
    package = {gripper_description = "tests/data/urdf"}, folder = "tests", close = {left_slide = 0},
    approach = {point = {0, 0, 0.1}, direction = {1, 2, 3}},
  }
  hand:set_dofs {0.02}
  local path = test.path ".lua"
  world:save(path)
  local again = clench.load(path)
  t.equal(again:hash(), world:hash())
  t.equal(again.robots[1].dof_info[1].default_velocity, 0)
  t.ok(again.robots[1].approach.frame == hand.approach.frame)
end)

test("closing and approach are set by options, by name or number", function(t)
  t.ok(gripper {close = {left_slide = 1}}.dof_info[1].default_velocity > 0)
  t.ok(gripper {close = {-1}}.dof_info[1].default_velocity < 0)
  -- a DOF whose name consists of digits is selected by the name only
  local hand = clench.world():add_robot("tests/data/urdf/digits.urdf", {close = {[1] = -1}})
  t.equal({hand.dof_names[2], hand.dof_info[1].default_velocity, hand.dof_info[2].default_velocity}, {"1", -1.0, -1.0})
  hand = clench.world():add_robot("tests/data/urdf/digits.urdf", {close = {["1"] = 1}})
  t.equal({hand.dof_info[1].default_velocity, hand.dof_info[2].default_velocity}, {1.0, 1.0})
  local frame = clench.pose {xyz = {1, 2, 3}}
  t.ok(gripper {approach = {frame = frame}}.approach.frame == frame)
end)

test("a wrong option is reported by its name", function(t)
  t.fails(function() gripper {close = {left_slid = 1}} end, "did you mean 'left_slide'?")
  t.fails(function() gripper {close = {[2] = 1}} end, "expected the name of a DOF or a number from 1 to 1, got '2'")
  t.fails(function() gripper {close = {left_slide = "in"}} end, "close: left_slide: expected 1, -1 or 0, got 'in'")
  t.fails(function() gripper {close = {left_slide = 0.5}} end, "close: left_slide: expected 1, -1 or 0, got 0.5")
  t.fails(function() gripper {close = 1} end, "close: expected a table such as {index = 1, [3] = -1}")
  t.fails(function() gripper {close = {[true] = 1}} end, "close: expected names or numbers as keys, got true")
  t.fails(function() gripper {package = "no/such/folder"} end, "package: expected a folder, got 'no/such/folder'")
  t.fails(function() gripper {package = {a = 1}} end, "package: a: expected a folder, got 1")
  t.fails(function() gripper {package = 1} end, "package: expected a folder or a table of folders")
  t.fails(function() gripper {folder = "no/such/folder"} end, "folder: expected a folder, got 'no/such/folder'")
  t.fails(function() gripper {approach = 1} end, "approach: expected a table {point = ..., direction = ...} or {frame = ...}")
  t.fails(function() gripper {approach = {direction = {0, 0, 0}}} end, "approach direction: expected a direction")
  t.equal(#clench.load(gripper_file).robots, 1)
  t.fails(function() clench.load(gripper_file, {close = {nobody = 1}}) end, "close: expected the name of a DOF")
end)

test("a text world that cannot store folders of packages reports that, and names a format that can", function(t)
  local _, world = gripper()
  local path, said = test.path ".wld", {}
  clench.log.sink(function(_, text) said[#said + 1] = text end)
  local ok, message = pcall(world.save, world, path)
  clench.log.sink()
  local all = table.concat(said, "\n") .. tostring(message)
  t.ok(all:find("does not hold the option 'package' that robot 'gripper' was read with; .lua does", 1, true), all)
end)

test("a robot is fixed to any link by its name, and to the last of a chain by number", function(t)
  local world = clench.world()
  local arm = world:add_robot "models/hands/dlr/dlr.cfg"
  local hand = world:add_robot("models/hands/parallel_jaw/parallel_jaw.cfg", {name = "jaw"})
  t.fails(function() hand:mount_on(arm, {link = "chain0_link0", chain = 1}) end, "expected chain or link, got both")
  t.fails(function() hand:mount_on(arm, {link = "chain0_lnk0"}) end, "robot 'dlr' has no link 'chain0_lnk0'")
  t.fails(function() hand:mount_on(arm, {link = arm.base.name}) end, "link: expected a link, got the base of")
  hand:mount_on(arm, {link = "chain0_link0", pose = clench.pose {xyz = {0.1, 0, 0}}})
  local carrier = arm:link "chain0_link0"
  local before = hand.pose
  local dofs = arm.dofs
  for i, limits in ipairs(arm.dof_limits) do dofs[i] = 0.5 * (limits[1] + limits[2]) + 0.1 * (limits[2] - limits[1]) end
  arm.dofs = dofs
  t.ok(hand.pose ~= before)
  t.ok(((carrier.pose:inverse() * hand.pose).position - clench.vec3(0.1, 0, 0)):norm() < 1e-12)
  local file = test.path()
  world:save(file .. ".lua", {root = "."})
  t.equal(clench.load(file .. ".lua", {root = "."}):hash(), world:hash())
  -- the formats of the original only support the last links of chains
  t.fails(function() world:save(file .. ".wld", {root = "."}) end, "which is not the last link of a chain")
end)

test("a snapshot restores into clones, and into no other world", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local clone, moment, before = world:clone(), world:snapshot(), world:hash()
  clone.robots[1]:autograsp()
  clone:add_object "models/objects/flask.iv"
  clone.objects[1].mass = 2
  t.equal(world:hash(), before)
  t.ok(clone:collides() == (#clone:colliding() > 0))
  local later = clone:snapshot()
  clone:restore(moment)
  t.equal(clone:hash(), before)
  world:restore(later)
  t.equal(#world.objects, 2)
  t.equal(world.objects[1].mass, 2)
  t.fails(function() clench.world():restore(moment) end, "belongs to another world, of which this is no clone")
end)

local function turntable(joint_type, limit)
  return test.path(".urdf", [[<robot name="turntable"><link name="base"/><link name="plate"><inertial><mass value="1"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" iyz="0" ixz="0"/></inertial></link><joint name="turn" type="]] .. joint_type
    .. [["><parent link="base"/><child link="plate"/><axis xyz="0 0 1"/>]] .. (limit or "") .. [[</joint><clench><dof joint="turn" velocity="1"/></clench></robot>]])
end

test("a joint without limits is unbounded, also after its robot was written and read", function(t)
  for _, row in ipairs {{"continuous"}, {"revolute", [[<limit lower="-1e12" upper="1e12" effort="0" velocity="0"/>]]}, {"prismatic"}} do
    local path = turntable(row[1], row[2])
    for _ = 1, 2 do
      local world = clench.world()
      local robot = world:add_robot(path)
      t.equal(robot.dof_info[1].endless, true)
      t.close(robot.dof_limits[1][2], row[1] == "prismatic" and 1 or 2 * math.pi, 1e-12)
      robot.controller = "effort"
      robot.dof_velocities = {10}
      local reached = 0
      world:on("limit", function() reached = reached + 1 end)
      world:run(2)
      t.close(robot.dofs[1], 20, 1e-6)
      t.equal(reached, 0)
      -- its position can be set, and restored from a snapshot
      local state = world:snapshot()
      robot:set_dofs {30}
      world:restore(state)
      t.close(robot.dofs[1], 20, 1e-6)
      -- closing continues from there, up to dof_limits
      local far = robot.dof_limits[1][2]
      t.close(far, 20 + (row[1] == "prismatic" and 1 or 2 * math.pi), 1e-6)
      robot:autograsp()
      t.close(robot.dofs[1], far, 1e-6)
      world:restore(state)
      robot:autograsp {dynamic = true}
      world:run(7)
      t.close(robot.dofs[1], far, 0.05)
      local now, reach = robot.dofs[1], far - 20
      for seed = 1, 20 do t.close(robot:random_posture(clench.random(seed))[1], now, reach + 1e-9) end
      local written = test.path ".urdf"
      clench.convert(path, written)
      path = written
    end
  end
  local path = turntable("revolute", [[<limit lower="-1" upper="1" effort="0" velocity="0"/>]])
  local limited = clench.world():add_robot(path)
  t.equal(limited.dof_info[1].endless, false)
  t.fails(function() limited:set_dofs {2} end, "must lie in [-1, 1] rad")
end)

test("a joint without limits takes the position of a keyframe, and searches start near its current one", function(t)
  local path = test.path(".xml", [[<mujoco model="arm"><compiler angle="radian"/><worldbody><body name="base"><geom size="0.1" mass="1"/>
    <body name="upper" pos="0 0 0.2"><joint name="a" axis="0 0 1"/><geom size="0.02" pos="0.2 0 0" mass="0.1"/>
    <body name="lower" pos="0.3 0 0"><joint name="b" axis="0 0 1" range="-2 2" limited="true"/><geom size="0.02" pos="0.2 0 0" mass="0.1"/>
    </body></body></body></worldbody><keyframe><key name="far" qpos="100 1"/></keyframe></mujoco>]])
  local world = clench.load(path)
  local arm = world.robots[1]
  world:set_keyframe "far"
  t.equal(arm.dofs, {100.0, 1.0})
  arm:set_dofs {100.02, 1.01}
  local goal = arm:link "lower".pose
  arm:set_dofs {100, 1}
  local found = arm:ik("lower", goal, {starts = 1})
  t.ok(found.reached)
  t.close(found.dofs[1], 100.02, 1e-4)
end)

-- two fingers on slides, on a wrist without limits; the box between them turns along
local function wrist_gripper(turn)
  local function link(name, z, size)
    return ([[<link name="%s"><collision><origin xyz="0 0 %g"/><geometry><box size="%s"/></geometry></collision></link>]]):format(name, z, size)
  end
  local function finger(name, x)
    return ([[<joint name="%s_slide" type="prismatic"><parent link="palm"/><child link="%s"/><origin xyz="%g 0 0.03"/><axis xyz="%g 0 0"/>
      <limit lower="0" upper="0.045" effort="10" velocity="1"/></joint>]]):format(name, name, x, x < 0 and 1 or -1)
  end
  local path = test.path(".urdf", [[<robot name="gripper">]] .. link("arm", 0, "0.1 0.1 0.02") .. link("palm", 0.02, "0.12 0.05 0.01")
    .. link("left", 0.05, "0.01 0.02 0.08") .. link("right", 0.05, "0.01 0.02 0.08") .. [[<joint name="wrist" type="continuous"><parent link="arm"/><child link="palm"/><axis xyz="0 0 1"/></joint>]]
    .. finger("left", -0.05) .. finger("right", 0.05) .. "</robot>")
  local world = clench.world()
  local hand = world:add_robot(path, {close = {left_slide = 1, right_slide = 1}, approach = {point = {0, 0, 0.1}, direction = {0, 0, 1}}})
  local box = world:add_object(clench.shapes.box {0.03, 0.03, 0.03}, {mass = 0.1, pose = clench.pose {xyz = {0, 0, 0.1}, rpy = {0, 0, 0.3}}})
  hand:set_dofs {wrist = turn}
  hand:autograsp()
  return clench.grasp(hand, box), hand, world
end

test("grasps, their measures and searches do not depend on full turns of a wrist without limits", function(t)
  local far = 20 * math.pi + 0.3
  local once, hand = wrist_gripper(0.3)
  local often, turned = wrist_gripper(far)
  t.equal({hand.dof_names[1], hand.dof_info[1].endless, hand.dof_info[2].endless}, {"wrist", true, false})
  t.close(turned.dofs[1], far, 1e-12)
  -- 20 pi has an error of 1e-14 in the sine
  t.ok(once.epsilon > 0)
  t.close(often.epsilon, once.epsilon, 1e-9)
  for _, measure in ipairs {"joint_margin", "joint_deviation"} do
    t.close(often:quality(measure), once:quality(measure), 1e-9)
  end
  local a, b = (clench.study.robustness(once, {samples = 20})), (clench.study.robustness(often, {samples = 20}))
  t.ok(a.probability > 0.5)
  t.equal(b.probability, a.probability)
  t.close(b.mean, a.mean, 1e-6)
  -- fixed variables do not move
  for _, options in ipairs {{posture = "fixed"}, {posture = "dofs", fixed = {"wrist"}}} do
    options.hand, options.object, options.position = turned, often.object, "approach"
    options.energy = function() return 1 end
    local search = clench.annealing(options)
    t.close(search.state.dofs[1], far, 1e-9)
  end
end)

test("worlds differ by whether a limit stops a joint", function(t)
  local function world(joint_type, limit)
    local path = turntable(joint_type, limit)
    local out = clench.world()
    out:add_robot(path)
    return out
  end
  local limit = ([[<limit lower="%.17g" upper="%.17g" effort="0" velocity="0"/>]]):format(-2 * math.pi, 2 * math.pi)
  t.equal(world("continuous"):hash(), world("continuous"):hash())
  t.ok(world("continuous"):hash() ~= world("revolute", limit):hash())
end)

test("a compliant DOF without limits moves on, and positions of its joints can be set", function(t)
  local path = test.path(".urdf", [[<robot name="spool"><link name="base"/><link name="drum"><inertial><mass value="1"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" iyz="0" ixz="0"/></inertial></link><joint name="turn" type="continuous"><parent link="base"/>
    <child link="drum"/><axis xyz="0 0 1"/></joint><clench><dof joint="turn" kind="compliant" velocity="1"/><joint name="turn" spring="1"/></clench></robot>]])
  local world = clench.world()
  local robot = world:add_robot(path)
  robot:set_dofs {20}
  robot:set_target_velocities {1}
  world:run(0.5)
  t.close(robot.dofs[1], 20.5, 0.01)
  robot:set_dofs({20}, {joint_positions = {{1, 1, 19.9}}})
  t.close(robot.chains[1].joints[1].value, 19.9, 1e-12)
  t.fails(function() robot:set_dofs({20}, {joint_positions = {{1, 1, 0 / 0}}}) end, "expected a finite number, got nan")
end)
