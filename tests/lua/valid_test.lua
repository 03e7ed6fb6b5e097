-- One rule per quantity: a file, an option and a field accept and reject the same numbers.
local test, clench = require "test", require "clench"

local nan = 0 / 0
local numbers = {nan, math.huge, -math.huge, 1e308, -1e308, 5e-324, 0, -1, 1}

local box = [[
Separator {
  Coordinate3 { point [ 0 0 0, 100 0 0, 0 100 0, 0 0 100 ] }
  IndexedFaceSet { coordIndex [ 0, 2, 1, -1, 0, 1, 3, -1, 0, 3, 2, -1, 1, 2, 3, -1 ] }
}
]]

-- calls a function with the path of a file with that ending and text
local function with_file(ending, text, use)
  return use(test.path(ending, text))
end

-- text of a number in a file: "nan" and "inf" are not numbers there
local function written(x) return ("%.17g"):format(x) end

local function body_file(header, x)
  return with_file(".iv", "#Inventor V2.1 ascii\n" .. header:format(written(x), written(x), written(x)) .. "\n" .. box,
                   function(path) return clench.world():add_object(path) end)
end

local function a_box(options) return clench.world():add_object(clench.shapes.box {0.1, 0.1, 0.1}, options) end

-- name, accepted numbers of the list above, the one that a file's reader repairs, and how to set one by file, option and field
local quantities = {
  {name = "mass", allowed = {1}, repaired = {-1, 0}, file = function(x) body_file("#mass %s", x) end,
   option = function(x) a_box {mass = x} end, field = function(x) a_box().mass = x end},
  {name = "com", allowed = {5e-324, 0, -1, 1}, file = function(x) body_file("#cog %s 0 0", x) end,
   option = function(x) a_box {com = {0, x, 0}} end, field = function(x) a_box().com = {0, x, 0} end},
  {name = "elastic modulus", allowed = {1}, repaired = {-1}, file = function(x) body_file("#youngs %s", x) end,
   option = function(x) a_box {elastic_modulus = x} end, field = function(x) a_box().elastic_modulus = x end},
  {name = "soft layer", allowed = {1}, option = function(x) a_box {soft_layer = x} end,
   field = function(x) a_box().soft_layer = x end},
  {name = "Poisson's ratio", allowed = {5e-324, 0}, option = function(x) a_box {poisson_ratio = x} end,
   field = function(x) a_box().poisson_ratio = x end},
  {name = "density", allowed = {1}, option = function(x) a_box {density = x} end},
  {name = "inertia", allowed = {1}, option = function(x) a_box {inertia = {{x, 0, 0}, {0, x, 0}, {0, 0, x}}} end,
   field = function(x) a_box().inertia = {{x, 0, 0}, {0, x, 0}, {0, 0, x}} end},
  {name = "color", allowed = {5e-324, 0, 1}, option = function(x) a_box {color = {x, 0, 0}} end,
   field = function(x) a_box().color = {x, 0, 0} end},
  {name = "transparency", allowed = {5e-324, 0, 1}, option = function(x) a_box {transparency = x} end,
   field = function(x) a_box().transparency = x end},
  {name = "position", allowed = {5e-324, 0, -1, 1},
   file = function(x)
     with_file(".iv", "#Inventor V2.1 ascii\n" .. box, function(path)
       local name = path:match "[^/]*$"
       with_file(".wld", ("#GraspIt! version 2.1\nGraspableBody\n%s\nT (1 0 0 0)[0 %s 0]\n"):format(name, written(x)), clench.load)
     end)
   end,
   option = function(x) a_box {pose = {xyz = {0, x, 0}}} end, field = function(x) a_box().pose = {xyz = {0, x, 0}} end},
  {name = "vertex", allowed = {5e-324, 0, -1, 1},
   file = function(x)
     with_file(".obj", ("v %s 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"):format(written(x)),
               function(path) return clench.world():add_object(path, {unit = "m"}) end)
   end,
   option = function(x)
     clench.world():add_object {vertices = {{x, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                triangles = {{1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}}
   end},
  {name = "mesh scale", allowed = {1}, option = function(x) a_box {mesh_scale = x} end},
  {name = "friction", allowed = {5e-324, 0, 1},
   option = function(x) clench.world():set_friction("cork", "wood", {static = x, kinetic = x}) end},
  {name = "contact threshold", allowed = {}, option = function(x) clench.world {contact_threshold = x} end,
   field = function(x) clench.world().contact_threshold = x end},
  {name = "focal distance", allowed = {1},
   field = function(x) clench.world().camera = {pose = {}, focal_distance = x} end},
  {name = "eye", allowed = {5e-324, 0, -1, 1},
   field = function(x) clench.world().camera = {eye = {x, 0, 9}, target = {0, 0, 0}, up = {0, 1, 0}} end},
}

for _, quantity in ipairs(quantities) do
  test(quantity.name .. " has one rule", function(t)
    local allowed, repaired = {}, {}
    for _, x in ipairs(quantity.allowed) do allowed[x] = true end
    for _, x in ipairs(quantity.repaired or {}) do repaired[x] = true end
    for _, way in ipairs {"file", "option", "field"} do
      for _, x in ipairs(quantity[way] and numbers or {}) do
        local ok, message = pcall(quantity[way], x)
        t.ok(ok == (allowed[x] or way == "file" and repaired[x] or false), ("%s: %s: %s: %s"):format(quantity.name, way, x, message))
        if not ok then t.ok(tostring(message):find "expected " or tostring(message):find " must be ", message) end
      end
    end
  end)
end

test("DOFs of a file obey the same rules", function(t)
  local function arm(numbers_of)
    local n = {velocity = "1", effort = "1", d = "0", a = "0", alpha = "0", min = "0", max = "1", spring = "0"}
    for key, value in pairs(numbers_of) do n[key] = written(value) end
    local text = ("Robot\npalm.iv\n1\nr %s %s 1 1 20\n1\n1\n1\nt 0 0 0\nd0 %s %s %s %s %s 0 0 %s\nRevolute\nlink.iv 0\n"):format(
      n.velocity, n.effort, n.d, n.a, n.alpha, n.min, n.max, n.spring)
    local folder = test.folder()
    assert(os.execute("mkdir " .. folder .. "/iv"))
    for _, name in ipairs {"iv/palm.iv", "iv/link.iv"} do clench.files.save_text(folder .. "/" .. name, "#Inventor V2.1 ascii\n" .. box) end
    clench.files.save_text(folder .. "/arm.cfg", text)
    local ok, message = pcall(function() return clench.world():add_robot(folder .. "/arm.cfg") end)
    return ok, tostring(message)
  end
  local ok, message = arm {}
  t.ok(ok, message)
  for _, key in ipairs {"velocity", "effort", "d", "a", "alpha", "max", "spring"} do
    for _, x in ipairs {nan, math.huge, 1e308} do
      ok, message = arm {[key] = x}
      t.ok(not ok and message:find "arm.cfg:%d+: .*expected ", key .. ": " .. message)
    end
  end
  for _, key in ipairs {"d", "a"} do
    ok, message = arm {[key] = 1e20}
    t.ok(not ok and message:find("expected a number from -1e+09 to 1e+09 [m]", 1, true), message)
  end
end)

test("names of objects made in a script have no control characters", function(t)
  local world = clench.world()
  local bad = "a\27[31mb"
  t.fails(function() world:add_object(clench.shapes.box {1, 1, 1}, {name = bad}) end,
          "world:add_object: body: name: expected no control characters, got 'a?[31mb'")
  local body = world:add_object(clench.shapes.box {1, 1, 1})
  t.fails(function() body.name = "a\nb" end, "name: expected no control characters, got 'a?b'")
  t.fails(function() body.name = "\xff" end, "name: expected text in UTF-8")
  t.fails(function() body.name = ("x"):rep(300) end, "name: expected at most 250 bytes, got 300")
  t.fails(function() world:set_friction("a\nb", "wood", {static = 1}) end, "material: name: expected no control characters")
  t.fails(function() world:add_robot("models/hands/barrett/barrett.cfg", {name = bad}) end,
          "robot: name: expected no control characters")
  body.name = "Tasse Grüße"
  t.equal(body.name, "Tasse Grüße")
end)

test("names in files are repaired, with a message", function(t)
  local urdf = [[<robot name="a%sb"><link name="l&#x1b;k"/></robot>]]
  local said = {}
  clench.log.sink(function(_, text) said[#said + 1] = text end)
  local ok, robot = pcall(with_file, ".urdf", urdf:format("&#xA;"), function(path) return clench.world():add_robot(path) end)
  clench.log.sink()
  if not ok then return t.ok(tostring(robot):find "urdf:1", robot) end
  t.equal(robot.name, "a?b")
  t.ok(table.concat(said, "\n"):find("name: expected no control characters, got 'a?b'; it becomes 'a?b'", 1, true))
end)

test("an inside-out mesh is flipped, with a message, like that of a file", function(t)
  local said = {}
  clench.log.sink(function(_, text, about) said[#said + 1] = about .. " " .. text end)
  local ok, body = pcall(function()
    return clench.world():add_object {vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                      triangles = {{1, 2, 3}, {1, 4, 2}, {1, 3, 4}, {2, 4, 3}}}
  end)
  clench.log.sink()
  t.ok(ok, body)
  t.equal(said, {"repaired world:add_object: mesh: its triangles face inward; flipped to face outward"})
  t.close(body.mesh.volume, 1 / 6, 1e-15)
end)

test("overflow of a result is an error, and overflow of intermediate values is avoided", function(t)
  local v = clench.vec3
  local large = v(1e308, 1e308, 0)
  for name, fn in pairs {
    ["+"] = function() return large + large end,
    ["-"] = function() return large - (-large) end,
    ["*"] = function() return large * 10 end,
    ["k *"] = function() return 10 * large end,
    ["/"] = function() return large / 0.01 end,
    dot = function() return large:dot(large) end,
    cross = function() return large:cross {0, 1e308, 1e308} end,
    norm = function() return v(1.7e308, 1.7e308, 1.7e308):norm() end,
    deg = function() return clench.deg(1e308) end,
  } do
    local message = t.fails(fn, "the result is not finite, got ")
    t.ok(message:find(name == "deg" and "clench.deg: " or "vec3", 1, true), message)
  end
  t.close(large:norm(), math.sqrt(2) * 1e308, 1e295)
  t.close(large:unit(), {math.sqrt(0.5), math.sqrt(0.5), 0}, 1e-15)
  t.close(v(5e-324, 5e-324, 0):unit(), {math.sqrt(0.5), math.sqrt(0.5), 0}, 1e-15)
  local x = clench.random(1):uniform(-1.7e308, 1.7e308)
  t.ok(x >= -1.7e308 and x < 1.7e308, tostring(x))
end)

test("composed, inverted or interpolated poses stay within the bound of positions", function(t)
  local p = clench.pose {xyz = {6e8, 0, 0}}
  t.fails(function() return p * p end, "pose: expected a position within 1e+09 m of the origin, got (1200000000, 0, 0)")
  t.fails(function() return clench.pose {xyz = {1e308, 0, 0}} end, "clench.pose: expected a position within 1e+09 m")
  t.equal(p:interpolate(p:inverse(), 0.5).position, clench.vec3(0, 0, 0))
end)

test("shapes of impossible sizes are rejected", function(t)
  local shapes = clench.shapes
  t.fails(function() shapes.box {1e300, 1, 1} end, "shapes.box: x must be a number of at most 1e+09, got 1e+300")
  t.fails(function() shapes.torus {1e308, 1e307} end, "shapes.torus: radius must be a number of at most 1e+09")
  t.fails(function() shapes.cylinder {1, from = {0, 0, 0}, to = {0, 0, 1e300}} end, "shapes.cylinder: to must be a point {x, y, z}")
  t.fails(function() shapes.scale(shapes.scale(shapes.box {1, 1, 1}, 1e308), 1e308) end,
          "shapes.scale: vertex 1 must be three numbers of at most 1e+09")
end)

test("messages of the engine have no control characters, and long names are shown by both ends", function(t)
  local world = clench.world()
  t.fails(function() world:body "a\27[2J\r" end, "no body 'a?[2J?' in this world")
  for shift = 0, 1 do
    local ok, message = pcall(function() world:body(("a"):rep(shift) .. ("\u{fc}"):rep(5000)) end)
    t.equal(ok, false)
    t.ok(#message < 1100 and utf8.len(tostring(message)), message)
    t.ok(message:find("' in this world", 1, true), message)
  end
end)
