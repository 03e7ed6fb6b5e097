-- Reports of a search: its assumptions, its diagnosis, its progress, and the approach directions of its grasps.
local test, clench = require "test", require "clench"
local assumptions = require "clench.plan.assumptions"
local batch = require "clench.plan.batch"
local diagnosis = require "clench.plan.diagnosis"
local spread = require "clench.plan.spread"

local function scene(mu, mass, hand_file)
  local world = clench.world()
  local hand = world:add_robot(hand_file or "models/hands/parallel_jaw/parallel_jaw.cfg")
  local box = world:add_object(clench.shapes.box {0.03, 0.05, 0.12}, {name = "box", pose = {xyz = {0, 0, 1}}, mass = mass or 0.1, material = "wood"})
  for _, body in ipairs(hand.bodies) do world:set_friction(body.material, "wood", {static = mu, kinetic = mu}) end
  return hand, box
end

-- Without shaking, which takes longest and does not affect the checks here.
local function sample(hand, box, more)
  local options = {hand = hand, object = box, candidates = 64, refine = 0, seed = 2, grasp = {soft = false}, verify = {shake = false}}
  for key, value in pairs(more or {}) do options[key] = value end
  return clench.plan.sample(options)
end

test("a search that lacks friction reports that, and how many grasps would hold with more", function(t)
  local run = sample(scene(0.08))
  t.equal(#run.grasps, 0)
  local words = tostring(run.report)
  local looked_at, held, friction = words:match "why: of (%d+) closed candidates that hold too little, .-(%d+) with a friction of ([%d.]+) instead of 0.08 %(%-%-friction%)"
  t.ok(held, words)
  t.ok(tonumber(held) >= 1 and tonumber(held) <= tonumber(looked_at), words)
  -- the diagnosis is right
  t.ok(#sample(scene(tonumber(friction))).grasps > 0)
end)

test("a search that lacks normal force names the force ratio", function(t)
  local hand, box = scene(0.6)
  local run = sample(hand, box, {verify = {force_ratio = 3, lift = 0, shake = false}})
  t.equal(#run.grasps, 0)
  local words = tostring(run.report)
  t.ok(words:find("normal forces of %d+ instead of 3 weights %(%-%-force%-ratio%)"), words)
  t.ok(words:find("sum of normal forces at most 3 times the weight", 1, true), words)
end)

test("a search with grasps has no diagnosis", function(t)
  local run = sample(scene(0.6))
  t.ok(#run.grasps > 0)
  t.equal(#run.report.causes, 0)
end)

test("a diagnosis names the smallest change that is enough", function(t)
  local assumed = {friction = 0.4, force_ratio = 10}
  local function text(counts) return diagnosis.text(counts, assumed) end
  t.equal(text {looked_at = 0, friction = {0, 0}, force_ratio = {0, 0}, effort = {0}}, nil)
  t.equal(text {looked_at = 20, friction = {3, 9}, force_ratio = {0, 2}, effort = {0}},
          "of 20 closed candidates that hold too little, 3 with a friction of 0.8 instead of 0.4 (--friction), " ..
          "2 with normal forces of 40 instead of 10 weights (--force-ratio) would hold")
  t.ok(text({looked_at = 5, friction = {0, 0}, force_ratio = {0, 0}, effort = {0}}):find "none would hold with 4 times the friction")
end)

test("assumptions name values and sources", function(t)
  local hand, box = scene(0.4)
  local verify = {force_ratio = 10}
  local of = assumptions.of(hand, box, verify, {})
  t.close(of.friction, 0.4, 1e-12)
  t.close(of.mass, 0.1, 1e-12)
  t.ok(of.lines[1]:find("^friction 0.4 of %w+ on wood"), of.lines[1])
  t.ok(of.lines[1]:find("of the object: set by the script)", 1, true), of.lines[1])
  t.equal(of.lines[2], "mass 0.1 kg (set by the script)")
  t.equal(of.lines[3], "sum of normal forces at most 10 times the weight (by default)")
  t.ok(of.lines[4]:find("^efforts of closing motors at most 140 N or N m %(from its file%)"), of.lines[4])
  of = assumptions.of(hand, box, verify, {friction = "0.4", mass = "0.1", ["force-ratio"] = "10"})
  t.equal(of.lines[1], "friction 0.4 between hand and object (--friction)")
  t.equal(of.lines[2], "mass 0.1 kg (--mass)")
  t.ok(of.lines[3]:find("(--force-ratio)", 1, true))
  hand.world:add_obstacle(clench.shapes.box {1, 1, 0.1}, {name = "wooden board", material = "wood"})
  t.equal(assumptions.of(hand, box, verify, {friction = "0.4"}).lines[1], "friction 0.4 between hand and object (--friction)")
  hand.world:add_obstacle(clench.shapes.box {1, 1, 0.1}, {name = "mat", material = hand.links[1].material})
  t.equal(assumptions.of(hand, box, verify, {friction = "0.4"}).lines[1],
          "friction 0.4 between hand and object (--friction), and of mat on the object: of a material of the hand")
  local path = test.path ".obj"
  box.mesh:save(path)
  local world = clench.world()
  local from_file = world:add_object(path, {unit = "m"})
  of = assumptions.of(world:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg", from_file, verify, {})
  t.ok(of.lines[1]:find("of the object: assumed, as", 1, true), of.lines[1])
  t.ok(of.lines[2]:find("assumed, as .-%.obj states none"), of.lines[2])
  from_file.material = "wood"
  t.ok(assumptions.of(hand, from_file, verify, {}).lines[1]:find("of the object: set by the script)", 1, true))
  -- colors and textures do not count as a source of friction
  local looks = test.path(".iv", "#Inventor V2.0 ascii\nSeparator { Material { diffuseColor 1 0 0 } Cube { width 40 height 40 depth 40 } }\n")
  local red = world:add_object(looks, {name = "red"})
  t.equal({red.material_from, red.mass_from}, {"assumed", "assumed"})
  red.mass = 0.2
  t.equal(red.mass_from, "script")
  t.equal(world:add_object("models/objects/flask.iv", {name = "flask"}).material_from, "file")
end)

test("progress shows candidates, grasps, the main causes and a hint", function(t)
  t.equal(batch.text {candidates = 64, grasps = 2, rejected = {a = 3, b = 9, c = 9, ["no time left"] = 50}}, "64 candidates, 2 grasps; b 9, c 9")
  t.equal(batch.text {candidates = 2, grasps = 0, rejected = {}, hint = "more"}, "2 candidates, 0 grasps; more")
  local states = {}
  local hand, box = scene(0.6)
  local run = sample(hand, box, {on_progress = function(state) states[#states + 1] = {state.candidates, state.grasps} end})
  t.equal(states[#states][1], 64)
  t.ok(states[#states][2] >= #run.grasps)
  for i = 2, #states do t.ok(states[i][1] >= states[i - 1][1] and states[i][2] >= states[i - 1][2]) end
end)

test("keep_searching continues beyond count, and returns count grasps", function(t)
  local hand, box = scene(0.6)
  local first = sample(hand, box, {candidates = 128, count = 3})
  t.equal(first.report.candidates, 64)
  local all = sample(hand, box, {candidates = 128, count = 3, keep_searching = true})
  t.equal(all.report.candidates, 128)
  t.equal(#all.grasps, 3)
  t.ok(all.grasps[1].epsilon >= first.grasps[1].epsilon)
end)

test("if there are too many grasps, those from different sides are kept first", function(t)
  local world = clench.world()
  local hand = world:add_robot "models/hands/barrett/barrett.cfg"
  local ball = world:add_object(clench.shapes.sphere {0.035}, {name = "ball", mass = 0.1, pose = {xyz = {0, 0, 1}}})
  local run = clench.plan.sample {hand = hand, object = ball, candidates = 512, count = 400, refine = 0, verify = false}
  local all, in_base = {}, hand.pose:inverse():rotate(hand.approach.direction)
  for i, grasp in ipairs(run.grasps) do all[i] = grasp end
  local function sides(list)
    local kinds = {}
    for _, grasp in ipairs(list) do
      local direction, is_new = grasp.pose:rotate(in_base), true
      for _, other in ipairs(kinds) do is_new = is_new and direction:dot(other) < math.cos(math.rad(30)) end
      if is_new then kinds[#kinds + 1] = direction end
    end
    return #kinds
  end
  t.ok(#all > 20, #all)
  local chosen = spread(hand, all, 8)
  t.equal(#chosen, 8)
  t.equal(sides(chosen), math.min(8, sides(all)))
  t.equal(chosen[1], all[1])
  for i = 2, 8 do t.ok(chosen[i - 1].epsilon >= chosen[i].epsilon) end
  t.equal(#spread(hand, all, #all + 1), #all)
end)

test("causes name what is wrong with the world or with the limits of the search, and the remedy helps", function(t)
  local function has(run, words)
    for _, cause in ipairs(run.report.causes) do
      if cause:find(words, 1, true) then return true end
    end
    return false
  end
  local hand, box = scene(0.6)
  hand.world:set_collision(false, hand, box)
  local run = sample(hand, box)
  t.equal(#run.grasps, 0)
  t.ok(run.report.causes[1]:find("the collisions of parallel_jaw and box are switched off", 1, true), run.report.causes[1])
  hand.world:set_collision(true, hand, box)
  t.ok(#sample(hand, box).grasps > 0)
  t.ok(has(sample(scene(0)), "the friction between parallel_jaw and box is 0"))
  t.ok(not has(sample(scene(0.08)), "is 0:"))
  local short = sample(scene(0.08))
  t.ok(not has(short, "candidates were tried: use more"))
  local hand, box = scene(0.08)
  t.ok(has(sample(hand, box, {candidates = 3}), "only 3 candidates were tried: use more candidates"))
  -- a box between walls
  hand, box = scene(0.6)
  for i, at in ipairs {{0.04, 0, 1}, {-0.04, 0, 1}, {0, 0.05, 1}, {0, -0.05, 1}, {0, 0, 1.09}, {0, 0, 0.91}} do
    hand.world:add_obstacle(clench.shapes.box {i < 3 and 0.02 or 0.3, i > 2 and i < 5 and 0.02 or 0.3, i > 4 and 0.02 or 0.3}, {name = "wall" .. i, pose = {xyz = at}})
  end
  local run = sample(hand, box)
  t.equal(#run.grasps, 0)
  t.ok(has(run, "the hand finds too little space around box: wall1"), tostring(run.report))
end)

test("a search that is too short says so, instead of a limit of reach", function(t)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  local run = clench.plan.anneal {hand = world.robots[1], object = world.objects[1], steps = 5, seed = 1}
  t.equal(#run.grasps, 0)
  t.equal(run.report.causes, {"the search made only 5 steps: use more steps"})
  local circumstances = require "clench.plan.circumstances"
  t.equal(circumstances.too_short {out_of_time = true, seconds = 0.5, candidates = 36}, "the time was over after 0.5 s, before all 36 candidates were tried: allow more seconds")
  t.equal(circumstances.too_short {candidates = 1}, "only 1 candidate was tried: use more candidates")
  t.equal(circumstances.too_short {steps = 500}, nil)
end)

test("the primitive planner plans for a hand on an arm, and a search that moves the arm instead names the hand", function(t)
  local world = clench.load("worlds/puma_barrett_glass.wld", {root = "."})
  local glass, hand = world.objects[1], nil
  for _, robot in ipairs(world.robots) do hand = robot.parent and robot or hand end
  local before = world:hash()
  local run = clench.plan.primitive {hand = hand, object = glass, density = 1}
  t.ok(run.report.found > 0, tostring(run.report))
  t.equal(world:hash(), before)
  local far = glass.pose.position + clench.vec3(5, 0, 0.3)
  glass.pose = {xyz = {far.x, far.y, far.z}}
  local wrong = clench.plan.sample {hand = hand.parent, object = glass, candidates = 2, seed = 1, refine = 0}
  t.equal(#wrong.grasps, 0)
  t.ok(wrong.report.causes[1]:find("the search moves puma560, which carries barrett: choose barrett as the hand", 1, true) or wrong.report.causes[2]:find("choose barrett as the hand", 1, true), tostring(wrong.report))
end)
