--- Modbus RTU as a master: requests and answers with their CRC-16 (polynomial 0xA001, reflected).
local device = require "clench.devices.device"
local raise = require "clench.raise"
local modbus = {}

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

-- one exchange: the answer without checksum; nil and the reason if there is none
local function exchange(master, request, size)
  local _ <close> = device.use(master)
  local port = master.port
  port:discard()
  local ok, why = port:write(request, master.timeout)
  if not ok then return nil, why end
  local head
  head, why = read(port, 5, master.timeout)  -- length of an answer that reports an error
  if not head then return nil, why end
  if head:byte(2) & 0x80 == 0 then
    local rest
    rest, why = read(port, size - 5, master.timeout)
    if not rest then return nil, why == "timeout" and "damaged" or why end
    head = head .. rest
  end
  if modbus.crc(head:sub(1, -3)) ~= string.unpack("<I2", head, #head - 1) or head:sub(1, 1) ~= request:sub(1, 1) then return nil, "damaged" end
  return head:sub(1, -3)
end

-- repeats a request until it is answered; start: first bytes of a correct answer, after the number of the slave; size: its length
local function ask(master, bytes, start, size, doing)
  local request = modbus.frame(bytes)
  local answer = device.repeated(master.subject, master, function()
    local answer, why = exchange(master, request, size)
    local is_right = answer and (answer:sub(2, 1 + #start) == start or answer:byte(2) == bytes:byte(2) | 0x80)
    if is_right then return answer end
    return nil, why or "damaged"
  end, doing)
  if answer:byte(2) == bytes:byte(2) then return answer end
  raise(("%s: the device rejects the request: %s (exception %d)"):format(master.subject, doing, answer:byte(3)), "stale")
end

--- Reads registers.
---@param master {subject: string, port: port, slave: integer, timeout: number, attempts: integer}
---@return string bytes  two per register
function modbus.read(master, address, count)
  local answer = ask(master, string.pack(">B B I2 I2", master.slave, 3, address, count), string.char(3, 2 * count), 5 + 2 * count, "reading registers")
  return answer:sub(4)
end

--- Writes registers.
---@param bytes string  two per register
function modbus.write(master, address, bytes)
  local head = string.pack(">B B I2 I2 B", master.slave, 16, address, #bytes // 2, #bytes)
  ask(master, head .. bytes, head:sub(2, 6), 8, "writing registers")
end

return modbus
