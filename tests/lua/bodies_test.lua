-- Bodies made from tables, and messages about suspicious ones.
local test, clench = require "test", require "clench"

-- runs fn; returns the messages logged meanwhile and fn's result
local function told(fn)
  local said = {}
  clench.log.sink(function(_, text, about) said[#said + 1] = ("%s %s"):format(about, text) end)
  local ok, result = pcall(fn)
  clench.log.sink()
  return said, ok and result or error(result, 0)
end

local corners = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}}
local faces = {{1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}

test("a triangle that names a vertex twice is left out and counted", function(t)
  local triangles = {{1, 1, 2}, table.unpack(faces)}
  triangles[#triangles + 1] = {4, 3, 4}
  local said, body = told(function() return clench.world():add_object {vertices = corners, triangles = triangles} end)
  t.equal(said, {"repaired world:add_object: mesh: 2 of 6 triangles name a vertex twice and are left out"})
  t.equal(body.mesh.triangles, faces)
  t.ok(body.mesh:is_watertight())
  t.fails(function() clench.world():add_object {vertices = {{0, 0, 0}}, triangles = {{1, 1, 1}}} end,
          "expected a triangle of three different vertices, got none")
  t.fails(function() clench.world():add_object {vertices = corners, triangles = {}} end,
          "expected at least one triangle, got none")
end)

test("a body without area, and objects too small or too large for any hand, are suspicious", function(t)
  local function doubts(mesh, method)
    local world = clench.world()
    return (told(function() return world[method or "add_object"](world, mesh) end))
  end
  t.equal(doubts {vertices = {{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}}, triangles = {{1, 2, 3}}},
          {"suspicious world:add_object: mesh: none of its triangles has an area",
           "suspicious world:add_object: mesh: no inertia is given, and the surface bounds no solid; that of a ball around it is assumed"})
  t.equal(doubts(clench.shapes.box {100, 20, 30}),
          {"suspicious world:add_object: mesh: it is 100 m large: is its unit right?"})
  t.equal(doubts(clench.shapes.box {1e-4, 1e-4, 1e-4}),
          {"suspicious world:add_object: mesh: it is 0.0001 m large: is its unit right?"})
  t.equal(doubts(clench.shapes.box {2.9, 0.002, 0.002}), {})
  -- an obstacle may be as large as a room
  t.equal(doubts(clench.shapes.box {100, 20, 30}, "add_obstacle"), {})
end)

test("masses, moduli and gravity in another unit are reported once", function(t)
  local world = clench.world()
  local box = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "box"})
  -- without the script's line
  local function doubts(fn)
    local said = t.warnings(fn)
    for i, text in ipairs(said) do said[i] = text:gsub("^%S+%.lua:%d+: ", "") end
    return said
  end
  t.equal(doubts(function()
    box.mass = 329
    box.mass = 400
  end), {"box: its mass of 329 kg makes 3.29e+05 kg/m^3: is its unit right?"})
  t.equal(doubts(function() box.elastic_modulus = 1.5 end),
          {"box: elastic_modulus 1.5 Pa is softer than any rubber; is it meant in MPa?"})
  t.equal(doubts(function() world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {mass = 0.3, elastic_modulus = 1.5}) end),
          {"world:add_object: mesh: elastic_modulus 1.5 Pa is softer than any rubber; is it meant in MPa?"})
  t.equal(doubts(function() world.gravity = {0, 0, -9810} end), {"gravity is 9810 m/s^2, and the earth's is 9.81: is its unit right?"})
  t.equal(doubts(function() clench.world {gravity = {0, 0, -9810}} end), {"clench.world: gravity is 9810 m/s^2, and the earth's is 9.81: is its unit right?"})
  t.equal(doubts(function()
    box.mass, box.elastic_modulus, world.gravity = 0.3, 1.5e6, {0, 0, -1.62}
  end), {})
end)

test("a number sets both coefficients of friction", function(t)
  local world = clench.world()
  world:set_friction("cork", "glass", 0.4)
  t.equal({world:friction("glass", "cork")}, {0.4, 0.4})
  t.fails(function() world:set_friction("cork", "glass", -0.4) end, "static: expected a number from 0")
  t.fails(function() world:set_friction("cork", "glass", 0 / 0) end, "friction: expected a finite number, got nan")
end)

test("vertices must be within a thousand million meters", function(t)
  local far = {{0, 0, 0}, {0.1, 0, 0}, {0, -1.1e9, 0}, {0, 0, 0.1}}
  t.fails(function() clench.world():add_object {vertices = far, triangles = faces} end,
          "mesh: vertex 3: coordinates: expected a number from -1e+09 to 1e+09 [m], got -1100000000")
  far[3][2] = -1e9
  t.ok(clench.world():add_obstacle {vertices = far, triangles = faces}.mesh:is_watertight())
end)

test("names in a list are reported, with a hint at missing braces", function(t)
  t.fails(function() clench.vec3 {x = 1, y = 2, z = 3} end, "expected 3 numbers, got a table with the key 'x'")
  t.fails(function() clench.vec3 {1, 2, 3, w = 4} end, "expected 3 numbers, got a table with the key 'w'")
  t.fails(function() clench.vec3 {1, 2, 3, [0] = 4} end, "got a table with the key [0]")
  t.fails(function() clench.vec3 {1, 2, 3, [5] = 4} end, "got a table with the key [5]")
  t.fails(function() clench.vec3 {1, 2, 3, [true] = 4} end, "got a table with the key [true]")
  local hand = clench.world():add_robot "models/hands/barrett/barrett.cfg"
  local count = #hand.virtual_contacts
  t.fails(function() hand.virtual_contacts = {link = hand.base, point = {0, 0, 0}, normal = {0, 0, 1}} end,
          "hand.virtual_contacts: virtual_contacts: expected a list of virtual contacts, got a table with the key 'link'")
  t.equal(#hand.virtual_contacts, count)
  local path = test.path()
  t.fails(function() clench.files.save_pregrasps(path, {point = {0, 0, 0}}) end,
          "expected a list of tables, got a table with the key 'point'")
end)

test("masses and friction have an upper limit", function(t)
  local world = clench.world()
  t.fails(function() world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {mass = 1e308}) end,
          "mass must be 1e-12 to 1e+12, got 1e+308")
  t.equal(#world.bodies, 0)
  local box = world:add_object(clench.shapes.box {0.1, 0.1, 0.1})
  t.fails(function() box.mass = 1e31 end, "mass: expected a number from 1e-12 to 1e+12 [kg], got 1e+31")
  t.fails(function() world:set_friction("wood", "glass", {static = 1e300}) end,
          "static must be 0 to 1000000, got 1e+300")
  local hand = world:add_robot "models/hands/barrett/barrett.cfg"
  t.fails(function() hand.virtual_contacts = {{link = hand.base, point = {0, 0, 0}, normal = {0, 0, 1}, mu = 1e40}} end,
          "mu: expected a number from 0 to 1e+06, got 1e+40")
end)

test("an impossible inertia is rejected", function(t)
  local odd = {{1, 0, 0}, {0, 1, 0}, {0, 0, 3}}
  local tail = "inertia: expected no moment above the sum of the others, got one of 1.5 times that sum"
  local world = clench.world()
  t.fails(function() world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {inertia = odd}) end, "world:add_object: body 'body': " .. tail)
  t.equal(#world.bodies, 0)
  local box = world:add_object(clench.shapes.box {0.1, 0.1, 0.1})
  t.fails(function() box.inertia = odd end, "body 'body': " .. tail)
  box.inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 2}}
  t.close(box.inertia[3][3], 2, 1e-12)
end)

test("contacts of a removed body can still be printed", function(t)
  local world = clench.world()
  local a = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "a"})
  local b = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "b", pose = {xyz = {0.10005, 0, 0}}})
  local contact = world:contacts(a, b)[1]
  t.ok(tostring(contact):find "contact of .- on ")
  world:remove(b)
  t.ok(tostring(contact):find "a removed body")
  world:remove(a)
  t.ok(tostring(contact):find "contact of a removed body on a removed body at")
end)

test("surplus arguments are rejected by every method", function(t)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  local hand, mug = world.robots[1], world.objects[1]
  hand:autograsp()
  local one = {
    world = world, robot = hand, body = mug, mesh = mug.mesh, contact = world:contacts(hand, mug)[1], pose = clench.pose {},
    vec3 = clench.vec3(1, 2, 3), random = clench.random(1), eigengrasps = hand.eigengrasps,
    ["virtual contact"] = hand.virtual_contacts[1], snapshot = world:snapshot(), grasp = clench.grasp(hand, mug),
    ["wrench space"] = clench.grasp(hand, mug):wrench_space(),
  }
  local tried = 0
  for _, class in ipairs(clench.entries().classes) do
    local object = one[class.name]
    for _, method in ipairs(object and class.methods or {}) do
      local ok, message = pcall(object[method.name], object, table.unpack({}, 1, 20))
      t.ok(not ok and message:find("expected [an][%a ]+%d* arguments?, got 20"), class.name .. ":" .. method.name .. ": " .. tostring(message))
      tried = tried + 1
    end
  end
  t.ok(tried > 40, "tried " .. tried)
end)

test("expected types are named with their article", function(t)
  local hand = clench.world():add_robot "models/hands/barrett/barrett.cfg"
  t.fails(function() hand.eigengrasps.amplitudes(hand) end, "expected eigengrasps before the colon, got a robot")
  t.fails(function() clench.eigengrasps {postures = {{1, 2}, {2, 1}}, vectors = {{1, 0}}} end,
          "clench.eigengrasps: expected postures or vectors, got both")
end)

test("the mesh of a body can be used for other bodies", function(t)
  local world = clench.world()
  local cube = world:add_object(clench.shapes.box {0.02, 0.03, 0.04}, {mass = 1})
  local copy = world:add_object(cube.mesh, {mass = 1, mesh_scale = 2, pose = {xyz = {1, 0, 0}}})
  t.close(copy.mesh.volume, 8 * cube.mesh.volume, 1e-18)
  t.close(cube.mesh.volume, 0.02 * 0.03 * 0.04, 1e-18)
  t.fails(function() world:add_object(cube) end, "body: expected a file name, a mesh of a body, or one {vertices")
  t.fails(function() world:distance({}, cube) end, "a: expected a body, a robot, or a list of at least one, got an empty table")
end)
