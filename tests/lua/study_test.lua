-- Studies of grasps: their random numbers, their statistics, and results for grasps with known answers.
local test, clench = require "test", require "clench"
local stats = require "clench.stats"

local function closed_on_flask()
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  hand:autograsp()
  return clench.grasp(hand, flask)
end

test("a spread contains mean, deviation and quantiles of numbers", function(t)
  local s = stats.summary {4, 1, 3, 2, 5}
  t.close({s.mean, s.min, s.median, s.max}, {3, 1, 3, 5}, 1e-15)
  t.close(s.std, math.sqrt(2.5), 1e-15)
  t.close({s.p05, s.p95}, {1.2, 4.8}, 1e-15)
  local one = stats.summary {7}
  t.close({one.mean, one.std, one.p05, one.p95}, {7, 0, 7, 7}, 0)
end)

test("the interval of a probability contains it, and shrinks with more trials", function(t)
  for _, trials in ipairs {1, 10, 1000} do
    for successes = 0, trials, math.max(1, trials // 7) do
      local i = stats.interval(successes, trials)
      t.ok(i.low <= successes / trials + 1e-15 and successes / trials - 1e-15 <= i.high and i.low >= 0 and i.high <= 1)
    end
  end
  -- the table of Brown, Cai and DasGupta (2001): 0 of 10 is at most 0.278
  t.close(stats.interval(0, 10).high, 0.2775, 5e-4)
  t.ok(stats.interval(500, 1000).high - stats.interval(500, 1000).low < 0.07)
end)

test("without errors every sample is the grasp itself", function(t)
  local grasp = closed_on_flask()
  local r = clench.study.robustness(grasp, {samples = 5})
  for _, epsilon in ipairs(r.samples) do t.ok(epsilon == grasp:quality "epsilon") end
  t.ok(r.probability == 1 and r.blocked == 0 and r.std == 0)
end)

test("soft fingers stay soft in every sample", function(t)
  -- three fingers on a ball: torsion counts in the weakest direction
  local world = clench.load("worlds/three_finger_sphere.wld", {root = "."})
  local hand, ball = world.robots[1], world.objects[1]
  hand:autograsp()
  local hard = clench.grasp(hand, ball):quality "epsilon"
  ball.elastic_modulus = 1e5
  local soft = clench.grasp(hand, ball)
  t.ok(soft.points[1].torsion_radius > 0 and soft:quality "epsilon" > hard + 0.01)
  t.ok(clench.study.robustness(soft, {samples = 2}).samples[2] == soft:quality "epsilon")
end)

test("the same seed gives bit-identical samples, for any number of samples", function(t)
  local grasp = closed_on_flask()
  local errors = {samples = 12, seed = 3, friction = 0.3, normal = 0.1}
  local first = clench.study.robustness(grasp, errors).samples
  t.close(clench.study.robustness(grasp, errors).samples, first, 0)
  errors.samples = 4
  for i, epsilon in ipairs(clench.study.robustness(grasp, errors).samples) do t.ok(epsilon == first[i]) end
  errors.seed = 4
  t.ok(clench.study.robustness(grasp, errors).samples[1] ~= first[1])
end)

test("a displaced object is grasped again, and the world is unchanged", function(t)
  local grasp = closed_on_flask()
  local before = grasp.hand.world:hash()
  local r = clench.study.robustness(grasp, {samples = 6, position = 0.004, angle = 0.05})
  t.ok(grasp.hand.world:hash() == before)
  t.ok(r.std > 0 and r.max < 1)
  -- errors of size zero give the grasp itself, except for the stop of its fingers within the threshold
  local same = clench.study.robustness(grasp, {samples = 3, position = 1e-9})
  t.close(same.mean, grasp:quality "epsilon", 0.1 * grasp:quality "epsilon")
  t.ok(same.probability == 1)
  local far = clench.study.robustness(grasp, {samples = 6, position = 50})
  t.ok(far.probability == 0 and far.mean == 0)
end)

test("robustness is that of the grasp, after any motion of the hand and the object", function(t)
  local grasp = closed_on_flask()
  local hand, flask = grasp.hand, grasp.object
  local errors = {samples = 4, position = 0.001, angle = 0.01}
  local first = clench.study.robustness(grasp, errors).samples
  local function again(tolerance)
    local before = hand.world:hash()
    t.close(clench.study.robustness(grasp, errors).samples, first, tolerance)
    t.equal(hand.world:hash(), before)
  end
  hand:open()
  again(0)
  -- errors are along the world's axes: the object is moved, not turned
  flask.pose = clench.pose {xyz = {0.1, 0, 0.02}} * flask.pose
  again(1e-4)
  hand:autograsp()
  again(1e-4)
end)

test("robustness uses the center of mass with which the grasp was evaluated", function(t)
  local grasp = closed_on_flask()
  local epsilon = grasp:quality "epsilon"
  local moving = {samples = 3, position = 0.001}
  local first = clench.study.robustness(grasp, moving).samples
  grasp.object.com = {0, 0, 0.03}
  t.equal(clench.study.robustness(grasp, {samples = 1}).samples[1], epsilon)
  local coms = {}
  moving.close = function(hand, object)
    hand:autograsp()
    coms[#coms + 1] = object.com.z
  end
  t.close(clench.study.robustness(grasp, moving).samples, first, 0)
  t.close(coms[1], 0.0743072, 1e-6)  -- as in models/objects/flask.iv
  t.equal(grasp.object.com.z, 0.03)
end)

test("a grasp with changed friction is stale for errors of pose, but not for those of friction", function(t)
  local grasp = closed_on_flask()
  local hand, flask = grasp.hand, grasp.object
  local first = clench.study.robustness(grasp, {samples = 3, friction = 0.2}).samples
  hand.world:set_friction(flask.material, hand.links[1].material, {static = 0.7, kinetic = 0.7})
  t.close(clench.study.robustness(grasp, {samples = 3, friction = 0.2}).samples, first, 0)
  local ok, problem = pcall(clench.study.robustness, grasp, {samples = 3, position = 0.001})
  t.ok(not ok and problem.kind == "stale")
  t.ok(tostring(problem):find("study.robustness: friction has changed since the grasp was measured; measure it anew", 1, true))
end)

test("a hand on an arm is restored by its joints, and is stale if the arm has moved it", function(t)
  local world = clench.load("worlds/puma_barrett_glass.wld", {root = "."})
  local hand, glass = world.robots[2], world.objects[1]
  hand:autograsp()
  local grasp = clench.grasp(hand, glass)
  local errors = {samples = 3, position = 0.0005}
  local first = clench.study.robustness(grasp, errors).samples
  local closed = hand.dofs
  hand:open()
  t.close(clench.study.robustness(grasp, errors).samples, first, 0)
  t.equal(grasp:apply():quality "epsilon", grasp:quality "epsilon")
  t.close(hand.dofs, closed, 1e-15)
  hand:open()
  glass.pose = clench.pose {xyz = {0.01, 0, 0}} * glass.pose
  t.fails(function() clench.study.robustness(grasp, errors) end,
          "study.robustness: hand and object have moved apart since the grasp was measured; measure it anew")
end)

test("an arm brings its hand to the pose of the grasp, or everything stays if it cannot reach it", function(t)
  local world = clench.load("worlds/puma_barrett_glass.wld", {root = "."})
  local arm, hand, glass = world.robots[1], world.robots[2], world.objects[1]
  hand:autograsp()
  local grasp = clench.grasp(hand, glass)
  hand:open()
  glass.pose = clench.pose {xyz = {0.01, 0.02, 0}} * glass.pose
  local again = grasp:apply()
  local offset = glass.pose:inverse() * hand.pose
  t.close((offset.position - grasp.pose.position):norm(), 0, 1e-8)
  t.equal(#again.contacts, #grasp.contacts)
  t.close(again:quality "epsilon", grasp:quality "epsilon", 1e-6)
  glass.pose = clench.pose {xyz = {9, 0, 0}} * glass.pose
  hand:open()
  local opened, posture = hand.dofs, arm.dofs
  t.fails(function() grasp:apply() end, "grasp of glass by barrett: 'puma560' cannot bring the hand there; at best it is")
  t.equal(hand.dofs, opened)
  t.equal(arm.dofs, posture)
end)

test("a grasp without a world is studied as far as possible, otherwise the error names the remedy", function(t)
  local grasp = closed_on_flask()
  local list = clench.grasps()
  list:add(grasp)
  local path = test.path()
  list:save(path .. ".jsonl")
  local loose = clench.grasps(path .. ".jsonl")[1]
  local sentence = "the grasp belongs to no world, like those of planners and files; grasp:apply(world) gives one that does"
  t.fails(function() clench.study.robustness(loose, {samples = 2, position = 0.001}) end, "study_test.lua", "study.robustness: " .. sentence)
  t.fails(function() clench.study.compare {grasp, loose} end, "study.compare: grasps[2]: " .. sentence)
  local errors = {samples = 4, friction = 0.2, normal = 0.1}
  t.close(clench.study.robustness(loose, errors).samples, clench.study.robustness(grasp, errors).samples, 1e-9)
end)

test("errors in millimeters and degrees are reported once, with the script's line", function(t)
  local said = clench.parallel.map(function()
    local clench, said = require "clench", {}
    clench.log.sink(function(_, text) said[#said + 1] = text end)
    local world = clench.load("worlds/dlr_flask.wld", {root = "."})
    local hand, flask = world.robots[1], world.objects[1]
    hand:autograsp()
    local grasp = clench.grasp(hand, flask)
    clench.study.robustness(grasp, {samples = 1, position = 0.2, angle = 6})
    for _ = 1, 2 do clench.study.robustness(grasp, {samples = 1, position = 3, angle = 15}) end
    return table.concat(said, "\n")
  end, {1})[1]  -- in a separate state, because it is reported once per state
  local _, meters = said:gsub("meters%?", "")
  local _, radians = said:gsub("radians%?", "")
  t.ok(radians == 1 and said:find("study.robustness: angle is 15: radians? clench.rad(15) is 0.2618", 1, true), said)
  t.ok(meters == 1 and said:find("study_test.lua:%d+: study.robustness: position is 3 m, more than the object's size of 0.281 m: meters%? clench.mm%(3%) is 0.003"), said)
end)

test("if friction may vanish, so may force closure", function(t)
  -- a factor 1 + 3 n, n normal, is below 0 in 37 % of all samples; 0.2 is three deviations of 60 samples
  local r = clench.study.robustness(closed_on_flask(), {samples = 60, friction = 3})
  t.ok(r.probability > 0.4 and r.probability < 0.85)
  t.ok(r.min == 0 and r.interval.low < r.probability and r.probability < r.interval.high)
end)

test("the caller may provide a closing function", function(t)
  local grasp, called = closed_on_flask(), 0
  clench.study.robustness(grasp, {samples = 3, position = 0.001, close = function(hand, object)
    called = called + 1
    t.ok(object.name == grasp.object.name and hand.world ~= grasp.hand.world)
  end})
  t.ok(called == 3)
end)

test("faults of options are reported in one sentence", function(t)
  local grasp = closed_on_flask()
  local function refused(given, sentence) t.fails(function() clench.study.robustness(grasp, given) end, sentence) end
  refused({samples = 0}, "study.robustness: samples must be a whole number from 1 to 1000000, got 0")
  refused({position = -1}, "study.robustness: position must be a number >= 0, got -1")
  refused({friction = "much"}, "study.robustness: friction must be a number >= 0, got 'much'")
  refused({close = 3}, "study.robustness: close must be a function, got 3")
  refused({frictoin = 1}, "study.robustness: unknown key 'frictoin'")
  t.fails(function() clench.study.robustness() end, "study.robustness: expected a grasp, got nothing")
  t.fails(function() clench.study.robustness(grasp.hand, {}) end, "study.robustness: expected a grasp, got a robot")
  t.fails(function() return clench.study.robust end, "study: there is no 'robust', only compare, fall_off, lift, planner_speed, predictors, resistible_wrenches, robustness, shake, shake_base")
end)

test("grasps are compared measure by measure, and drawn", function(t)
  local grasp = closed_on_flask()
  local hand, flask = grasp.hand, grasp.object
  local list = {}
  for i, mu in ipairs {0.2, 0.4, 0.8} do
    hand.world:set_friction(flask.material, "rubber", {static = mu, kinetic = mu})
    list[i] = clench.grasp(hand, flask)
  end
  local c = clench.study.compare(list, {measures = {"epsilon", "volume"}, labels = {"0.2", "0.4", "0.8"}})
  t.ok(c.best.epsilon == 3 and c.best.volume == 3)
  for i, g in ipairs(list) do t.ok(c.values.epsilon[i] == g:quality "epsilon" and c.values.volume[i] == g:quality "volume") end
  local picture = c:chart {title = "friction", width = 400}
  t.ok(picture.width == 400 and picture == c:chart {title = "friction", width = 400})
end)

test("letters that a chart cannot draw are named once per chart", function(t)
  local heard = {}
  clench.log.sink(function(level, message) heard[#heard + 1] = level .. ": " .. message end)
  local function draw(title) clench.chart {title = title, labels = {title}, series = {{name = title, values = {1}}}, width = 200} end
  draw "Größe µ, ε, τ, Ж и \xff"
  t.equal(#heard, 0)
  draw "手 и 力"
  draw "一丁丂七丄丅丆万丈三上下丌不与丏丐丑丒专"
  clench.log.sink(nil)
  t.equal(#heard, 2)
  t.equal(heard[1], "warning: chart: these characters are drawn as boxes: U+529B, U+624B")
  t.ok(heard[2]:find "and 12 more$")
end)

test("the best of a panel is the minimum for measures that should be small", function(t)
  local grasp = closed_on_flask()
  local hand, flask = grasp.hand, grasp.object
  hand.world:set_friction(flask.material, "rubber", {static = 0.8, kinetic = 0.8})
  local first = clench.grasp(hand, flask)
  local c = clench.study.compare({first}, {measures = {"gravity_effort"}, labels = {"1"}})
  c.values.gravity_effort = {3, 1}
  c.labels = {"1", "2"}
  local function by_hand(least)
    return clench.chart {series = {{name = "gravity_effort", values = {3, 1}, higher_is_better = not least}}, labels = {"1", "2"}}
  end
  t.ok(c:chart() == by_hand(true) and c:chart() ~= by_hand(false))
end)

test("a comparison without grasps or with other values is rejected", function(t)
  t.fails(function() clench.study.compare {} end, "study.compare: expected at least one grasp, got none")
  t.fails(function() clench.study.compare {3} end, "study.compare: grasps[1]: expected a grasp, got 3")
  t.fails(function() clench.study.compare(closed_on_flask()) end, "study.compare: expected a list of grasps, got a grasp")
  local grasp = closed_on_flask()
  t.fails(function() clench.study.compare({grasp}, {measures = {"epsilom"}}) end, "did you mean 'epsilon'?")
  t.fails(function() clench.study.compare({grasp}, {labels = {"a", "b"}}) end, "study.compare: expected 1 label, one per grasp, got 2")
end)

test("the best grasp is that of the least effort, and one that holds nothing is drawn as missing", function(t)
  local grasp = closed_on_flask()
  local hand, flask = grasp.hand, grasp.object
  local slippery = hand.world:clone()
  slippery:set_friction(flask.material, "rubber", {static = 0, kinetic = 0})
  local list = {clench.grasp(slippery.robots[1], slippery.objects[1]), grasp}
  local c = clench.study.compare(list, {measures = {"gravity_effort", "epsilon"}})
  t.ok(c.values.gravity_effort[1] == math.huge and c.best.gravity_effort == 2 and c.best.epsilon == 2)
  t.ok(c:chart {width = 300}.width == 300)
  t.fails(function() clench.study.compare {grasp, nil, grasp} end, "study.compare: grasps: expected a list without holes or names")
  t.fails(function() clench.study.compare({grasp}, {labels = "a"}) end, "study.compare: labels must be a list of strings, got 'a'")
end)

test("among compared grasps only those without a world are applied", function(t)
  local grasp = closed_on_flask()
  local list = clench.grasps()
  list:add(grasp)
  local path = test.path ".jsonl"
  list:save(path)
  local read = clench.grasps(path)
  t.equal(clench.study.compare({grasp}, {world = clench.world()}).values.epsilon[1], grasp:quality "epsilon")
  t.close(clench.study.compare(read, {world = grasp.hand.world}).values.epsilon[1], grasp:quality "epsilon", 1e-9)
  t.fails(function() clench.study.compare(read) end, "study.compare: grasps[1]: the grasp belongs to no world")
  t.fails(function() clench.study.compare({grasp, nil, grasp}, {world = grasp.hand.world}) end, "a list without holes or names")
end)
