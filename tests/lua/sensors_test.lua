-- Devices of a session: its commands with simulated gloves, trackers and hands.
local test, clench = require "test", require "clench"
local loop = clench.loop
local simulated = clench.devices.simulated

local function opened()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  return session
end

local function run_until(t, is_over)
  local last = loop.time() + 60
  while not is_over() and loop.time() < last do loop.run(0.01) end
  t.ok(is_over())
end

-- connects a device and waits for its first reading
local function connect(t, session, kind, device)
  session:run("sensors.connect_" .. kind, {path = device.path})
  run_until(t, function() return session.sensors[kind].reading ~= nil end)
end

-- waits for a reading that was asked for after now
local function renew(t, session, kind)
  local sensor = session.sensors[kind]
  local count = sensor.count
  run_until(t, function() return sensor.count >= count + 2 end)
end

-- a calibration in a file: DOFs 2 and 3 by sensors 1 and 2, 0.01 rad per count
local function load_calibration(session)
  local path = test.path()
  clench.devices.save_calibration(path, {slopes = {{0.01, 0}, {0, 0.01}}, intercepts = {0.1, -0.2}})
  session:run("sensors.load_calibration", {path = path, dofs = {[2] = 1, [3] = 2}})
end

local function replayed(session) return assert(load(session:script() .. "\nreturn world", "=script", "t"))() end

local function angles_close(t, got, expected, tolerance)
  t.equal(#got, #expected)
  for d, value in ipairs(expected) do t.close(got[d], value, tolerance) end
end

test("a glove moves the hand by its calibration, as one step of undo", function(t)
  local session = opened()
  local before = session.world:hash()
  t.fails(function() session:run "sensors.apply" end, "neither a glove nor a tracker is connected")
  local device <close> = simulated.cyberglove {sensors = {20, 60}}
  connect(t, session, "glove", device)
  t.fails(function() session:run "sensors.apply" end, "calibration: expected {slopes, intercepts}, or a hand with a glove, got nothing")
  load_calibration(session)
  session:run "sensors.apply"
  t.close(session.hand.dofs[2], 0.3, 1e-9)
  t.close(session.hand.dofs[3], 0.4, 1e-9)
  t.equal(replayed(session):hash(), session.world:hash())
  t.equal(session:undo(), "Move Hand to Readings")
  t.equal(session.world:hash(), before)
  session:run("sensors.disconnect", {device = "glove"})
  t.equal(session.sensors.glove, nil)
end)

test("a hand that follows a glove and a tracker moves as they do, until it is stopped", function(t)
  local session = opened()
  local start, hash = session.hand.pose, session.world:hash()
  local glove <close> = simulated.cyberglove {sensors = {20, 60}}
  local tracker <close> = simulated.flock {poses = {clench.pose {xyz = {0.3, 0.1, 0.2}}}}
  connect(t, session, "glove", glove)
  connect(t, session, "tracker", tracker)
  load_calibration(session)
  session:run("sensors.tracker_mode", {mode = "relative"})
  session:run "sensors.follow"
  for i = 1, 3 do
    glove.sensors[1] = 20 + 10 * i
    tracker.poses[1] = clench.pose {xyz = {0.3, 0.1, 0.2 - 0.02 * i}}
    renew(t, session, "glove")
    renew(t, session, "tracker")
    loop.run(0.03)
    t.close(session.hand.dofs[2], 0.3 + 0.1 * i, 1e-9)
    -- along the hand's own z, away from the mug; a word of the tracker is 0.028 mm
    t.close((session.hand.pose.position - start * clench.vec3(0, 0, -0.02 * i)):norm(), 0, 1e-4)
  end
  session:run "sensors.follow"
  local last = session.hand.dofs
  glove.sensors[1] = 20
  renew(t, session, "glove")
  t.equal(session.hand.dofs, last)
  t.equal(session:undo(), "Follow Sensors")
  t.equal(session.world:hash(), hash)
  -- absolute: the reading itself, without the glove by collision-free travel
  session:run("sensors.disconnect", {device = "glove"})
  tracker.poses[1] = clench.pose {xyz = {0, 0, 0.5}} * start
  renew(t, session, "tracker")
  session:run("sensors.tracker_mode", {mode = "absolute"})
  session:run "sensors.apply"
  t.close((session.hand.pose.position - start.position - clench.vec3(0, 0, 0.5)):norm(), 0, 1e-4)
end)

test("postures that were recorded calibrate the glove: it then leads back to them", function(t)
  local session = opened()
  local device <close> = simulated.cyberglove {}
  connect(t, session, "glove", device)
  t.fails(function() session:run("sensors.calibrate", {sensors_of = {{1}}}) end, "fewer than two postures were recorded")
  local postures = {{0.1, 0.2, 0.3, 0.4}, {0.5, 0.7, 0.8, 0.9}}
  for i, dofs in ipairs(postures) do
    for s = 1, 4 do device.sensors[s] = 50 * i + s end
    renew(t, session, "glove")
    session.hand.dofs = dofs
    t.equal(session:run "sensors.record_posture", i)
  end
  session:run("sensors.calibrate", {sensors_of = {{1}, {2}, {3}, {4}}})
  session.hand.dofs = {0, 0, 0, 0}
  session:run "sensors.apply"
  angles_close(t, session.hand.dofs, postures[2], 1e-9)
  for s = 1, 4 do device.sensors[s] = 75 + s end
  renew(t, session, "glove")
  session.hand.dofs = {0, 0, 0, 0}
  session:run "sensors.apply"
  angles_close(t, session.hand.dofs, {0.3, 0.45, 0.55, 0.65}, 1e-9)
  local path = test.path()
  session:run("sensors.save_calibration", {path = path})
  t.close(clench.files.glove_calibration(path).slopes[2][2], 0.01, 1e-12)
  session:run "sensors.clear_postures"
  t.equal(#session.sensors.postures, 0)
end)

test("a real hand and the simulated one follow each other, and a stop ends the motion", function(t)
  local session = opened()
  local device <close> = simulated.barrett {}
  connect(t, session, "hand", device)
  session.hand.dofs = {0.2, 0.4, 0.5, 0.6}
  session:run("sensors.push", {max_speed = 10})
  t.fails(function() session:run "sensors.push" end, "the real hand is already moving")
  run_until(t, function() return session.sensors.hand.task == nil end)
  renew(t, session, "hand")
  angles_close(t, session.sensors.hand.reading, {0.2, 0.4, 0.5, 0.6}, 1e-3)
  session.hand.dofs = {0, 0, 0, 0}
  session:run "sensors.pull"
  angles_close(t, session.hand.dofs, {0.2, 0.4, 0.5, 0.6}, 1e-3)
  t.equal(session:undo(), "Simulated Hand to Real One")

  local stops = device.stops
  session.hand.dofs = {0.2, 1.4, 1.4, 1.4}
  session:run("sensors.push", {max_speed = 0.05})
  renew(t, session, "hand")
  session:run "sensors.stop"
  run_until(t, function() return device.stops > stops end)
  renew(t, session, "hand")
  local reading = session.sensors.hand.reading
  t.ok(reading[2] > 0.4 and reading[2] < 1, reading[2])
  renew(t, session, "hand")
  t.equal(session.sensors.hand.reading, reading)

  session:open("worlds/dlr_flask.wld", {root = "."})
  t.fails(function() session:run "sensors.pull" end, "the real hand has 4 DOFs, and dlr has 12")
end)

test("a real hand follows continuously, a drag once it has ended, until it is stopped", function(t)
  local session = opened()
  local device <close> = simulated.barrett {}
  connect(t, session, "hand", device)
  session:run("sensors.push", {max_speed = 10, continuous = true})
  local function arrives(finger)
    run_until(t, function() return math.abs(session.sensors.hand.reading[2] - finger) < 1e-3 end)
  end
  for _, finger in ipairs {0.4, 0.2} do
    session:run("grasp.dofs", {dofs = {0, finger, 0.1, 0.1}})
    arrives(finger)
  end
  -- within a gesture it stays
  session:begin_gesture "Drag"
  session.hand.dofs = {0, 0.6, 0.1, 0.1}
  renew(t, session, "hand")
  t.close(session.sensors.hand.reading[2], 0.2, 1e-3)
  session:end_gesture()
  arrives(0.6)
  session:run "sensors.stop"
  run_until(t, function() return session.sensors.hand.task == nil end)
  session:run("grasp.dofs", {dofs = {0, 0.1, 0.1, 0.1}})
  renew(t, session, "hand")
  t.close(session.sensors.hand.reading[2], 0.6, 1e-3)
end)

test("a device that does not answer stops nothing, and one that is lost is reported and can be connected again", function(t)
  local session = opened()
  local messages = {}
  session:subscribe("diagnostic", function(value) messages[#messages + 1] = value.text end)
  t.fails(function() session:run("sensors.connect_glove", {path = "/dev/no_such_line"}) end, "/dev/no_such_line: No such file or directory")
  local silent <close> = clench.port.pty()
  session:run("sensors.connect_glove", {path = silent.path})
  t.equal(session.sensors.glove.state, "connecting")
  t.fails(function() session:run "sensors.apply" end, "neither a glove nor a tracker is connected")

  local device <close> = simulated.cyberglove {}
  connect(t, session, "glove", device)
  device:unplug()
  run_until(t, function() return session.sensors.glove.state == "lost" end)
  t.ok(#messages == 1 and messages[1]:find "^the glove: devices%.cyberglove: .* is %a+$", messages[1])
  t.fails(function() session:run "sensors.apply" end, "neither a glove nor a tracker is connected")
  local other <close> = simulated.cyberglove {}
  connect(t, session, "glove", other)
  t.equal(session.sensors.glove.problem, nil)
  load_calibration(session)
  session:run "sensors.follow"
  other:unplug()
  run_until(t, function() return session.following == nil end)
  t.equal(messages[#messages], "session: the glove is lost")

  local broken <close> = simulated.cyberglove {}
  broken.state = 1
  session:run("sensors.connect_glove", {path = broken.path})
  run_until(t, function() return session.sensors.glove.state == "lost" end)
  t.equal(messages[#messages], "the glove: the glove is not ready")
end)

test("clients of a server use devices, but connect none", function(t)
  local session = opened()
  local methods = require "clench.control.rpc.methods"
  for _, folder in ipairs {false, "."} do
    local context = {session = session, client = {}, server = {session = session, folder = folder or nil, jobs = {}}}
    for _, kind in ipairs {"glove", "tracker", "hand"} do
      local ok, problem = pcall(methods.call, context, "sensors.connect_" .. kind, {path = "/dev/null"}, true)
      t.equal(ok, false)
      t.ok(tostring(problem.message or problem):find "devices are connected by the program of the server only", kind)
    end
  end
  t.equal(session.sensors.glove, nil)
end)

test("postures of fingertips refine a calibration, and are saved and loaded", function(t)
  local session = clench.session(clench.world())
  session:run("world.import_robot", {path = "models/hands/human/human20.cfg"})
  t.ok(session.hand)
  local hand, random = session.hand, clench.random(1)
  t.fails(function() session:run("sensors.calibrate_tips", {tips = {"a", "b"}, refine = {17}}) end, "the glove is not calibrated")
  local tips = {hand.chains[5].links[3].name, hand.chains[1].links[3].name}
  -- true: 0.4 rad at 100 counts; the calibration is wrong by 0.1 rad in the thumb
  local known, wrong = {slopes = {}, intercepts = {}}, {slopes = {}, intercepts = {}}
  for d = 1, 20 do
    known.slopes[d], wrong.slopes[d], known.intercepts[d], wrong.intercepts[d] = {}, {}, 0, d == 18 and 0.1 or 0
    for s = 1, 22 do
      known.slopes[d][s] = s == d and 0.002 or 0
      wrong.slopes[d][s] = known.slopes[d][s]
    end
  end
  local measure = clench.devices.calibrate_tips {hand = hand, calibration = known, samples = (function()
    local list = {}
    for i = 1, 6 do
      list[i] = {sensors = {}, distance = 0}
      for s = 1, 22 do list[i].sensors[s] = random:integer(1, 255) end
    end
    return list
  end)(), tips = tips, refine = {1}, shell = 0}
  t.ok(measure.tips.rms > 0)
  session.sensors.calibration = wrong
  session.sensors.glove = {kind = "glove", path = "/dev/glove", state = "connected", count = 1}
  local function vertex(name)
    local far = clench.vec3(0, 0, 0)
    for _, v in ipairs(hand:link(name).mesh.vertices) do
      if clench.vec3(v[1], v[2], v[3]):norm() > far:norm() then far = clench.vec3(v[1], v[2], v[3]) end
    end
    return hand:link(name).pose * far
  end
  local posture = hand.dofs
  for _ = 1, 20 do
    local raw = {}
    for s = 1, 22 do raw[s] = random:integer(1, 255) end
    session.sensors.glove.reading = raw
    hand:set_dofs(clench.devices.glove_map {hand = hand, calibration = known} (raw))
    session:run("sensors.record_posture", {distance = (vertex(tips[1]) - vertex(tips[2])):norm() - 0.008})
  end
  hand:set_dofs(posture)
  t.fails(function() session:run("sensors.record_posture", {distance = 0, dofs = posture}) end, "a posture has either dofs or a distance")
  t.fails(function() session:run("sensors.calibrate", {sensors_of = {{1}}}) end, "fewer than two postures were recorded")
  local path = test.path()
  session:run("sensors.save_postures", {path = path})
  session:run "sensors.clear_postures"
  t.fails(function() session:run("sensors.calibrate_tips", {tips = tips, refine = {18}}) end, "fewer than 6 postures with a distance of two fingertips were recorded")
  t.equal(session:run("sensors.load_postures", {path = path}), 20)
  local report = session:run("sensors.calibrate_tips", {tips = tips, refine = {17, 18, 19, 20}})
  t.ok(report.max < 1e-9, report.max)
  t.close(session.sensors.calibration.intercepts, known.intercepts, 1e-8)
end)
