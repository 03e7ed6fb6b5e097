local loop = clench.loop
local modbus_slave = require "clench.devices.simulated.modbus_slave"
local new_line = require "clench.devices.simulated.line"

local function bit(byte, number) return byte // 2 ^ number % 2 == 1 end

-- moves all axes to their positions at the present time
local function update(hand)
  local now = loop.time()
  local step = (now - hand.time) * 255 / hand.full_time
  hand.time = now
  if hand.changes_mode_until and now >= hand.changes_mode_until then
    hand.mode, hand.changes_mode_until = hand.next_mode, nil
  end
  if not hand.goes then return end
  for _, axis in ipairs(hand.axes) do
    local stop = axis.object and axis.goal > axis.object and axis.object or axis.goal
    local left = stop - axis.position
    axis.position = math.abs(left) <= step and stop or axis.position + (left > 0 and step or -step)
    axis.state = axis.position ~= stop and 0 or stop ~= axis.goal and 2 or 3
  end
end

-- 0: moving, 1: an object has stopped some fingers, 2: objects have stopped all, 3: all have reached their goals
local function motion(hand)
  local stopped = 0
  for i, axis in ipairs(hand.axes) do
    if hand.goes and axis.state == 0 then return 0 end
    if i <= 3 and axis.state == 2 then stopped = stopped + 1 end
  end
  return stopped == 0 and 3 or stopped == 3 and 2 or 1
end

local function status(hand)
  local ready = not hand.is_active and 0 or hand.changes_mode_until and 2 or 3
  local bytes = {(hand.is_active and 1 or 0) + 2 * hand.next_mode + (hand.goes and 8 or 0) + 16 * ready + 64 * motion(hand), 0, 0}
  for i, axis in ipairs(hand.axes) do
    bytes[2] = bytes[2] + axis.state * 4 ^ (i - 1) // 1
    bytes[#bytes + 1] = axis.goal
    bytes[#bytes + 1] = math.floor(axis.position + 0.5)
    bytes[#bytes + 1] = axis.state == 0 and hand.goes and 30 or 0
  end
  bytes[16] = 0
  for i, byte in ipairs(bytes) do bytes[i] = math.tointeger(byte) end
  return string.char(table.unpack(bytes))
end

local function obey(hand, bytes)
  local action, options = bytes:byte(1, 2)
  hand.is_active, hand.goes = bit(action, 0), bit(action, 3)
  if not hand.is_active then hand.mode, hand.next_mode, hand.changes_mode_until = 0, 0, nil end
  local mode = action // 2 % 4
  if hand.is_active and mode ~= hand.next_mode then
    hand.next_mode, hand.changes_mode_until = mode, loop.time() + hand.full_time
    for i = 1, 3 do hand.axes[i].position = 0 end
  end
  if not hand.goes then
    hand.stops = hand.stops + 1
    return
  end
  for i, axis in ipairs(hand.axes) do
    local is_own = i == 1 or i <= 3 and bit(options, 2) or i == 4 and bit(options, 3)
    -- without options all fingers follow the first, and the mode determines the scissor
    if is_own then axis.goal = bytes:byte(3 * i + 1) elseif i <= 3 then axis.goal = bytes:byte(4) end
    if axis.goal ~= axis.position then axis.state = 0 end
  end
end

local function serve(hand)
  modbus_slave(hand, {
    [0x07D0] = {count = 8, read = function() return status(hand) end},
    [0x03E8] = {count = 8, write = function(bytes) obey(hand, bytes) end},
  }, function() update(hand) end)
end

--- Simulates a three-finger Robotiq gripper on a pseudo-terminal.
---@param options? table
---@option slave? integer [1 to 247] = 9
---@option full_time? number [s, > 0] = 0.05  from open to closed, and of a change of the mode
---@option objects? integer[]  positions at which objects stop closing fingers A, B and C, from 0 to 255
---@option flip_bytes? number [0 to 1] = 0  fraction of the bytes in which a bit is changed
---@option lose_bytes? number [0 to 1] = 0  fraction of the bytes that are lost
---@option delay? number [s, >= 0] = 0  before each answer
---@option seed? integer [0 to 9007199254740992] = 1
---@return table gripper # `path`, `axes` with `position` and `goal`, `mode`, `stops`: number of times that it was stopped, `unplug()`, `close()`
---@effect edits
--- > simulated = clench.devices.simulated.robotiq_3f {}
--- > line = clench.port.serial {path = simulated.path}
--- > line:write "\x09\x03\x07\xD0\x00\x01\x85\xCF"
--- > line:read(7, 1) == "\x09\x03\x02\xC0\xFF\x49\xC5"  --> true
--- > simulated:close()
--- > simulated.path:find "^/dev/" ~= nil  --> true
return function(options)
  return new_line("robotiq_3f", options, function(o)
    local objects, axes = o:raw "objects" or {}, {}
    if type(objects) ~= "table" or #objects > 3 then o:expected("objects", "a list of up to three numbers", objects) end
    for i = 1, 4 do
      local object = objects[i]
      if object ~= nil and (math.type(object) ~= "integer" or object < 0 or object > 255) then o:expected(("objects[%d]"):format(i), "a number from 0 to 255", object) end
      axes[i] = {position = i == 4 and 137 or 0, goal = i == 4 and 137 or 0, state = 3, object = object}
    end
    return {slave = o:get "slave", full_time = o:get "full_time", axes = axes, mode = 0, next_mode = 0, time = loop.time(), stops = 0}
  end, serve)
end
