-- CRC-16 of Modbus by a table of the reflected polynomial
local table_of = {}
for byte = 0, 255 do
  local crc = byte
  for _ = 1, 8 do crc = crc % 2 == 1 and (crc // 2) ~ 0xA001 or crc // 2 end
  table_of[byte] = crc
end

local function checksum(bytes)
  local crc = 0xFFFF
  for i = 1, #bytes do crc = crc // 256 ~ table_of[(crc ~ bytes:byte(i)) % 256] end
  return string.char(crc % 256, crc // 256)
end

-- function 3: all or some registers of a block
local function read(blocks, address, count)
  for first, block in pairs(blocks) do
    if block.read and count > 0 and address >= first and address + count <= first + block.count then
      local from = 2 * (address - first)
      return "\3" .. string.char(2 * count) .. block.read():sub(from + 1, from + 2 * count)
    end
  end
  return "\x83\2"
end

-- the answer to a frame without its checksum
local function answer(blocks, frame)
  local code = frame:byte(2)
  if code == 3 and #frame == 6 then return read(blocks, string.unpack(">I2 I2", frame, 3)) end
  if code == 16 and #frame >= 7 and #frame == 7 + frame:byte(7) then
    local address, count = string.unpack(">I2 I2", frame, 3)
    local block = blocks[address]
    if not block or not block.write or count ~= block.count or #frame ~= 7 + 2 * count then return "\x90\2" end
    block.write(frame:sub(8))
    return "\16" .. frame:sub(3, 6)
  end
  return string.char(code | 0x80, 1)
end

local function size_of(bytes)
  if bytes:byte(2) == 16 then return #bytes >= 7 and 9 + bytes:byte(7) or nil end
  return 8
end

--- Simulates a Modbus RTU slave, until the line is unplugged.
---@param line table  a simulated line with the field `slave`
---@param blocks table  by address: {count = registers, read = fun(): string, write = fun(bytes: string)}; a block is always written completely
---@param update fun()  called before each answer
return function(line, blocks, update)
  local waiting = ""
  while true do
    -- silence ends a frame
    local bytes, why = line:receive(waiting ~= "" and 0.005 or nil)
    if bytes then
      waiting = waiting .. bytes
    elseif why == "timeout" then
      waiting = ""
    else
      return
    end
    local size = #waiting >= 2 and size_of(waiting)
    if size and #waiting >= size then
      local frame, sum = waiting:sub(1, size - 2), waiting:sub(size - 1, size)
      waiting = ""
      if checksum(frame) == sum and frame:byte(1) == line.slave then
        update()
        local reply = frame:sub(1, 1) .. answer(blocks, frame)
        line:send(reply .. checksum(reply))
      end
    end
  end
end
