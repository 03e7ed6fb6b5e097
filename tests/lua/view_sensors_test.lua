-- The panel of devices, driven by synthetic input.
local test, clench = require "test", require "clench"
local loop = clench.loop

local function texts_of(view)
  view:frame()
  local texts = {}
  for _, item in ipairs(view:items()) do texts[#texts + 1] = item.label end
  return "\n" .. table.concat(texts, "\n") .. "\n"
end

test("the panel Sensors connects a glove, shows its readings, and moves the hand", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {1070, 937}}
  view:frame()
  view:frame()  -- tabs are laid out in the second frame
  view:click_label "Sensors"
  t.ok(texts_of(view):find "\nBarrett hand\n")
  local device <close> = clench.devices.simulated.cyberglove {sensors = {20, 60}}
  view:menu "Sensors/Connect Glove…"
  view.dialogs["sensors.connect_glove"].path = device.path
  view:click_label "OK"
  local last = loop.time() + 60
  while not session.sensors.glove.reading and loop.time() < last do loop.run(0.01) end
  t.ok(texts_of(view):find("\nconnected, " .. device.path .. "\n", 1, true))
  t.ok(texts_of(view):find "\n20 60 ")
  local path = test.path()
  clench.devices.save_calibration(path, {slopes = {{0.01, 0}, {0, 0.01}}, intercepts = {0.1, -0.2}})
  session:run("sensors.load_calibration", {path = path})
  view:click_label "Move Hand"
  t.close(session.hand.dofs[1], 0.3, 1e-9)
  view:click_label "Follow"
  t.ok(session.following)
  view:click_label "Stop Following"
  t.equal(session.following, nil)
  device:unplug()
  while session.sensors.glove.state ~= "lost" and loop.time() < last do loop.run(0.01) end
  t.ok(texts_of(view):find("\nlost, " .. device.path .. "\n", 1, true))
  view:click_label "Disconnect"
  t.equal(session.sensors.glove, nil)
  t.equal(texts_of(view):find "%.lua:%d+:", nil)
  view:close()
end)
