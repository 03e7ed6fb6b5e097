local test = require "test"
local clench = require "clench"

-- two fingers of two joints; the last joint of the second follows that of the first
local function twin(mimic)
  local parts = {'<robot name="twin"><link name="palm"/>'}
  local function joint(name, parent, child, more)
    parts[#parts + 1] = ([[<link name="%s"/><joint name="%s" type="revolute"><parent link="%s"/><child link="%s"/>
      <axis xyz="0 1 0"/><limit lower="-0.5" upper="1.57" effort="1" velocity="1"/>%s</joint>]]):format(child, name, parent, child, more or "")
  end
  joint("a1", "palm", "la1")
  joint("a2", "la1", "la2")
  joint("b1", "palm", "lb1")
  joint("b2", "lb1", "lb2", mimic and '<mimic joint="a2"/>')
  parts[#parts + 1] = "</robot>"
  local world = clench.world()
  local hand = world:add_robot(test.path(".urdf", table.concat(parts)))
  world:add_object(clench.shapes.box {0.05, 0.05, 0.05}, {name = "cube", mass = 0.1})
  return world, hand
end

local function multigripper(dofs, names)
  return test.path(".json", ('{"gripper": "twin", "object_id": "cube", "pose": [[0, 0, 0.2, 1, 0, 0, 0]], "dofs": [[%s]]%s}'):format(dofs,
    names and ', "dof_names": ' .. names or ""))
end

-- warnings logged while a function runs
local function warned(run)
  local said = {}
  clench.log.sink(function(level, text) if level == "warning" then said[#said + 1] = text end end)
  local ok, message = pcall(run)
  clench.log.sink()
  if not ok then error(message, 0) end
  return said
end

test("DOFs without names cause a warning, and dof_order gives their order", function(t)
  local world, hand = twin()
  local file = multigripper "0.11, 0.21, 0.12, 0.22"
  local grasp = clench.grasps(file)[1]
  local said = warned(function() grasp:apply(world) end)
  t.equal(#said, 1)
  t.ok(said[1]:find("it does not name its DOFs", 1, true) and said[1]:find('dof_order = "isaac"', 1, true), said[1])
  for _, one in ipairs {{"isaac", {0.11, 0.12, 0.21, 0.22}}, {"hand", {0.11, 0.21, 0.12, 0.22}}, {{"b2", "b1", "a2", "a1"}, {0.22, 0.12, 0.21, 0.11}}} do
    t.equal(#warned(function() grasp:apply(world, {dof_order = one[1]}) end), 0)
    t.equal(hand.dofs, one[2])
    local named = clench.grasps(file, {dof_order = one[1], hand = hand})[1]
    t.equal(#warned(function() named:apply(world) end), 0)
    t.equal(hand.dofs, one[2])
  end
  t.fails(function() grasp:apply(world, {dof_order = "breadth"}) end, "unknown dof_order 'breadth'")
  t.fails(function() grasp:apply(world, {dof_order = {"a1"}}) end, "dof_order: expected as many names as there are DOFs, 4, got 1")
  t.fails(function() grasp:apply(world, {dof_order = {"a1", "a1"}}) end, "dof_order: 'a1' appears twice")
  t.fails(function() clench.grasps(file, {dof_order = "isaac"}) end, "dof_order: expected the option 'hand' with it, or a list of names, got neither")
  local with_names = multigripper("1, 0, 0, 0", '["a1", "a2", "b1", "b2"]')
  said = warned(function() clench.grasps(with_names, {dof_order = "isaac", hand = hand}) end)
  t.ok(said[1] and said[1]:find("it names its DOFs, so dof_order is not used", 1, true), said[1])
end)

test("values of followers may be listed, and those that do not follow cause a warning", function(t)
  local world, hand = twin(true)
  local grasp = clench.grasps(multigripper("0.1, 0.3, 0.2, 0.2", '["a1", "b1", "a2", "b2"]'))[1]
  t.equal(#warned(function() grasp:apply(world) end), 0)
  t.equal(hand.dofs, {0.1, 0.2, 0.3})
  grasp = clench.grasps(multigripper("0.1, 0.3, 0.2, 0.4", '["a1", "b1", "a2", "b2"]'))[1]
  local said = warned(function() grasp:apply(world) end)
  t.ok(said[1]:find("joint 'b2' moves with DOF 'a2', which puts it at 0.2, not at 0.4", 1, true), said[1])
  -- as many values as joints
  grasp = clench.grasps(multigripper "0.1, 0.3, 0.2, 0.2")[1]
  grasp:apply(world, {dof_order = "isaac"})
  t.equal(hand.dofs, {0.1, 0.2, 0.3})
end)

test("a pregrasp and a list of states find DOFs by their names", function(t)
  local world, hand = twin()
  local file = test.path(".yaml", [[
format: isaac_grasp
format_version: "1.0"
object_frame_link: /World/cube
gripper_frame_link: /World/twin
object_scale: 2.0
open_limit: lower
grasps:
  grasp_0:
    confidence: 1.0
    position: [0, 0, 0.2]
    orientation: {w: 1.0, xyz: [0, 0, 0]}
    bite_point: [0, 0, 0]
    cspace_position: {b1: 0.3, a1: 0.1, b2: 0.4}
    pregrasp_cspace_position: {a1: 0.05, b1: 0.15, b2: 0, a2: 1}
]])
  local list, format
  local said = table.concat(warned(function() list, format = clench.grasps(file) end), "\n")
  t.equal(format, "isaac_grasp")
  t.ok(said:find("open_limit is not used", 1, true), said)
  t.ok(said:find("grasps.grasp_0: bite_point is not used", 1, true), said)
  t.ok(said:find("the object has to be loaded at scale 2", 1, true), said)
  t.ok(said:find("pregrasp_cspace_position: a2 is not used, as cspace_position does not list it", 1, true), said)
  local applied = list[1]:apply(world)
  t.equal(hand.dofs, {0.1, 0, 0.3, 0.4})
  t.equal(applied.pregrasp.dofs, {0.05, 0, 0.15, 0})
  local dofs, before = list[1]:dofs_for(hand)
  t.equal(dofs, {0.1, 0, 0.3, 0.4})
  t.equal(before, {0.05, 0, 0.15, 0})
end)

test("check summarizes lists in every format, and convert writes them in others", function(t)
  local world, hand = twin()
  hand:set_dofs {0.1, 0.2, 0.3, 0.4}
  local list = clench.grasps()
  for i = 1, 3 do
    local grasp = clench.grasp(hand, world.objects[1])
    grasp:quality "epsilon"
    grasp.info, grasp.labels = {seed = i}, {planner = "mine"}
    list:add(grasp)
  end
  local from = test.path ".jsonl"
  list:save(from)
  local report = require "clench.report"
  for _, one in ipairs {{".csv"}, {".npz"}, {".yaml"}, {".json", "graspgen"}, {".json", "multigripper"}, {".txt", "graspit"}, {".jsonl"}} do
    local to = test.path(one[1])
    t.equal(clench.convert(from, to, {format = one[2]}), "grasps")
    local seen = report.of(to)
    t.equal(seen.error, nil)
    t.equal(seen.parsed.count, 3)
    if one[2] ~= "graspit" then
      t.equal(seen.kind, "grasps")
      t.equal(seen.parsed.format, one[2] or ({[".csv"] = "csv", [".npz"] = "npz", [".yaml"] = "isaac_grasp", [".jsonl"] = "jsonl"})[one[1]])
    end
    if one[2] == nil then
      t.equal(seen.parsed.of, {"twin on cube"})
      t.equal(seen.parsed.dofs[2], {name = "a2", low = 0.2, high = 0.2, count = 3})
    end
    -- and back
    t.equal(#clench.grasps((clench.convert(to, test.path ".jsonl") and to)), 3)
  end
  local seen = report.of(from)
  t.equal(seen.parsed.notes.seed, {low = 1, high = 3, count = 3})
  t.equal(seen.parsed.labels, {"planner"})
  t.fails(function() clench.convert(from, test.path ".stl") end, "expected a name that ends in .jsonl, .csv, .npz, .yaml or .json, or a format")
  t.fails(function() clench.convert("models/objects/flask.iv", test.path ".csv") end, "expected a body to .xml")
  t.fails(function() clench.convert(from, test.path ".json") end, ".json may be several formats")
  local unnamed = multigripper "0.1, 0.2, 0.3, 0.4"
  t.fails(function() clench.convert(unnamed, test.path ".yaml") end, "expected DOFs with names, which the format isaac_grasp needs")
  local named = test.path ".yaml"
  clench.convert(unnamed, named, {dof_order = {"a1", "b1", "a2", "b2"}})
  t.equal(clench.grasps(named)[1].dof_names, {"a1", "b1", "a2", "b2"})
  t.fails(function() clench.convert(unnamed, test.path ".yaml", {dof_order = {"a1"}}) end, "expected as many names as there are DOFs, 4, got 1")
end)
