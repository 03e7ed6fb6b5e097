-- Real hands in a session, one test per driver; and a property: nothing beyond limits and speed is ever sent, whatever is asked for.
local test, clench = require "test", require "clench"
local with = dofile "tests/lua/sensor_session.lua"
local loop, simulated = clench.loop, clench.devices.simulated
local real_hands = require "clench.session.real_hands"

-- simulator and its options, arguments of the command, values of the device at a goal of the Barrett model, and do they agree with it?
local hands = {
  barrett = {"barrett", {}, {}, function(t, device, dofs)
    t.close(device.motors["1"].P * 2.51327 / 17800, dofs[2], 1e-3)
    t.close(device.motors.S.P * math.pi / 3150, dofs[1], 1e-3)
  end},
  dynamixel = {"dynamixel", {ids = {3, 7, 1, 2}, speed = 100}, {ids = {3, 7, 1, 2}, signs = {1, -1, 1, 1}, offsets = {0, 0.5, 0, 0}}, function(t, device, dofs)
    local function angle(id) return (string.unpack("<i4", string.char(table.unpack(device.motors[id].memory, 116, 119))) - 2048) * math.pi / 2048 end
    for i, id in ipairs {3, 1, 2} do t.close(angle(id), dofs[i == 1 and 1 or i + 1], 1e-3) end
    t.close(angle(7), 0.5 - dofs[2], 1e-3)
  end},
  leap = {"dynamixel", {ids = {0, 1, 2, 3}, speed = 100}, {ids = {0, 1, 2, 3}}, function(t, device)
    t.equal({device.motors[0].memory[11], device.motors[3].memory[102] + 256 * device.motors[3].memory[103]}, {5, 350})
  end},
  robotiq = {"robotiq", {}, {dofs = {3}}, function(t, device, dofs, limits) t.close(device.goal / 255, dofs[3] / limits[3][2], 3e-3) end},
  robotiq_3f = {"robotiq_3f", {}, {dofs = {2, 3, 4}}, function(t, device, dofs, limits)
    for i = 1, 3 do t.close(device.axes[i].goal / 255, dofs[i + 1] / limits[i + 1][2], 3e-3) end
  end},
}

for _, name in ipairs(real_hands.names) do
  local kind, options, args, agrees = table.unpack(hands[name])

  test(name .. ": the real hand follows, leads, is stopped, and stops when it is disconnected", function(t)
    local session = with.open()
    local device <close> = simulated[kind](options)
    local all = {driver = name}
    for key, value in pairs(args) do all[key] = value end
    with.connect(t, session, "hand", device, all)
    local goal = {0.2, 0.3, 0.4, 0.5}
    session.hand.dofs = goal
    session:run("sensors.push", {max_speed = 10})
    with.run_until(t, function() return session.sensors.hand.task == nil end, "the real hand does not arrive")
    t.equal(session.sensors.hand.problem, nil)
    agrees(t, device, goal, session.hand.dof_limits)
    with.renew(t, session, "hand")
    session.hand.dofs = {0.2, 0.2, 0.2, 0.2}
    session:run "sensors.pull"
    for _, d in ipairs(args.dofs or {1, 2, 3, 4}) do t.close(session.hand.dofs[d], goal[d], 0.02) end
    session:run "sensors.stop"
    with.run_until(t, function() return session.sensors.hand.task == nil end)
    t.equal(session.sensors.hand.problem, nil)
    with.renew(t, session, "hand")
    session:run("sensors.disconnect", {device = "hand"})
    local function has_stopped()
      if kind == "dynamixel" then return device.motors[3].memory[64] == 0 end
      return device.stops > 1 and not device.has_goal and not device.goes
    end
    with.run_until(t, has_stopped, "it is not stopped")
  end)
end

test("what does not fit a driver is refused in one sentence, before anything is opened", function(t)
  local session = with.open()
  local function fails(args, message)
    args.path = args.path or "/dev/no_such_line"
    t.fails(function() session:run("sensors.connect_hand", args) end, message)
    t.equal(session.sensors.hand, nil)
  end
  fails({driver = "leaf"}, "driver: expected barrett, leap, dynamixel, robotiq, robotiq_3f, got 'leaf'; did you mean 'leap'?")
  fails({ids = {1}}, "sensors.connect_hand: ids: a Barrett hand has no number")
  fails({driver = "dynamixel"}, "ids: expected the numbers of the motors, {1, 2, 3}")
  fails({driver = "dynamixel", ids = {"a"}}, "ids[1]: expected a whole number, got 'a'")
  fails({driver = "robotiq", ids = {1, 2}}, "ids: expected one number for a gripper, {9}")
  fails({baud = 0}, "baud: expected a number from 1 to 1e+07 bit/s, got 0")
  -- the system's reason, and what to do about it
  fails({}, "/dev/no_such_line: No such file or directory; ")
  fails({path = ""}, "session: path: expected a serial line, such as /dev/ttyUSB0; ")
  fails({path = "/dev/null"}, "/dev/null: expected a serial line")
  local serial_lines = require "clench.session.serial_lines"
  t.equal(serial_lines.advice "x: Permission denied", "; the lines belong to the group dialout")
  t.ok(serial_lines.hint():find "^/dev/tty" or serial_lines.hint() == "no /dev/ttyUSB or /dev/ttyACM exists")
  t.equal(serial_lines.advice "x: No such file or directory" ~= "", true)
  t.equal(serial_lines.advice "x: strange", "")

  t.fails(function() session:command {name = "mine.a", run = print, parameters = {{name = "p", type = "string", text = "x", hint = "y"}}} end,
          "session:command: mine.a: parameter p: hint: expected a function, got 'y'")

  -- the same line twice
  local device <close> = simulated.barrett {}
  with.connect(t, session, "hand", device)
  t.fails(function() session:run("sensors.connect_glove", {path = device.path}) end, "session: the real hand uses " .. device.path .. "; disconnect it first")
  t.fails(function() session:run("sensors.connect_hand", {path = device.path}) end, "session: the real hand uses " .. device.path)
  local glove <close> = simulated.cyberglove {}
  with.connect(t, session, "glove", glove)
  with.connect(t, session, "glove", glove)  -- again: instead of itself
  -- another number of values than of DOFs
  local gripper <close> = simulated.robotiq {}
  with.connect(t, session, "hand", gripper, {driver = "robotiq"})
  t.fails(function() session:run "sensors.push" end, "the real hand has 1 DOFs, and barrett has 4: connect it with dofs")
  with.connect(t, session, "hand", device, {dofs = {1, 2}})
  t.fails(function() session:run "sensors.pull" end, "the real hand has 4 values, and was connected with 2 dofs")
  with.connect(t, session, "hand", gripper, {driver = "robotiq", dofs = {9}})
  t.fails(function() session:run "sensors.push" end, "dofs[1] must be a number from 1 to 4, different from the others, got 9")
end)

-- goals in the bytes that a device has received: lists of values, in counts
local sent = {
  barrett = function(bytes)
    local goals = {}
    for letter, count in bytes:gmatch "([123S])FSET DP (%d+)\r" do goals[#goals + 1] = {letter == "S" and 1 or tonumber(letter) + 1, tonumber(count)} end
    return goals
  end,
  dynamixel = function(bytes)
    local goals = {}
    for parameters in bytes:gmatch "\xFF\xFF\xFD\0\xFE..\x83\x74\0\4\0(....................)" do
      for i = 1, 4 do goals[#goals + 1] = {i, (string.unpack("<i4", parameters, 5 * i - 3))} end
    end
    return goals
  end,
  robotiq = function(bytes)
    local goals = {}
    for position in bytes:gmatch "\9\x10\3\xE8\0\3\6\9..(.).." do goals[#goals + 1] = {1, position:byte()} end
    return goals
  end,
}
local cases = {
  barrett = {low = {0, 0, 0, 0}, high = {3150, 17800, 17800, 17800}, per_unit = {3150 / math.pi, 17800 / 2.51327, 17800 / 2.51327, 17800 / 2.51327}},
  dynamixel = {ids = {1, 2, 3, 4}, low = {2048, 2048, 2048, 2048}, high = {4096, 3686, 3686, 3686}, per_unit = {652, 652, 652, 652}, start = 2048},
  robotiq = {low = {0}, high = {255}, per_unit = {255 / 2.44346}, dofs = {2}},
}

for _, name in ipairs {"barrett", "dynamixel", "robotiq"} do
  test(name .. ": nothing beyond limits and speed is sent, for random goals, speeds and pauses", function(t)
    local case, random = cases[name], clench.random(7)
    local world = clench.load("worlds/barrett_mug.wld", {root = "."})
    local hand = world.robots[1]
    local device <close> = simulated[name] {ids = case.ids, speed = name == "dynamixel" and 1000 or nil, full_time = name == "robotiq" and 1e-3 or nil}
    local received, receive = {}, device.receive
    device.receive = function(self, seconds)
      local bytes, why = receive(self, seconds)
      received[#received + 1] = bytes
      return bytes, why
    end
    local port <close> = clench.port.serial {path = device.path}
    local real, prepare = real_hands.drivers[name].open(port, case.ids)
    prepare()
    local dofs = case.dofs or {1, 2, 3, 4}
    local scaled = name == "robotiq" and real_hands.scaled(real, hand, dofs) or real
    local last, count = {}, 0
    for i = 1, #dofs do last[i] = case.start or 0 end
    local reach  -- since the last call [rad]
    local function check()
      for _, goal in ipairs(sent[name](table.concat(received))) do
        local i, value = goal[1], goal[2]
        t.ok(value >= case.low[i] and value <= case.high[i], ("%s: value %d: %d"):format(name, i, value))
        t.ok(math.abs(value - last[i]) <= reach * case.per_unit[i] + 1.01, ("%s: value %d: %d after %d"):format(name, i, value, last[i]))
        last[i], count = value, count + 1
      end
      received = {}
    end
    for _ = 1, 8 do
      local speed, interval = random:uniform(0.1, 20), random:uniform(0.01, 0.2)
      local mirror = clench.devices.mirror {hand = hand, device = scaled, dofs = dofs, max_speed = speed, interval = interval}
      for _ = 1, 4 do
        hand.dofs = hand:random_posture(random)
        loop.sleep(random:uniform(0, 0.03))
        reach = speed * interval
        mirror:push()
        check()
      end
      -- what the driver itself is asked for: most of it is refused
      local values, fits = {}, true
      for i = 1, #dofs do
        local extreme = ({0 / 0, 1 / 0, -1 / 0, 1e300, -1e-6, 100, "1", {}})[random:integer(1, 8)]
        values[i] = random:uniform() < 0.5 and extreme or random:uniform(0, 4)
        fits = fits and type(values[i]) == "number" and values[i] >= 0 and values[i] <= (name == "robotiq" and 1 or 2.4)
      end
      reach = math.huge
      local ok = pcall(real.move, real, values)
      t.ok(ok or not fits)
      check()
      if ok then loop.sleep(0.05) end
    end
    t.ok(count > 20, count)
  end)
end
