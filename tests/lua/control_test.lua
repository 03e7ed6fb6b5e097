-- Scripts that take part in a run: times of their calls, reasons of their end, and safety of the world.
local test, clench = require "test", require "clench"

local function falling_box()
  local world = clench.world()
  local box = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "box", mass = 1, pose = {xyz = {0, 0, 1}}})
  return world, box
end

local function on_floor()
  local world, box = falling_box()
  world:add_obstacle(clench.shapes.box {2, 2, 0.1}, {name = "floor", pose = {xyz = {0, 0, -0.05}}})
  return world, box
end

test("a function that does nothing changes nothing bit-exactly, and run ends exactly", function(t)
  local world, box = on_floor()
  box.velocity = {linear = {0.3, 0, 0}, angular = {0, 5, 1}}
  local other = world:clone()
  local calls, sum = 0, 0
  world:on_step(function(w, dt)
    t.ok(w == world and dt > 0 and dt <= world.time_step * (1 + 1e-9))
    calls, sum = calls + 1, sum + dt
  end)
  world:run(0.7123)
  other:run(0.7123)
  t.equal(world:hash(), other:hash())
  t.equal(world.time, 0.7123)
  t.ok(calls >= 713 and calls == world.report.steps)
end)

test("the reported step lengths add up to the elapsed time, for any division into runs", function(t)
  for _, piece in ipairs {0.0015, 0.0025, 1 / 60, 0.0007} do
    local world = falling_box()
    local sum = 0
    world:on_step(function(_, dt) sum = sum + dt end)
    for _ = 1, 20 do world:run(piece) end
    t.close(sum, world.time, 1e-12)
    t.close(sum, 20 * piece, 1e-12)
  end
end)

test("a surface velocity acts only along the surface", function(t)
  local world, box = on_floor()
  box.pose = clench.pose {xyz = {0, 0, 0.05 + 2e-5}}
  world:body "floor".surface_velocity = {0.2, 0, 5}
  world:run(1)
  t.close(box.velocity.linear.x, 0.2, 1e-9)
  t.close(box.pose.position.z, 0.05, 1e-4)
end)

test("functions are called in order, at their rates, from the current time of the world", function(t)
  local world = falling_box()
  local seen = {}
  world:on_step(function() seen[#seen + 1] = "a" end, {rate = 10})
  world:on_step(function(_, dt) seen[#seen + 1] = "b" t.close(dt, 0.05, 1e-15) end, {rate = 20})
  world:run(0.1)
  t.equal(table.concat(seen), "abb")  -- at 0 both, b at 0.05; that of 0.1 comes with the next run
  world:run(0.001)
  t.equal(table.concat(seen), "abbab")
  -- after a restored snapshot the times are called again
  local times, moment = {}, world:snapshot()
  local handle = world:on_step(function(w) times[#times + 1] = w.time end, {rate = 50})
  world:run(0.1)
  local first = table.move(times, 1, #times, 1, {})
  world:restore(moment)
  times = {}
  world:run(0.1)
  t.close(times, first, 0)
  t.ok(#times == 5)
  handle:remove()
  t.equal(handle.status, "removed")
  world:run(0.1)
  t.equal(#times, 5)
  -- at most once per step
  local sum, calls = 0, 0
  world:on_step(function(_, dt) sum, calls = sum + dt, calls + 1 end, {rate = 2000})
  world:run(0.01)
  t.equal(calls, 10)
  t.close(sum, 0.01, 1e-12)
end)

test("a controller holds a box in the air", function(t)
  local world, box = falling_box()
  world:on_step(function()
    local v, z = box.velocity.linear.z, box.pose.position.z
    box:apply_force {0, 0, 9.81 + 100 * (1 - z) - 20 * v}
  end)
  world:run(1)
  t.close(box.pose.position.z, 1, 1e-3)
end)

test("a controller with a rate is equivalent to a script that steps", function(t)
  local world, box = falling_box()
  local other = world:clone()
  world:on_step(function() box.velocity = {linear = {world.time, 0, 0}} end, {rate = 100})
  world:run(0.2)
  local same = other.objects[1]
  for i = 0, 19 do
    same.velocity = {linear = {other.time, 0, 0}}
    other:run((i + 1) / 100 - other.time)
  end
  t.close(box.pose.position, same.pose.position, 1e-12)
end)

test("tasks wait for times and for conditions, in the order of their creation", function(t)
  local world = falling_box()
  local seen = {}
  local function note(text) seen[#seen + 1] = ("%s %.3f"):format(text, world.time) end
  local a = world:spawn(function(task)
    note "a"
    task.wait(0.01)
    note "a"
    local met = task.wait_until(function() return world.objects[1].velocity.linear.z < -0.2 end, 1)
    note(tostring(met))
    met = task.wait_until(function() return false end, 0.01)
    note(tostring(met))
  end)
  local b = world:spawn(function(task)
    note "b"
    task.wait_step()
    note "b"
  end)
  world:run(0.1)
  t.equal(table.concat(seen, ", "), "a 0.000, b 0.000, b 0.001, a 0.010, true 0.021, false 0.031")
  t.ok(a.status == "done" and b.status == "done")
end)

test("tasks may spawn tasks, end themselves and others, and outlive a run", function(t)
  local world = falling_box()
  local log = {}
  local endless = world:spawn(function(task) while true do log[#log + 1] = "." task.wait(0.01) end end)
  world:spawn(function(task)
    task.wait(0.025)
    world:spawn(function() log[#log + 1] = "new" end)
    endless:remove()
  end)
  world:run(0.02)
  t.equal(table.concat(log), "..")
  world:run(0.05)
  t.equal(table.concat(log), "...new")
  t.equal(endless.status, "removed")
end)

test("contacts and limits are reported by one event each", function(t)
  local world, box = on_floor()
  box.pose = clench.pose {xyz = {0, 0, 0.2}}
  local events = {}
  world:on("contact", function(e)
    events[#events + 1] = e.kind
    t.ok(e.a.name == "box" and e.b.name == "floor" or e.a.name == "floor" and e.b.name == "box")
    t.ok(e.time == world.time and math.abs(e.point.z) < 1e-3)
  end)
  world:on("contact_lost", function(e) events[#events + 1] = e.kind end)
  world:run(0.5)
  t.equal(table.concat(events, " "), "contact")
  world:run(0.2)
  t.equal(#events, 1)
  box.pose = clench.pose {xyz = {0, 0, 0.5}}
  world:run(0.01)
  t.equal(table.concat(events, " "), "contact contact_lost")

  local hand_world = clench.world()
  local hand = hand_world:add_robot "models/hands/barrett/barrett.cfg"
  local limits = {}
  hand_world:on("limit", function(e) if e.robot == hand and e.side == "high" then limits[e.dof] = e.value end end)
  hand.controller = "effort"
  hand:set_forces {5, 0, 0, 0}
  hand_world:run(2)
  t.close(limits[1], math.pi, 1e-4)
  t.equal(#limits, 1)
end)

test("an error ends the run with its position, and the world can continue", function(t)
  local world = falling_box()
  local handle = world:on_step(function() local nothing; nothing.x = 1 end)
  local message = t.fails(function() world:run(1) end, "attempt to index a nil value (local 'nothing')", "in a function of world:on_step",
                          "stack traceback", "control_test.lua")
  t.ok(message:find "control_test.lua:%d+:")
  t.equal(world.time, 0.0)
  handle:remove()
  world:run(0.01)
  local function deep(task) task.wait(0.005) error "too deep" end
  local task = world:spawn(function(task) deep(task) end)
  t.fails(function() world:run(1) end, "too deep", "in a task of world:spawn", "in upvalue 'deep'")
  t.equal(task.status, "failed")
  t.close(world.time, 0.015, 1e-9)
  world:run(0.01)
  task = world:spawn(function(task) task.wait_until(function() error "bad condition" end) end)
  t.fails(function() world:run(1) end, "bad condition")
  world:on("contact", function() error "never called" end)
  world:run(0.01)
end)

test("controllers may remove bodies and restore snapshots, but not start another run", function(t)
  local world, box = on_floor()
  local start = world:snapshot()
  world:spawn(function(task)
    task.wait(0.05)
    world:remove(box)
    task.wait(0.05)
    world:restore(start)
  end)
  local lost = 0
  world:on("contact_lost", function() lost = lost + 1 end)
  world:run(0.2)
  -- 0.1 s until the restore, and 0.1 s from there
  t.close(world.time, 0.1, 1e-12)
  t.close(box.pose.position.z, 1 - 0.5 * 9.81 * 0.01, 1e-2)
  world:on_step(function() world:run(1) end)
  t.fails(function() world:run(0.1) end, "world:run: the world is already running")
  -- another world may run
  local a, b = falling_box(), falling_box()
  a:on_step(function() b:run(0.001) end)
  a:run(0.01)
  t.close(b.time, 0.01, 1e-9)
end)

test("functions belong to one world: not to its clones and not to later worlds", function(t)
  local calls = 0
  for _ = 1, 50 do
    local world = falling_box()
    world:clone():run(0.002)
    t.equal(calls, 0)
    world:on_step(function() calls = calls + 1 end)
    world:run(0.002)
    t.equal(calls, 2)
    calls = 0
    world = nil
    collectgarbage()
  end
end)

test("faults are reported in one sentence", function(t)
  local world = falling_box()
  t.fails(function() world:on_step() end, "world:on_step: expected a function, got nothing")
  t.fails(function() world:on_step(print, {rate = 0}) end, "world:on_step: rate must be")
  t.fails(function() world:on_step(print, {rat = 1}) end, "world:on_step: unknown key 'rat'")
  t.fails(function() world:spawn(3) end, "world:spawn: expected a function, got 3")
  t.fails(function() world:on(nil, print) end, "world:on: event must be 'contact', 'contact_lost' or 'limit', got nothing")
  t.fails(function() world:on("touch", print) end, "world:on: event must be 'contact', 'contact_lost' or 'limit', got 'touch'")
  t.fails(function() world:on("contact") end, "world:on: expected a function, got nothing")
  local kept
  world:spawn(function(task)
    kept = task
    t.fails(function() task.wait(-1) end, "task.wait: expected a time >= 0 in seconds, got -1")
    t.fails(function() task.wait_until(3) end, "task.wait_until: expected a function, got 3")
    task.wait(1)
  end)
  world:run(0.01)
  t.fails(function() kept.wait(1) end, "task.wait: expected to be called in the task's own function")
end)

local function vector(matrix, v)
  local out = {}
  for i, row in ipairs(matrix) do
    out[i] = 0
    for k, x in ipairs(row) do out[i] = out[i] + x * v[k] end
  end
  return out
end

test("the mass matrix gives the kinetic energy, and inverse dynamics the forces that a motion requires", function(t)
  for _, file in ipairs {"barrett/barrett.cfg", "dlr/dlr.cfg"} do
    local world = clench.world()
    local hand = world:add_robot("models/hands/" .. file)
    hand.gravity_compensation = false
    hand.controller = "none"
    local random, velocities, middle = clench.random(3), {}, {}
    for i, limit in ipairs(hand.dof_limits) do
      velocities[i] = random:normal()
      middle[i] = 0.6 * limit[1] + 0.4 * limit[2]
    end
    hand:set_dofs(middle)
    hand.dof_velocities = velocities
    local M = hand:mass_matrix()
    for i = 1, #M do
      for k = 1, #M do t.close(M[i][k], M[k][i], 1e-15) end
    end
    local before = hand.dof_velocities
    -- forces of inverse dynamics give the requested accelerations
    local asked = {}
    for i = 1, #M do asked[i] = random:normal() end
    world.time_step = 1e-5
    hand:set_forces(hand:inverse_dynamics(asked))
    world:run(1e-5)
    local largest = 0
    for i, v in ipairs(hand.dof_velocities) do largest = math.max(largest, math.abs((v - before[i]) / 1e-5 - asked[i])) end
    t.ok(largest < 0.02 * math.sqrt(#M), ("%s: %g"):format(file, largest))
    local energy = 0
    local v = hand.dof_velocities
    for i, x in ipairs(vector(hand:mass_matrix(), v)) do energy = energy + 0.5 * x * v[i] end
    t.close(world:energy().kinetic, energy, 1e-6 * energy)
    t.fails(function() hand:inverse_dynamics {1 / 0} end, "expected")
  end
end)

test("bias forces include gravity if the motors of a robot do not compensate it", function(t)
  local world = clench.world()
  local hand = world:add_robot "models/hands/barrett/barrett.cfg"
  hand.gravity_compensation = true
  for _, force in ipairs(hand:bias_forces()) do t.close(force, 0, 1e-12) end
  hand.gravity_compensation = false
  local sum = 0
  for _, force in ipairs(hand:bias_forces()) do sum = sum + math.abs(force) end
  -- some 8 cm of finger, 0.2 kg in total
  t.ok(sum > 0.1 and sum < 0.3)
end)

test("stiffer motors yield less", function(t)
  local function deflection(gains)
    local world = clench.world()
    local hand = world:add_robot "models/hands/barrett/barrett.cfg"
    hand.gains = gains
    hand:set_dofs {0, 1, 1, 1}
    for _ = 1, 500 do
      hand.links[3]:apply_force {0, 0, -1}
      hand.links[3]:apply_force {1, 0, 0}
      world:run(0.001)
    end
    return math.abs(hand.dofs[2] - 1)
  end
  local function all(kp) return {{kp = kp, kd = 0.1}, {kp = kp, kd = 0.1}, {kp = kp, kd = 0.1}, {kp = kp, kd = 0.1}} end
  local soft, stiff = deflection(all(2)), deflection(all(20))
  t.ok(soft > 5 * stiff and stiff > 0, ("%g and %g"):format(soft, stiff))
  local hand = clench.world():add_robot "models/hands/barrett/barrett.cfg"
  t.fails(function() hand.gains = {{kp = 1}, false, false, false} end, "hand.gains[1]: kd: expected a number, got nil")
  t.fails(function() hand.gains = {{kp = -1, kd = 0}, false, false, false} end, "expected a number from 0 to 1e+12")
  t.fails(function() hand.gains = {{kp = 1, kd = 0, ki = 1}, false, false, false} end, "unknown key 'ki'")
  t.fails(function() hand.gains = 5 end, "expected a list of gains, got 5")
end)

-- a rod of 0.2 m on a hinge, initially horizontal; actuators: elements of MuJoCo
-- returns its world, the robot, and the robot read back from a URDF file
local function rod(actuators)
  local path = test.path(".xml", [[<mujoco model="rod"><compiler angle="radian"/><worldbody><body name="base" pos="0 0 1"><geom size="0.02" mass="1"/>
    <body name="rod"><joint name="hinge" axis="0 1 0" range="-3 3" limited="true"/>
    <geom type="box" size="0.1 0.005 0.005" pos="0.1 0 0" mass="0.1"/></body></body></worldbody>]] .. (actuators or "") .. "</mujoco>")
  local world = clench.world()
  local robot, written = world:add_robot(path), test.path ".urdf"
  clench.convert(path, written)
  local again = clench.world():add_robot(written)
  return world, robot, again
end

test("a joint without actuators swings, and one with a servo is held, and carries the weight", function(t)
  local world, robot = rod()
  t.equal(robot.controller, "effort")
  t.equal(robot.dof_info[1].driven, false)
  -- the weight of 0.1 kg at 0.1 m, on the hinge
  t.close(math.abs(robot:bias_forces()[1]), 0.1 * 9.81 * 0.1, 1e-9)
  world:run(0.05)
  -- a thin rod's angular acceleration 3 g / (2 l), a box's inertia a little more
  t.close(robot.dof_velocities[1] / 0.05, 1.5 * 9.81 / 0.2, 0.5)
  t.equal(robot.dof_efforts[1], 0)
  robot.controller = "position"
  robot:set_targets {0}
  world:run(1)
  -- held, by gains that follow from its inertia: it sags
  t.close(robot.dofs[1], 0, 0.05)
  t.close(robot.dof_velocities[1], 0, 1e-6)

  world, robot = rod [[<actuator><position joint="hinge" kp="1"/></actuator>]]
  t.equal(robot.controller, "position")
  t.equal(robot.dof_info[1].driven, true)
  t.close(robot:bias_forces()[1], 0, 1e-12)
  world:run(0.5)
  t.close(robot.dofs[1], 0, 1e-9)
  robot.gravity_compensation = false
  world:run(2)
  -- kp q = m g l cos q
  t.close(robot.dofs[1], 0.0981 * math.cos(robot.dofs[1]), 1e-3)
end)

test("the force added to a controller's effort and that effort together stay within the maximal effort", function(t)
  local world, robot = rod [[<actuator><position joint="hinge" kp="40" kv="2" forcerange="-20 20"/></actuator>]]
  world.gravity = {0, 0, 0}
  world.time_step = 1e-6
  -- in a time in which 20 N m accelerate the rod to 0.015 rad/s, at which the servo's damping is 0.03 N m
  local function effort(target, force)
    robot:set_dofs {0}
    robot:set_targets {target}
    robot:set_forces {force}
    world:run(1e-6)
    return robot.dof_efforts[1]
  end
  t.close(effort(0.25, -5), 5, 0.03)
  t.close(effort(2.5, -90), 10, 0.03)
  t.close(effort(-2.5, 90), -10, 0.03)
  t.close(effort(0, 50), 20, 1e-12)
  t.close(effort(1, 50), 20, 1e-12)
  t.close(effort(1, -100), -20, 1e-12)
end)

test("setting a velocity changes only what it names", function(t)
  local _, box = falling_box()
  box.velocity = {linear = {1, 2, 3}, angular = {4, 5, 6}}
  box.velocity = {angular = {0, 0, 1}}
  t.equal(box.velocity.linear, clench.vec3(1, 2, 3))
  t.equal(box.velocity.angular, clench.vec3(0, 0, 1))
  for _, wrong in ipairs {{{1, 2, 3}}, {3}} do
    t.fails(function() box.velocity = wrong[1] end, "expected {linear = {x, y, z}, angular = {x, y, z}}, got")
  end
  t.fails(function() box.velocity = {linaer = {1, 0, 0}} end, "unknown key 'linaer', expected one of linear, angular; did you mean 'linear'?")
end)

test("targets by name leave the other DOFs unchanged", function(t)
  local hand = clench.load("worlds/barrett_mug.wld").robots[1]
  hand.controller = "effort"
  hand:set_forces {0, 0, 0.05, 0}
  hand:set_targets {dof2 = 0.1}
  t.equal(hand.controller, "mixed")
  hand.world:run(0.01)
  t.close(hand.dof_efforts[3], 0.05, 1e-12)
  hand:set_targets {0, 0.1, 0, 0}
  t.equal(hand.controller, "position")
end)

test("forces and target velocities by name leave the other DOFs unchanged", function(t)
  local hand = clench.load("worlds/barrett_mug.wld").robots[1]
  hand.controller = "effort"
  hand:set_forces {0, 0.02, 0.05, 0}
  hand:set_forces {dof2 = 0.03}
  hand.world:run(0.01)
  t.close(hand.dof_efforts[2], 0.03, 1e-12)
  t.close(hand.dof_efforts[3], 0.05, 1e-12)
  hand:set_target_velocities {dof2 = 0.1}
  t.equal(hand.controller, "mixed")
  hand.world:run(0.05)
  t.ok(hand.dof_velocities[2] > 0.05, hand.dof_velocities[2])
  t.fails(function() hand:set_forces {dof9 = 1} end, "has no DOF 'dof9'")
  t.fails(function() hand:set_target_velocities {1, dof2 = 1} end, "expected")
end)

test("functions added during a step begin with the next step", function(t)
  local world = falling_box()
  local spawned, called, tasks = 0, 0, 0
  local function again()
    spawned = spawned + 1
    world:spawn(again)  -- would continue for ever within one step
  end
  world:spawn(again)
  world:on_step(function()
    tasks = tasks + 1
    if tasks == 1 then world:on_step(function() called = called + 1 end) end
  end)
  world:run(0.01)
  t.equal(spawned, 10)
  t.equal(called, 9)
end)

test("the halves of a step cannot be called within a run", function(t)
  local world = falling_box()
  world:on_step(function() world:move_bodies(0.001) end)
  t.fails(function() world:run(0.01) end, "world:move_bodies: the world is already running: functions called during a run cannot step it")
  world = falling_box()
  world:on_step(function() world:solve_velocities(0.001) end)
  t.fails(function() world:run(0.01) end, "world:solve_velocities: the world is already running: functions called during a run cannot step it")
end)

test("with breakaway, the fingertip of a blocked link continues to close, and without it both stop", function(t)
  for _, breakaway in ipairs {true, false} do
    local world = clench.world {gravity = {0, 0, 0}}
    local hand = world:add_robot "models/hands/barrett/barrett.cfg"
    t.equal(hand.breakaway, false)
    hand.breakaway = breakaway
    -- a rod in the path of the first link of the third finger
    hand:set_dofs {0, 0, 0, 1.6}
    local finger = hand.chains[3]
    local bounds = finger.links[1].bounds_in_world
    hand:set_dofs {0, 0, 0, 0}
    world:add_obstacle(clench.shapes.box {0.02, 0.005, 0.005}, {pose = {xyz = (bounds.low + bounds.high) / 2}})
    hand:autograsp {dynamic = true}
    world:run(4)
    local joints = hand.chains[3].joints
    t.ok(joints[1].value > 0.1 and joints[1].value < 1.6)
    t.equal(joints[2].broken_away, false)
    t.equal(joints[1].broken_away, breakaway)
    if breakaway then
      t.ok(joints[2].value > joints[1].value / 2)
    else
      t.close(joints[2].value, joints[1].value / 3, 1e-6)
    end
  end
end)

test("a pair of materials keeps its restitution if a study uses a fraction of its friction", function(t)
  local world = clench.world()
  local a = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {material = "wood"})
  t.equal(select("#", world:friction("plastic", "wood")), 2)
  world:set_friction("plastic", "wood", {static = 0.4, kinetic = 0.3, restitution = 0.7})
  local hand = world:add_robot "models/hands/barrett/barrett.cfg"
  for _, body in ipairs(hand.bodies) do body.material = "plastic" end
  require "clench.study.motion.share_friction"(hand, a, 0.5)
  local static, kinetic, restitution = world:friction("plastic", "wood")
  t.close(static, 0.2, 1e-15)
  t.close(kinetic, 0.15, 1e-15)
  t.equal(restitution, 0.7)
end)

test("the damping of a servo may be a ratio to the critical damping for the inertia of its DOF", function(t)
  for _, servo in ipairs {[[<position joint="hinge" kp="4" dampratio="0.5"/>]],
      [[<general joint="hinge" biastype="affine" gainprm="4" biasprm="0 -4 0.5"/>]]} do
    local _, robot, again = rod("<actuator>" .. servo .. "</actuator>")
    t.equal({robot.dof_info[1].damping_ratio, again.dof_info[1].damping_ratio}, {0.5, 0.5})
    local inertia = robot:mass_matrix()[1][1]
    t.equal(robot.gains[1].kp, 4.0)
    t.close(robot.gains[1].kd, math.sqrt(4 * inertia), 1e-12)
  end
end)

test("logs and recordings of a world stepped by a script equal those of a run", function(t)
  local function scene()
    local world = clench.world {gravity = {0, 0, -9.81}}
    world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "box", mass = 1, material = "wood"})
    return world, world:log {quantities = {"energy", world:body "box"}, rate = 500}, world:record {rate = 100}
  end
  local world, log, film = scene()
  for _ = 1, 50 do
    local passed = world:move_bodies(world.time_step)
    world:solve_velocities(passed)
  end
  local other, log_of_run, film_of_run = scene()
  other:run(0.05)
  t.equal(#log.rows, 26)
  t.equal(log.rows, log_of_run.rows)
  t.equal(film.times, film_of_run.times)
  t.equal(#film.times, 6)
  -- a function that cannot step the world at that point is named
  world:log {quantities = {mine = function() world:run(1) end}}
  t.fails(function() world:move_bodies(0.001) end, "the world is already running", "function 'mine' of world:log")
  local fresh = clench.world()
  fresh:log {quantities = {mine = function() error "broken" end}}
  t.fails(function() fresh:solve_velocities(0.001) end, "broken", "function 'mine' of world:log")
end)
