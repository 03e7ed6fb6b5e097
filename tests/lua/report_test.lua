-- Reports of `clench check` on files.
local test, report = require "test", require "clench.report"

test("a body is reported with its numbers", function(t)
  local r = report.of "models/objects/flask.iv"
  t.equal(r.kind, "body")
  t.equal(r.error, nil)
  local body = clench.world():add_object "models/objects/flask.iv"
  t.equal(r.parsed.mass, body.mass)
  t.equal(r.parsed.mesh.triangles, body.mesh.triangle_count)
  t.ok(r.parsed.mesh.watertight)
end)

test("a robot is reported link by link and DOF by DOF", function(t)
  local r = report.of "models/hands/barrett/barrett.cfg"
  t.equal(r.kind, "robot")
  t.equal(#r.parsed.dofs, 4)
  t.equal(r.parsed.dofs[2].kind, "breakaway")
  t.equal(r.parsed.dofs[2].unit, "rad")
  t.equal(#r.parsed.chains, 3)
  t.equal(#r.parsed.chains[1].joints, 3)
  t.ok(r.parsed.eigengrasps >= 1)
end)

test("a world is reported with its contents", function(t)
  local r = report.of "worlds/dlr_flask.wld"
  t.equal(r.kind, "world")
  t.equal(#r.parsed.objects, 1)
  t.equal(#r.parsed.robots, 1)
  t.equal(#r.parsed.overlaps, 0)
end)

test("for a crowded world some overlapping bodies are named", function(t)
  local path = test.path(".lua", [[local world = clench.world()
for i = 1, 40 do world:add_obstacle("models/objects/cube.iv", {name = "c" .. i}) end
return world]])
  local r = report.of(path)
  t.equal(r.error, nil)
  t.equal(#r.parsed.overlaps, 100)
  t.ok(r.parsed.more_overlaps)
  t.equal(table.concat(r.parsed.overlaps[40], " "), "c2 c3")
end)

test("the best epsilon is found among any number of measures", function(t)
  local lines = {}
  for line in io.lines "tests/data/seeds/grasps.jsonl" do lines[#lines + 1] = line end
  local measures = {}
  for i = 1, 400 do measures[i] = ('"m%d":%d'):format(i, i) end
  measures[401] = '"epsilon":0.5'
  lines[2] = lines[2]:gsub('"measures":%b{}', function() return '"measures":{' .. table.concat(measures, ",") .. "}" end)
  local r = report.of(test.path(".jsonl", table.concat(lines, "\n") .. "\n"))
  t.equal(r.error, nil)
  t.ok(r.parsed.more.measures > 290)
  t.equal(r.parsed.best_epsilon, 0.5)
end)

test("world:colliding returns the first pairs, up to max", function(t)
  local world = clench.world()
  for i = 1, 4 do world:add_obstacle("models/objects/cube.iv", {name = "c" .. i}) end
  local function names(...)
    local out = {}
    for i, pair in ipairs(world:colliding(...)) do out[i] = pair[1].name .. pair[2].name end
    return table.concat(out, " ")
  end
  local all = "c1c2 c1c3 c1c4 c2c3 c2c4 c3c4"
  t.equal(names(), all)
  t.equal(names(nil, nil, {max = 4}), all:sub(1, 19))
  t.equal(names(nil, nil, {max = 0}), "")
  t.equal(names(nil, nil, {max = 7}), all)
  t.equal(names(nil, nil, {}), all)
  t.equal(names(nil, world.bodies[4]), "c1c4 c2c4 c3c4")
  t.equal(names(world.bodies[2], nil, {max = 2}), "c2c1 c2c3")
  t.fails(function() world:colliding(nil, nil, {max = -1}) end, "world:colliding: max must be >= 0, got -1")
  t.fails(function() world:colliding(nil, nil, {min = 1}) end, "unknown key 'min'")
end)

test("overlaps of thousands of bodies take one sweep", function(t)
  local cell = {}
  for i = 1, 6000 do
    cell[i] = ("<body pos='%g %g 0'><freejoint/><geom type='box' size='.1 .1 .1'/></body>"):format(i % 80, i // 80)
  end
  cell[6001] = "<body name='last' pos='1 0 0'><freejoint/><geom type='box' size='.2 .2 .2'/></body>"
  local path = test.path(".xml", "<mujoco><worldbody>" .. table.concat(cell) .. "</worldbody></mujoco>")
  local began = clench.clock()
  local world = clench.load(path)
  local loading = clench.clock() - began
  local r = report.of(path)
  t.equal(r.error, nil)
  t.equal(#r.parsed.overlaps, 1)
  t.equal(r.parsed.overlaps[1][2], "last")
  -- separate queries for each body took 50 times as long as reading
  t.ok(clench.clock() - began < 10 * loading + 5, "quadratic")
  t.equal(#world.objects, 6001)
end)

test("a fault is one sentence, and the log is restored", function(t)
  local r = report.of "no/such.wld"
  t.equal(r.parsed, nil)
  t.ok(r.error:find("no such file: no/such.wld", 1, true))
  local heard
  clench.log.sink(function(_, text) heard = text end)
  report.of "tests/data/bad/wld/empty.wld"
  clench.log.sink()
  t.equal(heard, nil)
end)

test("implausible values that are used unchanged are suspicious", function(t)
  local r = report.of(test.path(".wld", "Camera\n0 0 0 0 0 0 1\n"))
  t.equal(r.error, nil)
  t.equal(#r.suspicious, 1)
  t.ok(r.suspicious[1]:find "first line")
end)

test("eigengrasps and virtual contacts are reported with their counts", function(t)
  local folder = test.path()
  local hand = clench.world():add_robot "models/hands/barrett/barrett.cfg"
  local egr, vgr = folder .. ".egr", folder .. ".vgr"
  hand.eigengrasps:save(egr)
  hand:save_virtual_contacts(vgr)
  local grasps, contacts = report.of(egr), report.of(vgr)
  t.equal(grasps.error, nil)
  t.equal(grasps.parsed, {dofs = 4, count = #hand.eigengrasps.vectors})
  t.equal(contacts.error, nil)
  t.equal(contacts.parsed, {count = #hand.virtual_contacts, robot = hand.name})
end)

-- report on a file with that text
local function report_of(ending, text)
  return report.of(test.path(ending, text))
end

test("files of numbers are reported with their counts", function(t)
  local path = test.path()
  clench.files.save_pregrasps(path, {{point = {0, 0, 0}, direction = {0, 0, 1}, thumb = {1, 0, 0}}})
  t.equal(report.of(path).parsed, {count = 1})
  clench.files.save_text(path, "0 0 0 1 0 0 0 0 0.25\n0 0 0 0 0 0 0 0 -2\n0 0 0 1 0 0 0 0 0.5\n")
  t.equal(report.of(path).parsed, {count = 2, runs = 2, best = 0.5})
  clench.files.save_object_contacts(path, {{frame = {}, normal = {0, 0, 1}}})
  t.equal(report.of(path).parsed, {count = 1, placed = true})
  local glove = report_of(".txt", "2 3\n1 2 3\n4 5 6\n7 8\n")
  t.equal(glove.kind, "glove calibration")
  t.equal(glove.parsed, {dofs = 2, sensors = 3})
  local poses = report_of("", "1\n2\n-1\n1 7 8\n0\n0\n0 0 0 1\n1 2 3\n")
  t.equal(poses.kind, "glove poses")
  t.equal(poses.parsed, {count = 1, sensors = 2, joints = 0})
  t.ok(report_of(".txt", "2 2\n1 2\n").error:find "got the end of the file")
end)

test("inferred, repaired, ignored and suspicious data are separate lists", function(t)
  local r = report_of(".iv", [[
#Inventor V2.1 ascii
#youngs 3
Units { units FEET }
Whirl { }
Coordinate3 { point [0 0 0, 9 0 0, 0 9 0, 0 0 9] }
IndexedFaceSet { coordIndex [0 1 2 -1 0 3 1 -1 0 2 3 -1 1 3 2 -1] }]])
  t.equal(r.error, nil)
  t.ok(#r.inferred == 3 and r.inferred[1]:find "Units FEET" and r.inferred[2]:find "no mass and no material is given")
  t.ok(r.inferred[3]:find "no inertia is given")
  t.ok(#r.repaired == 1 and r.repaired[1]:find "flipped to face outward")
  t.ok(#r.ignored == 1 and r.ignored[1]:find "Whirl")
  t.ok(#r.suspicious == 1 and r.suspicious[1]:find "youngs")
end)

-- all sentences of a kind
local function told(r, kind) return table.concat(r[kind], "\n") end

local function has(t, text, part) t.ok(text:find(part, 1, true), text) end

test("eigengrasps and virtual contacts that no file gives are reported as inferred", function(t)
  local finger = [[<link name="%s"><inertial><mass value="0.1"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-5" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0 0 0.05"/><geometry><box size="0.02 0.02 0.1"/></geometry></collision></link>]]
  local joint = [[<joint name="%s" type="revolute"><parent link="palm"/><child link="%s"/><origin xyz="%g 0 0.06"/><axis xyz="0 %d 0"/>
<limit lower="-0.2" upper="1.5" effort="1" velocity="1"/></joint>]]
  local path = test.path(".urdf", ([[<robot name="hand"><link name="palm"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>]]
    .. finger .. finger .. joint .. joint .. "</robot>"):format("left", "right", "j1", "left", -0.05, 1, "j2", "right", 0.05, -1))
  local r = report.of(path)
  has(t, told(r, "inferred"), ".urdf: no eigengrasps are given; each of its 2 DOFs counts as one")
  has(t, told(r, "inferred"), (".urdf: no virtual contacts are given; %d are found"):format(r.parsed.virtual_contacts))
  t.equal(r.parsed.virtual_contacts, 3)
  local hand = clench.world():add_robot(path)
  t.equal(hand.has_own_virtual_contacts, false)
  hand.virtual_contacts = {}
  t.equal(hand.has_own_virtual_contacts, true)
  -- values that files give are not inferred
  t.ok(not told(report.of "models/hands/barrett/barrett.cfg", "inferred"):find "are given", "barrett")
end)

test("masses of obstacles are MuJoCo's, or reported as assumed", function(t)
  local r = report_of(".xml", [[<mujoco><worldbody><geom name="table" type="box" size="0.2 0.2 0.2"/>
<body name="wall"><geom type="box" size="0.1 0.1 0.1" mass="7"/></body>
<body name="cube" pos="0 0 1"><freejoint/><geom type="box" size="0.02 0.02 0.02" mass="4000"/></body></worldbody></mujoco>]])
  t.close(r.parsed.obstacles[1].mass, 64, 1e-9)
  t.close(r.parsed.obstacles[2].mass, 7, 0)
  has(t, told(r, "suspicious"), "'cube': its mass of 4000 kg makes 6.25e+07 kg/m^3: is its unit right?")
  local box = test.path(".off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
  local world = report_of(".xml", "<world><obstacle><filename>" .. box .. "</filename></obstacle></world>")
  has(t, told(world, "inferred"), "no mass and no material is given; 0.3 kg of wood is assumed")
  t.ok(not told(world, "inferred"):find "inertia", told(world, "inferred"))
end)

test("five files with swapped or contradictory values are repaired or suspicious", function(t)
  local body = [[<link name="%s"><inertial><origin xyz="0 0 %g"/><mass value="%g"/><inertia ixx="%g" iyy="%g" izz="%g" ixy="0" ixz="0" iyz="0"/>
</inertial><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>]]
  local function urdf(link, low, high)
    return report_of(".urdf", '<robot name="a">' .. body:format("b", 0, 1, 1e-3, 1e-3, 1e-3) .. body:format("f", table.unpack(link)) ..
      ([[<joint name="j" type="revolute"><parent link="b"/><child link="f"/><origin xyz="0 0 0.2"/><axis xyz="0 1 0"/>
<limit lower="%g" upper="%g" effort="1" velocity="1"/></joint></robot>]]):format(low, high))
  end
  local good = {0, 0.5, 1e-3, 1e-3, 1e-3}
  t.equal(told(urdf(good, -0.2, 1.5), "suspicious"), "")
  has(t, told(urdf(good, 1.5, -0.2), "repaired"), "joint 'j': lower 1.5 exceeds upper -0.2; they are exchanged")
  has(t, told(urdf(good, 0, 90), "suspicious"), "joints that turn more than four times: 'j'")
  has(t, told(urdf({50, 0.5, 1e-3, 1e-3, 1e-3}, 0, 1), "suspicious"), "center of mass is far from their surface: 'a_f'")
  has(t, told(urdf({0, 0.5, 5, 5, 5}, 0, 1), "suspicious"), "parts with the inertia of a much larger body: 'a_f'")
  has(t, told(urdf({0, 500, 1, 1, 1}, 0, 1), "suspicious"), "parts ten times denser than any metal, or lighter than air: 'a_f'")
  has(t, told(urdf({0, 0.5, 1e-3, 1e-3, 5e-3}, 0, 1), "repaired"), "one moment exceeds the sum of the others")
end)

test("primitives of an object are counted", function(t)
  local r = report_of(".iv", "#Inventor V2.1 ascii\nSeparator { Cube { } Translation { translation 9 0 0 } Cube { } Sphere { } }")
  t.equal(r.parsed.primitives, {box = 2, sphere = 1})
end)

test("data of a robot without effect are kept, and reported", function(t)
  local folder = test.folder()
  assert(os.execute("mkdir " .. folder .. "/iv"))
  local function write(name, text) clench.files.save_text(folder .. "/" .. name, text) end
  write("iv/part.iv", "#Inventor V2.1 ascii\n#useFlockOfBirds 4\nCube { }")
  write("glove.txt", "1 2\n0.1 0.2\n0.3\n")
  write("hand.xml", [[<robot type="Hand">
    <palm>part.iv</palm>
    <dof type="r"><defaultVelocity>1</defaultVelocity></dof>
    <chain>
      <joint type="Revolute"><theta>d0</theta><d>0</d><a>50</a><alpha>0</alpha><minValue>0</minValue><maxValue>90</maxValue></joint>
      <link dynamicJointType="Revolute">part.iv</link>
      <filter params="0,0,0,1,2,3">0</filter>
    </chain>
    <cyberGlove>glove.txt</cyberGlove>
    <flockOfBirds number="2"/>
    <tendon name="flexor"><stiffness>2</stiffness>
      <insertionPoint><chain>-1</chain><link>-1</link><position>0 0 0</position></insertionPoint>
      <insertionPoint><chain>0</chain><link>0</link><position>1 0 0</position></insertionPoint>
    </tendon>
    <tendonWrapper><chain>0</chain><link>0</link><position>0 0 0</position><orientation>0 0 1</orientation><radius>3</radius>
      <wrapping_side tendon="flexor"><orientation>1 0 0</orientation></wrapping_side></tendonWrapper>
  </robot>]])
  local path = folder .. "/hand.xml"
  local r, hand = report.of(path), clench.world():add_robot(path)
  local json = clench.json.encode(r)
  t.equal(r.error, nil)
  t.equal(r.parsed.kept, {tendons = {"flexor"}, tendon_wrappers = 1, tactile_sensors = 1, glove = {dofs = 1, sensors = 2}, tracker = 2})
  t.ok(json:find('"tendons":["flexor"]', 1, true), json)
  t.equal(r.parsed.base.tracker, 4)
  local tendon, wrapper, sensor = hand.tendons[1], hand.tendon_wrappers[1], hand.tactile_sensors[1]
  t.equal(tendon.stiffness, 2000)
  t.ok(tendon.points[1].link == hand.base and tendon.points[2].link == hand.links[1])
  t.close(tendon.points[2].point, {0.001, 0, 0}, 1e-18)
  t.ok(wrapper.link == hand.links[1] and wrapper.sides[1].tendon == "flexor")
  t.close(wrapper.radius, 0.003, 1e-18)
  t.ok(sensor.link == hand.links[1])
  t.close(sensor.high, {0.001, 0.002, 0.003}, 1e-18)
end)

test("of many DOFs of a list of grasps the first are listed, and the others counted", function(t)
  for _, named in ipairs {true, false} do
    local names, row = {"x [m],y [m],z [m],qw,qx,qy,qz"}, {"0,0,0,1,0,0,0"}
    for i = 1, 130 do names[#names + 1], row[#row + 1] = (named and "dof d%d [rad]" or "dof_%d [rad]"):format(i), "0." .. i end
    local r = report.of(test.path(".csv", table.concat(names, ",") .. "\n" .. (table.concat(row, ",") .. "\n"):rep(2)))
    t.equal(r.error, nil)
    t.equal(#r.parsed.dofs, 100)
    t.equal(r.parsed.more, {dofs = 30, measures = 0, notes = 0})
    t.equal(r.parsed.dofs[100], {name = named and "d100" or "DOF 100", low = 0.1, high = 0.1, count = 2})
  end
end)
