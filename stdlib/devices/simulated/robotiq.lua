local loop = clench.loop
local modbus_slave = require "clench.devices.simulated.modbus_slave"
local new_line = require "clench.devices.simulated.line"

-- moves the fingers to their positions at the present time
local function update(gripper)
  local now = loop.time()
  local step = (now - gripper.time) * 255 / gripper.full_time
  gripper.time = now
  if not gripper.is_moving then return end
  local goal = gripper.goal
  local stop = gripper.object and goal > gripper.object and gripper.object or goal
  gripper.position = gripper.position + math.max(-step, math.min(step, stop - gripper.position))
  if math.abs(gripper.position - stop) < 0.5 then
    gripper.position, gripper.is_moving = stop, false
    gripper.object_status = stop ~= goal and 2 or 3
  end
end

local function status_bytes(gripper)
  local active = gripper.is_active and 0x31 or 0
  local object = gripper.is_moving and 0 or gripper.object_status
  return string.char(active | (gripper.has_goal and 0x08 or 0) | object << 6, 0, 0, gripper.goal, math.floor(gripper.position + 0.5), gripper.is_moving and 20 or 0)
end

local function command(gripper, bytes)
  local action, _, _, goal = bytes:byte(1, 4)
  gripper.is_active = action & 1 == 1
  gripper.has_goal = action & 8 ~= 0
  if not gripper.has_goal then
    gripper.is_moving = false
    gripper.stops = gripper.stops + 1
    return
  end
  if gripper.goal ~= goal or not gripper.is_moving then gripper.goal, gripper.is_moving = goal, true end
end

local function serve(gripper)
  modbus_slave(gripper, {
    [0x07D0] = {count = 3, read = function() return status_bytes(gripper) end},
    [0x03E8] = {count = 3, write = function(bytes) command(gripper, bytes) end},
  }, function() update(gripper) end)
end

--- Simulates a two-finger Robotiq gripper on a pseudo-terminal.
---@param options? table
---@option slave? integer [1 to 247] = 9
---@option full_time? number [s, > 0] = 0.05  from open to closed
---@option object? integer [0 to 255]  position at which an object stops closing fingers
---@option flip_bytes? number [0 to 1] = 0  fraction of the bytes in which a bit is changed
---@option lose_bytes? number [0 to 1] = 0  fraction of the bytes that are lost
---@option delay? number [s, >= 0] = 0  before each answer
---@option seed? integer [0 to 9007199254740992] = 1
---@return table gripper # `path`, `position`, `stops`: number of times that the fingers were stopped, `unplug()`, `close()`
---@effect edits
--- > simulated = clench.devices.simulated.robotiq {}
--- > line = clench.port.serial {path = simulated.path}
--- > line:write "\x09\x10\x03\xE8\x00\x03\x06\x01\x00\x00\x00\x00\x00\x72\xE1"
--- > line:read(8, 1) == "\x09\x10\x03\xE8\x00\x03\x01\x30"  --> true
--- > simulated:close()
--- > simulated.path:find "^/dev/" ~= nil  --> true
return function(options)
  return new_line("robotiq", options, function(o)
    local object = o:raw "object"
    if object ~= nil and (math.type(object) ~= "integer" or object < 0 or object > 255) then o:expected("object", "a number from 0 to 255", object) end
    return {slave = o:get "slave", full_time = o:get "full_time", object = object, position = 0, goal = 0, object_status = 3, time = loop.time(), stops = 0}
  end, serve)
end
