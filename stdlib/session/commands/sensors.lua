--- Commands of the Sensors menu: connect devices, move the current hand by them, and calibrate a glove.
local conditions = require "clench.session.conditions"
local sensed = require "clench.session.sensed"
local sensors = require "clench.session.sensors"

local file = {name = "path", type = "string", text = "a file of a glove's calibration"}
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

local function connection(kind, label, text)
  return setting("Sensors", 1, "connect_" .. kind, label, nil,
                 {{name = "path", type = "string", text = text},
                  {name = "baud", type = "integer", min = 1, max = 10000000, unit = "bit/s", optional = true, text = "that of the device by default"}},
                 function(session, args) sensors.connect(session, kind, args.path, args.baud) end)
end

local function record(session, args)
  local postures = session.sensors.postures
  postures[#postures + 1] = {sensors = sensors.reading(session, "glove"), dofs = args.dofs or session.hand.dofs}
  return #postures
end

local function calibrate(session, args)
  local calibration = clench.devices.calibrate {samples = session.sensors.postures, sensors_of = args.sensors_of}
  session.sensors.calibration = calibration
  return calibration.report
end

local function set_frame(session, args)
  local reading = sensors.reading(session, "tracker")
  session.sensors.frame = args.mode == "relative" and {mode = "relative", base = reading, pose = session.hand.pose} or nil
end

local function load_calibration(session, args)
  session.sensors.calibration = clench.files.glove_calibration(args.path)
  session.sensors.dofs = args.dofs
end

local function save_calibration(session, args)
  clench.devices.save_calibration(args.path, session.sensors.calibration)
  return args.path
end

local function has_postures(session) return #session.sensors.postures > 1, "fewer than two postures were recorded" end
local function has_calibration(session) return session.sensors.calibration ~= nil, "the glove is not calibrated" end

local function follow(session)
  if session.following then session:end_gesture() else sensed.follow(session) end
end

return {
  connection("glove", "Connect Glove…", "serial line of a CyberGlove"),
  connection("tracker", "Connect Tracker…", "serial line of a Flock of Birds"),
  connection("hand", "Connect Barrett Hand…", "serial line of a Barrett hand, which is initialized: its fingers move"),
  setting("Sensors", 1, "disconnect", "Disconnect…", nil, {{name = "device", type = "string", choices = {"glove", "tracker", "hand"}, text = "a real hand is stopped"}},
          function(session, args) sensors.disconnect(session, args.device) end),
  edit(3, "apply", "Move Hand to Readings", sensed.can_apply, sensed.apply),
  setting("Sensors", 3, "follow", "Follow/Stop Following", sensed.can_apply, nil, follow),
  setting("Sensors", 3, "tracker_mode", "Tracker Mode…", hand_and(tracker),
          {{name = "mode", type = "string", choices = {"absolute", "relative"}, default = "relative", text = "relative: the hand moves from where it is now as the sensor moves"}},
          set_frame),
  setting("Sensors/Glove Calibration", 2, "record_posture", "Record Posture…", hand_and(glove),
          {{name = "dofs", type = "table", optional = true, text = "of the hand that wears the glove; those of the current hand by default [rad]"}}, record),
  setting("Sensors/Glove Calibration", 2, "clear_postures", "Clear Postures", has_postures, nil, function(session) session.sensors.postures = {} end),
  setting("Sensors/Glove Calibration", 2, "calibrate", "Calibrate Glove…", has_postures, {{name = "sensors_of", type = "table", text = "lists of sensors by the numbers of DOFs, {{5}, {6}}"}}, calibrate),
  setting("Sensors/Glove Calibration", 2, "load_calibration", "Load Calibration…", nil,
          {file, {name = "dofs", type = "table", optional = true, text = "rows of the calibration by the numbers of DOFs, {[2] = 1}"}}, load_calibration),
  setting("Sensors/Glove Calibration", 2, "save_calibration", "Save Calibration…", has_calibration, {file}, save_calibration),
  edit(4, "pull", "Simulated Hand to Real One", hand_and(real_hand), sensed.pull),
  setting("Sensors", 4, "push", "Real Hand to Simulated One…", hand_and(real_hand),
          {{name = "max_speed", type = "number", min = 1e-3, max = 10, default = 1, unit = "rad/s", text = "of each joint"},
           {name = "continuous", type = "boolean", default = false, text = "true: it follows until it is stopped; a drag once it has ended"}},
          function(session, args) sensed.push(session, args.max_speed, args.continuous) end),
  setting("Sensors", 4, "stop", "Stop Real Hand", real_hand, nil, sensed.stop),
}
