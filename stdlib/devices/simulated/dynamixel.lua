local loop = clench.loop
local new_line = require "clench.devices.simulated.line"

local memory_size = 256
local broadcast = 254

-- bit by bit, as in the specification of the protocol
local function checksum(bytes)
  local crc = 0
  for i = 1, #bytes do
    crc = crc ~ bytes:byte(i) << 8
    for _ = 1, 8 do
      crc = crc << 1
      if crc > 0xFFFF then crc = crc ~ 0x18005 end
    end
  end
  return crc
end

local function store(motor, address, bytes)
  for i = 1, #bytes do motor.memory[address + i - 1] = bytes:byte(i) end
end

local function load_bytes(motor, address, count)
  local bytes = {}
  for i = 1, count do bytes[i] = string.char(motor.memory[address + i - 1] or 0) end
  return table.concat(bytes)
end

local function number_at(motor, address, format) return (string.unpack(format, load_bytes(motor, address, 4))) end

local function new_motor()
  local motor = {memory = {}, position = 2048, time = loop.time(), heard = loop.time()}
  for address = 0, memory_size - 1 do motor.memory[address] = 0 end
  store(motor, 11, "\3")
  store(motor, 48, string.pack("<i4 i4", 4095, 0))
  store(motor, 116, string.pack("<i4", 2048))
  return motor
end

-- the time until which a motor moves: the present one, or that at which its watchdog has stopped it
local function update_watchdog(motor, now)
  local period, heard = motor.memory[98], motor.heard
  motor.heard = now
  if period == 0 or period >= 128 or now - heard <= 0.02 * period then return now end
  motor.memory[98] = 255
  return heard + 0.02 * period
end

-- brings a motor to the present time
local function update(line, motor)
  local now = loop.time()
  local is_moving = motor.memory[64] == 1 and motor.memory[98] ~= 255
  local last = update_watchdog(motor, now)
  if is_moving then
    local goal, step = number_at(motor, 116, "<i4"), line.speed * 4096 / (2 * math.pi) * (last - motor.time)
    motor.position = motor.position + math.max(-step, math.min(step, goal - motor.position))
  end
  motor.time = now
  store(motor, 132, string.pack("<i4", math.floor(motor.position + 0.5)))
end

local function answer(line, id, code, parameters)
  local body = "\x55" .. string.char(code) .. parameters
  body = body:gsub("\xFF\xFF\xFD", "\xFF\xFF\xFD\xFD")
  local length = #body + 2
  local bytes = "\xFF\xFF\xFD\0" .. string.char(id, length & 255, length >> 8) .. body
  local crc = checksum(bytes)
  line:send(bytes .. string.char(crc & 255, crc >> 8))
end

-- writes registers as a motor does; returns the error code
local function write(motor, address, bytes)
  if address + #bytes > memory_size then return 7 end
  if address < 64 and motor.memory[64] == 1 then return 7 end  -- locked while the torque is on
  if motor.memory[98] == 255 and address <= 116 and address + #bytes > 100 then return 7 end
  if address == 116 and #bytes == 4 then
    local goal = string.unpack("<i4", bytes)
    if motor.memory[11] == 3 and (goal < number_at(motor, 52, "<i4") or goal > number_at(motor, 48, "<i4")) then return 6 end
  end
  store(motor, address, bytes)
  return 0
end

local function sync_write(line, parameters)
  if #parameters < 4 then return end
  local address, size = string.unpack("<I2 I2", parameters)
  for at = 5, #parameters - size, size + 1 do
    local motor = line.motors[parameters:byte(at)]
    if motor then write(motor, address, parameters:sub(at + 1, at + size)) end
  end
end

local function sync_read(line, parameters)
  if #parameters < 4 then return end
  local address, size = string.unpack("<I2 I2", parameters)
  for at = 5, #parameters do
    local id = parameters:byte(at)
    local motor = line.motors[id]
    if motor and address + size <= memory_size then answer(line, id, 0, load_bytes(motor, address, size)) end
  end
end

-- each motor appends a block to one packet after it has received those of the motors before it: if one is missing, none follows
local function fast_sync_read(line, parameters)
  if not line.fast or #parameters < 5 then return end
  local address, size = string.unpack("<I2 I2", parameters)
  if address + size > memory_size then return end
  local length = 1 + (#parameters - 4) * (size + 4)
  local bytes = "\xFF\xFF\xFD\0\xFE" .. string.char(length % 256, length // 256, 0x55)
  for at = 5, #parameters do
    local motor = line.motors[parameters:byte(at)]
    if not motor then break end
    bytes = bytes .. "\0" .. parameters:sub(at, at) .. load_bytes(motor, address, size)
    local sum = checksum(bytes)
    bytes = bytes .. string.char(sum % 256, sum // 256)
  end
  line:send(bytes)
end

local function one_motor(line, id, code, parameters)
  local motor = line.motors[id]
  if not motor then return end
  if code == 0x01 then
    answer(line, id, 0, "\x06\x04\x26")  -- model 1030, firmware 38
  elseif code == 0x02 and #parameters == 4 then
    local address, size = string.unpack("<I2 I2", parameters)
    if address + size > memory_size then return answer(line, id, 7, "") end
    answer(line, id, 0, load_bytes(motor, address, size))
  elseif code == 0x03 and #parameters > 2 then
    answer(line, id, write(motor, string.unpack("<I2", parameters), parameters:sub(3)), "")
  else
    answer(line, id, 2, "")
  end
end

local function obey(line, id, code, parameters)
  for _, motor in pairs(line.motors) do update(line, motor) end
  if id ~= broadcast then return one_motor(line, id, code, parameters) end
  line.instructions[code] = (line.instructions[code] or 0) + 1
  if code == 0x83 then sync_write(line, parameters) elseif code == 0x82 then sync_read(line, parameters) elseif code == 0x8A then fast_sync_read(line, parameters) end
end

-- processes the packets among received bytes; returns the remaining bytes
local function take_packets(line, bytes)
  while true do
    local at = bytes:find("\xFF\xFF\xFD\0", 1, true)
    if not at then return bytes:sub(-3) end
    bytes = bytes:sub(at)
    if #bytes < 7 then return bytes end
    local length = bytes:byte(6) + 256 * bytes:byte(7)
    if length >= 3 and length <= 1000 and #bytes < 7 + length then return bytes end
    local whole = bytes:sub(1, 7 + length)
    local is_valid = length >= 3 and length <= 1000 and checksum(whole:sub(1, -3)) == whole:byte(-2) + 256 * whole:byte(-1)
    if is_valid then
      local body = whole:sub(8, -3):gsub("\xFF\xFF\xFD\xFD", "\xFF\xFF\xFD")
      bytes = bytes:sub(8 + length)
      obey(line, whole:byte(5), body:byte(1), body:sub(2))
    else
      bytes = bytes:sub(5)
    end
  end
end

local function serve(line)
  local waiting = ""
  while true do
    -- a packet whose remainder does not arrive is dropped
    local bytes, why = line:receive(waiting ~= "" and 0.02 or nil)
    if bytes then
      waiting = take_packets(line, waiting .. bytes)
    elseif why == "timeout" then
      waiting = #waiting > 1 and take_packets(line, waiting:sub(2)) or ""
    else
      return
    end
  end
end

--- Simulates Dynamixel motors of the X series on one bus, on a pseudo-terminal.
---@param options? table
---@option ids? integer[]  of the motors; only 1 by default
---@option speed? number [rad/s, > 0] = 5
---@option fast? boolean = true  false: old firmware, without fast sync read
---@option flip_bytes? number [0 to 1] = 0  fraction of the bytes in which a bit is changed
---@option lose_bytes? number [0 to 1] = 0  fraction of the bytes that are lost
---@option delay? number [s, >= 0] = 0  before each answer
---@option seed? integer [0 to 9007199254740992] = 1
---@return table bus # `path`, `motors` by id, `instructions`: number of broadcasts of each, `unplug()`, `close()`
---@effect edits
--- > simulated = clench.devices.simulated.dynamixel {ids = {1, 2}}
--- > line = clench.port.serial {path = simulated.path}
--- > line:write "\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E"
--- > line:read(14, 1) == "\xFF\xFF\xFD\x00\x01\x07\x00\x55\x00\x06\x04\x26\x65\x5D"  --> true
--- > simulated:close()
--- > simulated.path:find "^/dev/" ~= nil  --> true
return function(options)
  return new_line("dynamixel", options, function(o)
    local ids, motors = o:raw "ids" or {1}, {}
    if type(ids) ~= "table" or #ids == 0 then o:expected("ids", "a list of numbers", ids) end
    for i, id in ipairs(ids) do
      if math.type(id) ~= "integer" or id < 0 or id > 252 then o:expected(("ids[%d]"):format(i), "a number from 0 to 252", id) end
      motors[id] = new_motor()
    end
    return {motors = motors, instructions = {}, speed = o:get "speed", fast = o:get "fast"}
  end, serve)
end
