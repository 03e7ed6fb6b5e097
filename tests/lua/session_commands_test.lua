-- Commands of a session: their descriptions, gestures, playback, planners as jobs.
local test, clench = require "test", require "clench"
local arguments = require "clench.session.arguments"
local loop = clench.loop

local function opened()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  return session
end

local function replayed(session) return assert(load(session:script() .. "\nreturn world", "=script", "t"))() end

local function run_until(t, is_over)
  local last = loop.time() + 600
  while not is_over() and loop.time() < last do loop.run(0.02) end
  t.ok(is_over())
end

local logged_by_result = {["body.place_on"] = true, ["grasp.apply"] = true, ["sensors.apply"] = true, ["sensors.pull"] = true}

test("every command is described: label, parameters with a text, and a unique shortcut", function(t)
  local session, shortcuts = clench.session(), {}
  t.ok(#session.order > 45, #session.order)
  for _, name in ipairs(session.order) do
    local command = session.commands[name]
    arguments.check_command(command)
    t.ok(type(command.label) == "string" and #command.label > 0, name)
    for _, parameter in ipairs(command.parameters or {}) do t.ok(type(parameter.text) == "string" and #parameter.text > 0, name .. ": " .. parameter.name) end
    if command.shortcut then
      t.equal(shortcuts[command.shortcut], nil, name)
      shortcuts[command.shortcut] = name
    end
    -- commands that change the world are logged, by their own lines or by their result
    t.ok(command.reads or command.script or logged_by_result[name], name)
  end
  t.equal(shortcuts["ctrl+g"], "grasp.autograsp")
  t.equal(shortcuts["ctrl+z"], "edit.undo")
  local names = {}
  for _, menu in ipairs(session:menus()) do
    for _, command in ipairs(menu.commands) do names[menu.name .. "/" .. command.label] = command.name end
  end
  t.equal(names["Grasp/Auto Grasp"], "grasp.autograsp")
  t.equal(names["Grasp/EigenGrasp Planner…"], "planner.anneal")
  t.equal(names["File/Save As…"], "world.save_as")
  local function nothing() end
  t.fails(function() session:command {name = "mine.a", run = nothing, shortcut = "ctrl+g"} end, "mine.a: shortcut: 'ctrl+g' belongs to grasp.autograsp")
  t.fails(function() session:command {name = "mine.a", run = nothing, shortcut = "Ctrl+J"} end, "mine.a: shortcut: expected a key in lower case")
  t.fails(function() session:command {name = "mine.a", run = nothing, shortcut = "shift+ctrl+j"} end, "in this order, got 'shift+ctrl+j'")
  t.fails(function() session:command {name = "mine.a", run = nothing, menu = "Grasp//Mine"} end, "mine.a: menu: expected a menu, or a menu and a submenu")
  t.fails(function() session:command {name = "mine.a", run = nothing, menu = "Grasp", section = "first"} end, "mine.a: section: expected a number, got 'first'")
  session:command {name = "mine.a", run = nothing, shortcut = "ctrl++"}
  session:command {name = "grasp.autograsp", run = nothing, shortcut = "ctrl+g", replace = true}
end)

test("commands evaluate the grasp like the functions", function(t)
  local session = opened()
  session:run "grasp.autograsp"
  local world, hand, mug = session.world, session.hand, session.object
  local grasp = clench.grasp(hand, mug)
  t.equal(session:run "grasp.quality", grasp:quality "epsilon")
  t.equal(session:run "grasp.measures".volume, grasp:quality_all().volume)
  t.equal(#session:run "grasp.contacts", #world:contacts(hand, mug))
  local weight = {0, 0, -9.81 * mug.mass, 0, 0, 0}
  t.close(session:run "grasp.forces".objective, grasp:contact_forces {load = weight}.objective, 1e-12)
  t.equal(session:run("grasp.stability", {max_force = 100}).status, grasp:equilibrium {load = weight, max_force = 100}.status)
  t.close(session:run "grasp.projection".volume, grasp:wrench_space():project {fixed = {tx = 0, ty = 0, tz = 0}}.volume, 1e-12)
  t.equal(session:run("body.distance", {a = "mug", b = "barrett"}), world:distance(mug, hand))
  t.equal(#session.history.done, 2)
  t.fails(function() clench.session(clench.world()):run "grasp.quality" end, "the command cannot run now: no object is current")
end)

test("a hand is cloned in its posture, without collisions with the original", function(t)
  local session = opened()
  session:run "grasp.autograsp"
  local hand = session.hand
  local copy = session:run "grasp.clone_hand"
  t.equal(copy.name, hand.name .. "_2")
  t.equal(copy.dofs, hand.dofs)
  t.equal(copy.pose, hand.pose)
  t.equal(session.world:may_collide(hand, copy), false)
  t.equal(session.hand, hand)
  t.equal(session:run("grasp.clone_hand").name, hand.name .. "_3")
  t.equal(replayed(session):hash(), session.world:hash())
  session:undo()
  session:undo()
  t.equal(#session.world.robots, 1)
end)

test("collisions are switched for the world, a body, a pair and the selection, and back", function(t)
  local session = opened()
  local world = session.world
  local first = world:hash()
  session:run "body.collisions"
  t.equal(world:may_collide(), false)
  session:run "body.collisions"
  t.equal(world:hash(), first)
  session:run("world.select", {addresses = {"mug", "barrett"}})
  session:run "body.collisions"
  t.equal(world:may_collide(session.object, session.hand), false)
  t.equal(world:may_collide(), true)
  session:run("body.collisions", {body = "mug", on = false})
  t.equal(world:may_collide(session.object), false)
  t.equal(replayed(session):hash(), world:hash())
  for _ = 1, 4 do session:undo() end
  t.equal(world:hash(), first)
  -- a pair of which one is missing is not taken for the complete world
  session.selection = {}
  t.fails(function() session:run("body.collisions", {other = "mug"}) end, "other: expected exactly one body as the first of the pair, got 0")
  session:run("world.select", {addresses = {"mug", "barrett"}})
  t.fails(function() session:run("body.collisions", {other = "mug"}) end, "other: expected exactly one body as the first of the pair, got 2")
  t.equal(world:hash(), first)
end)

test("commands act on the selection", function(t)
  local session = opened()
  t.fails(function() session:run "body.remove" end, "expected a body or robot, as nothing is selected")
  session:run("world.import_obstacle", {path = "models/objects/plate.iv", options = {pose = {xyz = {1, 0, 0}}}})
  session:run("world.select", {addresses = {"plate", "mug"}})
  session:run("body.material", {material = "rubber"})
  t.ok(session:find "plate".material == "rubber" and session.object.material == "rubber")
  session:run "body.remove"
  t.equal(#session.world.bodies, #session.hand.bodies)
  t.equal(#session.selection, 0)
  t.equal(replayed(session):hash(), session.world:hash())
  session:undo()
  t.equal(#session.selection, 2)
  t.fails(function() session:run("grasp.select_object", {object = "plate"}) end, "expected an object, got 'plate', of kind obstacle")
  t.fails(function() session:run("grasp.select_hand", {hand = "mug"}) end, "expected a robot, got the body 'mug'")
end)

test("postures are saved and restored", function(t)
  local session = opened()
  t.fails(function() session:run "grasp.restore_posture" end, "no posture of 'barrett' was saved")
  session:run "grasp.autograsp"
  local hash = session.world:hash()
  session:run "grasp.save_posture"
  session:run "grasp.open"
  session:run("body.move", {body = "barrett", pose = {xyz = {1, 1, 1}}})
  session:run "grasp.restore_posture"
  t.equal(session.world:hash(), hash)
  t.equal(replayed(session):hash(), hash)
end)

test("closing with motors holds an object that falls out of a hand closed by motion", function(t)
  local gravity = {0, 0, -9.81}
  local session = opened()
  local function height() return session.object.pose.position.z end
  local first = session.world:hash()
  session:run("world.settings", {gravity = {0, 0, 0}})
  local weightless = session.world:hash()
  session:run "dynamics.close_hand"
  t.ok(session.world:hash() ~= weightless)
  session:undo()
  t.equal(session.world:hash(), weightless)
  session:redo()
  session:run("dynamics.run", {seconds = 2})
  session:run("world.settings", {gravity = gravity})
  local held = height()
  session:run("dynamics.run", {seconds = 0.5})
  t.ok(math.abs(height() - held) < 0.01, height() - held)
  t.equal(replayed(session):hash(), session.world:hash())
  for _ = 1, 5 do session:undo() end
  t.equal(session.world:hash(), first)
  session:run "grasp.autograsp"
  local before = height()
  session:run("dynamics.run", {seconds = 0.5})
  t.ok(before - height() > 1, before - height())
end)

test("a gesture is one step of undo, logged as its result", function(t)
  local session = opened()
  local mug, first = session.object, session.world:hash()
  local labels = {}
  session:subscribe("changed", function(value) labels[#labels + 1] = value.gesture end)
  session:begin_gesture "Drag"
  for i = 1, 20 do mug:move_to(clench.pose {xyz = {0.002 * i, 0, 0}} * mug.pose) end
  t.ok(session:is_modified())
  session:end_gesture()
  local dragged = session.world:hash()
  t.equal(labels, {"Drag"})
  t.equal(#session.history.done, 2)
  t.equal(replayed(session):hash(), dragged)
  t.equal(session:undo(), "Drag")
  t.equal(session.world:hash(), first)
  session:redo()
  t.equal(session.world:hash(), dragged)
  -- joints that have left their DOFs are part of the result
  session:begin_gesture "Close"
  session.hand:autograsp()
  session.hand:move_to(clench.pose {xyz = {0, 0, -0.01}} * session.hand.pose)
  session:run("body.mass", {body = "mug", mass = 0.3})  -- another command ends it
  t.equal(session.gesture, nil)
  t.equal(#session.history.done, 4)
  t.equal(replayed(session):hash(), session.world:hash())
  local before = session.world:hash()
  session:begin_gesture "Cancelled"
  mug.pose = {xyz = {9, 9, 9}}
  session:cancel_gesture()
  t.equal(session.world:hash(), before)
  session:begin_gesture "Nothing"
  session:end_gesture()
  t.equal(#session.history.done, 4)
  -- a result that cannot be logged is reverted
  session:begin_gesture "Gravity"
  session.world.gravity = {0, 0, 0}
  t.fails(function() session:end_gesture() end, "needs a field script")
  t.equal(session.world:hash(), before)
  session:end_gesture()
  session:begin_gesture "Undone"
  mug.pose = {xyz = {9, 9, 9}}
  t.equal(session:run "edit.undo", "Undone")
  t.equal(session.world:hash(), before)
  session:run "edit.redo"
  t.equal(mug.pose.position.x, 9)
  t.fails(function() session:run "edit.redo" end, "there is nothing to redo")
  t.fails(function() clench.session():run "edit.undo" end, "there is nothing to undo")
  t.fails(function() opened():run "edit.undo" end, "there is nothing to undo")
  session:command {name = "mine.undo", run = function(s) s:undo() end}
  t.fails(function() session:run "mine.undo" end, "session:undo: a command is running")
end)

test("joints that have left their DOFs are part of the result of a gesture", function(t)
  local world = clench.world()
  local hand = world:add_robot "models/hands/barrett/barrett.cfg"
  -- a rod in the path of the first link of the third finger
  hand:set_dofs {0, 0, 0, 1.6}
  local bounds = hand.chains[3].links[1].bounds_in_world
  hand:set_dofs {0, 0, 0, 0}
  world:add_obstacle(clench.shapes.box {0.02, 0.005, 0.005}, {pose = {xyz = (bounds.low + bounds.high) / 2}})
  local session, first = clench.session(world), world:clone()
  session:begin_gesture "Drag"
  hand:autograsp()
  t.ok(hand.chains[3].joints[1].broken_away)
  session:end_gesture()
  local lines = session.history.done[1].lines
  t.ok(lines:find "joint_positions", lines)
  assert(load("local clench, world = ... " .. lines, "=script", "t"))(clench, first)
  t.equal(first:hash(), world:hash())
end)

test("dynamics run in real time, are one step of undo, and are logged as their steps", function(t)
  local session = opened()
  local first, events = session.world:hash(), 0
  session:subscribe("changed", function(value) events = events + (value.playing and 1 or 0) end)
  session:run("dynamics.play", {speed = 2})
  run_until(t, function() return events >= 3 and session.world.time > 0.01 end)
  session:run "dynamics.pause"
  local last, time = session.world:hash(), session.world.time
  loop.run(0.03)
  t.equal(session.world.time, time)
  t.equal(#session.history.done, 2)
  t.ok(session:script():find "for _ = 1, %d+ do world:run%(0.001%) end", session:script())
  t.equal(replayed(session):hash(), last)
  t.equal(session:undo(), "Play")
  t.equal(session.world:hash(), first)
  t.fails(function() session:run "dynamics.pause" end, "the simulation is not playing")
  -- a key toggles it, and an error ends it
  session:run "dynamics.play"
  session:run "dynamics.play"
  t.equal(session.playing, nil)
  t.equal(#session.history.done, 1)
  local told
  session:subscribe("diagnostic", function(value) told = value.text end)
  session.world:on_step(function() error "no more" end)
  session:run "dynamics.play"
  run_until(t, function() return told ~= nil end)
  t.ok(told:find "no more" and session.playing == nil, told)
end)

test("grasps of a search that was stopped are sorted by epsilon, too", function(t)
  local session = opened()
  local found = session:run("planner.sample", {refine = 0, verify = false, candidates = 1000000, count = 100000})
  run_until(t, function() return #session:grasps_of(found) >= 8 end)
  found:stop()
  t.ok(found:wait(20))
  local list = session:grasps_of(found)
  for i = 2, #list do t.ok(list[i - 1].epsilon >= list[i].epsilon, i) end
  t.ok(list[1].epsilon > list[#list].epsilon)
end)

test("planners are jobs of the session, with progress, grasps and results, and can be stopped, paused and resumed", function(t)
  local session = opened()
  local options = {count = 2, candidates = 64, refine = 0, seed = 3, verify = false}
  local progress, over = 0, nil
  session:subscribe("progress", function(value) progress = progress + (value.command == "planner.sample" and 1 or 0) end)
  session:subscribe("result", function(value) if value.state then over = value end end)
  local first = session.world:hash()
  local job = session:run("planner.sample", options)
  t.ok(session.jobs[1] == job)
  run_until(t, function() return over ~= nil end)
  t.equal(over.state, "done")
  t.equal(session.world:hash(), first)
  options.hand, options.object = session.hand, session.object
  local blocking = clench.plan.sample(options)
  local grasps = session:grasps_of(job)
  t.equal(#grasps, #blocking.grasps)
  for i, grasp in ipairs(grasps) do t.equal(grasp.dofs, blocking.grasps[i].dofs) end
  session:run "grasp.apply"
  t.ok(session.world:hash() ~= first)
  t.equal(replayed(session):hash(), session.world:hash())
  t.fails(function() session:run("grasp.apply", {rank = 9}) end, "rank: expected 1 to 2, the number of grasps of job 'plan.sample', got 9")
  t.fails(function() session:run("grasp.apply", {grasp = 3}) end, "grasp: expected a grasp")
  session:undo()
  t.equal(session.world:hash(), first)
  local endless = session:run("planner.anneal", {energy = "contact", steps = 100000000})
  run_until(t, function() return endless.state == "running" end)
  session:run "job.pause"
  t.equal(endless.state, "paused")
  session:run "job.resume"
  session:run "job.stop"
  t.ok(endless:wait(20))
  t.equal(endless.state, "stopped")
  loop.run()
  t.fails(function() session:run("job.stop", {job = 3}) end, "job: expected 1 to 2, got 3")
  t.fails(function() clench.session():run "job.stop" end, "no job was started")
  t.fails(function() session:run("planner.sample", {contacts = "fingertp"}) end, "contacts: expected fingertip, power, any, got 'fingertp'; did you mean 'fingertip'?")
  t.fails(function() session:run("planner.sample", {count = 0}) end, "count: expected a number from 1 to 1e+06, got 0")
  t.fails(function() session:grasps_of(3) end, "session:grasps_of: expected one of session.jobs, got 3")
  t.fails(function() session:add_job(3) end, "session:add_job: expected a job, got 3")
end)

test("messages of a command become diagnostics if there is a receiver", function(t)
  local session = opened()
  session:command {name = "mine.warn", reads = true, run = function() clench.log.warning "too thin" return 7 end}
  local list = {}
  local off = session:subscribe("diagnostic", function(value) list[#list + 1] = value end)
  t.equal(session:run "mine.warn", 7)
  t.equal(#list, 1)
  t.ok(list[1].severity == "warning" and list[1].text == "too thin")
  off()
  local printed = clench.log.collect(function() session:run "mine.warn" end)
  t.equal(#printed, 1)
  t.equal(#list, 1)
end)

test("files are checked, converted, saved and drawn by commands", function(t)
  local session = opened()
  local folder = test.folder()
  t.equal(session:run("world.save_as", {path = folder .. "/world"}), folder .. "/world.wld")
  t.equal(session.path, folder .. "/world.wld")
  t.equal(session:run("file.check", {path = "models/objects/mug.iv"}).kind, "body")
  t.equal(session:run("file.convert", {from = "models/objects/mug.iv", to = folder .. "/mug.stl"}), "body")
  t.equal(#session.history.done, 1)
  t.ok(not session:is_modified())
end)

test("a hand is mounted on an arm and dismounted like by the functions, and the script repeats it", function(t)
  local session = clench.session()
  session:run "world.new"
  t.equal({session.commands["body.mount"].enabled(session)}, {false, "there is no other robot"})
  session:run("world.import_robot", {path = "models/arms/ur5/ur5.cfg"})
  session:run("world.import_robot", {path = "models/hands/parallel_jaw/parallel_jaw.cfg", options = {pose = {xyz = {0.5, 0.5, 0}}}})
  local arm, hand = session.world.robots[1], session.world.robots[2]
  t.equal({session.commands["body.dismount"].enabled(session)}, {false, "no robot is mounted"})
  session:run("body.mount", {on = arm.name, pose = {xyz = {0, 0, 0.01}}})
  t.equal(hand.parent == arm, true)
  local other = clench.world()
  local other_arm, other_hand = other:add_robot "models/arms/ur5/ur5.cfg", other:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
  other_hand:mount_on(other_arm, {pose = {xyz = {0, 0, 0.01}}})
  t.equal(hand.pose == other_hand.pose, true)
  t.equal(replayed(session):hash(), session.world:hash())
  local mounted = hand.pose
  session:run "body.dismount"
  t.equal(hand.parent, nil)
  t.equal(hand.pose == mounted, true)
  t.equal(replayed(session):hash(), session.world:hash())
  t.fails(function() session:run("body.mount", {on = hand.name}) end, "body.mount: on: expected another robot than '" .. hand.name .. "'")
end)

-- a world with a table, whose top is 550 mm square and 450 mm high
local function at_a_table()
  local session = clench.session()
  session:run "world.new"
  session:run("world.import_obstacle", {path = "models/obstacles/table.iv", place = "free"})
  return session
end

local function inside(bounds, other)
  return bounds.low.x >= other.low.x and bounds.high.x <= other.high.x and bounds.low.y >= other.low.y and bounds.high.y <= other.high.y
end

test("imported bodies are placed where they are free, resting on the table, and the script repeats it", function(t)
  local session = at_a_table()
  local world = session.world
  for _, name in ipairs {"mug", "glass", "mug", "box", "banana"} do
    local path = ("models/objects/%s.iv"):format(name)
    local messages = clench.log.collect(function()
      local body = session:run("world.import_object", {path = path, place = "free"})
      local bounds = body.bounds_in_world
      t.ok(inside(bounds, world:body "table".bounds_in_world), body.name)
      t.close(bounds.low.z, 0.45, 2 * world.contact_threshold)
      t.ok(#world:contacts(body, world:body "table") > 0, body.name)
    end)
    t.ok(tostring(messages[1].message or messages[1].text):find "rests on 'table'", path)
  end
  t.equal(#world:colliding(), 0)
  -- what is at the origin stays there if it is free; what is not free goes elsewhere
  local hand = session:run("world.import_robot", {path = "models/hands/barrett/barrett.cfg", place = "free"})
  t.equal(#world:colliding(hand), 0)
  session:run("world.import_object", {path = "models/objects/mug.iv", pose = {xyz = {1, 0, 2}}, place = "free"})
  t.close(session.object.pose.position, {1, 0, 2}, 1e-12)
  session:run("world.import_object", {path = "models/objects/plate.iv", place = "free"})
  t.equal(#world:colliding(), 0)
  local again = load(session:script() .. "\nreturn world")()
  t.equal(again:hash(), world:hash())
  t.fails(function() session:run("world.import_object", {path = "models/objects/mug.iv", place = "fre"}) end, "place: expected origin, free, got 'fre'")
  -- by default it stays at the origin, as in scripts until now
  local before = #world.objects
  session:run("world.import_object", {path = "models/objects/mug.iv"})
  t.close(world.objects[before + 1].pose.position, {0, 0, 0}, 1e-12)
end)

test("bodies are put on others: straight down, or at the nearest free spot", function(t)
  local session = at_a_table()
  local world = session.world
  local cube = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "cube", pose = {xyz = {0.05, -0.02, 0.9}}})
  local ball = world:add_object(clench.shapes.sphere {0.05}, {name = "ball", pose = {xyz = {0.05, -0.02, 0.7}}})
  t.equal(session:run("body.place_on", {body = "ball"}) == world:body "table", true)
  t.close(ball.pose.position, {0.05, -0.02, 0.5}, 2 * world.contact_threshold)
  -- the cube's bottom rests on the top of the ball below it
  session:run("world.select", {addresses = {"cube"}})
  t.equal(session:run "body.place_on" == ball, true)
  t.close(cube.pose.position, {0.05, -0.02, 0.6}, 2 * world.contact_threshold)
  -- on the table, it is beside the ball
  session:run("body.place_on", {body = "cube", on = "table"})
  t.close(cube.pose.position.z, 0.5, 2 * world.contact_threshold)
  t.ok(world:distance(cube, ball) > 0)
  t.ok(inside(cube.bounds_in_world, world:body "table".bounds_in_world))
  local hash = world:hash()
  session:undo()
  session:redo()
  t.equal(world:hash(), hash)
  local pose = cube.pose
  t.fails(function() session:run("body.place_on", {body = "table"}) end, "there is nothing below 'table'")
  t.fails(function() session:run("body.place_on", {body = "cube", on = "cube"}) end, "on: expected another body than 'cube'")
  cube.pose = ball.pose
  t.fails(function() session:run("body.place_on", {body = "cube"}) end, "'cube' overlaps 'ball': choose a body to put it on, or move it above")
  cube.pose = pose
  local slab = world:add_obstacle(clench.shapes.box {3, 3, 0.01}, {name = "roof", pose = {xyz = {0, 0, 0.47}}})
  t.fails(function() session:run("body.place_on", {body = "cube", on = "table"}) end, "there is no free spot on 'table' for 'cube'")
  world:remove(slab)
  session:run("world.select", {addresses = {"cube", "ball"}})
  t.fails(function() session:run "body.place_on" end, "expected one body or robot, got 2")
  -- an arm with its hand is put down as one
  local arm = clench.load("worlds/puma_barrett_glass.wld", {root = "."})
  local other = clench.session(arm)
  local hand, puma = other.hand, nil
  for _, robot in ipairs(arm.robots) do
    if robot.parent then hand = robot else puma = robot end
  end
  t.fails(function() other:run("body.place_on", {body = hand.name}) end, ("'%s' is mounted on '%s'"):format(hand.name, puma.name))
end)

test("the current hand of a world is its first robot with fingers, not the arm that carries it", function(t)
  local session = clench.session()
  session:open("worlds/puma_barrett_glass.wld", {root = "."})
  t.equal(session.world.robots[1].name, "puma560")
  t.equal(session.hand.name, "barrett")
  session:run("body.remove", {body = "barrett"})
  t.equal(session.hand.name, "puma560")
  session:undo()
  t.equal(session.hand.name, "barrett")
end)
