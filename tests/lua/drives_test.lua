--- Grips by motors that pull in one direction, weakly, or not at all: load margins, verdicts and reports.
local test = require "test"
local verification = require "clench.plan.verification"

local weight = 9.81 * 0.2  -- of the block [N]

-- two jaws that slide towards each other, with actuators given as elements of MJCF, where %s is the joint second: actuator of j2, if different
local function gripper(t, actuator, second)
  local jaw = [[<body name="f%d" pos="0 %g 0.06"><inertial pos="0 0 0" mass="0.1" diaginertia="0.0001 0.0001 0.0001"/>
    <joint name="j%d" type="slide" axis="0 %d 0" range="0 0.04"/><geom type="box" size="0.01 0.005 0.05"/></body>]]
  local drive = actuator and "<actuator>" .. actuator:format "j1" .. (second or actuator):format "j2" .. "</actuator>" or ""
  return test.path(".xml", [[<mujoco model="grip"><compiler angle="radian"/><worldbody><body name="palm">
    <inertial pos="0 0 0" mass="0.5" diaginertia="0.001 0.001 0.001"/><geom type="box" size="0.02 0.08 0.01"/>]]
    .. jaw:format(1, -0.06, 1, 1) .. jaw:format(2, 0.06, 2, -1) .. "</body></worldbody>" .. drive .. "</mujoco>")
end

-- the gripper closed around a block of 50 mm between its jaws, and the grasp
local function closed(t, actuator, second)
  local world = clench.world()
  -- joints without motors close, too: the motors are tested below
  local hand = world:add_robot(gripper(t, actuator, second), {close = {j1 = 1, j2 = 1}})
  local block = world:add_object(clench.shapes.box {0.05, 0.05, 0.05}, {mass = 0.2, pose = {xyz = {0, 0, 0.08}}})
  hand:autograsp()
  return hand, block, clench.grasp(hand, block)
end

local hopeless = {
  none = false,
  gain0 = [[<general joint="%s" gainprm="0" biastype="none" ctrlrange="0 1"/>]],
  gear0 = [[<motor joint="%s" gear="0" ctrlrange="-1 1"/>]],
  kp0 = [[<position joint="%s" kp="0"/>]],
  negative_gear = [[<motor joint="%s" gear="-1" ctrllimited="true" ctrlrange="0 20"/>]],
  only_opens = [[<motor joint="%s" ctrllimited="true" ctrlrange="-20 0"/>]],
  muscle = [[<muscle joint="%s" ctrllimited="true" ctrlrange="0 1"/>]],
  no_area = [[<cylinder joint="%s" area="0" ctrllimited="true" ctrlrange="0 1"/>]],
  integrates_open = [[<intvelocity joint="%s" kp="100" actrange="-0.1 0"/>]],
  damper = [[<damper joint="%s" kv="100" ctrllimited="true" ctrlrange="0 1"/>]],
  closes_with_1mN = [[<position joint="%s" kp="100" forcelimited="true" forcerange="-20 0.001"/>]],
}

test("motors that cannot close verify no grasp, and the shaken object falls out", function(t)
  for name, actuator in pairs(hopeless) do
    local hand, block, grasp = closed(t, actuator)
    t.ok(grasp:quality "epsilon" > 0, name)
    local load = verification.load(block, grasp, 10)
    t.ok(load < 0.01, name)
    local options = {grasp = {}}
    for key, value in pairs(verification.defaults) do options[key] = value end
    grasp.collision_free = true
    local numbers, why = verification.check(hand, block, grasp, options)
    t.equal(numbers, nil)
    t.equal(why, verification.too_weak)
    local verdict = clench.study.shake {hand = hand, object = block, mass = 0.2, force = weight, seconds = 0.4, settle = 0.05, grip_seconds = 0.05}
    t.equal(verdict.survived, false)
    t.ok(verdict.grip_force < 0.01, name)
  end
end)

test("a check names the DOFs that no motor closes", function(t)
  local report = require "clench.report"
  local function not_closed(actuator) return report.of(gripper(t, actuator)).parsed.not_closed end
  t.equal(not_closed(hopeless.only_opens), "motors that cannot pull in the closing direction drive j1, j2")
  t.equal(not_closed(hopeless.no_area), "no motor drives j1, j2")
  t.equal(not_closed [[<motor joint="%s"/>]], nil)
end)

test("a shaken grip presses with its motors' efforts, and the verdict reports them", function(t)
  local hand, block = closed(t, [[<motor joint="%s" ctrlrange="-3 3"/>]])
  local verdict = clench.study.shake {hand = hand, object = block, mass = 0.2, force = 0.1, grip_force = 100, seconds = 0.1, settle = 0.1}
  t.close(verdict.grip_force, 6, 1e-3)
  t.ok(tostring(verdict):find("gripped with 6 N of normal forces, 100 N requested", 1, true))
end)

test("a grip slips when the load exceeds the friction force of the motors' efforts", function(t)
  local random = clench.random(3)
  local kinds = {  -- actuators with a given effort, for a DOF at q
    function(effort) return [[<motor joint="%%s" gear="%.17g" ctrlrange="-0.5 1"/>]], effort end,
    function(effort) return [[<general joint="%%s" gear="-1" gainprm="%.17g" forcerange="-50 1"/>]], effort, 50 end,
    function(effort, q) return [[<position joint="%%s" kp="%.17g" ctrlrange="0 0.04"/>]], effort / (0.04 - q) end,
    function(effort) return [[<velocity joint="%%s" kv="%.17g" ctrlrange="-1 2"/>]], effort / 2 end,
  }
  local q = closed(t, [[<motor joint="%s"/>]]).dofs[1]
  for _, kind in ipairs(kinds) do
    local drawn = random:uniform(1, 5)
    local element, number, effort = kind(drawn, q)
    local hand, block, grasp = closed(t, element:format(number))
    effort = effort or drawn
    local held = grasp:max_load({direction = {1, 0, 0, 0, 0, 0}, torque_limits = true}).load
    t.close(held, 2 * grasp.contacts[1].mu * effort, 1e-6 * held)
    local verdict = clench.study.fall_off {hand = hand, object = block, rate = 8 * held, max_force = 2 * held, friction_share = 1, max_distance = 1e-3,
                                           grip_force = 3 * effort, settle = 0.05, grip_seconds = 0.1}
    t.close(verdict.grip_force, 2 * effort, 0.02 * effort)
    for _, row in ipairs(verdict.directions) do
      -- across the jaws friction holds it
      if not row.direction:find "y" then t.ok(row.force > held and row.force < 1.6 * held, element .. row.direction .. row.force / held) end
    end
  end
end)

test("a motor without a limit is named wherever its effort counts", function(t)
  local hand, block, grasp = closed(t, [[<position joint="%s" kp="100"/>]])
  t.equal(hand.effort_ranges[1], {-math.huge, math.huge})
  local statement = "effort of joints j1, j2: unlimited (none given)"
  t.equal(grasp:max_load({direction = {0, 0, -1, 0, 0, 0}, torque_limits = true}).unlimited_efforts, {"j1", "j2"})
  t.equal(grasp:equilibrium().unlimited_efforts, {"j1", "j2"})
  t.equal(grasp:contact_forces({torque_limits = {1, 1}}).unlimited_efforts, nil)
  local quick = {hand = hand, object = block, seconds = 0.01, settle = 0.01, grip_seconds = 0.01}
  t.ok(tostring(clench.study.shake(quick)):find(statement, 1, true))
  local asked = {hand = hand, object = block, candidates = 20, refine = 0, verify = {lift = 0}}
  local report = clench.plan.sample(asked).report
  t.equal(report.unlimited_efforts, {"j1", "j2"})
  t.ok(tostring(report):find(statement, 1, true))
  asked.max_effort = 5
  local limited = clench.plan.sample(asked)
  t.equal(limited.report.unlimited_efforts, nil)
  for _, found in ipairs(limited.grasps) do t.ok(found.info.load_margin <= 5 / weight * 2) end
  t.equal(hand.max_effort, nil)
  hand.max_effort = 3
  t.equal(hand.effort_ranges[1], {-3.0, 3.0})
  t.equal(grasp:max_load({direction = {0, 0, -1, 0, 0, 0}, torque_limits = true}).unlimited_efforts, nil)
  t.fails(function() hand.max_effort = -1 end, "largest effort: expected a number")
  t.fails(function() clench.plan.sample {hand = hand, object = block, max_effort = 0} end, "max_effort must be a number > 0, got 0")
end)

test("a search that cannot verify names the joints without a motor", function(t)
  local expected = {none = "no motor drives j1, j2", only_opens = "motors that cannot pull in the closing direction drive j1, j2"}
  for name, words in pairs(expected) do
    local hand, block = closed(t, hopeless[name])
    local run = clench.plan.sample {hand = hand, object = block, candidates = 10, refine = 0}
    t.equal(#run.grasps, 0)
    t.ok(tostring(run.report):find("why: no grasp of grip can be verified, as it exerts no force: " .. words, 1, true), tostring(run.report))
  end
end)

test("a search without success names the one joint that closes without a motor", function(t)
  local hand, block = closed(t, [[<motor joint="%s" ctrlrange="-20 20"/>]], hopeless.gear0)
  local run = clench.plan.sample {hand = hand, object = block, candidates = 10, refine = 0}
  t.equal(#run.grasps, 0)
  t.ok(tostring(run.report):find("why: joints that close grip exert no force: no motor drives j2", 1, true), tostring(run.report))
end)

test("a hand without motors does not close dynamically", function(t)
  local hand = closed(t, false)
  t.equal(hand.dof_info[1].driven, false)
  t.equal(hand.dof_info[1].can_close, false)
  t.equal(hand.effort_ranges[1], {0.0, 0.0})
  t.fails(function() hand:autograsp {dynamic = true} end, "no motor drives any of the DOFs that close it: j1, j2")
  local opens = closed(t, hopeless.only_opens)
  t.equal(opens.dof_info[1].driven, true)
  t.equal(opens.dof_info[1].can_close, false)
  t.equal(opens.effort_ranges[1], {-20.0, 0.0})
end)

test("the control range of a servo bounds its effort, including added forces", function(t)
  for _, controller in ipairs {"position", "effort"} do
    local hand, block = closed(t, [[<position joint="%s" kp="100" ctrlrange="0 0.04"/>]])
    local world = hand.world
    world.gravity = {0, 0, 0}
    -- 0.04 m minus the 0.03 m at which the jaws touch
    t.close(hand.effort_ranges[1][2], 100 * (0.04 - hand.dofs[1]), 1e-12)
    t.close(hand.effort_ranges[1][2], 1, 0.02)
    hand.controller = controller
    hand:set_forces {50, 50}
    world:run(0.1)
    t.close(hand.dof_efforts[1], 100 * (0.04 - hand.dofs[1]), 1e-4)
    t.ok(#world:contacts(hand, block) > 0)
  end
end)
