--- Packets of the Dynamixel protocol 2.0: header, id, length, instruction, parameters with stuffed bytes, CRC-16 (polynomial 0x8005).
local raise = require "clench.raise"
local packet = {}

local header = "\xFF\xFF\xFD\x00"
packet.broadcast = 0xFE
packet.instructions = {ping = 0x01, read = 0x02, write = 0x03, reg_write = 0x04, action = 0x05, reboot = 0x08, clear = 0x10, status = 0x55,
                       sync_read = 0x82, sync_write = 0x83, fast_sync_read = 0x8A}

local crc_of_byte = {}
for byte = 0, 255 do
  local crc = byte << 8
  for _ = 1, 8 do crc = crc & 0x8000 ~= 0 and (crc << 1 ~ 0x8005) & 0xFFFF or crc << 1 end
  crc_of_byte[byte] = crc
end

--- The checksum of bytes.
function packet.crc(bytes)
  local crc = 0
  for i = 1, #bytes do crc = (crc << 8 & 0xFFFF) ~ crc_of_byte[crc >> 8 ~ bytes:byte(i)] end
  return crc
end

--- A complete packet.
---@param id integer
---@param instruction string  name of an instruction
---@param parameters? string
function packet.encode(id, instruction, parameters)
  local code = packet.instructions[instruction] or raise("devices.dynamixel: there is no instruction '" .. tostring(instruction) .. "'")
  local body = (string.char(code) .. (parameters or "")):gsub("\xFF\xFF\xFD", "\xFF\xFF\xFD\xFD")
  local bytes = header .. string.pack("<B I2", id, #body + 2) .. body
  return bytes .. string.pack("<I2", packet.crc(bytes))
end

--- The first packet among received bytes.
---@return table? found  {id, error, parameters, raw}; nil: none is complete yet
---@return integer next  position at which the search continues
---@return boolean? damaged  a packet with a wrong checksum was skipped
function packet.decode(bytes, from)
  local at = bytes:find(header, from, true)
  if not at then return nil, math.max(from, #bytes - 2) end  -- a header may begin in the last bytes
  if #bytes < at + 6 then return nil, at end
  local id, length = string.unpack("<B I2", bytes, at + 4)
  if length < 4 or length > 1000 then return nil, at + 1, true end
  if #bytes < at + 6 + length then return nil, at end
  local crc = string.unpack("<I2", bytes, at + 5 + length)
  if packet.crc(bytes:sub(at, at + 4 + length)) ~= crc then return nil, at + 1, true end
  local raw = bytes:sub(at + 7, at + 4 + length)
  local body = raw:gsub("\xFF\xFF\xFD\xFD", "\xFF\xFF\xFD")
  return {id = id, instruction = body:byte(1), error = body:byte(2), parameters = body:sub(3)}, at + 7 + length
end

-- bytes per motor in an answer to a fast sync read, in addition to its data: error, id and checksum
local block_overhead = 4

--- The answer of several motors to a fast sync read: one packet, without stuffed bytes, to which each motor appends a block.
---@param ids integer[]  of the motors, in the order of the request
---@param size integer  of the data of each [bytes]
---@return table? answers  {error, parameters} by id; nil: it is not complete yet
---@return boolean? damaged  it has a wrong checksum, or is not from these motors
function packet.decode_fast(bytes, ids, size)
  local at = bytes:find(header, 1, true)
  if not at then return nil end
  local length = 1 + #ids * (size + block_overhead)
  if #bytes < at + 6 + length then return nil end
  local id, found_length, instruction = string.unpack("<B I2 B", bytes, at + 4)
  local crc = string.unpack("<I2", bytes, at + 5 + length)
  if id ~= packet.broadcast or found_length ~= length or instruction ~= packet.instructions.status or packet.crc(bytes:sub(at, at + 4 + length)) ~= crc then return nil, true end
  local answers = {}
  for i, wanted in ipairs(ids) do
    local from = at + 8 + (i - 1) * (size + block_overhead)
    local code, found = bytes:byte(from, from + 1)
    if found ~= wanted then return nil, true end
    answers[found] = {error = code, parameters = bytes:sub(from + 2, from + 1 + size)}
  end
  return answers
end

return packet
