-- The panel of devices, driven by synthetic input.
local test, clench = require "test", require "clench"
local loop = clench.loop

local function texts_of(view)
  view:frame()
  local texts = {}
  for _, item in ipairs(view:items()) do texts[#texts + 1] = item.label end
  return "\n" .. table.concat(texts, "\n") .. "\n"
end

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
  t.ok(texts_of(view):find "\nBarrett hand\n")
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
