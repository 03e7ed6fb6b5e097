--- Torques that hold several loads without being adjusted, and the loads that given torques hold.
local test, clench = require "test", require "clench"

local mu = 0.5

-- two jaws that slide towards each other along y, driven by motors of 10 N, around a block of 50 mm without gravity
local function closed()
  local jaw = [[<body name="f%d" pos="0 %g 0.06"><inertial pos="0 0 0" mass="0.1" diaginertia="0.0001 0.0001 0.0001"/>
    <joint name="j%d" type="slide" axis="0 %d 0" range="0 0.04"/><geom type="box" size="0.01 0.005 0.05"/></body>]]
  local world = clench.world()
  local hand = world:add_robot(test.path(".xml", [[<mujoco model="grip"><worldbody><body name="palm">
    <inertial pos="0 0 0" mass="0.5" diaginertia="0.001 0.001 0.001"/><geom type="box" size="0.02 0.08 0.01"/>]]
    .. jaw:format(1, -0.06, 1, 1) .. jaw:format(2, 0.06, 2, -1)
    .. [[</body></worldbody><actuator><motor joint="j1" ctrlrange="-10 10"/><motor joint="j2" ctrlrange="-20 20"/></actuator></mujoco>]]),
    {close = {j1 = 1, j2 = 1}})
  local block = world:add_object(clench.shapes.box {0.05, 0.05, 0.05}, {mass = 0.2, pose = {xyz = {0, 0, 0.08}}})
  world:set_friction(hand.bodies[1].material, block.material, mu)
  hand:autograsp()
  local grasp = clench.grasp(hand, block)
  for _, contact in ipairs(grasp.contacts) do assert(math.abs(contact.mu - mu) < 1e-12) end
  return grasp
end

local zero = {0, 0, 0, 0, 0, 0}
local function force(x, y, z) return {x, y, z, 0, 0, 0} end

test("jaws keep the force whose friction carries the largest load across them", function(t)
  local grasp = closed()
  local preload = grasp:optimal_preload {loads = {zero, force(0, 0, -2), force(3, 0, 0), force(1.2, 0, 1.6)}}
  t.equal(preload.status, "optimal")
  -- 2 mu P = 3, and the weaker motor limits the fraction
  t.close(preload.torques[1], 3, 1e-6)
  t.close(preload.torques[2], 3, 1e-6)
  t.close(preload.fraction, 0.3, 1e-7)
  for k, normals in ipairs(preload.normals) do
    local sum = {0, 0}
    for i, contact in ipairs(grasp.contacts) do
      local side = contact.normal.y > 0 and 1 or 2
      sum[side] = sum[side] + normals[i]
    end
    t.close(sum[1], 3, 1e-6, k)
    t.close(sum[2], 3, 1e-6, k)
  end
  local more = {}
  for i, torque in ipairs(preload.torques) do more[i] = 1.001 * torque end
  for _, load in ipairs {zero, force(3, 0, 0)} do t.equal(grasp:equilibrium({load = load, torques = more}).status, "stable") end
  for i, torque in ipairs(preload.torques) do more[i] = 0.999 * torque end
  t.equal(grasp:equilibrium({load = force(3, 0, 0), torques = more}).status, "unstable")
end)

test("constant forces of two jaws hold one load along them, and locked jaws share it", function(t)
  local grasp = closed()
  local loads = {zero, force(0, 4, 0), force(0, -6, 0), force(0, 0, 1)}
  t.equal(grasp:optimal_preload({loads = {loads[1], loads[2]}}).status, "infeasible")
  local locked = grasp:optimal_preload {loads = loads, locked = true}
  t.equal(locked.status, "optimal")
  -- each jaw takes half of a load along them: no jaw loses contact if P = 6 / 2; 2 mu P = 1 requires less
  t.close(locked.fraction, 0.3, 1e-6)
  t.close(locked.torques[1], 3, 1e-5)
  t.close(locked.torques[2], 3, 1e-5)
  local single = grasp:optimal_preload {loads = {loads[2]}}
  -- the jaw that the load pushes against
  t.close(single.torques[1] + single.torques[2], 4, 1e-6)
  t.close(math.max(single.torques[1], single.torques[2]), 4, 1e-6)
end)

test("no preload exceeds the limits of motors or contacts", function(t)
  local grasp = closed()
  t.equal(grasp:optimal_preload({loads = {force(0, 0, 9.99)}}).status, "optimal")
  t.equal(grasp:optimal_preload({loads = {force(0, 0, 10.01)}}).status, "infeasible")
  t.equal(grasp:optimal_preload({loads = {force(0, 0, 10.01)}, torque_limits = {11, 11}}).status, "optimal")
  local free = grasp:optimal_preload {loads = {force(0, 0, 30)}, torque_limits = false}
  t.close(free.fraction, 30, 1e-5)
  local cap = 2 / #grasp.contacts
  t.equal(grasp:optimal_preload({loads = {force(0, 0, 0.99)}, max_force = cap}).status, "optimal")
  t.equal(grasp:optimal_preload({loads = {force(0, 0, 1.01)}, max_force = cap}).status, "infeasible")
end)

test("a preload scales with loads and limits of any size, and inactive limits change nothing", function(t)
  local grasp = closed()
  for _, size in ipairs {1e-12, 1e-4, 1, 1e4, 1e12} do
    for _, locked in ipairs {false, true} do
      local loads = {zero, force(3 * size, 0, 0)}
      t.close(grasp:optimal_preload({loads = loads, torque_limits = false, locked = locked}).fraction / size, 3, 1e-9)
      t.close(grasp:optimal_preload({loads = loads, torque_limits = {10 * size, 20 * size}, locked = locked}).fraction, 0.3, 1e-9)
    end
  end
  t.close(grasp:optimal_preload({loads = {force(3, 0, 0)}, torque_limits = {1e9, 1e9}, max_force = 1e9}).torques[1], 3, 1e-6)
end)

test("the tendon of a gripper on springs keeps the smallest torque that holds all loads", function(t)
  local world = clench.load("worlds/tendon_cylinder.wld", {root = "."})
  local hand, cylinder = world.robots[1], world.objects[1]
  hand:autograsp()
  local grasp = clench.grasp(hand, cylinder)
  local loads = {zero, force(0, 0, -0.2), force(0.1, 0, 0)}
  local preload = grasp:optimal_preload {loads = loads}
  t.equal(preload.status, "optimal")
  local function holds(torque)
    for _, load in ipairs(loads) do
      if grasp:equilibrium({load = load, torques = {torque}}).status ~= "stable" then return false end
    end
    return true
  end
  t.ok(holds(preload.torques[1] * (1 + 1e-5)), "not held")
  t.ok(not holds(preload.torques[1] * (1 - 1e-3)), "a smaller torque holds, too")
end)

test("jaws of constant force resist a disk of forces across them, and none along them", function(t)
  local grasp = closed()
  local across = clench.study.resistible_wrenches(grasp, {axes = {"fx", "fz"}, count = 36, torques = {3, 3}})
  for _, ray in ipairs(across.rays) do
    t.close(ray.load, 3, 1e-6)
    t.close(math.sqrt(ray.point[1] ^ 2 + ray.point[2] ^ 2), 3, 1e-6)
  end
  -- polygon of 36 points on a circle
  t.close(across.area, 36 / 2 * 9 * math.sin(2 * math.pi / 36), 1e-5)
  for i, ray in ipairs(clench.study.resistible_wrenches(grasp, {axes = {"fy", "fz"}, count = 8, torques = {3, 3}}).rays) do
    t.close(ray.load, (i == 3 or i == 7) and 3 or 0, 1e-6)
  end
end)

test("motors that adjust resist what they and friction can, and torques are scaled by rho", function(t)
  local grasp = closed()
  local section = clench.study.resistible_wrenches(grasp, {axes = {"fz", "ty"}, count = 4, max_force = 1})
  for i, name in ipairs {1, 5, 1, 5} do
    local direction = zero
    local ray = section.rays[i]
    local wanted = {0, 0, 0, 0, 0, 0}
    wanted[name == 1 and 3 or 5] = (i > 2 and -1 or 1) * (name == 1 and 1 or grasp.rho)
    for k = 1, 6 do t.close(ray.wrench[k], wanted[k] + direction[k], 1e-12) end
    local asked = grasp:max_load {direction = wanted, max_force = 1, torque_limits = true}
    t.close(ray.load, asked.load, 1e-9)
  end
  local unlimited = clench.study.resistible_wrenches(grasp, {axes = {"fx", "fz"}, count = 3, torque_limits = false})
  t.equal(unlimited.rays[1].load, math.huge)
  t.equal(unlimited.area, nil)
  -- pulling jaws hold nothing
  local open = clench.study.resistible_wrenches(grasp, {count = 3, torques = {-1, -1}})
  t.equal(open.rays[1].status, "infeasible")
  t.equal(open.rays[1].load, nil)
end)

test("bad arguments are named", function(t)
  local grasp = closed()
  local function preload(options) return function() grasp:optimal_preload(options) end end
  t.fails(preload {loads = {}}, "optimal preload: expected at least one load, got none")
  t.fails(preload {loads = {zero}, torque_limits = {1}}, "torque limits: expected 2, one per DOF, got 1")
  t.fails(preload {loads = {zero}, torqes = {1}}, "unknown key 'torqes'")
  t.fails(function() grasp:max_load {direction = force(1, 0, 0), torques = {1}} end, "torques: expected 2, one per DOF, got 1")
  local resistible = clench.study.resistible_wrenches
  t.fails(function() resistible(grasp, {axes = {"fx"}}) end, "axes must be two different coordinates")
  t.fails(function() resistible(grasp, {axes = {"fx", "f"}}) end, "axes[2]: expected any of fx, fy, fz, tx, ty, tz, got 'f'")
  t.fails(function() resistible(grasp, {count = 2}) end, "count must be")
  t.fails(function() resistible(grasp, {torques = {1, 1}, torque_limits = true}) end, "torques and torque_limits exclude each other")
  t.fails(function() resistible(3) end, "study.resistible_wrenches: expected a grasp, got 3")
end)
