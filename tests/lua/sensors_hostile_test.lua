-- Hostile devices against a session and its drivers: whatever they send, other coroutines go on, and each error is one sentence.
local test, clench = require "test", require "clench"
local with = dofile "tests/lua/sensor_session.lua"
local loop, simulated = clench.loop, clench.devices.simulated

local max_pause = 0.9  -- of other coroutines on a busy machine; a driver that blocked the loop would do so for at least a second [s]
local drivers = {"barrett", "leap", "robotiq", "robotiq_3f"}

-- connects each kind of device, and each driver of hands, to lines of their own; calls f(session, kind, line, problems)
local function for_all(t, serve, f)
  local cases = {{"glove"}, {"tracker", {birds = 2}}}
  for _, driver in ipairs(drivers) do cases[#cases + 1] = {"hand", {driver = driver}} end
  for _, case in ipairs(cases) do
    local session, problems = with.open(), {}
    session:subscribe("diagnostic", function(value) problems[#problems + 1] = value.text end)
    local line <close> = clench.port.pty()
    loop.spawn(function() serve(line) end)
    local args = {path = line.path}
    for name, value in pairs(case[2] or {}) do args[name] = value end
    session:run("sensors.connect_" .. case[1], args)
    f(session, case[1], line, problems)
    session:run("sensors.disconnect", {device = case[1]})
    for _, problem in ipairs(problems) do
      t.ok(#problem < 300 and not problem:find "[\n\r]" and not problem:find "%.lua:%d" and not problem:find "traceback", problem)
    end
  end
end

-- runs the loop for a time, and returns the longest pause of a coroutine that wakes every 5 ms
local function longest_pause(seconds)
  local longest, last, is_over = 0, loop.time(), false
  local finish = last + seconds
  loop.spawn(function()
    while not is_over do
      loop.sleep(0.005)
      local now = loop.time()
      longest, last = math.max(longest, now - last), now
    end
  end)
  while loop.time() < finish do loop.run(0.01) end
  is_over = true
  return longest
end

test("noise: random bytes at any time are no reading that a check would catch, and stop nothing", function(t)
  local random = clench.random(11)
  for_all(t, function(line)
    while true do
      local bytes = {}
      for i = 1, random:integer(1, 200) do bytes[i] = string.char(random:integer(0, 255)) end
      if not line:send(table.concat(bytes)) then return end
      loop.sleep(0.002)
    end
  end, function(session, kind)
    t.ok(longest_pause(0.5) < max_pause, kind)
    -- hands are not moved by noise: their protocols have checksums, or answers that must agree
    if kind == "hand" then t.equal(session.sensors.hand and session.sensors.hand.reading, nil) end
  end)
end)

test("silence: a device that never answers is given up, and disconnecting it never waits", function(t)
  for_all(t, function() end, function(session, kind)
    t.ok(longest_pause(0.1) < max_pause, kind)
    local began = loop.time()
    session:run("sensors.disconnect", {device = kind})
    t.ok(loop.time() - began < max_pause, kind)
    t.equal(session.sensors[kind], nil)
  end)
  -- ten or 20 attempts, however many damaged answers would be allowed
  for _, name in ipairs {"barrett", "robotiq", "robotiq_3f", "cyberglove", "flock"} do
    local line <close> = clench.port.pty()
    local requests, asked = 0, nil
    loop.spawn(function()
      while line:read_some() do requests = requests + 1 end
    end)
    local _, ok, problem = clench.log.collect(function()
      return pcall(function()
        local driver <close> = clench.devices[name] {port = line.path, timeout = 0.01, attempts = 1000}
        local ok, problem = pcall(driver.read, driver)
        asked = requests  -- before it is stopped, which is repeated for some seconds
        if not ok then error(problem, 0) end
      end)
    end)
    asked = asked or requests
    t.ok(not ok and tostring(problem):find("no valid answer from " .. line.path, 1, true), tostring(problem))
    t.ok(asked >= 10 and asked <= 22, asked)
  end
end)

test("a hand is stopped while another coroutine waits for its motion, and the command is not repeated", function(t)
  local session = with.open()
  local line <close> = clench.port.pty()
  local received, is_deaf = {}, false
  loop.spawn(function()
    while true do
      local command = line:read_until "\r"
      if not command then return end
      received[#received + 1] = command
      local setting = command:match "^[123S]FGET DP$" and "0\r\n" or command:find "FGET P" and "0 0 0 0\r\n" or ""
      -- a motion ends only when the hand is told to stop
      if not is_deaf and not command:find "M$" then line:send(command .. "\r\n" .. setting .. "=> ") end
    end
  end)
  with.connect(t, session, "hand", line)
  session.hand.dofs = {0, 0, 0, 0}
  session:run("sensors.push", {max_speed = 1})
  with.run_until(t, function() return received[#received]:find "M$" end, "no motion")
  local count = #received
  session:run "sensors.stop"
  with.run_until(t, function() return session.sensors.hand.task == nil end, "no stop")
  t.equal({session.sensors.hand.state, session.sensors.hand.problem}, {"connected"})
  t.equal(received[count + 1], "T")
  for i = count + 1, #received do t.ok(not received[i]:find "M$", received[i]) end
  session:run("sensors.push", {max_speed = 1})
  with.run_until(t, function() return received[#received]:find "M$" end, "no motion")
  local began = loop.time()
  session:run("sensors.disconnect", {device = "hand"})
  t.ok(loop.time() - began < max_pause)
  count = #received
  with.run_until(t, function() return not line:is_open() or received[#received] == "T" end, "no stop")
  loop.run(0.3)
  for i = count + 1, #received do t.equal(received[i], "T") end

  -- deaf: disconnecting waits for nothing
  with.connect(t, session, "hand", simulated.barrett {})
  local deaf <close> = simulated.barrett {}
  with.connect(t, session, "hand", deaf)
  local messages = {}
  session:subscribe("diagnostic", function(value) messages[#messages + 1] = value.text end)
  loop.run(0.02)
  deaf.lose_bytes = 1
  began = loop.time()
  session:run("sensors.disconnect", {device = "hand"})
  t.ok(loop.time() - began < max_pause)
  with.run_until(t, function() return #messages > 0 end, "no message")
  t.equal(messages[1], ("the real hand at %s has not confirmed that it has stopped"):format(deaf.path))
end)

test("a gripper and motors are stopped while another coroutine moves or reads them", function(t)
  local device <close> = simulated.robotiq {delay = 0.005}
  local gripper <close> = clench.devices.robotiq {port = device.path, move_timeout = 1}
  gripper:activate()
  device.full_time = 20
  local is_over = false
  loop.spawn(function()
    pcall(gripper.move, gripper, 0)
    is_over = true
  end)
  with.run_until(t, function() return device.is_moving and device.position > 1 end, "no motion")
  gripper:stop()
  t.equal({device.is_moving, device.has_goal}, {false, false})
  with.run_until(t, function() return is_over end)
  t.ok(device.position < 128)

  local motors <close> = simulated.dynamixel {ids = {1, 2}, delay = 0.002}
  local bus <close> = clench.devices.dynamixel {port = motors.path, ids = {1, 2}}
  local problems, count, is_done = {}, 0, false
  loop.spawn(function()
    while not is_done do
      local ok, problem = pcall(bus.read_positions, bus)
      problems[#problems + 1], count = not ok and problem or nil, count + 1
    end
  end)
  for i = 1, 5 do
    bus:set_torque(i % 2 == 0)
    t.equal(motors.motors[2].memory[64], (i + 1) % 2)
  end
  with.run_until(t, function() return count > 1 end, "the motors are not read")
  is_done = true
  t.equal(problems, {})
end)

test("a flood is read without stopping the loop", function(t)
  for_all(t, function(line)
    local bytes = ("G\1\2\xFF\xFF\xFD\0\9\x10=> "):rep(5000)
    while line:is_open() do
      line:send(bytes)
      loop.sleep(0.001)
    end
  end, function(session, kind)
    t.ok(longest_pause(0.5) < max_pause, kind)
    local view = clench.view.offscreen {session = session, size = {320, 240}}
    local began = loop.time()
    for _ = 1, 3 do view:frame() end
    view:close()
    t.ok(loop.time() - began < 10 * max_pause, kind)
  end)
end)

-- drivers of real hands with simulators that answer wrongly: what a driver reads is right, or an error
test("answers with wrong numbers, lengths and contents are discarded", function(t)
  local modbus = require "clench.devices.modbus"
  local packet = require "clench.devices.dynamixel_packet"
  local status = "\x31\0\0\0\0\0"
  local modbus_answers = {
    "\9\3\6" .. status, -- the only right one
    "\8\3\6" .. status, "\9\3\4" .. status, "\9\4\6" .. status, "\9\x84\2", "\9\3\6" .. status .. "\0",
  }
  for i, answer in ipairs(modbus_answers) do
    local line <close> = clench.port.pty()
    loop.spawn(function() while line:read(8) do line:send(modbus.frame(answer)) end end)
    local gripper <close> = clench.devices.robotiq {port = line.path, timeout = 0.02, attempts = 3}
    local ok, state = pcall(gripper.read, gripper)
    t.equal(ok, i == 1, i)
    if ok then t.equal(state.opening, 0.085) else t.ok(tostring(state):find("no valid answer from " .. line.path, 1, true), tostring(state)) end
  end
  -- a write that is confirmed for other registers is not confirmed
  local line <close> = clench.port.pty()
  loop.spawn(function() while line:read_some() do line:send(modbus.frame "\9\x10\3\xE9\0\3") end end)
  local gripper <close> = clench.devices.robotiq {port = line.path, timeout = 0.02, attempts = 3}
  t.fails(function() gripper:activate() end, "no valid answer")
  -- Dynamixel: limits that are none, other ids, other lengths
  for _, case in ipairs {{-1, 4095}, {0, 4096}, {3000, 1000}, {-2147483648, 2147483647}} do
    local device <close> = simulated.dynamixel {ids = {1}}
    local bytes = string.pack("<i4 i4", case[2], case[1])
    for i = 1, 8 do device.motors[1].memory[47 + i] = bytes:byte(i) end
    t.fails(function() clench.devices.dynamixel {port = device.path, ids = {1}} end, ("devices.dynamixel: motor 1: expected limits from 0 to 4095, got %d to %d"):format(case[1], case[2]))
    t.equal(device.motors[1].memory[64], 0)
  end
  local other <close> = clench.port.pty()
  loop.spawn(function()
    while other:read_some() do
      for id = 2, 5 do other:send(packet.encode(id, "status", "\0\1\2\3\4")) end
      other:send(packet.encode(1, "ping"))  -- an echo, as of lines with one wire
      other:send(packet.encode(1, "status", "\0"):sub(1, -2) .. "x")
    end
  end)
  t.fails(function() clench.devices.dynamixel {port = other.path, ids = {1}, timeout = 0.01, attempts = 3} end, "no valid answer from " .. other.path .. ": motor 1: ping")
end)

-- a line whose far side is a device, and which ends after a number of bytes from it
local function relay(device_path, count)
  local near, far = clench.port.pty(), clench.port.serial {path = device_path}
  loop.spawn(function()
    while true do
      local bytes = near:read_some()
      if not bytes or not far:send(bytes) then break end
    end
    far:close()
  end)
  loop.spawn(function()
    local left = count
    while left > 0 do
      local bytes = far:read_some()
      if not bytes then break end
      near:send(bytes:sub(1, left))
      left = left - #bytes
    end
    near:drain(0.05)
    near:close()
  end)
  return near
end

test("a line that is unplugged at any byte ends in one sentence, at once", function(t)
  local options = {barrett = {}, dynamixel = {ids = {1, 2}}, robotiq = {}, robotiq_3f = {}, cyberglove = {}, flock = {}}
  local uses = {
    barrett = function(d) d:initialize() d:move {0, 1, 1, 1} d:read() end,
    dynamixel = function(d) d:write_positions {0.1, 0.2} d:read_positions() end,
    robotiq = function(d) d:activate() d:move(0.01) end,
    robotiq_3f = function(d) d:activate() d:move(0.5) end,
    cyberglove = function(d) d:is_ready() d:read() end,
    flock = function(d) d:read() d:read() end,
  }
  for name, use in pairs(uses) do
    for count = 0, 70, 7 do
      local device <close> = simulated[name](options[name])
      local line = relay(device.path, count)
      local began = loop.time()
      local problems, ok, problem = clench.log.collect(function()
        return pcall(function()
          local driver <close> = clench.devices[name] {port = line.path, ids = options[name].ids}
          use(driver)
        end)
      end)
      if not ok then
        local text = tostring(problem)
        t.ok(text:find("devices." .. name .. ": " .. line.path .. " is ", 1, true) and not text:find "\n", text)
      end
      t.ok(#problems <= 1, name)  -- at most the warning that a Barrett hand has not confirmed its stop
      t.ok(loop.time() - began < 3, name)
      line:close()
    end
  end
end)

test("a calibration whose values overflow moves nothing, and ends following with one sentence", function(t)
  local session, problems = with.open(), {}
  session:subscribe("diagnostic", function(value) problems[#problems + 1] = value.text end)
  local device <close> = simulated.cyberglove {sensors = {200, 200}}
  with.connect(t, session, "glove", device)
  local dofs = session.hand.dofs
  for _, slopes in ipairs {{{1e308, 0}}, {{1e308, -1e308}}, {{-1e308, 0}}} do
    session.sensors.calibration, session.sensors.dofs = {slopes = slopes, intercepts = {0}}, {[2] = 1}
    session:run "sensors.follow"
    with.run_until(t, function() return session.following == nil end)
    t.equal(session.hand.dofs, dofs)
  end
  session.sensors.calibration = {slopes = {{0 / 0, 0}}, intercepts = {0}}
  t.fails(function() session:run "sensors.apply" end, "DOF 1: expected finite numbers, got nan")
  t.equal(#problems, 3)
  for _, problem in ipairs(problems) do t.ok(problem:find "^devices%.glove_map: DOF 1: expected a finite value, got %-?[in][na][fn]$", problem) end
end)

test("a line that closes while a film is saved: the film is complete, and the device is lost afterwards", function(t)
  local session = with.open()
  local device = simulated.cyberglove {}
  with.connect(t, session, "glove", device)
  session:run("dynamics.run", {seconds = 0.05})
  local path = test.path() .. ".html"
  device:unplug()
  session:run("dynamics.save_film", {path = path})
  t.ok(clench.files.read_text(path):find "</html>")
  with.run_until(t, function() return session.sensors.glove.state == "lost" end)
  os.remove(path)
end)

test("a line belongs to one program at a time", function(t)
  local device <close> = simulated.cyberglove {}
  local first <close> = clench.port.serial {path = device.path}
  local session = with.open()
  t.fails(function() session:run("sensors.connect_glove", {path = device.path}) end, device.path .. ": another process uses this serial line")
  t.equal(session.sensors.glove, nil)
  first:close()
  with.connect(t, session, "glove", device)

end)
