-- Drivers of devices with simulated devices: one suite for all, and each protocol by the bytes of its description.
local test, clench = require "test", require "clench"
local loop, devices = clench.loop, clench.devices
local simulated = devices.simulated

local pose = clench.pose {xyz = {0.3, -0.1, 0.2}, rpy = {0.3, -0.4, 0.5}}

-- how to connect, command and read each device. `check`: compares a reading with the commanded or simulated state
local kinds = {
  barrett = {
    connect = function(at, quick, attempts)
      local hand = devices.barrett {port = at, timeout = quick or 0.5, move_timeout = quick or 5, attempts = attempts or 300}
      hand:initialize()
      return hand
    end,
    command = function(hand) hand:move {0.5, 1, 1.5, 2} end,
    check = function(t, hand) t.close(hand:read(), {0.5, 1, 1.5, 2}, 2e-3) end,
    refuse = function(hand) hand:move {0.5, 1, 9, 2} end, refusal = "finger 2: expected 0 to 2.51327 rad, got 9",
    stopped = function(device) return device.stops > 0 end, quick = 0.02,
  },
  dynamixel = {
    options = {ids = {1, 2, 3}, speed = 100},
    connect = function(at, quick, attempts) return devices.dynamixel {port = at, ids = {1, 2, 3}, timeout = quick, attempts = attempts or 300} end,
    command = function(bus) bus:write_positions {0.1, -0.2, 0.3} loop.sleep(0.05) end,
    check = function(t, bus) t.close(bus:read_positions(), {0.1, -0.2, 0.3}, 8e-4) end,
    refuse = function(bus) bus:write_positions {0, 4, 0} end, refusal = "motor 2: expected -3.14159 to 3.14006 rad, got 4",
    stopped = function(device) return device.motors[1].memory[64] == 0 end, quick = 0.02,
  },
  robotiq = {
    connect = function(at, quick, attempts)
      local gripper = devices.robotiq {port = at, timeout = quick, attempts = attempts or 300, poll = 0.001}
      gripper:activate()
      return gripper
    end,
    command = function(gripper) gripper:move(0.03) end,
    check = function(t, gripper) t.close(gripper:read().opening, 0.03, 2e-4) end,
    refuse = function(gripper) gripper:move(0.1) end, refusal = "opening: expected 0 to 0.085 m, got 0.1",
    stopped = function(device) return device.stops > 2 and not device.has_goal end, quick = 0.02,
  },
  robotiq_3f = {
    connect = function(at, quick, attempts)
      local gripper = devices.robotiq_3f {port = at, timeout = quick, attempts = attempts or 300, poll = 0.001}
      gripper:activate()
      return gripper
    end,
    command = function(gripper) gripper:move {0.2, 0.4, 0.6} end,
    check = function(t, gripper) t.close({table.unpack(gripper:read().closing, 1, 3)}, {0.2, 0.4, 0.6}, 2e-3) end,
    refuse = function(gripper) gripper:move {0.2, 0.4, 1.1} end, refusal = "finger C: expected 0 to 1 (1: closed), got 1.1",
    stopped = function(device) return device.stops > 2 and not device.goes end, quick = 0.02,
  },
  cyberglove = {
    options = {sensors = {10, 20, 30, 255, 1}},
    connect = function(at, quick, attempts) return devices.cyberglove {port = at, timeout = quick, attempts = attempts or 300, readings = quick and 15 or 1} end,
    check = function(t, glove, device) t.equal(glove:read(), device.sensors) end, quick = 0.02,
  },
  flock = {
    options = {poses = {pose}},
    connect = function(at, quick, attempts) return devices.flock {port = at, timeout = quick, attempts = attempts or 300, readings = quick and 15 or 1} end,
    check = function(t, flock)
      local got = flock:read()[1]
      t.close((got.position - pose.position):norm(), 0, 2e-4)
      t.close((got:inverse() * pose):angle(), 0, 6e-3)
    end, quick = 0.02,
  },
}
local names = {"barrett", "cyberglove", "dynamixel", "flock", "robotiq", "robotiq_3f"}

-- a simulated device, with further options
local function simulate(name, more)
  local options = {}
  for key, value in pairs(kinds[name].options or {}) do options[key] = value end
  for key, value in pairs(more or {}) do options[key] = value end
  return simulated[name](options)
end

for _, name in ipairs(names) do
  local kind = kinds[name]

  test(name .. ": it is connected, commanded and read, in the main program and in a coroutine", function(t)
    local device <close> = simulate(name)
    local driver <close> = kind.connect(device.path)
    if kind.command then kind.command(driver) end
    kind.check(t, driver, device)
    local ticks, done = 0, false
    device.delay = 0.005
    loop.spawn(function()
      for _ = 1, 3 do kind.check(t, driver, device) end
      done = true
    end)
    loop.spawn(function() while not done do ticks = ticks + 1 loop.sleep(0.001) end end)
    while not done do loop.run(0.01) end
    t.ok(ticks > 3, ticks)  -- others run while it waits
  end)

  test(name .. ": 5 % bad bytes do not change what is read or commanded", function(t)
    local device <close> = simulate(name, {seed = 3})
    local driver <close> = kind.connect(device.path, kind.quick)
    device.flip_bytes, device.lose_bytes = 0.04, 0.01
    if kind.command then kind.command(driver) end
    for _ = 1, 3 do kind.check(t, driver, device) end
    device.flip_bytes, device.lose_bytes = 0, 0
    kind.check(t, driver, device)
  end)

  test(name .. ": unplugged, it is an error within its deadline, and it can be connected again", function(t)
    local device = simulate(name)
    local driver = kind.connect(device.path)
    device:unplug()
    local began = loop.time()
    t.fails(function() kind.check(t, driver, device) end, "devices." .. name, "is unplugged")
    t.ok(loop.time() - began < 1)
    driver:close()
    local other <close> = simulate(name)
    local again <close> = kind.connect(other.path)
    kind.check(t, again, other, kind.command and kind.command(again))
  end)

  test(name .. ": a device that is silent is an error within its deadline", function(t)
    local device <close> = simulate(name)
    local driver <close> = kind.connect(device.path, 0.02, 20)
    device.lose_bytes = 1
    t.fails(function() kind.check(t, driver, device) end, "no valid answer from " .. device.path)
  end)

  test(name .. ": arguments are checked", function(t)
    local ids = name == "dynamixel" and {1} or nil
    t.fails(function() devices[name] {port = 5, ids = ids} end, "port: expected the path of a serial line, or a port, got 5")
    t.fails(function() devices[name] {port = "/dev/no_such_line", ids = ids} end, "No such file or directory")
    t.fails(function() devices[name] {port = "/dev/null", ids = ids, prot = "x"} end, "unknown key")
    t.fails(function() simulated[name] {flip = 1} end, "unknown key 'flip'")
    t.fails(function() simulated[name] {flip_bytes = 2} end, "flip_bytes must be a number of at most 1, got 2")
  end)

  if kind.refuse then
    test(name .. ": what is out of range is refused here, and nothing is sent", function(t)
      local device <close> = simulate(name)
      local driver <close> = kind.connect(device.path)
      kind.command(driver)
      t.fails(function() kind.refuse(driver) end, kind.refusal)
      kind.check(t, driver, device)
    end)

    test(name .. ": closing repeats the stop until a device on a bad line confirms it", function(t)
      for seed = 1, 5 do
        local device <close> = simulate(name, {seed = seed})
        local driver = kind.connect(device.path, kind.quick, 100)
        kind.command(driver)
        device.flip_bytes, device.lose_bytes = 0.04, 0.01
        t.equal(driver:close(), true, seed)
        t.ok(kind.stopped(device), seed)
        t.equal(driver:close(), true)
      end
      local device <close> = simulate(name)
      local driver = kind.connect(device.path, kind.quick, 5)
      device.lose_bytes = 1
      local problems, stopped = clench.log.collect(function() return driver:close() end)
      t.equal(stopped, false)
      t.ok(problems[1].text:find("devices." .. name .. ": the device at " .. device.path .. " has not confirmed that it has stopped", 1, true), problems[1].text)
    end)

    test(name .. ": it stops when a script ends or fails", function(t)
      for _, ending in ipairs {"driver:close()", "error 'x'", "driver = nil collectgarbage()"} do
        local device <close> = simulate(name)
        local job = clench.job(function(kind_name, path, code)
          local clench = require "clench"
          local options = kind_name == "dynamixel" and {port = path, ids = {1, 2, 3}} or {port = path}
          local made = clench.devices[kind_name](options)
          if kind_name == "barrett" then made:initialize() elseif kind_name:find "^robotiq" then made:activate() end
          local env = setmetatable({driver = made}, {__index = _G})
          made = nil
          load(code, "=code", "t", env)()
        end, {args = {name, device.path, ending}})
        loop.wait(job, 10)
        local last = loop.time() + 5
        while not kind.stopped(device) and loop.time() < last do loop.sleep(0.01) end
        t.ok(kind.stopped(device), ending)
      end
    end)
  end
end

test("Barrett: faults of the hand are reported with their numbers", function(t)
  local device <close> = simulated.barrett {}
  local hand <close> = devices.barrett {port = device.path}
  t.fails(function() hand:move {0, 0, 0, 0} end, "the hand reports error 1 after 123SM")
  hand:initialize()
  t.equal(device.motors.S.MOV, 18)
  hand:close_fingers "12"
  t.equal({device.motors["1"].P, device.motors["2"].P, device.motors["3"].P}, {17800, 17800, 0})
  hand:increment(-800, "1")
  t.equal(device.motors["1"].P, 17000)
  hand:torque("open", "2")
  t.equal(device.motors["2"].P, 0)
  hand:home()
  t.equal(hand:read(), {0, 0, 0, 0})
  device.motors["2"].BD, device.motors["2"].BP = 1, 8900
  t.equal(hand:breakaways()[2], {broken = true, position = 8900 / 17800 * 2.51327})
  hand:move {math.pi, 2.51327, 0, 1.256635}
  t.equal({device.motors.S.P, device.motors["1"].P, device.motors["3"].P}, {3150, 17800, 8900})
  t.fails(function() hand:open "4" end, "motors: expected letters of 1, 2, 3 and S")
  t.fails(function() hand:increment(0) end, "counts: expected a whole number other than 0, from -17800 to 17800, got 0")
  t.fails(function() hand:torque "shut" end, "direction: expected 'close' or 'open', got 'shut'")
end)

test("Barrett: a stop that the hand does not confirm is repeated, for a bounded time", function(t)
  local line <close> = clench.port.pty()
  local received = 0
  local deaf, why = 3, nil  -- the first stops are lost
  loop.spawn(function()
    while true do
      local bytes = line:read_some()
      if not bytes then return end
      for _ in bytes:gmatch "T\r" do
        received = received + 1
        if received > deaf then line:send "T\r\n=> " end
      end
    end
  end)
  t.equal(devices.barrett {port = line.path, timeout = 0.05}:close(), true)
  t.equal(received, 4)
  deaf, received = math.huge, 0
  local began = clench.clock()
  local problems
  problems, why = clench.log.collect(function() return devices.barrett {port = line.path, timeout = 0.05, attempts = 5}:close() end)
  t.equal({why, received}, {false, 5})
  t.ok(problems[1].text:find("has not confirmed that it has stopped", 1, true), problems[1].text)
  t.equal(devices.barrett {port = line.path, timeout = 1, attempts = 1000}:close(), false)
  t.ok(clench.clock() - began < 20)
end)

test("Barrett: closing stops the hand also while another coroutine waits for its reply", function(t)
  local device <close> = simulated.barrett {}
  local hand = devices.barrett {port = device.path}
  hand:initialize()
  device.move_time = 0.2
  loop.spawn(function() pcall(hand.home, hand) end)
  loop.run(0.05)
  t.equal(device.stops, 0)
  t.equal(hand:close(), true)
  t.ok(device.stops > 0)
end)

test("Dynamixel: packets are those of the protocol's description", function(t)
  local device <close> = simulated.dynamixel {ids = {1, 2}}
  local bus <close> = devices.dynamixel {port = device.path, ids = {1, 2}}
  local function bytes(hex) return (hex:gsub("%x%x ?", function(pair) return string.char(tonumber(pair:sub(1, 2), 16)) end)) end
  t.equal(bus.packet {id = 1, instruction = "ping"}, bytes "FF FF FD 00 01 03 00 01 19 4E")
  t.equal(bus.packet {id = 1, instruction = "read", parameters = bytes "84 00 04 00"}, bytes "FF FF FD 00 01 07 00 02 84 00 04 00 1D 15")
  t.equal(bus.packet {id = 1, instruction = "write", parameters = bytes "74 00 00 02 00 00"}, bytes "FF FF FD 00 01 09 00 03 74 00 00 02 00 00 CA 89")
  -- parameters that look like a header are stuffed
  local stuffed = bus.packet {id = 1, instruction = "write", parameters = bytes "74 00 FF FF FD 00"}
  t.equal(stuffed:sub(9, 15), bytes "74 00 FF FF FD FD 00")
  t.fails(function() bus.packet {id = 1, instruction = "pong"} end, "instruction must be the name of an instruction, got 'pong'")
  local packet = require "clench.devices.dynamixel_packet"
  local found = packet.decode(bytes "00 FF FF FF FD 00 01 08 00 55 00 A6 00 00 00 8C C0", 1)
  t.equal({found.id, found.error, found.parameters}, {1, 0, bytes "A6 00 00 00"})
  local body = bytes "55 00 FF FF FD 01"
  local whole = packet.encode(7, "status", body:sub(2))
  found = packet.decode(whole, 1)
  t.equal(found.parameters, body:sub(3))
  local broken = whole:sub(1, 10) .. "\1" .. whole:sub(12)
  t.equal({packet.decode(broken, 1)}, {nil, 2, true})
end)

-- the worked examples of the manual of protocol 2.0; those of status packets are answers of XM430-W210 motors
local published = [[
FF FF FD 00 01 07 00 02 00 00 02 00 21 51
FF FF FD 00 FE 03 00 01 31 42
FF FF FD 00 01 07 00 55 00 06 04 26 65 5D
FF FF FD 00 02 07 00 55 00 06 04 26 6F 6D
FF FF FD 00 01 04 00 55 00 A1 0C
FF FF FD 00 01 09 00 04 68 00 C8 00 00 00 AE 8E
FF FF FD 00 01 03 00 05 02 CE
FF FF FD 00 01 04 00 06 01 A1 E6
FF FF FD 00 01 03 00 08 2F 4E
FF FF FD 00 01 08 00 10 01 44 58 4C 22 B1 DC
FF FF FD 00 FE 11 00 83 74 00 04 00 01 96 00 00 00 02 AA 00 00 00 82 87
FF FF FD 00 FE 0D 00 92 01 90 00 02 00 02 92 00 01 00 1A 05
FF FF FD 00 01 06 00 55 00 77 00 C3 69
FF FF FD 00 02 05 00 55 00 24 8B A9
FF FF FD 00 FE 10 00 93 01 20 00 02 00 A0 00 02 1F 00 01 00 50 B7 68]]

test("Dynamixel: checksums are those of all examples of the protocol's manual, in the driver and in the simulator", function(t)
  local packet = require "clench.devices.dynamixel_packet"
  local function bytes(hex) return (hex:gsub("%x%x ?", function(pair) return string.char(tonumber(pair:sub(1, 2), 16)) end)) end
  local count = 0
  for hex in published:gmatch "[^\n]+" do
    local whole = bytes(hex)
    t.equal(packet.crc(whole:sub(1, -3)), string.unpack("<I2", whole, #whole - 1), hex)
    count = count + 1
  end
  t.equal(count, 15)
  -- the simulated motors answer as the real ones: a write, a sync write, and a sync read of positions 166 and 2079
  local device <close> = simulated.dynamixel {ids = {1, 2}, speed = 1e-9}
  local line <close> = clench.port.serial {path = device.path, baud = 57600}
  device.motors[1].position, device.motors[2].position = 166, 2079
  for _, case in ipairs {
    {"FF FF FD 00 01 09 00 03 74 00 00 02 00 00 CA 89", "FF FF FD 00 01 04 00 55 00 A1 0C"},
    {"FF FF FD 00 01 07 00 02 84 00 04 00 1D 15", "FF FF FD 00 01 08 00 55 00 A6 00 00 00 8C C0"},
    {"FF FF FD 00 FE 11 00 83 74 00 04 00 01 96 00 00 00 02 AA 00 00 00 82 87", ""},
    {"FF FF FD 00 FE 09 00 82 84 00 04 00 01 02 CE FA", "FF FF FD 00 01 08 00 55 00 A6 00 00 00 8C C0 FF FF FD 00 02 08 00 55 00 1F 08 00 00 BA BE"},
  } do
    line:write(bytes(case[1]))
    local answer = bytes(case[2])
    t.equal(answer ~= "" and line:read(#answer, 5) or "", answer, case[1])
  end
  t.equal({device.motors[1].memory[116], device.motors[2].memory[116]}, {0x96, 0xAA})
end)

test("Barrett: an error is accepted once it is repeated, and an echo must be complete", function(t)
  local line <close> = clench.port.pty()
  local replies = {"FGET P\r\nERR 2\r\n=> ", "FGET P\r\n0 0 0 0\r\n=> ", "FGET P123SFGET P\r\nERR 2\r\n=> ", "FGET P\r\n0 0 0 0\r\n=> ",
                   "FGET P\r\nERR 2\r\n=> ", "FGET P\r\nERR 2\r\n=> "}
  loop.spawn(function()
    for _, reply in ipairs(replies) do
      if not line:read_until "\r" then return end
      line:send("123S" .. reply)
    end
  end)
  local hand = devices.barrett {port = line.path}
  t.equal(hand:read(), {0, 0, 0, 0})
  t.fails(function() hand:read() end, "the hand reports error 2 after 123SFGET P")
  line:close()
  hand:close()
end)

test("Dynamixel: the watchdog stops motors without packets, and new goals set it again", function(t)
  local device <close> = simulated.dynamixel {ids = {1}, speed = 100}
  local bus <close> = devices.dynamixel {port = device.path, ids = {1}, watchdog = 0.2}
  bus:write_positions {0.2}
  loop.sleep(0.4)
  bus:read_positions()
  t.equal(device.motors[1].memory[98], 255)
  bus:write_positions {0.5}
  local last = loop.time() + 5
  while math.abs(bus:read_positions()[1] - 0.5) > 8e-4 and loop.time() < last do bus:write_positions {0.5} end
  t.close(bus:read_positions()[1], 0.5, 8e-4)
  t.equal(bus:read_faults(), {0})
  t.close(bus:read_velocities()[1], 0, 0)
  bus:set_torque(false)
  t.equal(device.motors[1].memory[64], 0)
  local held <close> = simulated.dynamixel {ids = {4}}
  local soft <close> = devices.dynamixel {port = held.path, ids = {4}, mode = "current_position", current = 350, velocity = 1}
  t.equal({held.motors[4].memory[11], held.motors[4].memory[102] + 256 * held.motors[4].memory[103], held.motors[4].memory[112]}, {5, 350, 42})
  t.equal(#soft.ids, 1)
end)

test("Dynamixel: one packet answers a fast sync read, and motors without it are read as before", function(t)
  local packet = require "clench.devices.dynamixel_packet"
  local function counts(device) return device.instructions[0x8A] or 0, device.instructions[0x82] or 0 end
  for _, case in ipairs {{true, nil}, {true, false}, {false, nil}, {true, true}} do
    local device <close> = simulated.dynamixel {ids = {3, 7, 4}, fast = case[1], speed = 100}
    local bus <close> = devices.dynamixel {port = device.path, ids = {3, 7, 4}, fast = case[2]}
    bus:write_positions {0.1, 0.2, -0.3}
    loop.sleep(0.05)
    bus:read_positions()
    local fast, plain = counts(device)
    t.close(bus:read_positions(), {0.1, 0.2, -0.3}, 8e-4)
    local fast_now, plain_now = counts(device)
    local is_fast = case[1] and case[2] ~= false
    t.equal({fast_now - fast, plain_now - plain}, is_fast and {1, 0} or {0, 1})
  end
  -- data that look like a header are not stuffed; a wrong byte anywhere, or another motor, is no answer
  local whole = "\xFF\xFF\xFD\0\xFE\x11\0\x55\0\3\xFF\xFF\xFD\0"
  whole = whole .. string.pack("<I2", packet.crc(whole)) .. "\x80\7\1\2\3\4"
  whole = whole .. string.pack("<I2", packet.crc(whole))
  local answers = packet.decode_fast("\xFF\xFF" .. whole, {3, 7}, 4)
  t.equal({answers[3].parameters, answers[3].error, answers[7].parameters, answers[7].error}, {"\xFF\xFF\xFD\0", 0, "\1\2\3\4", 0x80})
  t.equal({packet.decode_fast(whole, {7, 3}, 4)}, {nil, true})
  for i = 1, #whole do
    local broken = whole:sub(1, i - 1) .. string.char(whole:byte(i) ~ 0x10) .. whole:sub(i + 1)
    t.equal((packet.decode_fast(broken, {3, 7}, 4)), nil, i)
    t.equal({packet.decode_fast(whole:sub(1, i - 1), {3, 7}, 4)}, {})
  end
  -- a motor that is missing: those after it are silent
  local device <close> = simulated.dynamixel {ids = {1, 2}}
  t.fails(function() devices.dynamixel {port = device.path, ids = {1, 5, 2}, timeout = 0.01, attempts = 3} end, "motor 5: ping")
end)

test("Robotiq: frames are those of the gripper's manual", function(t)
  local modbus = require "clench.devices.modbus"
  local function hex(text) return (text:gsub(".", function(byte) return ("%02X "):format(byte:byte()) end)) end
  t.equal(hex(modbus.frame "\x09\x10\x03\xE8\x00\x03\x06\x00\x00\x00\x00\x00\x00"), "09 10 03 E8 00 03 06 00 00 00 00 00 00 73 30 ")
  t.equal(hex(modbus.frame "\x09\x10\x03\xE8\x00\x03\x06\x09\x00\x00\xFF\xFF\xFF"), "09 10 03 E8 00 03 06 09 00 00 FF FF FF 42 29 ")
  t.equal(hex(modbus.frame "\x09\x03\x07\xD0\x00\x01"), "09 03 07 D0 00 01 85 CF ")
  local device <close> = simulated.robotiq {object = 128}
  local gripper <close> = devices.robotiq {port = device.path}
  t.fails(function() gripper:move(0.02) end, "the gripper is not active; call activate first")
  gripper:activate()
  local state = gripper:move(0)
  t.equal({state.object, state.fault, state.is_moving}, {"closing", 0, false})
  t.close(state.opening, 0.085 * (1 - 128 / 255), 1e-12)
  t.equal(gripper:move(0.085).object, nil)
  t.fails(function() modbus.read(gripper, 0, 1) end, "the device rejects the request: reading registers (exception 2)")
end)

test("Robotiq: three fingers move together or each for itself, in all modes, and report what they meet", function(t)
  local modbus = require "clench.devices.modbus"
  -- a status of the gripper's manual, with its checksum: stopped, all fingers where they should be
  local status = "\x09\x03\x10\xF9\xFF\x00\x00\x07\x00\x00\x06\x00\x00\x06\x00\x00\x89\x00\x00"
  t.equal(modbus.frame(status):sub(-2), "\x34\x8D")
  local manual = {port = clench.port.pty(), poll = 0.001}
  local reader = devices.robotiq_3f {port = clench.port.serial {path = manual.port.path}, timeout = 1}
  loop.spawn(function()
    manual.port:read(8, 2)
    manual.port:send(modbus.frame(status))
  end)
  local state = reader:read()
  t.close(state.closing, {7 / 255, 6 / 255, 6 / 255, 137 / 255}, 1e-12)
  t.equal({state.is_active, state.is_moving, state.mode, state.fault, state.objects}, {true, false, "basic", 0, {false, false, false, false}})
  manual.port:close()

  local device <close> = simulated.robotiq_3f {objects = {128, 255, 200}}
  local gripper <close> = devices.robotiq_3f {port = device.path, poll = 0.001}
  t.fails(function() gripper:move(1) end, "robotiq_3f:move: the gripper is not active; call activate first")
  t.fails(function() gripper:set_mode "wide" end, "robotiq_3f:set_mode: the gripper is not active")
  gripper:activate()
  state = gripper:move(1)
  t.close(state.closing, {128 / 255, 1, 200 / 255, 137 / 255}, 1e-12)
  t.equal(state.objects, {"closing", false, "closing", false})
  gripper:set_mode "pinch"
  t.equal({device.mode, gripper:read().mode, gripper:read().is_active}, {1, "pinch", true})
  t.close(gripper:move(0.25).closing, {64 / 255, 64 / 255, 64 / 255, 137 / 255}, 1e-12)
  t.close(gripper:move({0.1, 0.2, 0.3, 0.9}, 0.5, 1).closing, {26 / 255, 51 / 255, 77 / 255, 230 / 255}, 1e-12)
  gripper:stop()
  t.equal({gripper:read().mode, device.goes}, {"pinch", false})
  gripper:activate()
  t.equal(gripper:read().mode, "basic")
  t.fails(function() gripper:move {0.1, 0.2} end, "robotiq_3f:move: expected one number, one per finger, or those and the scissor's")
  t.fails(function() gripper:move(0.5, 2) end, "robotiq_3f:move: speed: expected a fraction from 0 to 1, got 2")
  t.fails(function() gripper:move "x" end, "closing: expected 0 to 1 (1: closed), got 'x'")
  t.fails(function() gripper:set_mode "fist" end, "robotiq_3f:set_mode: expected basic, pinch, wide or scissor, got 'fist'")
  t.fails(function() simulated.robotiq_3f {objects = {300}} end, "objects[1] must be a number from 0 to 255, got 300")
end)

test("CyberGlove: DOFs follow from a calibration, within their limits", function(t)
  local device <close> = simulated.cyberglove {sensors = {100, 200}}
  local glove <close> = devices.cyberglove {port = device.path}
  local calibration = {slopes = {{0.01, 0}, {0.01, 0.01}}, intercepts = {-0.5, 0}}
  t.close(glove:read_dofs(calibration), {0.5, 3}, 1e-12)
  t.close(glove:read_dofs(calibration, {{0, 1}, {0, 1.5}}), {0.5, 1.5}, 1e-12)
  t.ok(glove:is_ready())
  device.state = 1
  t.ok(not glove:is_ready())
  for _, case in ipairs {{{slopes = {{0.01}, {0.02}}, intercepts = {0}}, nil, "calibration: expected {slopes, intercepts}, got a table with names"},
                         {{slopes = {5}, intercepts = {0}}, nil, "slopes[1]: expected 1 numbers"}, {{slopes = {{0 / 0}}, intercepts = {0}}, nil, "DOF 1: expected finite numbers, got nan"},
                         {calibration, {5}, "limits[1]: expected a range {low, high}, got 5"}, {calibration, 5, "limits: expected ranges {low, high}, got 5"}} do
    t.fails(function() glove:read_dofs(case[1], case[2]) end, "cyberglove:read_dofs: " .. case[3])
  end
end)

test("Flock of Birds: both modes, all directions, and several birds", function(t)
  local random = clench.random(5)
  local device <close> = simulated.flock {poses = {pose, clench.pose {xyz = {-0.9, 0.9, -0.5}}}}
  local matrix <close> = devices.flock {port = device.path, birds = 2}
  for _ = 1, 20 do
    local wanted = clench.pose {xyz = {random:uniform(-0.9, 0.9), random:uniform(-0.9, 0.9), random:uniform(-0.9, 0.9)}} * random:rotation()
    device.poses[1] = wanted
    local got = matrix:read()
    t.close((got[1].position - wanted.position):norm(), 0, 2e-4)
    t.close((got[1]:inverse() * wanted):angle(), 0, 8e-3)
    t.close((got[2].position - device.poses[2].position):norm(), 0, 2e-4)
  end
  matrix:close()
  local angles <close> = devices.flock {port = device.path, mode = "angles"}
  for _ = 1, 20 do
    device.poses[1] = clench.pose {xyz = {random:uniform(-0.9, 0.9), 0, 0}} * random:rotation()
    t.close((angles:read()[1]:inverse() * device.poses[1]):angle(), 0, 1e-3)
  end
end)

test("Flock of Birds: words that are no rotation are damaged, not a pose", function(t)
  local pty <close> = clench.port.pty()
  local flock <close> = devices.flock {port = pty.path, timeout = 0.05, attempts = 2}
  -- three rows (1, 0, 0): each has the length 1
  local record = "\x80\0" .. ("\0"):rep(4) .. ("\x7F\x3F" .. ("\0"):rep(4)):rep(3)
  loop.spawn(function()
    while pty:read_until("B", 5) do pty:write(record) end
  end)
  t.fails(function() flock:read() end, "no valid answer from ")
end)

test("a device that never pauses is an error, not a hang", function(t)
  local noises = {dynamixel = "\xFF\xFF\xFD\x00\x09\x04\x00\x55\x00", flock = "\x80", cyberglove = "G", barrett = "x", robotiq = "\9"}
  for name, noise in pairs(noises) do
    local path = test.path()
    local listener <close> = clench.port.listen {path = path}
    local job <close> = clench.job(function(where, bytes)
      local clench = require "clench"
      local port <close> = clench.port.connect(where)
      while port:write(bytes:rep(10000), 1) do end
    end, {args = {path, noise}})
    local port <close> = listener:accept(10)
    local began = loop.time()
    t.fails(function()
      local driver <close> = devices[name] {port = port, ids = name == "dynamixel" and {1} or nil, timeout = 0.02, attempts = 3}
      driver:read()
    end, "no valid answer from ")
    t.ok(loop.time() - began < 10, name)
  end
end)
