-- The panel of devices, driven by synthetic input.
local test, clench = require "test", require "clench"
local views = dofile "tests/lua/view_session.lua"
local texts_of = views.texts_of
local loop = clench.loop

local function open_panel()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {1070, 937}}
  view:frame()
  view:frame()  -- tabs are laid out in the second frame
  view:click_label "Sensors"
  return session, view
end

test("the panel Sensors connects a glove, shows its readings, and disconnects it", function(t)
  local session, view = open_panel()
  t.ok(texts_of(view):find "\nReal hand\n")
  local device <close> = clench.devices.simulated.cyberglove {sensors = {20, 60}}
  view:menu "Sensors/Connect Glove…"
  view:frame()
  view:type(device.path)
  view:click_label "OK"
  local last = loop.time() + 60
  while not session.sensors.glove.reading and loop.time() < last do loop.run(0.01) end
  t.ok(texts_of(view):find("\nconnected, " .. device.path .. "\n", 1, true))
  t.ok(texts_of(view):find "\n20 60 ")
  device:unplug()
  while session.sensors.glove.state ~= "lost" and loop.time() < last do loop.run(0.01) end
  t.ok(texts_of(view):find("\nlost, " .. device.path .. "\n", 1, true))
  view:click_label "Disconnect"
  t.equal(session.sensors.glove, nil)
  t.equal(texts_of(view):find "%.lua:%d+:", nil)
  view:close()
end)

test("buttons of the panel Sensors move the hand, and show the residuals of a calibration", function(t)
  local session, view = open_panel()
  -- as a glove that was connected, whose readings the test chooses
  local glove = {kind = "glove", path = "/dev/glove", state = "connected", reading = {20, 60}, count = 1}
  session.sensors.glove = glove
  session.sensors.calibration = {slopes = {{0.01, 0}, {0, 0.01}}, intercepts = {0.1, -0.2}}
  view:frame()
  view:click_label "Move Hand"
  t.close(session.hand.dofs[1], 0.3, 1e-9)
  view:click_label "Follow"
  t.ok(session.following)
  glove.reading, glove.count = {30, 60}, 2
  loop.run(0.05)
  t.close(session.hand.dofs[1], 0.4, 1e-9)
  view:click_label "Stop Following"
  t.equal(session.following, nil)
  for i, value in ipairs {0.1, 0.3, 0.2} do
    glove.reading = {10 + 20 * i, 60}
    session:run("sensors.record_posture", {dofs = {value}})
  end
  session:run("sensors.calibrate", {sensors_of = {{1}}})
  -- the line through (30, 0.1), (50, 0.3), (70, 0.2) has residuals of 1/20, 1/10 and 1/20 rad
  t.ok(texts_of(view):find("\nresiduals within 0.100 rad (DOF 1)\n", 1, true), texts_of(view))
  view:close()
end)

test("the dialog of a real hand has its driver, numbers and rate, and says which lines exist", function(t)
  local session, view = open_panel()
  local hint = require "clench.session.serial_lines".hint()
  t.ok(texts_of(view):find("\nserial lines: " .. hint .. "\n", 1, true), texts_of(view))
  view:menu "Sensors/Connect Real Hand…"
  local texts = texts_of(view)
  for _, label in ipairs {"path", "driver", "ids", "dofs", "signs", "offsets", "baud [bit/s]"} do t.ok(texts:find("\n" .. label .. "\n", 1, true), label) end
  t.equal(view.dialogs["sensors.connect_hand"].hints.path, hint)
  -- an error stays in the dialog
  view:type "/dev/no_such_line"
  view:click_label "OK"
  t.ok(texts_of(view):find("/dev/no_such_line: No such file or directory; ", 1, true), texts_of(view))
  view:click_label "Cancel"
  local device <close> = clench.devices.simulated.robotiq {}
  session:run("sensors.connect_hand", {path = device.path, driver = "robotiq", dofs = {2}})
  local last = loop.time() + 60
  while not session.sensors.hand.reading and loop.time() < last do loop.run(0.01) end
  texts = texts_of(view)
  t.ok(texts:find("\nRobotiq gripper, connected, " .. device.path .. "\n", 1, true), texts)
  t.equal(texts:find("serial lines:", 1, true), nil)
  view:close()
end)

test("the panel shows what each bird moves", function(t)
  local session, view = open_panel()
  local device <close> = clench.devices.simulated.flock {birds = 2, poses = {clench.pose {xyz = {0.3, 0.1, 0.2}}}}
  session:run("sensors.connect_tracker", {path = device.path, birds = 2})
  local last = loop.time() + 60
  while not session.sensors.tracker.reading and loop.time() < last do loop.run(0.01) end
  t.ok(texts_of(view):find("\nbird 1: barrett, absolute\n0.3000 m, 0.1000 m, 0.2000 m\n", 1, true), texts_of(view))
  t.ok(texts_of(view):find("bird 2: moves nothing\n", 1, true))
  local before = view.camera.eye
  view:menu "Sensors/Tracker Mode…"
  local state = view.dialogs["sensors.tracker_mode"]
  view:frame()
  view:type "2"  -- the first field with a text
  state.mode, state.target = "relative", "camera"
  view:click_label "OK"
  t.ok(texts_of(view):find("bird 2: camera, relative\n", 1, true), texts_of(view))
  device.poses[2] = clench.pose {xyz = {0.1, 0, 0}}
  local count = session.sensors.tracker.count
  while session.sensors.tracker.count < count + 2 and loop.time() < last do loop.run(0.01) end
  view:click_label "Follow"
  loop.run(0.05)
  -- along its own x, the direction of view
  local towards = (view.camera.target - before):unit()
  t.close((view.camera.eye - before - towards * 0.1):norm(), 0, 1e-3)
  view:click_label "Stop Following"
  view:close()
end)
