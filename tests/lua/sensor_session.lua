-- Sessions with simulated devices, for tests.
local clench = require "clench"
local loop = clench.loop
local sensor_session = {}

--- A session with a hand above a mug.
function sensor_session.open(path)
  local session = clench.session()
  session:open(path or "worlds/barrett_mug.wld", {root = "."})
  return session
end

--- Runs the loop until a condition is true.
function sensor_session.run_until(t, is_over, what)
  local last = loop.time() + 60
  while not is_over() and loop.time() < last do loop.run(0.01) end
  t.ok(is_over(), what)
end

--- Connects a device and waits for its first reading.
function sensor_session.connect(t, session, kind, device, options)
  local args = {path = device.path}
  for name, value in pairs(options or {}) do args[name] = value end
  session:run("sensors.connect_" .. kind, args)
  sensor_session.run_until(t, function() return session.sensors[kind].reading ~= nil end, kind .. " has no reading")
end

--- Waits for a reading that was asked for after now.
function sensor_session.renew(t, session, kind)
  local sensor = session.sensors[kind]
  local count = sensor.count
  sensor_session.run_until(t, function() return sensor.count >= count + 2 end, kind .. " has no new reading")
end

return sensor_session
