-- Two fingers closed by one motor: feasible grasps, starts, compliance, and the report when nothing fits.
local test, clench = require "test", require "clench"
local closing, facing, give_way = require "clench.plan.closing", require "clench.plan.facing", require "clench.plan.give_way"
local opposition, pads, starts = require "clench.plan.opposition", require "clench.plan.pads", require "clench.plan.starts"
local new_job = require "clench.plan.job"
local verification = require "clench.plan.verification"

local function scene(hand, object, options)
  local world = clench.world()
  options = options or {}
  options.pose = {xyz = {0, 0, 1}}
  return world:add_robot(("models/hands/%s/%s.cfg"):format(hand, hand)), world:add_object(object, options)
end

test("points face each other across the wall of a vessel, its neck, and the slopes of a cone", function(t)
  local _, flask = scene("parallel_jaw", "models/objects/flask.iv")
  local random, walls, necks, slopes = clench.random(1), 0, 0, 0
  for _, at in ipairs(flask.mesh:sample(random, 2000)) do
    local _, _, width = facing.pair(flask.world, flask, at, random, 0.5, 0.085)
    if width then
      if width < 0.004 then walls = walls + 1 end
      if width > 0.036 and width < 0.05 then necks = necks + 1 end
      if width > 0.06 then slopes = slopes + 1 end
    end
  end
  t.ok(walls > 100 and necks > 10 and slopes > 10, ("%d %d %d"):format(walls, necks, slopes))
end)

test("pads determine the opening width of grippers, and where they hold", function(t)
  for name, expected in pairs {parallel_jaw = {0.08, 0.115}, adaptive_gripper = {0.0846, 0.130}} do
    local hand = clench.world():add_robot(("models/hands/%s/%s.cfg"):format(name, name))
    local before = hand.world:hash()
    local dofs = (starts.opened(hand))
    local thumb, finger = opposition.thumb(hand)
    local middle, width, half = pads.of(hand)(dofs, thumb, finger)
    t.equal(hand.world:hash(), before)
    t.close(width, expected[1], 3e-4)
    t.close(middle.x, 0, 3e-4)
    t.close(middle.z, expected[2], 3e-3)
    t.ok(half > 0.008 and half < 0.02, half)
  end
end)

test("the adaptive gripper's pads stay parallel from an opening of 85 mm to closed", function(t)
  local hand = clench.world():add_robot "models/hands/adaptive_gripper/adaptive_gripper.cfg"
  local tip = hand.chains[1].links[2]
  local open = tip.pose
  hand:autograsp()
  t.ok((open:inverse() * tip.pose):angle() < 1e-9)
  t.close((open.position - tip.pose.position).x, 0.0422, 3e-4)
  t.equal(#hand.world:colliding(), 0)
  t.equal(tip.elastic_modulus, 1.5e6)
end)

test("jaws start only where the pads can get past the obstacles", function(t)
  local hand, mug = scene("adaptive_gripper", "models/objects/mug.iv")
  local job = new_job("plan.sample", {hand = hand, object = mug, seed = 1}, function(read)
    for _, option in ipairs(read.fields) do read:raw(option.name) end
  end)
  local standoff = 0.15
  local next_start = starts.random(job, {standoff = standoff, friction = 0.5, width = 0.2, kind = "antipodal"})
  local free, blocked = 0, 0
  for i = 1, 60 do
    local state = next_start(i)
    -- omits starts whose hand moves on until the palm touches
    if state.reach < standoff + 0.03 then
      local direction = state.pose:rotate(clench.vec3(0, 0, 1))
      state = {pose = clench.pose {xyz = direction * state.reach} * state.pose, dofs = state.dofs}
      if closing.place(job.hand, job.object, state) then free = free + 1 else blocked = blocked + 1 end
    end
  end
  t.ok(free >= 30 and blocked == 0, free .. " " .. blocked)
end)

test("jaws are hands whose fingers are all closed by one motor", function(t)
  for path, expected in pairs {["parallel_jaw/parallel_jaw"] = true, ["adaptive_gripper/adaptive_gripper"] = true, ["robonaut/robonaut"] = false,
                               ["barrett/barrett"] = false} do
    t.equal(give_way.are_jaws(clench.world():add_robot(("models/hands/%s.cfg"):format(path))), expected)
  end
end)

test("jaws turn to the narrowest direction", function(t)
  local hand, bar = scene("parallel_jaw", clench.shapes.box {0.03, 0.06, 0.06})
  hand.pose = clench.pose {axis = {0, 0, 1}, angle = 0.05} * clench.pose {xyz = {0.004, 0, 1 - 0.115}}
  local start, dofs = hand.pose, (starts.opened(hand))
  local shifted = give_way.shift(hand, bar, start, dofs)
  t.close(shifted:angle(), 0.05, 1e-9)
  local turned = give_way.turn(hand, bar, start, dofs)
  t.ok(turned:angle() < 0.015, turned:angle())
  hand:set_posture(turned, dofs)
  hand:autograsp()
  t.ok(not give_way.touches_one_side(hand, bar))
end)

test("the adaptive gripper has verified grasps of mug, banana and tin, and tries cause no warning", function(t)
  local said, before = 0, clench.log.level()
  clench.log.sink(function() said = said + 1 end)
  local counts = {}
  for _, name in ipairs {"mug", "banana", "tea_tin"} do
    local hand, object = scene("adaptive_gripper", ("models/objects/%s.iv"):format(name))
    counts[name] = #clench.plan.sample({hand = hand, object = object, candidates = 24, refine = 2}).grasps
  end
  clench.log.sink()
  for name, count in pairs(counts) do t.ok(count >= 1, name) end
  t.equal(said, 0)
  t.equal(clench.log.level(), before)
end)

test("jaws hold a mug, wider than they open, by its wall", function(t)
  local hand, mug = scene("parallel_jaw", "models/objects/mug.iv", {mass = 0.33})
  local run = clench.plan.antipodal {hand = hand, object = mug, candidates = 60, count = 100}
  t.ok(#run.grasps >= 3, #run.grasps)
  for _, grasp in ipairs(run.grasps) do
    grasp:apply(hand.world)
    t.ok(not hand.world:collides(hand))
    t.ok(not give_way.touches_one_side(hand, mug))
  end
end)

local gripper = [[<robot name="slides">
  <link name="base"><collision><origin xyz="0 0 0.03"/><geometry><box size="0.06 0.2 0.06"/></geometry></collision></link>
  <link name="left"><collision><origin xyz="0 0.005 0.025"/><geometry><box size="0.02 0.01 0.05"/></geometry></collision></link>
  <link name="right"><collision><origin xyz="0 -0.005 0.025"/><geometry><box size="0.02 0.01 0.05"/></geometry></collision></link>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="left"/><origin xyz="0 0 0.0605"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" effort="70" velocity="0.2"/></joint>
  <joint name="other" type="prismatic"><parent link="base"/><child link="right"/><origin xyz="0 0 0.0605"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.04" effort="70" velocity="0.2"/><mimic joint="slide"/></joint>
</robot>]]

test("a gripper of URDF, two sliding boxes, holds an object that fits between them", function(t)
  local path = test.path(".urdf", gripper)
  local world = clench.world()
  local hand = world:add_robot(path)
  local box = world:add_object(clench.shapes.box {0.05, 0.06, 0.12}, {mass = 0.2, material = "wood", pose = {xyz = {0, 0, 1}}})
  local run = clench.plan.sample {hand = hand, object = box, candidates = 128, refine = 2}
  t.ok(#run.grasps >= 5, tostring(run.report))
end)

test("a report explains that nothing fits between the pads, and how far the best grasp is too weak", function(t)
  local hand, ball = scene("adaptive_gripper", clench.shapes.sphere {0.06}, {name = "ball"})
  local run = clench.plan.sample {hand = hand, object = ball, candidates = 16}
  t.equal(#run.grasps, 0)
  local words = tostring(run.report)
  t.ok(words:find("ball is too wide for adaptive_gripper: opposite points of its surface are at least 11%d mm apart, and the pads open to 85 mm"), words)
  local flask
  hand, flask = scene("adaptive_gripper", "models/objects/flask.iv")
  run = clench.plan.sample {hand = hand, object = flask, candidates = 40, refine = 2, verify = {min_load = 50}}
  words = tostring(run.report)
  t.ok(words:find("are too weak against loads: the best holds [%d.]+ times the object's weight in its weakest direction, with a sum of normal forces of 10 weights"), words)
  t.ok(words:find("but 50 times is required; see min_load and force_ratio of verify", 1, true), words)
  t.ok(not words:find("wider", 1, true), words)
end)

test("jaws with a gap below the contact threshold on one side press on command", function(t)
  local hand, box = scene("parallel_jaw", clench.shapes.box {0.04, 0.04, 0.06}, {mass = 0.1, material = "wood"})
  local middle = hand.pose:inverse() * hand.approach.point + clench.vec3(0, 0, 0.05)
  for _, aside in ipairs {0, 3e-5, -3e-5} do
    box.pose = hand.pose * clench.pose {xyz = middle + clench.vec3(aside, 0, 0)}
    hand:open()
    hand:autograsp()
    local verdict = clench.study.shake {hand = hand, object = box, seconds = 0.2, settle = 0.2}
    t.ok(verdict.survived, tostring(verdict))
    t.ok(verdict.grip_force > 0.45 * 10 and verdict.grip_force < 1.02 * 10, verdict.grip_force)
  end
end)

test("with until_lost, an object lost in the first direction is not shaken in others", function(t)
  local hand, box = scene("parallel_jaw", clench.shapes.box {0.04, 0.04, 0.06}, {mass = 0.1, material = "wood"})
  box.pose = hand.pose * clench.pose {xyz = hand.pose:inverse() * hand.approach.point + clench.vec3(0, 0, 0.05)}
  hand:autograsp()
  local options = {hand = hand, object = box, seconds = 0.3, settle = 0.1, force = 50, grip_force = 10}
  local all = clench.study.shake(options)
  options.until_lost = true
  local first = clench.study.shake(options)
  t.equal({#all.directions, all.survived, first.survived}, {6, false, false})
  local count = 1
  while all.directions[count].held do count = count + 1 end
  t.equal({#first.directions, first.held}, {count, count - 1})
  options.force = 1
  t.equal({#clench.study.shake(options).directions, clench.study.shake(options).survived}, {6, true})
end)

test("an object can pivot between two fingers, with or without a palm, and not between three", function(t)
  local jaws, barrett = scene("parallel_jaw", clench.shapes.sphere {0.02}), scene("barrett", clench.shapes.sphere {0.02})
  local function tips(hand, count)
    local links = {hand.base.name}
    for i = 1, count do
      local chain = hand.chains[i]
      links[#links + 1] = chain.links[#chain.links].name
    end
    return {links = links}
  end
  t.equal({verification.can_pivot(jaws, tips(jaws, 2)), verification.can_pivot(barrett, tips(barrett, 2)), verification.can_pivot(barrett, tips(barrett, 3))},
          {true, true, false})
end)

test("the load of two soft fingers decreases with the distance from the center of mass, epsilon about their line does not", function(t)
  local hand, bar = scene("parallel_jaw", clench.shapes.box {0.03, 0.2, 0.03}, {mass = 0.1, material = "wood"})
  local loads, epsilons = {}, {}
  for i, lever in ipairs {0, 0.01, 0.02, 0.04} do
    bar.pose = hand.pose * clench.pose {xyz = hand.pose:inverse() * hand.approach.point + clench.vec3(0, lever, 0.05)}
    hand:open()
    hand:autograsp()
    local grasp = clench.grasp(hand, bar)
    loads[i], epsilons[i] = verification.load(bar, grasp, 10), grasp:quality "epsilon"
  end
  for i = 2, #loads do t.ok(loads[i] < loads[i - 1], ("%g %g"):format(loads[i - 1], loads[i])) end
  t.ok(loads[4] < 0.5 * loads[1], ("%g %g"):format(loads[1], loads[4]))
  t.ok(epsilons[4] > 0)
end)

test("jaws are verified by shaking unless that is declined, and hold when shaken again", function(t)
  local function search(verify)
    local hand, bar = scene("parallel_jaw", clench.shapes.box {0.03, 0.16, 0.03}, {mass = 0.1, material = "wood"})
    return clench.plan.sample {hand = hand, object = bar, candidates = 24, refine = 2, seed = 3, verify = verify}, hand, bar
  end
  local run, hand, bar = search()
  t.ok(#run.grasps >= 2, tostring(run.report))
  t.ok(run.report.shaken >= run.report.survived and run.report.survived >= #run.grasps)
  for i, grasp in ipairs(run.grasps) do
    t.equal({grasp.info.survived, grasp.info.directions_held}, {1, 6})
    if i <= 2 then
      grasp:apply(hand.world, {hand = hand, object = bar})
      t.ok(clench.study.shake({hand = hand, object = bar, mass = bar.mass, force = 9.81 * bar.mass}).survived)
    end
  end
  local plain = search {shake = false}
  t.equal(plain.report.shaken, nil)
  for _, grasp in ipairs(plain.grasps) do t.equal(grasp.info.survived, nil) end
end)
