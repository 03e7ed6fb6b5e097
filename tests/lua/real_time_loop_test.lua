-- examples/16_real_time_loop.lua as a user runs it: with quiet and with noisy lines, and with a tracker that is unplugged.
local test = require "test"

local program = (function()
  local pipe <close> = io.popen "readlink /proc/$PPID/exe"
  return pipe:read "l"
end)()

local function run(arguments)
  local pipe = assert(io.popen(("'%s' -q run examples/16_real_time_loop.lua %s 2>&1"):format(program, arguments)))
  local text = pipe:read "a"
  return text, (pipe:close())
end

-- number, mean and longest latency of a stage [ms]
local function stage(text, name)
  local count, mean, longest = text:match("\n" .. name .. " +(%d+) times, mean +([%d.]+) ms, longest +([%d.]+) ms")
  return tonumber(count), tonumber(mean), tonumber(longest)
end

for _, arguments in ipairs {"", "bad_bytes=0.05 readings=9"} do
  test(("the hand closes, and the latency of each stage is printed (%s)"):format(arguments ~= "" and arguments or "quiet lines"), function(t)
    local text, ok = run(arguments)
    t.ok(ok, text)
    local epsilon, fingers = text:match "^closed at epsilon ([%d.]+), fingers at %[([^%]]+)%]"
    t.ok(tonumber(epsilon) > 0, text)
    local _, commas = fingers:gsub(",", "")
    t.equal(commas, 3)
    for _, name in ipairs {"track", "plan", "follow", "verify", "send"} do
      local count, mean, longest = stage(text, name)
      t.ok(count and count > 0 and mean > 0 or name == "plan" and count and mean >= 0, text)
      t.ok(mean <= longest and longest < 10000, text)
    end
    t.equal((stage(text, "verify")), 1)
    t.equal(select(2, text:gsub("\n", "")), 6)
    t.ok(stage(text, "track") >= (stage(text, "follow")), text)
  end)
end

test("a tracker that is unplugged ends the loop with one sentence", function(t)
  local text, ok = run "unplug=0.5"
  t.ok(not ok)
  t.ok(text:find "^clench: examples/16_real_time_loop%.lua:%d+: devices%.flock: /dev/%S+ is unplugged\n", text)
  t.ok(not text:find "motors are off", text)
end)

test("arguments that are not known are refused", function(t)
  for _, argument in ipairs {"readings=x", "port=/dev/ttyUSB0", "/dev/ttyUSB0"} do
    local text, ok = run(argument)
    t.ok(not ok)
    t.ok(text:find("expected NAME=VALUE with one of the names above, got " .. argument, 1, true), text)
  end
end)
