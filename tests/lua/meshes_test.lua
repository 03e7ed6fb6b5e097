local test, clench = require "test", require "clench"

-- a tetrahedron with edges of 120 units along the axes
local points, faces = "v 0 0 0\nv 120 0 0\nv 0 120 0\nv 0 0 120\n", "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"

local function add(text, options)
  return clench.world():add_object(test.path(".obj", text), options)
end

test("the unit of a mesh is inferred, or given by name or by length", function(t)
  local function size(options) return add(points .. faces, options).mesh.bounds.high.x end
  t.close(size(), 0.12, 1e-15)
  t.close(size{unit = "cm"}, 1.2, 1e-14)
  t.close(size{unit = "inch"}, 3.048, 1e-14)
  t.close(size{mesh_scale = 0.5}, 60, 1e-12)
  t.fails(function() add(points .. faces, {unit = "cm", mesh_scale = 1}) end, "expected unit or mesh_scale, got both")
  t.fails(function() add(points .. faces, {unit = "yard"}) end, "unknown unit 'yard'")
end)

test("an inferred unit is logged, and a given one is not", function(t)
  local lines = {}
  clench.log.sink(function(level, message) lines[#lines + 1] = level .. " " .. message end)
  add(points .. faces)
  add(points .. faces, {unit = "mm", mass = 1, material = "glass"})
  add(points .. faces, {unit = "mm", density = 700})
  add(points .. faces, {unit = "mm", material = "glass"})
  clench.log.sink(nil)
  t.equal(#lines, 7)
  t.ok(lines[1]:find("info .*120 x 120 x 120, is taken for mm"), lines[1])
  t.ok(lines[2]:find("info .*: no mass and no material is given; 0.3 kg of wood is assumed"), lines[2])
  t.ok(lines[3]:find("info .*: no inertia is given; that of a uniform solid is assumed"), lines[3])
  t.ok(lines[4]:find("info .*: no inertia is given"), lines[4])
  -- a density is used
  t.ok(lines[5]:find("info .*: no material is given; wood is assumed"), lines[5])
  t.ok(lines[6]:find("info .*: no mass is given; 0.3 kg is assumed"), lines[6])
  t.ok(lines[7]:find("info .*: no inertia is given"), lines[7])
end)

test("density applies only to closed meshes, and not together with a mass", function(t)
  t.close(add(points .. faces, {density = 500}).mass, 500 * 0.12 ^ 3 / 6, 1e-12)
  local open = points .. "f 1 3 2\nf 1 2 4\nf 1 4 3\n"
  t.fails(function() add(open, {density = 500}) end, "density: expected a watertight mesh, got one with 3 open edges; give its mass")
  t.fails(function() add(points .. faces, {density = 500, mass = 1}) end, "expected mass or density, got both")
  t.fails(function() add(points .. "f 1 2 3\nf 3 2 1\n", {density = 1}) end, "got one with no volume")
  t.fails(function() add(points .. faces, {density = -1}) end, "density")
end)

test("a mesh's report counts what was read and repaired", function(t)
  local report = add(points .. points .. "f 1 3 2\nf 5 6 8\nf 1 4 3\nf 2 3 4\nf 1 2 2\nv 9 9 9\n").mesh_report
  t.equal(report.format, "OBJ")
  t.equal(report.triangles_read, 5)
  t.equal(report.dropped_triangles, 1)
  t.equal(report.welded_vertices, 3)
  t.equal(report.unused_vertices, 2)
  t.equal(report.flipped, false)
  t.equal(report[1], "OBJ: 5 triangles of 7 vertices")
  t.equal(report[3], "3 vertices welded, 1 degenerate triangle dropped, 2 unused vertices left out")
  t.equal(clench.world():add_object(clench.shapes.box {1, 1, 1}).mesh_report, nil)
end)

test("a mesh made by the script accepts a unit, too, and unknown keys of it are rejected", function(t)
  local mesh = clench.shapes.box {1, 2, 3}
  local box = clench.world():add_object(mesh, {unit = "mm"})
  t.close(box.mesh.bounds.high.z, 0.0015, 1e-18)
  t.close(clench.world():add_object(mesh, {mesh_scale = 2}).mesh.bounds.high.z, 3, 0)
  local odd = {vertices = mesh.vertices, triangles = mesh.triangles, normals = {}}
  t.fails(function() clench.world():add_object(odd) end, "add_object: mesh: unknown key 'normals'")
end)

test("missing meshes for display are reported once, in one sentence", function(t)
  local link = [[<link name="l%d"><inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision><visual><geometry><mesh filename="no/%d.stl"/></geometry></visual></link>]]
  local joint = [[<joint name="j%d" type="revolute"><parent link="l%d"/><child link="l%d"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint>]]
  local parts = {}
  for i = 1, 5 do parts[#parts + 1] = link:format(i, i) end
  for i = 1, 4 do parts[#parts + 1] = joint:format(i, i, i + 1) end
  local path = test.path(".urdf", '<robot name="r">' .. table.concat(parts) .. "</robot>")
  local missing = {}
  for _, said in ipairs(t.warnings(function() clench.world():add_robot(path) end)) do
    if said:find "drawn" then missing[#missing + 1] = said end
  end
  t.equal(#missing, 1)
  t.ok(missing[1]:find "mesh: no such file: no/1.stl; it and 4 other meshes are not drawn", missing[1])
  -- without a sink, messages of a file are not printed again when it is loaded again
  local code = ("local w = require 'clench'.world() w:add_robot('%s') w:add_robot('%s', {name = 'again'})"):format(path, path)
  local script, log = test.path(".lua", code), test.path ".log"
  os.execute(("readlink /proc/$PPID/exe > '%s'"):format(log))
  local file <close> = io.open(log)
  local program = file:read "l"
  os.execute(("'%s' run '%s' 2> '%s'"):format(program, script, log))
  local printed <close> = io.open(log)
  local _, count = printed:read "a":gsub("are not drawn", "")
  t.equal(count, 1)
end)
