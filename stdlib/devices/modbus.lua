--- Modbus RTU as a master: requests and answers with their CRC-16 (polynomial 0xA001, reflected).
local device = require "clench.devices.device"
local raise = require "clench.raise"
local modbus = {}

local read_code, write_code = 3, 16  -- functions of a slave
local write_answer_size = 8          -- [bytes]

--- The checksum of bytes.
function modbus.crc(bytes)
  local crc = 0xFFFF
  for i = 1, #bytes do
    crc = crc ~ bytes:byte(i)
    for _ = 1, 8 do crc = crc & 1 ~= 0 and crc >> 1 ~ 0xA001 or crc >> 1 end
  end
  return crc
end

--- A frame with its checksum.
function modbus.frame(bytes) return bytes .. string.pack("<I2", modbus.crc(bytes)) end

-- exactly `size` bytes; nil and the reason: "damaged" if only some of them were received
local function read(port, size, seconds)
  local bytes, why = port:read(size, seconds)
  if not bytes and why == "timeout" and port:read_some(0) then why = "damaged" end
  return bytes, why
end

-- The answer to a request, without checksum; nil and the reason if there is none, or if it belongs to another request.
-- start: first bytes of a correct answer, after the number of the slave; size: its length; seconds: maximum waiting time
local function exchange(master, bytes, start, size, seconds)
  local _ <close> = device.use(master)
  local port = master.port
  port:discard()
  local ok, why = port:write(modbus.frame(bytes), seconds)
  if not ok then return nil, why end
  local frame
  frame, why = read(port, 5, seconds)  -- length of an answer that reports an error
  if not frame then return nil, why end
  if frame:byte(2) & 0x80 == 0 then
    local rest
    rest, why = read(port, size - 5, seconds)
    if not rest then return nil, why == "timeout" and "damaged" or why end
    frame = frame .. rest
  end
  local answer = frame:sub(1, -3)
  local is_right = answer:byte(1) == master.slave and (answer:sub(2, 1 + #start) == start or answer:byte(2) == bytes:byte(2) | 0x80)
  if not is_right or modbus.crc(answer) ~= string.unpack("<I2", frame, #frame - 1) then return nil, "damaged" end
  return answer
end

local function ask(master, bytes, start, size, doing)
  local answer = device.ask(master, doing, exchange, bytes, start, size, master.timeout)
  if answer:byte(2) == bytes:byte(2) then return answer end
  raise(("%s: the device rejects the request: %s (exception %d)"):format(master.subject, doing, answer:byte(3)), "stale")
end

--- Reads registers.
---@param master {subject: string, port: port, slave: integer, timeout: number, attempts: integer}
---@return string bytes  two per register
function modbus.read(master, address, count)
  local request = string.pack(">B B I2 I2", master.slave, read_code, address, count)
  return ask(master, request, string.char(read_code, 2 * count), 5 + 2 * count, "reading registers"):sub(4)
end

local function write_request(master, address, bytes)
  return string.pack(">B B I2 I2 B", master.slave, write_code, address, #bytes // 2, #bytes) .. bytes
end

-- the answer to this request begins like it: function, address and number of registers
local function write_start(request) return request:sub(2, 6) end

--- Writes registers.
---@param bytes string  two per register
function modbus.write(master, address, bytes)
  local request = write_request(master, address, bytes)
  ask(master, request, write_start(request), write_answer_size, "writing registers")
end

--- The frame that writes registers.
function modbus.write_frame(master, address, bytes) return modbus.frame(write_request(master, address, bytes)) end

--- Writes registers, in one attempt.
---@param seconds number  maximum waiting time [s]
---@return boolean is_confirmed
---@return string? reason  as returned by port:read
function modbus.try_write(master, address, bytes, seconds)
  local request = write_request(master, address, bytes)
  local answer, why = exchange(master, request, write_start(request), write_answer_size, seconds)
  return answer ~= nil and answer:byte(2) == write_code, why
end

return modbus
