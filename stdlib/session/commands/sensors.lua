--- Commands of the Sensors menu: connect devices, move the current hand by them, and calibrate a glove.
local birds = require "clench.session.birds"
local conditions = require "clench.session.conditions"
local gloves = require "clench.session.glove"
local real_hands = require "clench.session.real_hands"
local sensed = require "clench.session.sensed"
local sensors = require "clench.session.sensors"
local serial_lines = require "clench.session.serial_lines"

-- a file of a glove that is read, or written
local function glove_file(kind, text, writes) return {name = "path", type = "string", files = {kinds = {kind}, writes = writes}, text = text} end
local calibration_file, new_calibration_file = glove_file("glove calibration", "a file of a glove's calibration"), glove_file("glove calibration", "file of the glove's calibration to write", true)
local posture_file, new_posture_file = glove_file("glove poses", "a file of postures of a glove"), glove_file("glove poses", "file of the postures to write", true)

local glove, tracker, real_hand = sensors.has_reading "glove", sensors.has_reading "tracker", sensors.has_reading "hand"

local function hand_and(condition)
  return function(session)
    if not session.hand then return conditions.hand(session) end
    return condition(session)
  end
end

-- a command that does not change the world
local function setting(menu, section, name, label, enabled, parameters, run)
  return {name = "sensors." .. name, label = label, menu = menu, section = section, reads = true, enabled = enabled, parameters = parameters, run = run}
end

-- a command that moves the current hand
local function edit(section, name, label, enabled, run)
  return {name = "sensors." .. name, label = label, menu = "Sensors", section = section, enabled = enabled, run = run}
end

-- more: parameters of this device
local function connection(kind, label, text, more)
  local parameters = {{name = "path", type = "string", text = text, hint = serial_lines.hint}}
  for _, parameter in ipairs(more) do parameters[#parameters + 1] = parameter end
  parameters[#parameters + 1] = {name = "baud", type = "integer", min = 1, max = 10000000, unit = "bit/s", optional = true, text = "that of the device by default"}
  return setting("Sensors", 1, "connect_" .. kind, label, nil, parameters, function(session, args) sensors.connect(session, kind, args.path, args) end)
end

local bird_count = {name = "birds", type = "integer", min = 1, max = 3, default = 1, text = "number of sensors of the tracker"}
local hand_parameters = {
  {name = "driver", type = "string", choices = real_hands.names, default = "barrett", text = "robotiq: two fingers; dynamixel: motors on one bus"},
  {name = "ids", type = "table", optional = true, text = "numbers of Dynamixel motors, {1, 2, 3}, or of a gripper, {9}; LEAP hands: 0 to 15 by default"},
  {name = "dofs", type = "table", optional = true, text = "of the simulated hand, one for each value of the real one; all by default"},
  {name = "signs", type = "table", optional = true, text = "1 or -1 for each value: DOF = sign * value + offset"},
  {name = "offsets", type = "table", optional = true, text = "for each value [rad or m]"},
}

local function choose_bird(session, args) birds.choose(session, args.bird, args.target, args.mode) end

local function load_calibration(session, args)
  session.sensors.calibration = clench.files.glove_calibration(args.path)
  session.sensors.dofs = args.dofs
end

local function save_calibration(session, args)
  clench.devices.save_calibration(args.path, session.sensors.calibration)
  return args.path
end

local function has_calibration(session) return session.sensors.calibration ~= nil, "the glove is not calibrated" end

local function follow(session)
  if session.following then session:end_gesture() else sensed.follow(session) end
end

return {
  connection("glove", "Connect Glove…", "serial line of a CyberGlove", {}),
  connection("tracker", "Connect Tracker…", "serial line of a Flock of Birds", {bird_count}),
  connection("hand", "Connect Real Hand…", "serial line of a hand, which is initialized: fingers of Barrett hands and grippers move", hand_parameters),
  setting("Sensors", 1, "disconnect", "Disconnect…", nil, {{name = "device", type = "string", choices = {"glove", "tracker", "hand"}, text = "a real hand is stopped"}},
          function(session, args) sensors.disconnect(session, args.device) end),
  edit(3, "apply", "Move Hand to Readings", sensed.can_apply, sensed.apply),
  setting("Sensors", 3, "follow", "Follow/Stop Following", sensed.can_apply, nil, follow),
  setting("Sensors", 3, "tracker_mode", "Tracker Mode…", tracker,
          {{name = "mode", type = "string", choices = {"absolute", "relative", "camera"}, default = "absolute",
            text = "relative: the target moves from where it is now as the sensor moves; camera: relative to the camera, which another bird moves"},
           {name = "bird", type = "integer", min = 1, max = 3, default = 1, text = "number of the sensor"},
           {name = "target", type = "string", default = "hand", text = "what the bird moves: hand (the current one), camera, none, or the name of a body or robot"}},
          choose_bird),
  setting("Sensors/Glove Calibration", 2, "record_posture", "Record Posture…", hand_and(glove),
          {{name = "dofs", type = "table", optional = true, text = "of the hand that wears the glove; those of the current hand by default [rad]"},
           {name = "distance", type = "number", min = 0, max = 1, unit = "m", optional = true, text = "of two fingertips, instead of dofs; 0: they touch"}}, gloves.record),
  setting("Sensors/Glove Calibration", 2, "clear_postures", "Clear Postures", gloves.has_any, nil, function(session) session.sensors.postures = {} end),
  setting("Sensors/Glove Calibration", 2, "load_postures", "Load Postures…", nil, {posture_file}, function(session, args) return gloves.load_postures(session, args.path) end),
  setting("Sensors/Glove Calibration", 2, "save_postures", "Save Postures…", gloves.has_any, {new_posture_file}, function(session, args)
    clench.devices.save_postures(args.path, session.sensors.postures)
    return args.path
  end),
  setting("Sensors/Glove Calibration", 2, "calibrate", "Calibrate Glove…", gloves.has_postures,
          {{name = "sensors_of", type = "table", text = "lists of sensors by the numbers of DOFs, {{5}, {6}}"}}, gloves.calibrate),
  setting("Sensors/Glove Calibration", 2, "calibrate_tips", "Calibrate Fingertips…", gloves.has_tips,
          {{name = "tips", type = "table", text = "names of the two links that have the fingertips, {'thumb', 'index'}"},
           {name = "refine", type = "table", text = "DOFs whose coefficients are fitted, those of the thumb: {17, 18, 19, 20}"},
           {name = "shell", type = "number", min = 0, max = 0.1, default = 0.008, unit = "m", text = "separation of the points of two tips that touch"}}, gloves.calibrate_tips),
  setting("Sensors/Glove Calibration", 2, "load_calibration", "Load Calibration…", nil,
          {calibration_file, {name = "dofs", type = "table", optional = true, text = "rows of the calibration by the numbers of DOFs, {[2] = 1}"}}, load_calibration),
  setting("Sensors/Glove Calibration", 2, "save_calibration", "Save Calibration…", has_calibration, {new_calibration_file}, save_calibration),
  edit(4, "pull", "Simulated Hand to Real One", hand_and(real_hand), sensed.pull),
  setting("Sensors", 4, "push", "Real Hand to Simulated One…", hand_and(real_hand),
          {{name = "max_speed", type = "number", min = 1e-3, max = 10, default = 1, unit = "rad/s", text = "of each joint"},
           {name = "continuous", type = "boolean", default = false, text = "true: it follows until it is stopped; a drag once it has ended"}},
          function(session, args) sensed.push(session, args.max_speed, args.continuous) end),
  setting("Sensors", 4, "stop", "Stop Real Hand", real_hand, nil, sensed.stop),
}
