local test = require "test"
local clench = require "clench"

-- a shipped hand, closed, and its grasp in a list
local function closed()
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  hand:autograsp()
  local grasp = clench.grasp(hand, flask)
  grasp:quality "epsilon"
  grasp.info, grasp.labels = {seed = 7, energy = -0.5}, {planner = "007"}
  local list = clench.grasps()
  list:add(grasp)
  return world, grasp, list
end

test("a table of grasps keeps the types of its columns", function(t)
  local _, grasp, list = closed()
  local file = test.path ".csv"
  list:save(file)
  local row = clench.csv.read(file)[1]
  t.equal(row.seed, 7)
  t.equal(math.type(row.seed), "integer")
  t.equal(row.planner, "007")
  t.equal(row.epsilon, grasp.epsilon)
  t.equal(row.energy, -0.5)
  t.equal(row["x [m]"], grasp.pose.position.x)
  t.equal(clench.grasps(file)[1].labels.planner, "007")
end)

test("a grasp of every format with DOFs can be applied to a world where the object has another name", function(t)
  local _, grasp, list = closed()
  for _, one in ipairs {{".csv"}, {".npz"}, {".yaml"}, {".json", "multigripper"}} do
    local file = test.path(one[1])
    list:save(file, {format = one[2]})
    local other = clench.load("worlds/dlr_flask.wld", {root = "."})
    local hand, flask = other.robots[1], other.objects[1]
    flask.name = "an object"
    local back = clench.grasps(file)[1]
    t.fails(function() back:apply(other) end, "there is no such object in this world")
    local again = back:apply(other, {hand = hand, object = flask})
    t.equal(#again.contacts, #grasp.contacts)
    t.close(again:quality "epsilon", grasp.epsilon, 1e-6)
  end
end)

test("DOFs are found by their names, and an unknown name is rejected", function(t)
  local world, _, list = closed()
  local file = test.path ".yaml"
  list:save(file)
  local text = clench.files.read_text(file)
  local name = text:match "cspace_position:\n%s+\"([^\"]+)\""
  clench.files.save_text(file, (text:gsub('"' .. name .. '"', '"nothing"')))
  t.fails(function() clench.grasps(file)[1]:apply(world) end, "the hand has no DOF 'nothing'")
end)

test("a grasp without a hand needs one, which must be in the given world", function(t)
  local world, _, list = closed()
  local file = test.path ".json"
  list:save(file, {format = "graspgen"})
  local back = clench.grasps(file)[1]
  t.fails(function() back:apply(world, {object = world.objects[1]}) end, "it does not name its hand; give one")
  t.fails(function() back:apply(world, {hand = world:clone().robots[1]}) end, "hand: expected one of that world, got one of another")
  t.fails(function() back:apply(world, {hands = 1}) end, "unknown key 'hands'")
  local before = world.robots[1].dofs
  back:apply(world, {hand = world.robots[1], object = world.objects[1]})
  t.equal(world.robots[1].dofs[1], before[1])
end)

test("numpy reads the written files, if it is installed", function(t)
  local _, grasp, list = closed()
  local file = test.path ".npz"
  list:save(file)
  local pipe = io.popen("python3 -c 'import numpy,sys; a=numpy.load(sys.argv[1]); print(a[\"poses\"].shape[1], a[\"dofs\"].shape[1], repr(float(a[\"epsilon\"][0])), a[\"hands\"][0])' "
    .. file .. " 2>/dev/null")
  local said = pipe:read "a"
  pipe:close()
  if said ~= "" then t.equal(said, ("7 %d %.17g %s\n"):format(#grasp.dofs, grasp.epsilon, grasp.hand_name)) end
  t.equal(clench.grasps(file)[1].hand_name, grasp.hand_name)
end)

test("edited DOFs that contradict unedited joints are rejected", function(t)
  local world, _, list = closed()
  local file = test.path ".jsonl"
  list:save(file)
  local text = clench.files.read_text(file)
  local function with(edit)
    clench.files.save_text(file, (edit(text)))
    return clench.grasps(file)[1]
  end
  local hand = world.robots[1]
  local before = hand.dofs
  local edited = with(function(s) return s:gsub('"dofs":%[[^,]*,', '"dofs":[0.123,') end)
  t.fails(function() edited:apply(world) end, "but its DOF puts it at 0.123; omit 'joints' to use the DOFs alone")
  t.equal(hand.dofs, before)
  local alone = with(function(s) return s:gsub('"dofs":%[[^,]*,', '"dofs":[0.123,'):gsub('"joints":%[[^%]]*%],?', "") end)
  alone:apply(world)
  t.equal(hand.dofs[1], 0.123)
  local meters = with(function(s) return s:gsub('"dof_units":%["rad"', '"dof_units":["m"') end)
  t.fails(function() meters:apply(world) end, "expected a value in rad, got one in m")
end)

test("joints have the same names in a grasp, in its lists and in its scene, including followers", function(t)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  local hand, mug = world.robots[1], world.objects[1]
  hand:autograsp()
  local grasp = clench.grasp(hand, mug)
  t.equal(grasp.joint_names, {"dof1", "dof2", "chain0_joint2", "chain1_joint0", "dof3", "chain1_joint2", "dof4", "chain2_joint1"})
  t.equal(grasp.joint_values, grasp.joint_positions)
  t.equal(grasp.hand_file, hand.source)
  t.equal(grasp.object_file, mug.source)
  local list, path = clench.grasps(), test.path()
  list:add(grasp)
  for _, ending in ipairs {".jsonl", ".csv", ".npz"} do
    list:save(path .. ending)
    local again = clench.grasps(path .. ending)[1]
    t.equal(again.joint_names, grasp.joint_names)
    t.equal(again.joint_positions, grasp.joint_positions)
    t.equal(#again.points, #grasp.points)
    t.equal(again.hand_file, grasp.hand_file)
    t.equal(#again:apply(world).contacts, #grasp.contacts)
  end
  -- isaac_grasp lists followers after the DOFs
  list:save(path .. ".yaml")
  local isaac = clench.grasps(path .. ".yaml")[1]
  t.equal(isaac.dof_names, {"dof1", "dof2", "dof3", "dof4", "chain0_joint2", "chain1_joint0", "chain1_joint2", "chain2_joint1"})
  t.equal(#isaac:apply(world).contacts, #grasp.contacts)
  grasp:save(path .. ".xml")
  local scene = assert(io.open(path .. ".xml")):read "a"
  for _, name in ipairs(grasp.joint_names) do t.ok(scene:find(('<joint name="%s" type="hinge"'):format(name), 1, true), name) end
  for _, name in ipairs(grasp.dof_names) do t.ok(scene:find(('<general name="%s" joint="%s"'):format(name, name), 1, true), name) end
end)
