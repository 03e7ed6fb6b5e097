-- Grasps judged in motion: verdicts, and that the world is unchanged.
local test, clench = require "test", require "clench"
local roc = require "clench.study.motion.roc"

local function closed_on_flask()
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  hand:autograsp()
  return hand, flask, world
end

test("a grasp survives pushes along six directions, and the world is unchanged", function(t)
  local hand, flask, world = closed_on_flask()
  local before = world:hash()
  local v = clench.study.shake {world = world, hand = hand, object = flask, seconds = 0.5, settle = 0.5}
  t.ok(world:hash() == before)
  t.ok(v.survived and v.held == 6 and #v.directions == 6 and v.grip == "forces" and v.failures == 0)
  for i, name in ipairs {"+x", "-x", "+y", "-y", "+z", "-z"} do
    local row = v.directions[i]
    t.ok(row.direction == name and row.held and row.time == nil and row.moved < 0.05 and row.turned < math.rad(15))
  end
  t.ok(tostring(v):find("held in 6 of 6 directions: 1 N along each axis for 0.5 s, 0.1 kg, gripped with 9.93 N of normal forces, 10 N requested", 1, true))
  t.close(v.grip_force, 10, 0.1)
  -- bit-identical when repeated
  local again = clench.study.shake {world = world, hand = hand, object = flask, seconds = 0.5, settle = 0.5}
  for i, row in ipairs(v.directions) do t.ok(row.moved == again.directions[i].moved) end
end)

test("a grasp held under a load comes to rest, and then needs almost no iterations", function(t)
  local new_trial, read_motion = require "clench.study.motion.trial", require "clench.study.motion.options"
  for _, name in ipairs {"dlr_flask", "human_flask", "shadow_bottle"} do
    local world = clench.load("worlds/" .. name .. ".wld", {root = "."})
    local hand, object = world.robots[1], world.objects[1]
    hand:autograsp()
    local read = require "clench.options"("study.fall_off", {hand = hand, object = object, mass = 0.1, grip_force = 10})
    local trial = new_trial(read_motion(read))
    trial:push(function() return clench.vec3(0.5, 0, 0) end)
    trial.world:run(1)
    local before = trial.world.report.iterations
    trial.world:run(0.2)
    t.ok(trial.world.report.iterations - before <= 400)
  end
end)

test("a trial under steady forces ends once nothing moves, with the verdict and displacements of the full time", function(t)
  local new_trial, read_motion = require "clench.study.motion.trial", require "clench.study.motion.options"
  local world = clench.world()
  local hand = world:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
  local object = world:add_object(clench.shapes.box {0.03, 0.03, 0.02}, {mass = 0.1, pose = {xyz = hand.approach.point + hand.approach.direction * 0.02}})
  hand:autograsp()
  for _, load in ipairs {0.5, 100} do
    local read = require "clench.options"("study.fall_off", {hand = hand, object = object, mass = 0.1, grip_force = 10, max_distance = 0.005})
    local trial = new_trial(read_motion(read))
    trial:push(function() return hand.approach.direction * -load end)
    local began = trial.world.time
    local short = trial:watch_steady(4)
    local took = trial.world.time - began
    trial:reset()
    local full = trial:watch(4)
    t.ok(short.held == full.held and short.held == (load < 1) and short.time == full.time)
    t.close(short.moved, full.moved, 1e-9)
    t.close(short.turned, full.turned, 1e-7)
    t.ok(took < 0.5)
  end
end)

test("a trial at rest continues while anything else in its world moves", function(t)
  local detector = require "clench.study.motion.rest".detector
  local world = clench.world()
  world.gravity = {0, 0, 0}
  world:add_object(clench.shapes.box {0.1, 0.1, 0.1})
  local other = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {pose = {xyz = {0, 0, 2}}})
  local function parts_until_rest(count)
    local at_rest = detector(world)
    for part = 1, count do
      world:run(0.01)
      if at_rest() then return part end
    end
  end
  t.equal(parts_until_rest(20), 5)
  other.velocity = {linear = {0, 0, 0.1}, angular = {0, 0, 0}}
  t.ok(parts_until_rest(20) == nil)
end)

test("only a share of the friction is used, and with a smaller share a grasp is lost", function(t)
  local hand, flask, world = closed_on_flask()
  local static, kinetic = world:friction(hand.links[1].material, flask.material)
  local all = {hand = hand, object = flask, seconds = 0.5, settle = 0.2}
  all.friction_share = 1
  t.ok(clench.study.shake(all).held == 6)
  all.friction_share = 0.02
  t.ok(clench.study.shake(all).held < 6)
  t.equal({world:friction(hand.links[1].material, flask.material)}, {static, kinetic})
  all.friction_share = 0
  t.fails(function() clench.study.shake(all) end, "friction_share must be")
end)

test("without friction the flask is lost, and the time of the loss is reported", function(t)
  local hand, flask = closed_on_flask()
  flask.material = "frictionless"
  local v = clench.study.shake {hand = hand, object = flask, seconds = 1, settle = 0.2}
  t.ok(not v.survived and v.held < 6)
  for _, row in ipairs(v.directions) do t.ok(row.held == (row.time == nil)) end
end)

test("an untouched object is lost before it is shaken", function(t)
  local hand, flask = closed_on_flask()
  hand:open()
  hand.pose = clench.pose {xyz = {0, 0, 1}} * hand.pose
  local v = clench.study.shake {hand = hand, object = flask, seconds = 0.1, settle = 0.1, grip_seconds = 0.1}
  t.ok(not v.survived and v.held == 0 and not v.settled.held and v.contacts == 0 and v.grip == "close")
  for _, row in ipairs(v.directions) do t.ok(not row.held and row.time == 0) end
end)

test("surroundings are left out, except on request", function(t)
  local hand, flask, world = closed_on_flask()
  -- a table directly under the flask carries it
  local bounds = flask.bounds_in_world
  local middle = (bounds.low + bounds.high) * 0.5
  world:add_obstacle(clench.shapes.box {1, 1, 0.02}, {pose = {xyz = {middle.x, middle.y, bounds.low.z - 0.0105}}})
  flask.material = "frictionless"
  local function falls(surroundings)
    local v = clench.study.shake {hand = hand, object = flask, seconds = 0.5, settle = 0.1, surroundings = surroundings}
    return v.directions[6].moved
  end
  t.ok(falls(true) < falls(false))
end)

test("a grasp is lifted, and slips without friction", function(t)
  local hand, flask, world = closed_on_flask()
  local before = world:hash()
  local options = {hand = hand, object = flask, mass = 0.1, height = 0.05, hold = 0.2, settle = 0.2}
  local v = clench.study.lift(options)
  t.ok(v.survived and #v.rows == 3 and v.rows[1].phase == "gravity" and v.rows[2].phase == "lift" and v.rows[3].phase == "hold")
  t.ok(world:hash() == before)
  flask.material = "frictionless"
  t.ok(not clench.study.lift(options).survived)
  t.fails(function() clench.study.lift {hand = hand, object = flask, direction = {0, 0, 0}} end, "study.lift: direction must not be zero")
end)

test("a hand that is shaken harder loses the flask", function(t)
  local hand, flask, world = closed_on_flask()
  local before = world:hash()
  local function shaken(acceleration)
    return clench.study.shake_base {hand = hand, object = flask, mass = 0.1, acceleration = acceleration, seconds = 0.5, settle = 0.2}
  end
  local gentle, hard = shaken(2), shaken(200)
  t.ok(gentle.survived and #gentle.axes == 3 and not hard.survived)
  t.ok(world:hash() == before)
  t.fails(function() clench.study.shake_base {hand = hand, object = flask, amplitude = 1, acceleration = 1} end, "expected acceleration or amplitude, got both")
  local same = clench.study.shake_base {hand = hand, object = flask, mass = 0.1, amplitude = 2 / (10 * math.pi) ^ 2, seconds = 0.5, settle = 0.2}
  t.close(same.axes[1].moved, gentle.axes[1].moved, 1e-6)
end)

test("the load at which a grasp is lost exceeds the load that it survives", function(t)
  local hand, flask = closed_on_flask()
  local fall = clench.study.fall_off {hand = hand, object = flask, settle = 0.2, rate = 10, max_force = 10}
  t.ok(not fall.survived and fall.min_force > 1 and fall.min_force < 10)
  t.close(fall.min_time, fall.min_force / 10, 1e-12)
  local function survives(force)
    return clench.study.shake {hand = hand, object = flask, force = force, grip_force = 10, seconds = 0.5, settle = 0.2}.survived
  end
  -- a suddenly applied force stretches springs up to twice as far as a slowly increasing one
  t.ok(survives(0.3 * fall.min_force) and not survives(3 * fall.min_force))
end)

test("the area under a ROC curve is the fraction of pairs in the right order", function(t)
  t.close(roc({3, 4}, {1, 2}).auc, 1, 0)
  t.close(roc({1, 2}, {3, 4}).auc, 0, 0)
  t.close(roc({1, 1}, {1, 1, 1}).auc, 0.5, 0)
  local random, good, bad = clench.random(1), {}, {}
  for i = 1, 40 do
    good[i] = math.floor(10 * (random:normal() + 1))
    bad[i] = math.floor(10 * random:normal())
  end
  local right = 0
  for _, g in ipairs(good) do
    for _, b in ipairs(bad) do right = right + (g > b and 1 or g == b and 0.5 or 0) end
  end
  local r = roc(good, bad)
  t.close(r.auc, right / 1600, 1e-12)
  t.ok(r.low < r.auc and r.auc < r.high)
  t.equal(roc({1}, {}), {curve = {false_positives = {0, 0}, true_positives = {0, 1}}})
end)

test("measures are rated by surviving grasps, with any number of threads", function(t)
  local hand, flask, world = closed_on_flask()
  local grasps = {clench.grasp(hand, flask)}
  flask.pose = clench.pose {xyz = {0, 0, 0.02}} * flask.pose
  hand:open()
  hand:autograsp()
  grasps[2] = clench.grasp(hand, flask)
  hand:open()
  grasps[3] = clench.grasp(hand, flask)  -- of nothing
  local options = {hand = hand, object = flask, measures = {"load_margin", "epsilon", "contacts", "gravity_effort"}, threads = 1,
                   shake = {seconds = 0.2, settle = 0.2, grip_seconds = 0.2}}
  local before = world:hash()
  local p = clench.study.predictors(grasps, options)
  t.ok(world:hash() == before and p.failed == 0 and p.count == 3 and not p.grasps[3].survived)
  t.ok(p.survived >= 1 and p.rows[1].auc == 1)
  options.threads = 2
  local again = clench.study.predictors(grasps, options)
  t.equal(tostring(again), tostring(p))
  t.ok(p:chart {width = 300}.width == 300 and p:plot {width = 300}.picture.width == 300)
  t.fails(function() p:plot {series = {}} end, "study.predictors: plot: unknown key 'series'")
end)

test("if nothing is lost, text, chart and table report that there is nothing to compare", function(t)
  local hand, flask = closed_on_flask()
  local p = clench.study.predictors({clench.grasp(hand, flask)}, {hand = hand, object = flask, measures = {"epsilon"}, threads = 1,
                                                                  shake = {seconds = 0.1, settle = 0.1, grip_seconds = 0.1}})
  local row = p.rows[1]
  t.ok(p.survived == 1 and row.auc == nil and row.low == nil and row.high == nil)
  t.ok(tostring(p):find "epsilon +nothing to compare")
  t.ok(p:chart {width = 300}.width == 300 and p:plot {width = 300}.picture.width == 300)
  local path = test.path()
  clench.csv.write(path, {{measure = row.measure, auc = row.auc}}, {columns = {"measure", "auc"}})
  t.equal(clench.csv.read(path)[1].auc, nil)
end)

test("a study begins at rest, for any initial velocities", function(t)
  local hand, flask, world = closed_on_flask()
  local shake = {hand = hand, object = flask, seconds = 0.1, settle = 0.1, grip_seconds = 0.1}
  local lift = {hand = hand, object = flask, mass = 0.1, height = 0.02, hold = 0.1, settle = 0.1, grip_seconds = 0.1}
  local first, lifted = clench.study.shake(shake), clench.study.lift(lift)
  hand.base.velocity = {linear = {0, 0, 0.1}, angular = {0, 1, 0}}
  flask.velocity = {linear = {0, 1, 1}}
  flask:apply_force {0, 0, 1000}
  local velocities = {}
  for i in ipairs(hand.dofs) do velocities[i] = 1 end
  hand.dof_velocities = velocities
  local before = world:hash()
  local again = clench.study.shake(shake)
  for i, row in ipairs(first.directions) do t.equal(again.directions[i].moved, row.moved) end
  for i, row in ipairs(clench.study.lift(lift).rows) do t.equal(row.moved, lifted.rows[i].moved) end
  t.ok(world:hash() == before and flask.velocity.linear.z == 1 and hand.base.velocity.linear.z == 0.1)
end)

test("a verdict names the directions in which the object was lost", function(t)
  local hand, flask = closed_on_flask()
  local options = {hand = hand, object = flask, force = 300, mass = 0.1, seconds = 0.2, settle = 0.1, grip_seconds = 0.1}
  local verdict = clench.study.shake(options)
  local lost = {}
  for _, row in ipairs(verdict.directions) do
    if not row.held then lost[#lost + 1] = row.direction end
  end
  t.ok(#lost > 0)
  t.ok(tostring(verdict):find(("lost along %s: "):format(table.concat(lost, ", ")), 1, true), tostring(verdict))
end)

test("a halted trial does not move", function(t)
  local new_trial, read_motion = require "clench.study.motion.trial", require "clench.study.motion.options"
  local hand, flask = closed_on_flask()
  local read = require "clench.options"("study.fall_off", {hand = hand, object = flask, settle = 0.01, grip_seconds = 0.01})
  local trial = new_trial(read_motion(read))
  trial.root.base.velocity = {linear = {0, 0, 0.1}}
  trial.world:run(0.1)
  trial:halt()
  local before = trial.root.pose
  trial.world:run(0.1)
  t.equal(trial.root.pose, before)
end)

test("options that cannot be simulated are rejected by name", function(t)
  local hand, flask, world = closed_on_flask()
  local function refused(study, given, sentence)
    given.hand, given.object = hand, flask
    t.fails(function() clench.study[study](given) end, "motion_study_test.lua", ("study.%s: %s"):format(study, sentence))
  end
  refused("shake", {force = 1e9}, "force must be at most 100000 N, which accelerates 0.1 kg by 1e+06 m/s^2, got 1000000000")
  refused("fall_off", {max_force = 1e9}, "max_force must be at most 100000 N")
  refused("fall_off", {rate = 1e-9}, "rate must be at least 2e-05 N/s, to reach max_force in a million seconds, got 1e-09")
  refused("lift", {speed = 1e9}, "speed must be a number of at most 1e+06, got 1000000000")
  refused("lift", {hold = 1e9}, "hold must be a number of at most 1e+06")
  refused("shake", {gravity = {0, 0, 1e9}}, "gravity must be a vector of at most 1e+06 m/s^2, got 1000000000")
  refused("shake_base", {frequency = 1e4}, "frequency must be at most 100 Hz, 10 time steps of 0.001 s in a period, got 10000")
  refused("shake_base", {acceleration = 1e9}, "acceleration must be at most 1e+06 m/s^2, got 1000000000")
  refused("shake_base", {amplitude = 1e9}, "amplitude must be at most 1013.21 m at that frequency, got 1000000000")
  refused("lift", {mass = 1e-13}, "body 'flask': mass: expected a number from 1e-12")
  world.time_step = 0.01
  refused("shake_base", {frequency = 11}, "frequency must be at most 10 Hz, 10 time steps of 0.01 s in a period, got 11")
end)

test("a welded object cannot be lost", function(t)
  local hand, flask = closed_on_flask()
  flask:weld(hand.links[3])
  for _, study in ipairs {"shake", "lift", "shake_base", "fall_off"} do
    t.fails(function() clench.study[study] {hand = hand, object = flask} end, "motion_study_test.lua", ("study.%s: object: 'flask' is welded to '%s': unweld it first, as a welded object cannot be lost"):format(study, hand.links[3].name))
  end
end)

test("an angle in degrees and a distance in millimeters are reported once", function(t)
  local said = clench.parallel.map(function()
    local clench, said = require "clench", {}
    clench.log.sink(function(_, text) said[#said + 1] = text end)
    local world = clench.load("worlds/dlr_flask.wld", {root = "."})
    world.robots[1]:autograsp()
    for _ = 1, 2 do
      clench.study.shake {hand = world.robots[1], object = world.objects[1], max_angle = 15, max_distance = 50,
                          seconds = 0.01, settle = 0.01, grip_seconds = 0.01}
    end
    return table.concat(said, "\n")
  end, {1})[1]  -- in a separate state
  local _, meters = said:gsub("meters%?", "")
  local _, radians = said:gsub("radians%?", "")
  t.ok(radians == 1 and said:find("study.shake: max_angle is 15: radians? clench.rad(15) is 0.2618", 1, true), said)
  t.ok(meters == 1 and said:find("study.shake: max_distance is 50 m: meters? clench.mm(50) is 0.05", 1, true), said)
end)

test("faults of a study are reported in one sentence", function(t)
  local hand, flask, world = closed_on_flask()
  local function refused(given, ...)
    local words = {...}
    t.fails(function() clench.study.shake(given) end, table.unpack(words))
  end
  refused({object = flask}, "study.shake: hand must be a robot, got nothing")
  refused({hand = hand, object = hand}, "study.shake: object must be a body, got a robot")
  refused({hand = hand, object = hand.base}, "study.shake: object: '", "is of kind 'base', expected an object")
  refused({hand = hand, object = flask, force = 0}, "study.shake: force must be")
  refused({hand = hand, object = flask, gravity = 3}, "study.shake: gravity must be a vector {x, y, z}, got 3")
  refused({hand = hand, object = flask, grip = "tight"}, "study.shake: grip must be 'forces' or 'close', got 'tight'")
  refused({hand = hand, object = flask, surroundings = 1}, "study.shake: surroundings must be true or false, got 1")
  refused({hand = hand, object = flask, forces = 1}, "study.shake: unknown key 'forces'")
  refused({hand = hand, object = flask, world = clench.world()}, "study.shake: hand and object must be in the same world")
  local function no_study(grasps, given, text) t.fails(function() clench.study.predictors(grasps, given) end, text) end
  local grasp = clench.grasp(hand, flask)
  no_study({}, {}, "study.predictors: expected at least one grasp, got none")
  no_study({1}, {}, "study.predictors: grasps[1]: expected a grasp, got 1")
  no_study(5, {}, "study.predictors: expected a list of grasps, got 5")
  no_study({grasp}, {hand = hand, object = flask, measures = {"epsilom"}}, "study.predictors: measures[1]: there is no measure 'epsilom'; did you mean 'epsilon'?")
  no_study({grasp}, {hand = hand, object = flask, shake = {hand = hand}}, "study.predictors: shake: unknown key 'hand'")
  no_study({grasp}, {hand = hand, object = flask, shake = {sceonds = 1}}, "unknown key 'sceonds'")
  t.ok(world)
end)

test("a hand on an arm is tested with its arm, and without other robots", function(t)
  local world = clench.load("worlds/puma_barrett_glass.wld", {root = "."})
  local arm, hand, glass = world.robots[1], world.robots[2], world.objects[1]
  t.ok(hand.parent == arm)
  -- another hand on another arm, made before its arm
  local other_hand = world:add_robot("models/hands/parallel_jaw/parallel_jaw.cfg", {name = "other"})
  hand:autograsp()
  local closed = world:hash()
  local v = clench.study.lift {hand = hand, object = glass, mass = 0.05, settle = 0.1, hold = 0.1, surroundings = false}
  t.ok(v.contacts > 0)
  t.equal(#v.rows, v.survived and 3 or v.held + 1)
  t.equal(world:hash(), closed)
  t.ok(other_hand.world == world)
end)

test("a study leaves undriven joints free, and keeps gains set by a script", function(t)
  local path = "build/one_free_finger.xml"
  clench.files.save_text(path, [[<mujoco model="jaw"><compiler angle="radian"/><worldbody><body name="base"><geom type="box" size=".05 .01 .01"/>
    <body name="l" pos="-0.05 0 0"><joint name="a" type="slide" axis="1 0 0" range="-0.03 0.05"/><geom type="box" size="0.005 0.01 0.05" pos="0 0 0.06" mass="0.1"/></body>
    <body name="r" pos="0.05 0 0"><joint name="b" type="slide" axis="-1 0 0" range="-0.03 0.05"/><geom type="box" size="0.005 0.01 0.05" pos="0 0 0.06" mass="0.1"/></body>
    </body></worldbody><actuator><position joint="a" kp="400" kv="20"/></actuator></mujoco>]])
  local world = clench.world()
  local hand = world:add_robot(path)
  local block = world:add_object(clench.shapes.box {0.06, 0.02, 0.04}, {mass = 0.1, pose = {xyz = {0, 0, 0.08}}})
  hand:set_dofs {0.01499, 0.01499}
  -- the free finger yields
  t.equal(clench.study.shake({hand = hand, object = block, seconds = 0.2, settle = 0.2}).survived, false)
  hand.gains = {{kp = 7, kd = 0.7}, {kp = 8, kd = 0.8}}
  local new_trial, read_motion = require "clench.study.motion.trial", require "clench.study.motion.options"
  local trial = new_trial(read_motion(require "clench.options"("study.fall_off", {hand = hand, object = block, settle = 0.01, grip_seconds = 0.01})))
  t.equal({trial.hand.gains[1].kp, trial.hand.gains[2].kp}, {7.0, 8.0})
end)

test("the direction of a lift is a vector in either form", function(t)
  local hand, flask = closed_on_flask()
  for _, direction in ipairs {clench.vec3(0, 0, 2), {0, 0, 2}} do
    t.ok(clench.study.lift({hand = hand, object = flask, height = 0.02, hold = 0.1, settle = 0.1, mass = 0.1, direction = direction}).survived)
  end
  t.fails(function() clench.study.lift {hand = hand, object = flask, direction = "up"} end, "direction must be a vector {x, y, z}, got 'up'")
end)

test("a grasp without contacts has the worst value of each measure", function(t)
  local hand, flask = closed_on_flask()
  local good = clench.grasp(hand, flask)
  hand:open()
  local p = clench.study.predictors({good, clench.grasp(hand, flask)}, {hand = hand, object = flask, measures = {"gravity_effort", "epsilon"}, threads = 1,
                                                                         shake = {seconds = 0.1, settle = 0.1, grip_seconds = 0.1}})
  t.equal({p.rows[1].auc, p.rows[2].auc}, {1.0, 1.0})
end)
