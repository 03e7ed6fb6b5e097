-- Trackers of several birds in a session: each moves the hand, a body or the camera of the view.
local test, clench = require "test", require "clench"
local with = dofile "tests/lua/sensor_session.lua"

-- readings of sensors that are at poses of the world, if the transmitter is at another one
local transmitter = clench.pose {xyz = {0.2, -0.1, 0.05}, rpy = {0.2, 0.3, -0.4}}
local function read_at(pose) return transmitter:inverse() * pose end

-- a word of a position is 0.03 mm; one of a rotation is off by up to 2 mrad, which moves what is far from the sensor
local function close(t, got, expected, distance)
  t.close((got.position - expected.position):norm(), 0, 4e-4 + 4e-3 * (distance or 0))
  t.close((got:inverse() * expected):angle(), 0, 1.2e-2)
end

local function camera_of(session) return session.sensors.camera.get() end

test("a bird moves the camera: its x forwards, its y to the right and its z down, as on GraspIt!'s camera", function(t)
  local session = with.open()
  local view = clench.view.offscreen {session = session, size = {400, 300}}
  view:frame()
  local device <close> = clench.devices.simulated.flock {poses = {read_at(clench.pose {xyz = {0.3, 0.2, 0.1}, rpy = {0.1, -0.2, 0.5}})}}
  with.connect(t, session, "tracker", device)
  session:run("sensors.tracker_mode", {mode = "relative", target = "camera"})
  local start, distance = camera_of(session), (view.camera.eye - view.camera.target):norm()
  local base = device.poses[1]
  local function offset(x, y, z) device.poses[1] = base * clench.pose {xyz = {x, y, z}} end
  for _, case in ipairs {{{0.1, 0, 0}, {0, 0, -0.1}}, {{0, 0.1, 0}, {0.1, 0, 0}}, {{0, 0, 0.1}, {0, -0.1, 0}}} do
    offset(table.unpack(case[1]))
    with.renew(t, session, "tracker")
    session:run "sensors.apply"
    close(t, camera_of(session), start * clench.pose {xyz = case[2]})
    t.close((view.camera.eye - view.camera.target):norm(), distance, 1e-9)
    t.ok(view.needs_frame)
    view:frame()
  end
  -- turned by any rotation about the sensor: the picture turns as if the camera were fixed to it
  local turn = clench.pose {rpy = {0.3, 0.2, -0.1}}
  device.poses[1] = base * turn
  with.renew(t, session, "tracker")
  session:run "sensors.follow"
  clench.loop.run(0.1)
  session:run "sensors.follow"
  local right, up, back = start:rotate {1, 0, 0}, start:rotate {0, 1, 0}, start:rotate {0, 0, 1}
  local sensor = clench.pose {x_axis = back * -1, z_axis = up * -1}  -- axes of the sensor in the world: forwards, right, down
  t.close((sensor:rotate {0, 1, 0} - right):norm(), 0, 1e-12)
  local turned = sensor * turn
  t.close((camera_of(session):rotate {0, 0, -1} - turned:rotate {1, 0, 0}):norm(), 0, 1.2e-2)
  t.close((camera_of(session):rotate {1, 0, 0} - turned:rotate {0, 1, 0}):norm(), 0, 1.2e-2)
  t.equal(session:undo() ~= "Follow Sensors", true)  -- a moved camera is no step of undo
  view:close()
  t.equal(session.sensors.camera, nil)
  t.fails(function() session:run "sensors.apply" end, "no view is open, whose camera a tracker could move")
end)

test("three birds move the camera, the mug and the hand, each in its mode, as one step of undo", function(t)
  local session = with.open()
  local view = clench.view.offscreen {session = session, size = {400, 300}}
  view:frame()
  local hand, mug = session.hand, session.object
  local camera, hand_start, hash = camera_of(session), hand.pose, session.world:hash()
  -- the camera's sensor: forwards, right, down
  local function camera_sensor(pose) return pose * clench.pose {x_axis = {0, 0, -1}, z_axis = {0, -1, 0}} end
  local mug_goal = clench.pose {xyz = {0.35, 0.1, 0.05}, rpy = {0, 0, 0.6}}
  local sensor_of_hand = clench.pose {xyz = {0.5, 0.5, 0.5}}
  transmitter = clench.pose {xyz = camera.position * 0.5}  -- the tracker reaches 0.9 m
  local device <close> = clench.devices.simulated.flock {birds = 3, poses = {read_at(camera_sensor(camera)), read_at(mug_goal), sensor_of_hand}}
  with.connect(t, session, "tracker", device, {birds = 3})
  t.equal(#session.sensors.tracker.reading, 3)
  t.fails(function() session:run("sensors.tracker_mode", {mode = "camera", bird = 2, target = "mug"}) end, "mode 'camera' needs a bird that moves the camera")
  session:run("sensors.tracker_mode", {mode = "relative", bird = 1, target = "camera"})
  session:run("sensors.tracker_mode", {mode = "camera", bird = 2, target = "mug"})
  session:run("sensors.tracker_mode", {mode = "relative", bird = 3})
  t.fails(function() session:run("sensors.tracker_mode", {mode = "absolute", bird = 2, target = "camera"}) end, "session: bird 1 moves 'camera'; choose another target for it first")
  t.fails(function() session:run("sensors.tracker_mode", {mode = "absolute", bird = 2, target = "mugg"}) end, "there is no body or robot 'mugg'; did you mean 'mug'?")
  -- the camera turns, the hand moves up along its own z
  local turned = camera * clench.pose {rpy = {0, 0.1, 0}}
  device.poses[1], device.poses[3] = read_at(camera_sensor(turned)), sensor_of_hand * clench.pose {xyz = {0, 0, -0.05}}
  with.renew(t, session, "tracker")
  local result = session:run "sensors.apply"
  close(t, camera_of(session), turned, 1)
  t.equal(result.birds[2].fraction, 1)
  t.equal(result.birds[1], nil)
  close(t, mug.pose, mug_goal, 1)
  t.close((hand.pose.position - hand_start * clench.vec3(0, 0, -0.05)):norm(), 0, 4e-4)
  session:undo()
  t.equal(session.world:hash(), hash)
  -- what a bird moves can be changed, and ended
  session:run("sensors.tracker_mode", {bird = 2, target = "none"})
  session:run "sensors.apply"
  close(t, session.object.pose, clench.pose {})
  session:run("sensors.tracker_mode", {bird = 1, target = "none"})
  session:run("sensors.tracker_mode", {bird = 1, target = "camera"})
  view:close()
end)

test("a tracker with fewer birds than are asked for, and targets that are gone, are errors of one sentence", function(t)
  local session = with.open()
  local messages = {}
  session:subscribe("diagnostic", function(value) messages[#messages + 1] = value.text end)
  local device <close> = clench.devices.simulated.flock {}
  with.connect(t, session, "tracker", device)
  t.fails(function() session:run("sensors.tracker_mode", {bird = 2}) end, "session: the tracker has 1 bird, and bird 2 is asked for")
  t.fails(function() session:run("sensors.tracker_mode", {bird = 4}) end, "bird: expected a number from 1 to 3, got 4")
  t.fails(function() session:run("sensors.tracker_mode", {target = "camera"}) end, "no view is open")
  session:run("sensors.tracker_mode", {target = "none"})
  t.fails(function() session:run "sensors.apply" end, "no bird of the tracker moves anything")
  session:run("sensors.tracker_mode", {target = "mug", mode = "relative"})
  session:run "sensors.follow"
  session.world:remove(session.object)
  with.renew(t, session, "tracker")
  with.run_until(t, function() return session.following == nil end)
  t.ok(messages[1]:find("there is no body or robot 'mug'", 1, true), messages[1])
end)

test("a hand whose file names a bird is moved by that bird, through the mount of its sensor", function(t)
  local session = with.open "worlds/barrett_mug.wld"
  local mount = clench.pose {xyz = {0, 0.02, 0.1}, rpy = {0, 0, 0.5}}
  local birds = require "clench.session.birds"
  local hand = {name = "h", tracker = {number = 2, pose = mount}, pose = clench.pose {}}
  local readings = {clench.pose {}, clench.pose {xyz = {0.1, 0.2, 0.3}} * mount}
  local stand_in = {hand = hand, world = session.world, sensors = {birds = {}, tracker = {reading = readings, state = "connected"}}}
  t.equal(birds.of_hand(stand_in), 2)
  t.equal(birds.of_others(stand_in), {})
  t.close((birds.pose(stand_in, 2).position - clench.vec3(0.1, 0.2, 0.3)):norm(), 0, 1e-12)
  t.close(birds.pose(stand_in, 2):angle(), 0, 1e-7)
end)
