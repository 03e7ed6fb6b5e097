--- Messages of WebSocket clients (RFC 6455), one frame at a time: unmasked, fragments joined, pings answered. A client that breaks the
--- protocol receives the code of its error and is disconnected.
local base64 = require "clench.base64"
local sha1 = require "clench.control.web.sha1"
local socket = {}

local max_fragments = 1000  -- of one message
local max_control = 125     -- payload of a ping, pong or close [bytes]
local text, binary, close, ping, pong = 1, 2, 8, 9, 10

--- The answer to a key of a handshake.
function socket.accept_key(key) return base64(sha1(key .. "258EAFA5-E914-47DA-95CA-C5AB0DC85B11")) end

-- a frame of ours: complete, and not masked
local function frame(opcode, payload)
  local size = #payload
  local first = string.char(0x80 | opcode)
  if size < 126 then return first .. string.char(size) .. payload end
  if size < 1 << 16 then return first .. string.pack(">BI2", 126, size) .. payload end
  return first .. string.pack(">BI8", 127, size) .. payload
end

--- A message to a client.
function socket.message(words) return frame(text, words) end

local function send(client, opcode, payload) client:send_raw(frame(opcode, payload)) end

--- Sends a client the reason, and disconnects it.
function socket.refuse(client, code, reason)
  send(client, close, string.pack(">I2", code) .. reason)
  client:finish(reason)
end

--- Sends a ping.
function socket.ping(client) send(client, ping, "") end

local block = 24  -- integers of eight bytes that are unmasked at a time
local block_format = "<" .. ("i8"):rep(block)

--- Removes the mask of a payload, or adds it.
---@param payload string
---@param key string  four bytes
function socket.masked(payload, key)
  local mask = ("<i8"):unpack(key .. key)
  local out, size = {}, 8 * block
  local padded = payload .. ("\0"):rep(-#payload % size)
  for at = 1, #padded, size do
    local values = {block_format:unpack(padded, at)}
    for i = 1, block do values[i] = values[i] ~ mask end
    out[#out + 1] = block_format:pack(table.unpack(values, 1, block))
  end
  return table.concat(out):sub(1, #payload)
end

-- code of a close frame that a client may send
local function is_code(code) return code >= 1000 and code <= 1003 or code >= 1007 and code <= 1014 or code >= 3000 and code <= 4999 end

local function end_by_client(client, payload)
  if #payload == 0 then
    send(client, close, "")
    return client:finish "closed by the client"
  end
  local code = #payload >= 2 and (">I2"):unpack(payload) or 0
  if not is_code(code) or not utf8.len(payload, 3) then return socket.refuse(client, 1002, "a close frame is wrong") end
  send(client, close, payload:sub(1, 2))
  client:finish "closed by the client"
end

-- a part of a message; returns the message when it is complete
local function add_part(client, header, payload)
  local parts = client.parts
  if header.opcode == 0 and not parts then return socket.refuse(client, 1002, "a continuation without a first frame") end
  if header.opcode ~= 0 and parts then return socket.refuse(client, 1002, "a new message before the end of the last one") end
  if header.is_last and not parts then return payload end
  parts = parts or {size = 0}
  client.parts = parts
  parts[#parts + 1] = payload
  parts.size = parts.size + #payload
  if #parts > max_fragments then return socket.refuse(client, 1008, "a message has too many fragments") end
  if not header.is_last then return nil end
  client.parts = nil
  return table.concat(parts)
end

-- handles a frame; returns a message that it completes
local function take_frame(client, header, payload)
  if header.opcode == close then return end_by_client(client, payload) end
  if header.opcode == ping then return send(client, pong, payload) end
  if header.opcode == pong then return nil end
  local message = add_part(client, header, payload)
  if message and not utf8.len(message) then return socket.refuse(client, 1007, "a message is not UTF-8") end
  return message
end

-- why a frame is refused: code and reason; nil: it is not
local function fault_of(client, header)
  local opcode, kept = header.opcode, client.parts and client.parts.size or 0
  if header.reserved ~= 0 then return 1002, "a reserved bit is set" end
  if not header.is_masked then return 1002, "a frame is not masked" end
  if opcode == binary then return 1003, "messages are text" end
  if opcode ~= 0 and opcode ~= text and (opcode < close or opcode > pong) then return 1002, "the kind of a frame is unknown" end
  if opcode >= close and (not header.is_last or header.size > max_control) then return 1002, "a control frame is too long or not complete" end
  if header.size < 0 or kept + header.size > client.port.max_line then return 1009, ("a message has more than %d bytes"):format(client.port.max_line) end
end

local extended = {[126] = ">I2", [127] = ">i8"}

-- reads the next part of a frame's header; false: it has not arrived yet
local function read_header(client)
  local stream, header = client.port.stream, client.header
  if not header then
    if stream:size() < 2 then return false end
    local first, second = stream:take(2):byte(1, 2)
    header = {is_last = first & 0x80 ~= 0, reserved = first & 0x70, opcode = first & 15, is_masked = second & 0x80 ~= 0, size = second & 127}
    header.format = extended[header.size]
    client.header = header
  end
  if header.key then return true end
  local count = (header.format and header.format:packsize() or 0) + (header.is_masked and 4 or 0)
  if stream:size() < count then return false end
  local rest = stream:take(count)
  if header.format then header.size = header.format:unpack(rest) end
  header.key = header.is_masked and rest:sub(-4) or ""
  return true
end

--- Takes one frame of what has arrived.
---@return boolean some  false: it is not complete yet
---@return string? message  that it completes
function socket.take(client)
  if not read_header(client) then return false end
  local header, stream = client.header, client.port.stream
  local code, reason = fault_of(client, header)
  if code then
    socket.refuse(client, code, reason)
    return true
  end
  if stream:size() < header.size then return false end
  client.header = nil
  return true, take_frame(client, header, socket.masked(stream:take(header.size), header.key))
end

return socket
