-- Programs that are killed while a hand moves: watchdogs stop motors that have one, other hands are not stopped, and the line can be used again at once.
local test, clench = require "test", require "clench"
local loop, simulated = clench.loop, clench.devices.simulated

local program = (function()
  local pipe <close> = io.popen "readlink /proc/$PPID/exe"
  return pipe:read "l"
end)()

local function wait_for(t, what, is_over)
  local last = loop.time() + 30
  while not is_over() and loop.time() < last do loop.sleep(0.01) end
  t.ok(is_over(), what)
end

-- runs a script with the path of a device as a process of its own, and kills it once a condition is true; the script ends with a line that it prints
local function kill_when(t, script, device, is_time)
  local path = test.path()
  local file <close> = assert(io.open(path, "w"))
  file:write(script)
  file:close()
  local pipe = assert(io.popen(("echo $$; exec '%s' -q run '%s' '%s' 2>&1"):format(program, path, device.path)))
  local process = pipe:read "l"
  wait_for(t, "the script does not move the device", is_time)
  os.execute("kill -9 " .. process)
  local words = pipe:read "a"
  pipe:close()
  t.equal(words, "")
end

test("Dynamixel: the watchdog of each motor stops it after its time", function(t)
  local device <close> = simulated.dynamixel {ids = {1, 2}, speed = 1}
  kill_when(t, [[
    local clench = require "clench"
    local bus = clench.devices.dynamixel {port = arg[1], ids = {1, 2}, watchdog = 0.2}
    bus:write_positions {3, -3}
    while true do bus:read_positions() end]], device, function() return device.motors[1].position > 2048 + 100 end)
  local before = {device.motors[1].position, device.motors[2].position}
  loop.sleep(0.5)
  local packet = require "clench.devices.dynamixel_packet"
  local line = clench.port.serial {path = device.path, baud = 57600}
  line:write(packet.encode(1, "ping"))
  t.ok(line:read(14, 5))
  line:close()
  for i, motor in ipairs(device.motors) do
    t.equal(motor.memory[98], 255)
    -- 1 rad/s for the time of the watchdog, not for that since the kill
    local moved = math.abs(motor.position - before[i]) * 2 * math.pi / 4096
    t.ok(moved > 0.1 and moved < 0.25, moved)
  end
  local bus <close> = clench.devices.dynamixel {port = device.path, ids = {1, 2}}
  bus:write_positions {0.1, 0.1}
end)

-- hands without a watchdog: {simulator, its options, code that starts a motion, is it moving?, does it continue to the end?}
local others = {
  barrett = {{move_time = 0.3}, "d:initialize() d:move {0, 1, 1, 1}", function(device) return device.motors["1"].P > 0 end,
             function(device) return device.stops == 0 end},
  robotiq = {{full_time = 1}, "d:activate() d:move(0)", function(device) return device.is_moving and device.position > 10 end,
             function(device) return device.position == 255 end},
  robotiq_3f = {{full_time = 1}, "d:activate() d:move(1)", function(device) return device.goes and device.axes[1].position > 10 end,
                function(device) return device.axes[1].position == 255 and device.axes[3].position == 255 end},
}

for _, name in ipairs {"barrett", "robotiq", "robotiq_3f"} do
  local options, code, is_moving, has_ended = table.unpack(others[name])
  test(name .. ": without a watchdog, a motion continues to its end, and the line is free", function(t)
    local device <close> = simulated[name](options)
    kill_when(t, ("local d = require 'clench'.devices.%s {port = arg[1]} %s while true do end"):format(name, code), device, function() return is_moving(device) end)
    loop.sleep(0.4)
    local driver <close> = clench.devices[name] {port = device.path}
    wait_for(t, "the motion does not end", function()
      driver:read()
      return has_ended(device)
    end)
  end)
end
