-- Planners: results are reproducible and correct at any number of threads, and failures are explained.
local test, clench = require "test", require "clench"

local function barrett_mug()
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  return world, world.robots[1], world.objects[1]
end

local function jaws_and(mesh)
  local world = clench.world()
  local hand = world:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
  return world, hand, world:add_object(mesh, {pose = {xyz = {0, 0, 1}}, name = "thing"})
end

-- every grasp, applied to a world that no planner has used, has the reported measures and no collisions
local function check_grasps(t, run, make)
  local world, hand, object = make()
  for _, g in ipairs(run.grasps) do
    local again = g:apply(world)
    t.close(again:quality "epsilon", g.epsilon, 1e-9)
    t.ok(not world:collides(hand))
    t.ok(again.hand_name == hand.name and again.object_name == object.name)
  end
end

test("sampled grasps are verified, and hold when evaluated again", function(t)
  local world, hand, mug = barrett_mug()
  local before = world:hash()
  local run = clench.plan.sample {hand = hand, object = mug, count = 6, seed = 2, refine = 3}
  t.equal(world:hash(), before)
  t.ok(#run.grasps >= 5)
  check_grasps(t, run, barrett_mug)
  local last = math.huge
  for _, g in ipairs(run.grasps) do
    t.ok(g.collision_free and g.epsilon >= 0.01 and g.epsilon <= last)
    t.ok(g.info.load_margin >= 2 and g.info.perturbed_epsilon >= 0.01)
    t.equal(g.labels.planner, "sample")
    last = g.epsilon
  end
end)

test("an object on a floor is displaced into it, and verification continues", function(t)
  local world = clench.world()
  local hand = world:add_robot "models/hands/dlr/dlr.cfg"
  local bottle = world:add_object "models/objects/bottle.iv"
  world:add_obstacle "models/obstacles/floor.iv"
  local run = clench.plan.sample {hand = hand, object = bottle, candidates = 128, refine = 0, threads = 2}
  t.ok(#run.grasps > 5)
  for why in pairs(run.report.rejected) do t.equal(why:find(".lua:", 1, true), nil) end
end)

test("refining makes grasps better on average", function(t)
  local _, hand, mug = barrett_mug()
  local function mean(refine)
    local run = clench.plan.sample {hand = hand, object = mug, count = 12, candidates = 200, seed = 5, refine = refine, verify = false}
    local sum = 0
    for _, g in ipairs(run.grasps) do sum = sum + g.epsilon end
    return sum / #run.grasps
  end
  t.ok(mean(8) > 1.2 * mean(0))
end)

test("results of all planners are byte-identical with any number of threads", function(t)
  local planners = {
    sample = {count = 2, refine = 1}, random = {count = 5}, guided = {steps = 2500, child_steps = 30, children = 2},
  }
  for name, options in pairs(planners) do
    local bytes
    for _, threads in ipairs {1, 3} do
      local _, hand, mug = barrett_mug()
      options.hand, options.object, options.threads, options.seed = hand, mug, threads, 4
      local run = clench.plan[name](options)
      bytes = bytes or clench.json.encode(run.grasps)
      t.equal(clench.json.encode(run.grasps), bytes)
      t.ok(#run.grasps > 0, name)
    end
  end
end)

test("candidates around a cylinder are those of the rules", function(t)
  local starts = require "clench.plan.primitive_starts"
  local can = {kind = "cylinder", pose = clench.pose {}, radius = 0.03, height = 0.1}
  -- 2 + 2 at the ends, and 4 sides with the thumb across and along
  t.equal(#starts({can}, 1, "corrected"), 12)
  -- 4 + 4 at the ends; 3 planes of 8 steps
  t.equal(#starts({can}, 2, "corrected"), 8 + 3 * 8 * 2)
  for _, s in ipairs(starts({can}, 1, "corrected")) do
    t.close(s.direction:norm(), 1, 1e-12)
    t.close(s.direction:dot(s.thumb), 0, 1e-12)
  end
  -- too low to be gripped across; its sides are gripped along the axis only
  local coin = {kind = "cylinder", pose = clench.pose {}, radius = 0.03, height = 0.01}
  t.equal(#starts({coin}, 1, "corrected"), 8)
  -- radii are not diameters
  local drum = {kind = "cylinder", pose = clench.pose {}, radius = 0.15, height = 0.1}
  t.ok(#starts({drum}, 1, "graspit") > #starts({drum}, 1, "corrected"))
end)

test("hands start half an edge and 80 mm from the center of a box, or a whole edge by the original's rule", function(t)
  local starts = require "clench.plan.primitive_starts"
  local box = {kind = "box", pose = clench.pose {xyz = {1, 0, 0}}, size = clench.vec3(0.06, 0.06, 0.06)}
  for rule, far in pairs {corrected = 0.03 + 0.08, graspit = 0.06 + 0.08} do
    local list = starts({box}, 1, rule)
    t.equal(#list, 12)
    for _, s in ipairs(list) do t.close((s.position - clench.vec3(1, 0, 0)):norm(), far, 1e-12) end
  end
end)

test("the primitive planner finds a cylinder from its sides", function(t)
  local _, hand, mug = barrett_mug()
  local cup = {{kind = "cylinder", pose = clench.pose {rpy = {math.pi / 2, 0, 0}}, radius = 0.04, height = 0.09}}
  local run = clench.plan.primitive {hand = hand, object = mug, primitives = cup, density = 1}
  t.equal(run.report.candidates, 12)
  t.ok(#run.grasps >= 3)
  check_grasps(t, run, barrett_mug)
end)

test("jaws close on opposite points", function(t)
  local function make() return jaws_and(clench.shapes.box {0.03, 0.04, 0.1}) end
  local _, hand, bar = make()
  local run = clench.plan.antipodal {hand = hand, object = bar, count = 10, seed = 1}
  t.ok(#run.grasps >= 5)
  check_grasps(t, run, make)
end)

test("a list of states is tested unchanged", function(t)
  local _, hand, mug = barrett_mug()
  local found = clench.plan.random {hand = hand, object = mug, count = 4}.grasps
  local run = clench.plan.list {hand = hand, object = mug, states = found, approach = 0.3}
  t.ok(#run.grasps >= 1 and run.report.candidates == #found)
end)

test("an online planner follows the object", function(t)
  local world, hand, mug = barrett_mug()
  hand:place_approach(mug.pose.position, {0, 0, -1}, 0.15)
  local before = world:hash()
  local planner = clench.plan.online {hand = hand, object = mug, seed = 2}
  for _ = 1, 3 do planner:search(400) end
  t.equal(world:hash(), before)
  t.ok(planner.tested > 0)
  mug.pose = clench.pose {xyz = {0.05, 0, 0}} * mug.pose
  local list = planner:search(200)
  t.equal(#list, #planner:grasps())
  for _, g in ipairs(list) do t.ok(g.epsilon > 0) end
  t.fails(function() clench.plan.online {hand = hand, object = mug, energy = function() return 1 end} end, "energy must be a string or an energy, got a function")
  t.fails(function() clench.plan.online {hand = hand, object = mug, limits = {}} end, "unknown key 'limits'")
end)

test("reasons for a failure are reported by name", function(t)
  local _, hand, mug = barrett_mug()
  local far = clench.plan.guided {hand = hand, object = mug, steps = 500, limits = {Tx = {0.24, 0.25}, Ty = {0.24, 0.25}, Tz = {0.3, 0.35}}}
  t.equal(#far.grasps, 0)
  t.ok(tostring(far.report):find "cannot reach the object")
  local _, jaws, block = jaws_and(clench.shapes.box {0.4, 0.4, 0.4})
  local large = clench.plan.random {hand = jaws, object = block, candidates = 40}
  t.equal(#large.grasps, 0)
  t.ok(tostring(large.report):find("is too wide for parallel_jaw: opposite points of its surface are at least 400 mm apart, and the pads open to 80 mm", 1, true), tostring(large.report))
end)

test("a robot that cannot close is reported first", function(t)
  local path = test.path(".urdf", [[<robot name="stick"><link name="palm"/><link name="tip"><collision><geometry><box size="0.02 0.02 0.1"/></geometry></collision></link>
    <joint name="j" type="revolute"><parent link="palm"/><child link="tip"/><axis xyz="1 0 0"/><limit lower="0" upper="1"/></joint>
    <clench><dof joint="j" velocity="0"/></clench></robot>]])
  local world = clench.world()
  local stick = world:add_robot(path)
  local cube = world:add_object(clench.shapes.box {0.05, 0.05, 0.05}, {pose = {xyz = {2, 0, 0}}})
  local run = clench.plan.sample {hand = stick, object = cube, candidates = 8}
  t.ok(run.report.causes[1]:find "^no DOF of stick closes", run.report.causes[1])
end)

test("wrong options are reported", function(t)
  local _, hand, mug = barrett_mug()
  local function fails(name, options, ...)
    options.hand, options.object = options.hand or hand, options.object or mug
    local words = {...}
    t.fails(function() clench.plan[name](options) end, table.unpack(words))
  end
  fails("anneal", {step = 3}, "step", "steps")
  fails("sample", {hand = 3}, "hand must be a robot")
  fails("sample", {object = hand}, "object must be a body")
  fails("sample", {verify = 3}, "verify must be a boolean or a table")
  fails("sample", {on_grasp = 3}, "on_grasp must be a function")
  fails("sample", {standoff = -1}, "standoff must be a number > 0")
  fails("random", {verify = true}, "unknown key 'verify'")
  fails("primitive", {primitives = {}}, "primitives must be")
  fails("primitive", {primitives = "nowhere.iv"}, "nowhere.iv")
  fails("primitive", {primitives = {{}}}, "primitives[1]")
  fails("antipodal", {friction = 0}, "friction must be a number > 0")
  fails("list", {states = 3}, "states")
  fails("guided", {child_energy = "strct"}, "strct")
end)

test("errors of the engine about a planner's options name the script's line and the option", function(t)
  local world, hand, mug = barrett_mug()
  local before = world:hash()
  local function refused(name, options, sentence)
    options.hand, options.object = hand, options.object or mug
    t.fails(function() clench.plan[name](options) end, "plan_test.lua:", ("plan.%s: %s"):format(name, sentence))
    t.equal(world:hash(), before)
  end
  for _, name in ipairs {"sample", "random", "antipodal"} do
    refused(name, {standoff = 1e300}, "standoff must be a number of at most 10, got 1e+300")
  end
  for _, part in ipairs {hand.links[1], hand.base} do
    for _, name in ipairs {"sample", "anneal", "online"} do
      refused(name, {object = part}, ("object: '%s' is a part of the hand"):format(part.name))
    end
  end
  refused("random", {grasp = {edgse = 3}}, "grasp: clench.grasp: unknown key 'edgse'")
  for _, name in ipairs {"anneal", "guided", "loop"} do
    refused(name, {limits = {Tx = {0.25, -0.25}}}, "search variable 'Tx': min 0.25 exceeds max -0.25")
    refused(name, {steps = 0}, "steps must be a whole number from 1 to 1000000000, got 0")
    refused(name, {steps = 20, energy = function() return math.huge end}, "energy: expected a finite number of at least one state, got inf of all")
    local calls = 0
    refused(name, {steps = 20, energy = function()
      calls = calls + 1
      return calls < 5 and calls or 0 / 0
    end}, "energy: expected a number, got nan")
  end
end)

test("states with infinite energy are skipped", function(t)
  local _, hand, mug = barrett_mug()
  local calls = 0
  local run = clench.plan.anneal {hand = hand, object = mug, steps = 200, energy = function()
    calls = calls + 1
    return calls % 50 == 0 and calls or math.huge
  end}
  t.equal(run.report.best, 50)
end)

test("missing and unknown entries of a list of states are named", function(t)
  local _, hand, mug = barrett_mug()
  local function refused(states, sentence, energy)
    t.fails(function() clench.plan.list {hand = hand, object = mug, states = states, energy = energy} end, "plan_test.lua:", "plan.list: " .. sentence)
  end
  refused({}, "states: expected at least one grasp or state, got none")
  refused({{dofs = hand.dofs}}, "states[1]: pose is missing: expected a grasp or {pose =, dofs =}")
  refused({{pose = hand.pose}}, "states[1]: dofs are missing: expected a grasp or {pose =, dofs =}")
  refused({{pose = 3, dofs = hand.dofs}}, "states[1].pose must be a pose, got 3")
  refused({{pose = hand.pose, dofs = {1}}}, "states[1].dofs must be 4 numbers, one per DOF, got a table of 1")
  refused({{pose = hand.pose, dofs = {1, 2, "x", 4}}}, "states[1].dofs[3] must be a finite number, got 'x'")
  local away = {{pose = clench.pose {xyz = {0, 0, 5}}, dofs = hand.dofs}}
  refused(away, "energy: expected a finite number, got nan", function() return 0 / 0 end)
  t.fails(function() clench.plan.list {hand = hand, object = mug, states = away, approach = 1e300} end, "approach must be a number of at most 1e+06")
end)

test("primitives have sizes, and are in meters", function(t)
  local _, hand, mug = barrett_mug()
  local function plan(p)
    p.pose = clench.pose {}
    return clench.plan.primitive {hand = hand, object = mug, primitives = {p}}
  end
  local function refused(p, sentence) t.fails(function() plan(p) end, "plan_test.lua:", "plan.primitive: primitives[1]: " .. sentence) end
  refused({kind = "sphere", radius = -1}, "radius must be a number > 0, got -1")
  refused({kind = "sphere", radius = 0 / 0}, "radius must be a number > 0, got nan")
  refused({kind = "sphere", radius = 30}, "radius must be at most 10 m, got 30: meters? clench.mm(30) is 0.03")
  refused({kind = "cone", radius = 0.1, height = "x"}, "height must be a number > 0, got 'x'")
  refused({kind = "box", size = clench.vec3(0.1, -0.1, 0.1)}, "size.y must be a number > 0, got -0.1")
  local large = plan {kind = "sphere", radius = 3}
  t.equal(large.report.causes[1], "no primitive has a size that a hand can grasp: thumb and fingers span at most 200 mm")
end)

test("a hand on an arm keeps the grasps that the arm reaches", function(t)
  local world = clench.load("worlds/puma_barrett_glass.wld", {root = "."})
  local arm, hand = world.robots[1], world.robots[2]
  if not hand.parent then arm, hand = hand, arm end
  local glass = world.objects[1]
  local run = clench.plan.random {hand = hand, object = glass, count = 20, seed = 1}
  t.ok(#run.grasps + run.report.out_of_reach + run.report.alike >= 20)
  for _, g in ipairs(run.grasps) do
    local dofs = {}
    for i in ipairs(arm.dofs) do dofs[i] = g.info["arm_" .. i] end
    arm.dofs = dofs
    t.close((glass.pose * g.pose).position - hand.pose.position, {0, 0, 0}, 1e-5)
  end
  glass.pose = {xyz = {9, 9, 9}}
  local far = clench.plan.random {hand = hand, object = glass, count = 5, seed = 1}
  t.equal(#far.grasps, 0)
  t.ok(tostring(far.report):find "the arm reaches none")
  local base = arm.base
  world:add_obstacle(clench.shapes.box {0.1, 0.1, 0.1}, {name = "crate", pose = {xyz = base.pose.position}})
  local said = t.warnings(function() clench.plan.random {hand = hand, object = glass, count = 1, seed = 1} end)
  t.ok(said[1]:find(("plan.random: '%s' collides before anything moves; grasps are not rejected for these collisions: "):format(arm.name), 1, true), said[1])
  t.ok(said[1]:find("crate", 1, true), said[1])
  world:remove(world:body "crate")
  world:add_obstacle(clench.shapes.box {0.05, 0.05, 0.05}, {name = "block", pose = {xyz = glass.pose * glass.com}})
  said = t.warnings(function() clench.plan.random {hand = hand, object = glass, count = 1, seed = 1} end)
  t.ok(said[1]:find("plan.random: the object overlaps other bodies before anything moves; grasps are not rejected for these overlaps: ", 1, true), said[1])
  t.ok(said[1]:find("block", 1, true), said[1])
end)

test("grasps that are verified by shaking survive it, and lost ones are dropped or marked", function(t)
  local function shaken(verify, threads)
    local _, hand, mug = barrett_mug()
    mug.mass = 0.1
    return clench.plan.sample {hand = hand, object = mug, count = 4, candidates = 24, seed = 2, refine = 0, verify = verify, threads = threads}
  end
  local easy = {seconds = 0.3, settle = 0.3}
  local run = shaken({shake = easy}, 1)
  t.ok(#run.grasps > 0 and run.report.survived >= #run.grasps and run.report.shaken >= run.report.survived)
  for _, g in ipairs(run.grasps) do t.ok(g.info.survived == 1 and g.info.directions_held == 6) end
  t.ok(tostring(run.report):find(("%d of %d shaken grasps held in all 6 directions"):format(run.report.survived, run.report.shaken), 1, true))
  t.equal(clench.json.encode(shaken({shake = easy}, 2).grasps), clench.json.encode(run.grasps))
  -- nothing survives a hundred weights
  local hard = {seconds = 0.3, settle = 0.1, force = 100}
  local lost = shaken({shake = hard})
  t.ok(#lost.grasps == 0 and lost.report.survived == 0 and lost.report.rejected["lost when shaken"] == lost.report.shaken)
  local kept = shaken({shake = hard, keep_lost = true})
  t.ok(#kept.grasps > 0 and kept.report.survived == 0)
  for _, g in ipairs(kept.grasps) do t.ok(g.info.survived == 0 and g.info.directions_held < 6) end
  t.fails(function() shaken {shake = {hand = 1}} end, "plan.sample: verify: shake: unknown key 'hand'")
end)

test("the dynamic energy counts the directions in which a shaken grasp holds", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  local before = world:hash()
  local e = clench.energy.dynamic {hand = hand, object = flask, shake = {seconds = 0.1, settle = 0.1}}
  t.equal(e(), -6.0)
  t.equal(world:hash(), before)
  -- far away it is the distance
  hand.pose = clench.pose {xyz = {0, 0, 1}} * hand.pose
  t.close(e(), 1 + clench.energy.contact {hand = hand, object = flask}(), 1e-9)
  world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local run = clench.plan.anneal {hand = world.robots[1], object = world.objects[1], steps = 5, energy = "dynamic"}
  t.equal(run.report.steps, 5)
  t.fails(function() clench.energy.dynamic {hand = hand} end, "clench.energy.dynamic: object must be a body, got nothing")
  t.fails(function() clench.energy.dynamic {hand = hand, object = world.objects[1]} end, "belongs to another world than the hand")
  t.fails(function() clench.energy.dynamic() end, "clench.energy.dynamic: expected one table of options")
end)
