-- Objects on supports: their supports, displacements and yielding, and verdicts with and without a table.
local test, clench = require "test", require "clench"
local closing = require "clench.plan.closing"
local supports = require "clench.plan.supports"
local verification = require "clench.plan.verification"

local threshold = 1e-4
local free_height = 5  -- far from the table [m]

local function path_of(hand) return ("models/hands/%s/%s.cfg"):format(hand, hand) end

-- A hand far away, and an object whose lowest point is `gap` [m] above a table at z = 0.
local function stand(hand_name, object, gap, options)
  local world = clench.world()
  local hand = world:add_robot(path_of(hand_name), {pose = {xyz = {0, 0, 3}}})
  local body = world:add_object(object, options)
  body.pose = {xyz = {0, 0, gap - body.mesh.bounds.low.z}}
  local board = world:add_obstacle(clench.shapes.box {2, 2, 0.1}, {name = "board", pose = {xyz = {0, 0, -0.05}}})
  return hand, body, board
end

local function check_vector(t, v, x, y, z) t.ok((v - clench.vec3(x, y, z)):norm() < 1e-6, tostring(v)) end

test("a support is touched by an object, or overlaps it by no more than the contact threshold", function(t)
  for _, gap in ipairs {5e-5, 1e-9, 0, -1e-17, -3e-5, -0.99 * threshold} do
    local hand, box, board = stand("parallel_jaw", clench.shapes.box {0.04, 0.04, 0.08}, gap)
    local before = hand.world:hash()
    local on = supports.of(hand, box)
    t.equal(hand.world:hash(), before)
    t.equal({#on.touched, #on.overlapped, on.touched[1] == board}, {1, 0, true})
    for _, normal in ipairs(on.normals) do check_vector(t, normal, 0, 0, 1) end
    t.equal({on:permit(clench.vec3(0, 0, 1)), on:permit(clench.vec3(1, 0, 0)), on:permit(clench.vec3(0, 0, -1))}, {true, true, false})
    t.equal(on:entered_by(box), false)
  end
  local hand, box = stand("parallel_jaw", clench.shapes.box {0.04, 0.04, 0.08}, 1.5 * threshold)
  t.equal(#supports.of(hand, box).touched, 0)
  hand, box = stand("parallel_jaw", clench.shapes.box {0.04, 0.04, 0.08}, -1.5 * threshold)
  local on = supports.of(hand, box)
  t.equal({#on.touched, #on.overlapped, #on.normals}, {0, 1, 0})
end)

test("a yielding object slides along supports, stops in a corner, and may come down again when lifted", function(t)
  local hand, box = stand("parallel_jaw", clench.shapes.box {0.04, 0.04, 0.08}, 2e-5)
  local still = clench.vec3(0, 0, 0)
  local on = supports.of(hand, box)
  check_vector(t, on:slide(still, clench.vec3(0.003, 0, -0.004)), 0.003, 0, 0)
  check_vector(t, on:slide(still, clench.vec3(0, 0, -0.004)), 0, 0, 0)
  check_vector(t, on:slide(still, clench.vec3(0.001, 0, 0.002)), 0.001, 0, 0.002)
  check_vector(t, on:slide(clench.vec3(0, 0, 0.001), clench.vec3(0.002, 0, -0.004)), 0.002, 0, -0.001)
  hand.world:add_obstacle(clench.shapes.box {0.1, 1, 1}, {name = "wall", pose = {xyz = {0.07 + 2e-5, 0, 0.5}}})
  on = supports.of(hand, box)
  check_vector(t, on:slide(still, clench.vec3(0.003, 0.001, -0.004)), 0, 0.001, 0)
  t.equal({on:permit(clench.vec3(1, 0, 0)), on:permit(clench.vec3(0, 1, 0))}, {false, true})
end)

-- Grasps of an object in free space from above and from the side; the hand stays more than 1 cm above the object's lowest point.
local function grasps_in_air(hand_name, object, options)
  local world = clench.world()
  local hand = world:add_robot(path_of(hand_name))
  local body = world:add_object(object, options)
  body.pose = {xyz = {0, 0, free_height}}
  local run = clench.plan.sample {hand = hand, object = body, candidates = 160, count = 100, refine = 0, verify = false, distance = 0}
  local low, list = body.bounds_in_world.low.z, {}
  local function is_clear()
    for _, part in ipairs(hand.bodies) do
      local bounds = part.bounds_in_world
      if bounds and bounds.low.z < low + 0.01 then return false end
    end
    return true
  end
  for _, grasp in ipairs(run.grasps) do
    grasp:apply(world)
    local closed = is_clear()
    hand:set_dofs(grasp.pregrasp.dofs)
    if closed and is_clear() and hand.approach.direction.z < 0.1 then list[#list + 1] = grasp end
  end
  return hand, body, list
end

local function check_all(hand, object, grasps)
  local rows = {}
  for i, grasp in ipairs(grasps) do
    local placed = grasp:apply(hand.world, {hand = hand, object = object})
    placed:quality "epsilon"
    placed.collision_free, placed.pregrasp = not hand.world:collides(hand), grasp.pregrasp
    local options = {shake = false}  -- shaking leaves out the table in any case
    for key, value in pairs(verification.defaults) do options[key] = value end
    local numbers, why = verification.check(hand, object, placed, options)
    rows[i] = {why = why, load = numbers and numbers.load_margin, perturbed = numbers and numbers.perturbed_epsilon}
  end
  return rows
end

test("a grasp that does not touch the table gets the same verdicts there as in free space", function(t)
  for _, case in ipairs {{"parallel_jaw", clench.shapes.box {0.03, 0.05, 0.12}}, {"parallel_jaw", clench.shapes.cylinder {0.02, 0.14}},
                         {"adaptive_gripper", clench.shapes.box {0.03, 0.05, 0.12}}, {"barrett", clench.shapes.cylinder {0.03, 0.2}}} do
    local options = {mass = 0.1, material = "wood", name = "thing"}
    local hand, object, grasps = grasps_in_air(case[1], case[2], options)
    t.ok(#grasps >= 5, case[1] .. " " .. #grasps)
    local in_air, held = check_all(hand, object, grasps), 0
    for _, gap in ipairs {3e-5, 0} do
      hand, object = stand(case[1], case[2], gap, options)
      local on_table = check_all(hand, object, grasps)
      for i, row in ipairs(in_air) do
        t.equal({case[1], i, on_table[i].why}, {case[1], i, row.why})
        if row.load then
          held = held + 1
          t.close(on_table[i].load, row.load, 1e-3 * row.load)
          t.close(on_table[i].perturbed, row.perturbed, 1e-3 * row.perturbed + 1e-6)
        end
      end
    end
    t.ok(held >= 4, case[1] .. " " .. held)
  end
end)

test("jaws hold objects on a table, and searches do not warn of objects exactly on it", function(t)
  local said = {}
  clench.log.sink(function(_, text) said[#said + 1] = text end)
  local counts = {}
  for _, name in ipairs {"parallel_jaw", "adaptive_gripper"} do
    for gap_name, gap in pairs {exact = 0, resting = 2e-5} do
      local hand, box = stand(name, clench.shapes.box {0.03, 0.06, 0.12}, gap, {mass = 0.2, material = "wood"})
      -- shaking leaves out the table and takes longest: once is enough
      local verify = not (gap_name == "resting" and name == "parallel_jaw") and {shake = false} or nil
      counts[name .. " " .. gap_name] = #clench.plan.sample({hand = hand, object = box, candidates = 64, refine = 1, verify = verify}).grasps
    end
  end
  clench.log.sink()
  for case, count in pairs(counts) do t.ok(count >= 5, case .. " " .. count) end
  t.equal(said, {})
end)

test("an object exactly on a table is moved and lifted", function(t)
  for _, gap in ipairs {0, -5e-5} do
    local hand, box = stand("parallel_jaw", clench.shapes.box {0.03, 0.05, 0.12}, gap, {mass = 0.1, material = "wood"})
    local X_WO = box.pose
    t.equal(box:move_to(clench.pose {xyz = {0.2, 0, 0}} * X_WO).fraction, 1)
    box.pose = X_WO
    local run = clench.plan.sample {hand = hand, object = box, candidates = 32, count = 1, refine = 0, verify = {shake = false}}
    run.grasps[1]:apply(hand.world)
    t.ok(verification.can_be_lifted(hand, box, 0.1))
    t.ok(clench.study.lift({hand = hand, object = box, height = 0.05, hold = 0.1, settle = 0.2}).survived)
  end
end)

test("a shelf above the hand obstructs the lift", function(t)
  local hand, box = stand("parallel_jaw", clench.shapes.box {0.03, 0.05, 0.12}, 2e-5, {mass = 0.1, material = "wood"})
  local run = clench.plan.sample {hand = hand, object = box, candidates = 64, count = 3, refine = 0, verify = {shake = false}}
  local grasp = run.grasps[1]
  local function why_with(obstacle)
    local world = hand.world:clone()
    local other_hand, other_box = world:robot(hand.name), world:body(box.name)
    if obstacle then world:add_obstacle(obstacle[1], {name = "block", pose = obstacle[2]}) end
    return check_all(other_hand, other_box, {grasp})[1].why
  end
  t.equal(why_with(nil), nil)
  grasp:apply(hand.world)
  local top = hand.base.bounds_in_world.high.z
  for _, part in ipairs(hand.bodies) do top = math.max(top, part.bounds_in_world.high.z) end
  t.equal(why_with {clench.shapes.box {1, 1, 0.02}, {xyz = {0, 0, top + 0.05}}}, "in collision when lifted")
end)

test("a table obstructs hands that approach a flat object from the side, and no others", function(t)
  local options = {mass = 0.1, material = "wood", name = "thing"}
  local plate = clench.shapes.box {0.06, 0.12, 0.012}
  local world = clench.world()
  local hand = world:add_robot(path_of "parallel_jaw")
  local body = world:add_object(plate, options)
  body.pose = {xyz = {0, 0, free_height}}
  local run = clench.plan.sample {hand = hand, object = body, candidates = 96, count = 100, refine = 0, verify = false, distance = 0}
  local low, from_side = body.bounds_in_world.low.z, {}
  for _, grasp in ipairs(run.grasps) do
    grasp:apply(world)
    local lowest = math.huge
    for _, part in ipairs(hand.bodies) do
      local bounds = part.bounds_in_world
      if bounds then lowest = math.min(lowest, bounds.low.z) end
    end
    if #from_side < 4 and math.abs(hand.approach.direction.z) < 0.3 and lowest < low - 0.01 then from_side[#from_side + 1] = grasp end
  end
  t.ok(#from_side >= 3, #from_side)
  local on_table_hand, on_table = stand("parallel_jaw", plate, 2e-5, options)
  local in_air, there, held = check_all(hand, body, from_side), check_all(on_table_hand, on_table, from_side), 0
  for i, row in ipairs(there) do
    t.equal({i, row.why}, {i, "in collision when closed"})
    if not in_air[i].why then held = held + 1 end
    local grasp = from_side[i]
    local state = {pose = grasp.pregrasp.pose, dofs = grasp.pregrasp.dofs}
    local closed, why = closing.close(on_table_hand, on_table, state, {approach = 0.3})
    t.ok(not (closed and closed.collision_free and (closed.pose.position - grasp.pose.position):norm() < 1e-4), why)
  end
  t.ok(held >= 1, held)
end)
