local test, clench = require "test", require "clench"

local folder = test.folder()

local function read(path)
  local file = assert(io.open(path, "rb"))
  local text = file:read "a"
  file:close()
  return text
end

local function write(name, text)
  local path = folder .. "/" .. name
  clench.files.save_text(path, text)
  return path
end

-- a world in which everything that can be set is set
local function rich_world()
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  local claw = world:add_robot("tests/data/two_finger/claw.cfg", {name = "the claw", pose = {xyz = {0.5, 0, 0.1}, rpy = {0.1, 0.2, 0.3}}})
  claw:set_dofs({claw.dof_limits[1][2] / 2, 0}, {joint_positions = {{1, 1, 0.001}}})
  world:set_friction("cork", "wood", {static = 0.9, kinetic = 0.1})
  world:set_friction("felt", "cork", {static = 0.7})
  world:set_friction("glass", "metal", {static = 0.3, kinetic = 0.3})
  local ball = world:add_object(clench.shapes.sphere {0.03}, {
    name = "a \"round\" thing", material = "felt", mass = 0.1, com = {0.001, 0, 0}, inertia = {{1, 0, 0}, {0, 2, 0}, {0, 0, 2}},
    color = {1, 0.5, 0.1}, transparency = 0.25, elastic_modulus = 1e6, soft_layer = 0.004, poisson_ratio = 0.25, pose = {xyz = {1, 1 / 3, 0}, rpy = {1, 2, 3}}})
  local wrist = world:add_robot("tests/data/two_finger/pincher.cfg", {name = "wrist"})
  wrist:mount_on(claw, {chain = 2, pose = {xyz = {0.01, 0.02, 0.03}, rpy = {0, 0, 1}}, adapter = "tests/data/two_finger/box.iv"})
  world:add_obstacle("models/obstacles/table.iv", {name = "last", material = "cork", pose = {xyz = {0, 0, -2}}})
  flask.name, flask.mass, flask.com = "bottle", 0.456, {0, 0.01, 0}
  local third, fourth = hand.links[3].name, hand.links[4].name
  hand.links[3].name = "spare"
  hand.links[4].name = third
  hand.links[3].name = fourth
  hand.base.material, hand.links[1].mass, hand.links[2].color = "cork", 0.077, {0, 0, 1}
  world:set_collision(false, hand, ball)
  world:set_collision(true, hand.base, hand.links[1])
  world:set_collision(false, flask)
  world.contact_threshold = 2.5e-4
  world.camera = {eye = {1, 2, 3}, target = {0, 0, 0.5}, up = {0, 0, 1}}
  return world
end

test("a world saved as Lua is bit-identical, with any settings", function(t)
  local world = rich_world()
  local path = folder .. "/rich.lua"
  t.equal(t.warnings(function() world:save(path, {root = "."}) end), {})
  local again = clench.load(path, {root = "."})
  t.equal(again:hash(), world:hash())
  t.equal(clench.load(path):hash(), world:hash())
  t.equal(again.camera.eye, world.camera.eye)
  t.equal(again.camera.target, world.camera.target)
  for i, body in ipairs(world.bodies) do t.equal(again.bodies[i].name, body.name) end
  t.equal(again:body('a "round" thing').color, world:body('a "round" thing').color)
  t.equal(again.source, path)
  again:save(folder .. "/again.lua", {root = "."})
  t.equal(read(folder .. "/again.lua"), read(path))
end)

test("the sign of a zero is restored from Lua", function(t)
  local box, zero = clench.shapes.box {0.1, 0.1, 0.1}, -0.0
  local function same(make)
    local world = clench.world()
    make(world)
    world:save(folder .. "/zero.lua")
    t.equal(clench.load(folder .. "/zero.lua"):hash(), world:hash())
  end
  same(function(w) w:add_object(box, {pose = clench.pose {xyz = {0.1, 0, 0}}:inverse()}) end)
  same(function(w) w:add_object(box, {com = {zero, 0, zero}}) end)
  same(function(w) w:add_object(box, {inertia = {{1, zero, 0}, {zero, 1, 0}, {0, 0, 1}}}) end)
  same(function(w)
    w:add_object {vertices = {{zero, 0, 0}, {1, zero, 0}, {0, 1, zero}, {0, 0, 1}}, triangles = {{1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}}
  end)
  same(function(w)
    local hand = w:add_robot("models/hands/barrett/barrett.cfg", {approach = {direction = {0, 1, 0}}})
    hand:set_dofs {zero, zero, zero, zero}
  end)
end)

test("eigengrasps removed from a hand stay removed", function(t)
  local world = clench.world()
  local hand = world:add_robot "models/hands/human/human20.cfg"
  local count = #hand.eigengrasps
  hand.eigengrasps = nil
  world:save(folder .. "/bare.lua")
  local again = clench.load(folder .. "/bare.lua")
  t.equal(again:hash(), world:hash())
  t.ok(#again.robots[1].eigengrasps == 20 and count < 20)
end)

test("a world that loads itself is reported", function(t)
  local path = write("self.lua", "return require 'clench'.load(select(2, ...) .. '/other.lua')")
  write("other.lua", "return require 'clench'.load(select(2, ...) .. '/self.lua')")
  t.fails(function() clench.load(path) end, "self.lua: it loads itself")
  t.fails(function() clench.load(path) end, "self.lua: it loads itself")
  -- loading one file twice is not a cycle
  local twice = write("twice.lua", "local f = select(2, ...) .. '/zero.lua' local a = require 'clench'.load(f) return require 'clench'.load(f)")
  t.ok(clench.load(twice))
end)

-- an .xml is a scene of MuJoCo unless stated otherwise
local formats = {[".xml"] = "graspit"}

test("all shipped worlds are restored bit-exactly from Lua, and their poses and DOFs from every format", function(t)
  for _, name in ipairs {"dlr_flask", "barrett_mug", "barrett_glass_table"} do
    local world = clench.load("worlds/" .. name .. ".wld", {root = "."})
    for _, ending in ipairs {".wld", ".xml", ".lua"} do
      local path = folder .. "/" .. name .. ending
      t.equal(t.warnings(function() world:save(path, {root = ".", format = formats[ending]}) end), {})
      t.equal(clench.load(path, {root = "."}):hash(), world:hash())
    end
  end
end)

test("a closed hand is restored closed", function(t)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  world.robots[1]:autograsp()
  for _, ending in ipairs {".wld", ".xml", ".lua"} do
    local path = folder .. "/closed" .. ending
    world:save(path, {root = ".", format = formats[ending]})
    local again = clench.load(path, {root = "."})
    t.equal(again.robots[1].dofs, world.robots[1].dofs)
    t.equal(#again:contacts(), #world:contacts())
    t.equal(#again:colliding(), 0)
  end
end)

test("data that .wld and .xml cannot store are reported in one warning that names them", function(t)
  local world = rich_world()
  for _, ending in ipairs {".wld", ".xml"} do
    local said = table.concat(t.warnings(function() world:save(folder .. "/lossy" .. ending, {root = ".", format = formats[ending]}) end), "\n")
    t.ok(said:find("lossy" .. ending .. " does not hold which bodies may collide, the contact threshold, the name 'bottle'", 1, true), said)
    for _, part in ipairs {"the mass of 'bottle'", "the center of mass of 'bottle'", " more"} do t.ok(said:find(part, 1, true), said) end
    t.equal(select(2, said:gsub("\n", "")), 0)
    local again = clench.load(folder .. "/lossy" .. ending, {root = "."})
    t.equal(#again.bodies, #world.bodies)
    for _, kind in ipairs {"objects", "obstacles", "robots"} do
      for i, thing in ipairs(again[kind]) do
        local off = thing.pose:inverse() * world[kind][i].pose
        t.close(off.position:norm() + off:angle(), 0, 1e-9)
      end
    end
  end
  local plain = clench.world()
  plain:add_object("models/objects/mug.iv").mass = 7
  plain:set_friction("cork", "wood", {static = 1})
  t.equal(t.warnings(function() plain:save(folder .. "/plain.wld", {root = "."}) end),
    {"plain.wld does not hold the mass of 'mug', the friction of cork on wood"})
end)

test("a warning reports that only .lua stores the soft layer and Poisson's ratio", function(t)
  local world = clench.world()
  world:add_object(clench.shapes.sphere {0.03}, {name = "ball", elastic_modulus = 1e6, soft_layer = 0.004, poisson_ratio = 0.25})
  for _, ending in ipairs {".wld", ".xml"} do
    t.equal(t.warnings(function() world:save(folder .. "/soft" .. ending, {format = formats[ending]}) end),
      {"soft" .. ending .. " does not hold the soft layer of 'ball', Poisson's ratio of 'ball'"})
  end
  t.equal(t.warnings(function() world:save(folder .. "/soft.lua") end), {})
end)

test("bodies made in a script are written next to worlds for GraspIt!, and read back", function(t)
  local world = clench.world()
  local ball = world:add_object(clench.shapes.sphere {0.03}, {name = "ball", mass = 0.2, material = "rubber"})
  for _, ending in ipairs {".wld", ".xml"} do
    t.equal(t.warnings(function() world:save(folder .. "/made" .. ending, {format = formats[ending]}) end), {})
    local again = clench.load(folder .. "/made" .. ending)
    t.equal(again.objects[1].source ~= "", ending == ".wld")
    t.equal(again.objects[1].mesh.triangle_count, ball.mesh.triangle_count)
    t.equal(again.objects[1].mass, 0.2)
    t.equal(again.objects[1].material, "rubber")
  end
end)

test("a file that cannot be written keeps its old contents", function(t)
  local path = write("old.wld", "precious")
  local world = clench.world()
  t.fails(function() world:save "no/such/folder/a.wld" end, "no such folder: no/such/folder")
  t.fails(function() world:save(folder .. "/a.obj") end, "expected the extension .xml, .mjcf, .wld or .lua, got '.obj'")
  t.fails(function() world:save(path, {rot = "."}) end, "unknown key 'rot'")
  t.equal(read(path), "precious")
  world:save(path)
  t.equal(read(path), "#GraspIt! version 2.0\n")
end)

test("a Lua world is a script that returns a world", function(t)
  local good = write("good.lua", [[
    local options, here = ...
    local world = require "clench".world()
    world:add_object(require "clench".shapes.box {1, 1, 1}, {name = options.root .. here})
    return world]])
  t.equal(clench.load(good, {root = "."}).objects[1].name, "." .. folder)
  t.fails(function() clench.load(write("none.lua", "return 3")) end, "none.lua: expected a script that returns a world, got 3")
  t.fails(function() clench.load(write("syntax.lua", "local = 3")) end, "syntax.lua:1:")
  t.fails(function() clench.load(write("raises.lua", "error 'no luck'")) end, "raises.lua:1: no luck")
  t.fails(function() clench.load(write("itself.lua", "return require 'clench'.load(" .. ("%q"):format(folder .. "/itself.lua") .. ")")) end, "itself.lua: it loads itself")
end)

test("sets of eigengrasps and virtual contacts that the user gave a hand are saved with a Lua world", function(t)
  local world = clench.world()
  local hand = world:add_robot "models/hands/barrett/barrett.cfg"
  hand.eigengrasps = clench.eigengrasps {postures = {{0, 0, 0, 0}, {0, 1, 1, 1}, {1, 0, 0, 0}}, count = 2}
  local path = folder .. "/sets.lua"
  t.equal(t.warnings(function() world:save(path, {root = "."}) end), {})
  t.equal(clench.load(path):hash(), world:hash())
  t.ok(t.warnings(function() world:save(folder .. "/sets.wld", {root = "."}) end)[1]:find "the eigengrasps of 'barrett'")
end)

test("a camera is set by eye and target or by its pose", function(t)
  local world = clench.world()
  world.camera = {eye = {0, -2, 0}, target = {0, 0, 0}, up = {0, 0, 1}}
  t.close(world.camera.target, {0, 0, 0}, 1e-15)
  t.close(world.camera.up, {0, 0, 1}, 1e-15)
  world.camera = {pose = {xyz = {1, 2, 3}}, focal_distance = 2}
  t.equal(world.camera.target, clench.vec3 {1, 2, 1})
  world.camera = nil
  t.equal(world.camera, nil)
  t.fails(function() world.camera = {eye = {0, 0, 0}, target = {0, 0, 0}} end, "different eye and target")
  t.fails(function() world.camera = {eye = {1, 0, 0}, target = {0, 0, 0}, field_of_view = 1} end, "field_of_view: expected 0.785")
end)

test("joints that broke away are set by chain, joint and value", function(t)
  local claw = clench.world():add_robot "tests/data/two_finger/claw.cfg"
  local high = claw.dof_limits[1][2]
  claw:set_dofs({high, high}, {joint_positions = {{2, 1, 0}}})
  t.equal(claw.chains[2].joints[1].broken_away, true)
  t.equal(claw.chains[2].joints[1].value, 0)
  t.equal(claw.chains[1].joints[1].broken_away, false)
  claw:set_dofs {high, high}
  t.equal(claw.chains[2].joints[1].broken_away, false)
  for bad, text in pairs {[{3, 1, 0}] = "expected a chain from 1 to 2, got 3", [{1, 7, 0}] = "expected a joint from 1 to", [{1, 1, 99}] = "expected a value in"} do
    t.fails(function() claw:set_dofs({0, 0}, {joint_positions = {bad}}) end, text)
  end
end)

test("files outside of the folder of confined reading are not read again to save a world", function(t)
  local world = clench.world()
  world:add_object "models/objects/flask.iv"
  local told = table.concat(t.warnings(function() world:save(folder .. "/confined.xml", {confine = "worlds", format = "graspit"}) end), "\n")
  t.ok(told:find("'flask' is saved with its triangles, for '", 1, true) and told:find("lies outside of worlds", 1, true), told)
  t.ok(told:find("confined.xml lies outside of worlds, to which reading is confined: contents that it cannot represent are not reported", 1, true), told)
  t.equal(clench.load(folder .. "/confined.xml").objects[1].mass, world.objects[1].mass)
  t.equal(t.warnings(function() world:save(folder .. "/confined.lua", {confine = "models"}) end), {})
  t.equal(clench.load(folder .. "/confined.lua"):hash(), world:hash())
  t.fails(function() world:save(folder .. "/confined.lua", {confine = "no such"}) end, "world:save: confine: expected a folder, got 'no such'")
end)

test("dynamic state that is not saved is reported", function(t)
  local world = clench.load("worlds/parallel_jaw_cube.wld")
  world.time_step = 0.002
  t.equal(t.warnings(function() world:save(folder .. "/dynamic.lua") end), {})
  t.equal(clench.load(folder .. "/dynamic.lua").time_step, 0.002)
  t.equal(t.warnings(function() world:save(folder .. "/dynamic.wld") end), {"dynamic.wld does not hold the time step"})
  -- setting and resetting is not a change
  world.robots[1].floating = true
  world.robots[1].floating = false
  t.equal(t.warnings(function() world:save(folder .. "/dynamic.lua") end), {})
  world.robots[1].floating = true
  t.equal(t.warnings(function() world:save(folder .. "/dynamic.lua") end), {})
  t.equal(clench.load(folder .. "/dynamic.lua").robots[1].floating, true)
  t.equal(t.warnings(function() world:save(folder .. "/dynamic.wld") end)[1],
    "world:save: settings of dynamics other than the time step are not saved: engine, friction cone, gains, max_effort, floating bases, breakaway, " ..
    "gravity compensation, belts, welds")
  world.robots[1].gravity_compensation = false
  world:run(0.01)
  t.equal(t.warnings(function() world:save(folder .. "/dynamic.lua") end),
    {"world:save: settings of dynamics other than the time step and floating bases are not saved: engine, friction cone, gains, max_effort, breakaway, " ..
     "gravity compensation, belts, welds",
     "world:save: the time, velocities and targets of motors of a world that has run are not saved"})
end)

test("worlds of the original are restored from every format, and equal in both of its versions", function(t)
  local shared = os.getenv "CLENCH_SHARED" or "../shared"
  local file = io.open(shared .. "/data/README.md")
  if not file then t.skip("no third-party data at ../shared or CLENCH_SHARED") end
  file:close()
  local text, xml = shared .. "/data/graspit", shared .. "/data/graspit-xml"
  clench.log.level "quiet"
  local worlds = {{text, "barrettGlassDyn.wld"}, {text, "plannerMug.wld"}, {xml, "plannerMug.xml"}, {xml, "tmp_cube.xml"}}
  local loaded = {}
  for i, entry in ipairs(worlds) do
    local root, name = entry[1], entry[2]
    local world = clench.load(root .. "/worlds/" .. name, {root = root})
    loaded[i] = world
    for _, ending in ipairs {".wld", ".xml", ".lua"} do
      world:save(folder .. "/original" .. ending, {root = root, format = formats[ending]})
      local again = clench.load(folder .. "/original" .. ending, {root = root})
      -- the hand of the first one is carried: its pose on the arm and in the world are both written, and not every length in meters has an exactly
      -- equal decimal in millimeters
      if ending == ".lua" or i > 1 then t.equal(again:hash(), world:hash()) end
      for k, body in ipairs(world.bodies) do
        local off = body.pose:inverse() * again.bodies[k].pose
        t.ok(off.position:norm() < 1e-15 and off:angle() < 1e-15, body.name)
      end
    end
  end
  for i, body in ipairs(loaded[2].bodies) do t.equal(body.pose, loaded[3].bodies[i].pose) end
end)

test("an .xml is a scene of MuJoCo, or a world of GraspIt! on request or if a robot carries another", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  world.robots[1]:autograsp()
  world:save(folder .. "/scene.xml")
  t.ok(read(folder .. "/scene.xml"):find("^<mujoco"))
  t.ok(read(folder .. "/scene_files/flask.obj"):find("^# meters\nv "))
  local again = clench.load(folder .. "/scene.xml")
  t.equal(again.keyframes[1], "start")
  t.equal(again.robots[1].name, "dlr")
  t.equal(#again.bodies, #world.bodies)
  for i, body in ipairs(world.bodies) do
    local other = again.bodies[i]
    t.ok(other.name:find(body.name, 1, true), other.name)
    t.close((other.pose.position - body.pose.position):norm(), 0, 1e-9)
    t.close(other.mass, body.mass, 1e-12)
  end
  for i, value in ipairs(again.robots[1].dofs) do t.close(value, world.robots[1].dofs[i], 1e-12) end
  world:save(folder .. "/scene.mjcf")
  t.equal(#clench.load(folder .. "/scene.mjcf").robots, 1)
  t.fails(function() world:save(folder .. "/scene.xml", {format = "wld"}) end, "unknown format 'wld', expected one of mjcf, graspit, lua")
  t.fails(function() world:save(folder .. "/scene.wld", {format = "mjcf"}) end, "scene.wld: the format 'mjcf' is not written to '.wld'")
  local carried = clench.world()
  local arm, hand = carried:add_robot "models/arms/puma560/puma560.cfg", carried:add_robot "models/hands/barrett/barrett.cfg"
  hand:mount_on(arm)
  clench.log.level "warning"
  local told = table.concat(t.warnings(function() carried:save(folder .. "/carried.xml") end), "\n")
  t.ok(told:find("carried.xml: a robot carries another one", 1, true), told)
  t.equal(#clench.load(folder .. "/carried.xml").robots, 2)
  local middle, jaw = clench.world(), nil
  arm, jaw = middle:add_robot "models/arms/puma560/puma560.cfg", middle:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
  jaw:mount_on(arm, {link = arm.chains[1].links[1].name})
  local ok, problem = pcall(middle.save, middle, folder .. "/middle.wld")
  t.ok(not ok and tostring(problem):find(("the world: '%s' is carried by"):format(jaw.name), 1, true), problem)
  carried:save(folder .. "/carried.xml", {format = "mjcf"})
  t.equal(#clench.load(folder .. "/carried.xml").robots, 1)
end)

test("the friction of pairs from a scene's geoms is that of the world", function(t)
  local world = clench.world()
  local hand = world:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
  local cube = world:add_object("models/objects/cube.iv")
  world:save(folder .. "/friction.xml")
  local again = clench.load(folder .. "/friction.xml")
  for i, body in ipairs(hand.bodies) do
    local ours = world:friction(body.material, cube.material)
    local other = again.robots[1].bodies[i]
    t.close((again:friction(other.material, again.objects[1].material)), ours, 1e-12)
  end
end)
