-- Mistakes of newcomers that the engine could accept silently: one warning, or one sentence that suggests the intended call.
local clench = require "clench"
local test = require "test"

test("degrees and millimeters in a pose are reported once, with the script's line", function(t)
  local world = clench.world {}
  local box = clench.shapes.box {0.1, 0.1, 0.1}
  -- within a turn and ten meters nothing is reported
  t.equal(#t.warnings(function() clench.pose {rpy = {0, -6.28, 3}, xyz = {10, 0, -10}} end), 0)
  local said = t.warnings(function()
    for _ = 1, 2 do world:add_object(box, {pose = {rpy = {0, 0, 90}, xyz = {300, 0, 0}}}) end
    clench.pose {axis = {0, 0, 1}, angle = 45}
    world.objects[1].pose = {xyz = {0, 0, 1000}}
  end)
  t.equal(#said, 2)
  t.ok(said[1]:find("mistakes_test.lua:11: world:add_object: pose: rpy is 90: radians? clench.rad(90) is 1.571", 1, true), said[1])
  t.ok(said[2]:find("world:add_object: pose: it is 300 m away: meters? clench.mm(300) is 0.3", 1, true), said[2])
end)

test("a standoff in millimeters is reported, and so are the forms of a pose", function(t)
  local hand = clench.load("worlds/barrett_mug.wld").robots[1]
  t.fails(function() clench.pose {x = {1, 0, 0}} end,
          "unknown key 'x', expected one of axis, angle, x_axis, y_axis, z_axis, rpy, quat, matrix, xyz")
  t.fails(function() hand:link "fingr" end, "no link 'fingr', expected one of")
  local said = clench.parallel.map(function()
    local clench, said = require "clench", nil
    clench.log.sink(function(_, text) said = text end)
    clench.load("worlds/barrett_mug.wld").robots[1]:place_approach({0, 0, 0}, {0, 0, -1}, 50)
    return said
  end, {1})  -- in a separate state, because it is reported once per state
  t.ok(said[1]:find("hand:place_approach: standoff: it is 50 m away: meters? clench.mm(50) is 0.05", 1, true), said[1])
end)

test("a typo in the name of a material is reported once, and a new material is not", function(t)
  local said = t.warnings(function()
    local world = clench.world {}
    world:set_friction("cork", "wood", {static = 0.7})
    world:set_friction("rubber 2", "wood", {static = 0.7})
    world:set_friction("glas", "rubber", {static = 0.7})
    world:set_friction("glass", "rubber", {static = 0.7})
  end)
  t.equal(#said, 1)
  t.ok(said[1]:find("world:set_friction: 'glas' is a new material; did you mean 'glass'?", 1, true), said[1])
end)

test("an unknown key is answered with the nearest, or with all if these are few", function(t)
  local world = clench.load "worlds/dlr_flask.wld"
  local hand = world.robots[1]
  t.fails(function() hand:autograsp {sped = 1} end,
          "unknown key 'sped', expected one of speed, stop_at_contact, dofs, stages, dynamic; did you mean 'speed'?")
  t.fails(function() hand:approach_object {far = 1} end, "unknown key 'far', expected one of reach")
  t.fails(function() world:body "flsk" end, "did you mean 'flask'?")
  t.fails(function() world:robot "barrett" end, "no robot 'barrett' in this world, expected one of dlr")
  t.fails(function() clench.grasp(hand, world:body "flask"):quality "epsilom" end, "did you mean 'epsilon'?")
  t.fails(function() return hand.dof_limit end, "did you mean 'dof_limits'?")
  t.fails(function() clench.plan.sample {cuont = 1} end, "hand must be a robot, got nothing")
  t.fails(function() clench.plan.sample {hand = hand, object = world:body "flask", cuont = 1} end,
          "plan.sample: unknown key 'cuont', expected any of hand, object", "; did you mean 'count'?")
  t.fails(function() return clench.plan.sampel end, "plan: there is no 'sampel'", "; did you mean 'sample'?")
  local message = t.fails(function() clench.plan.anneal {hand = hand, object = world:body "flask", energy = "contct"} end,
                          "plan.anneal: energy: clench.energy has no 'contct'; did you mean 'contact'?")
  t.ok(not message:find("stdlib", 1, true), message)
  t.fails(function() return hand:link "chain3_lnik2" end, "no link 'chain3_lnik2'; did you mean 'chain3_link2'?")
  t.fails(function() return hand:link "dlr_chain3_lnik2" end, "; did you mean 'dlr_chain3_link2'?")
end)

test("an assignment to a name of a library is an error that explains the use of the name", function(t)
  local function fails(key, library, message) t.fails(function() library[key] = "error" end, message) end
  fails("level", clench.log, "clench.log.level cannot be set: it is a function; call clench.log.level(name)")
  fails("version", clench, "clench.version cannot be set: it is read only")
  fails("log", clench, "clench.log cannot be set: it is read only")
  fails("plan", clench, "clench.plan cannot be set: it is read only")
  fails("levle", clench.log, "clench.log has no 'levle' to set; did you mean 'level'?; a script keeps its values in its own variables")
  fails("mine", clench, "clench has no 'mine' to set; a script keeps its values in its own variables")
  fails(1, clench.json, "clench.json: expected a name to set, got a number")
  fails("box", clench.shapes, "clench.shapes.box cannot be set: it is a function; call it")
  fails("boxx", clench.shapes, "clench.shapes has no 'boxx' to set; did you mean 'box'?")
  fails("mean", clench.stats, "clench.stats.mean cannot be set: it is a function; call it")
  t.fails(function() return clench.stats.maen end, "clench.stats has no 'maen'; did you mean 'mean'?")
  t.equal(clench.log.level(), "info")
  -- the contents of libraries can be listed
  local names = {}
  for name, value in pairs(clench.log) do names[name] = type(value) end
  t.equal(names, {collect = "function", debug = "function", info = "function", warning = "function", error = "function", level = "function", sink = "function"})
  local seen = false
  for name in pairs(clench) do seen = seen or name == "load" end
  t.ok(seen)
end)

test("indexing a list of bodies or robots by a name is answered with the method that finds one", function(t)
  local world = clench.load("worlds/dlr_flask.wld")
  local hand = world.robots[1]
  local function fails(list, key, message) t.fails(function() return list[key] end, message) end
  fails(world.robots, "hand", "world.robots has no 'hand': it is a list; did you mean world:robot(\"hand\")?")
  fails(world.objects, "flask", "world.objects has no 'flask': it is a list; did you mean world:body(\"flask\")?")
  fails(world.obstacles, "name", "world.obstacles has no 'name': it is a list; did you mean world.obstacles[1].name?")
  fails(world.bodies, "count", "world.bodies has no 'count': it is a list; did you mean #world.bodies?")
  fails(world.robots, "autograsp", "world.robots has no 'autograsp': it is a list; did you mean world.robots[1]:autograsp?")
  fails(hand.links, "thumb", "hand.links has no 'thumb': it is a list; did you mean hand:link(\"thumb\")?")
  t.equal(#world.robots, 1)
  t.equal(world.robots[2], nil)
  t.equal(world.robots[0], nil)
  local count = 0
  for _ in ipairs(world.bodies) do count = count + 1 end
  for _ in pairs(world.bodies) do count = count + 1 end
  t.equal(count, 2 * #world.bodies)
  t.ok(tostring(world.robots):find "^{robot", tostring(world.robots))
end)

test("a posture beyond the limits is clamped and names the DOFs, and degrees cause a warning", function(t)
  local world = clench.load("worlds/barrett_mug.wld")
  local hand = world.robots[1]
  local stopped
  local told = t.warnings(function() stopped = hand:set_posture(hand.pose, {0, 60, 1, 60}) end)
  t.equal(stopped, {2, 4})
  t.equal(#told, 1)
  t.ok(told[1]:find("DOF 2 stops at 2.513 rad, 60 were asked for; degrees? clench.rad(60) is 1.047", 1, true), told[1])
  t.equal(hand:set_posture(hand.pose, {0, 1, 1, 1}), nil)
end)

test("an assignment to a part of a copied table is an error that suggests the correct form", function(t)
  local world = clench.load "worlds/dlr_flask.wld"
  local hand = world.robots[1]
  local before = hand.dofs
  t.fails(function() hand.dofs[2] = 0.3 end, "hand.dofs is a copy", "local copy = hand.dofs; copy[1] = ...; hand.dofs = copy")
  t.fails(function() hand.dofs [ #before ]=0.3 end, "hand.dofs is a copy")
  t.fails(function()
    world.robots[1].dofs[2] = 0.3
  end, "hand.dofs is a copy")
  t.fails(function() world.dynamics.time_step = 0.01 end, "world.dynamics is a copy")
  t.fails(function() hand.dofs[2] = hand.dofs[2] + 0.1 end, "hand.dofs is a copy")
  t.fails(function() load "local hand = ...; hand.dofs[1] = 1" (hand) end, "hand.dofs is a copy")
  t.equal(hand.dofs, before)
  -- values that only look like a mistake
  local own, list = {dofs = {}}, hand.dofs
  own.dofs[2], list[2] = hand.dofs[1], 0.3
  own.dofs[2] = hand.dofs[2]
  own.dofs = hand.dofs
  own.dofs[2] = 0.3
  if hand.dofs[2] == 0.3 then own.x = 1 end  -- hand.dofs[2] = 0.3
  own[hand.dofs[1]] = 1
  world.robots[1].dofs = list
  t.equal(hand.dofs[2], 0.3)
end)
