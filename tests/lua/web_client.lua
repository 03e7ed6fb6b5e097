-- A client of WebSockets for tests, written from RFC 6455 without the server's code; it can also send what the RFC forbids.
local clench = require "clench"
local web_client = {}

local function masked(payload, key)
  local out = {}
  for i = 1, #payload do out[i] = string.char(payload:byte(i) ~ key:byte((i - 1) % 4 + 1)) end
  return table.concat(out)
end

--- A frame. options: last = false (a fragment), key = "" (no mask), reserved = bits, size = a size that is not that of the payload.
function web_client.frame(opcode, payload, options)
  options = options or {}
  local key = options.key or "\x12\x34\xab\xcd"
  local size = options.size or #payload
  local first = (options.last == false and 0 or 128) | (options.reserved or 0) | opcode
  local bit = key ~= "" and 128 or 0
  local head = math.ult(size, 126) and string.pack("BB", first, bit | size)
    or math.ult(size, 65536) and string.pack(">BBI2", first, bit | 126, size)
    or string.pack(">BBI8", first, bit | 127, size)
  return head .. key .. (key ~= "" and masked(payload, key) or payload)
end

--- Reads a frame: {opcode, payload}, or nil and why there is none.
function web_client.read_frame(port, seconds)
  local head, why = port:read(2, seconds)
  if not head then return nil, why end
  local first, size = head:byte(1, 2)
  assert(first & 0x70 == 0 and size < 128, "a frame of a server has no mask and no reserved bits")
  if size == 126 then size = (">I2"):unpack(assert(port:read(2, seconds))) end
  if size == 127 then size = (">I8"):unpack(assert(port:read(8, seconds))) end
  local payload = ""
  if size > 0 then
    payload, why = port:read(size, seconds)
    if not payload then return nil, why end
  end
  return {opcode = first & 15, payload = payload}
end

--- All bytes of a connection until it ends.
function web_client.read_all(port, seconds)
  local out = {}
  while true do
    local bytes, why = port:read_some(seconds or 10)
    if not bytes then return table.concat(out), why end
    out[#out + 1] = bytes
  end
end

--- Connects and asks for a WebSocket. fields: further header fields, or false for one that is left out.
---@return table port, string head
function web_client.open(port_number, target, fields)
  local port = clench.port.connect("127.0.0.1", port_number)
  local all = {Host = "127.0.0.1:" .. port_number, Upgrade = "websocket", Connection = "Upgrade", ["Sec-WebSocket-Version"] = "13",
               ["Sec-WebSocket-Key"] = "dGhlIHNhbXBsZSBub25jZQ=="}
  for name, value in pairs(fields or {}) do all[name] = value end
  local head = {"GET " .. target .. " HTTP/1.1"}
  for name, value in pairs(all) do head[#head + 1] = value and name .. ": " .. value or nil end
  port:write(table.concat(head, "\r\n") .. "\r\n\r\n")
  return port, port:read_until("\r\n\r\n", 10)
end

--- A caller of JSON-RPC over an open connection: call(method, params) returns the response; `notes` has what came before it.
---@param port table
---@param version? string  "2.0" by default; false: requests have none
function web_client.caller(port, version)
  if version == nil then version = "2.0" end
  local number, notes = 0, {}
  return function(method, params)
    number = number + 1
    port:write(web_client.frame(1, clench.json.encode {jsonrpc = version or nil, id = number, method = method, params = params}))
    while true do
      local frame, why = web_client.read_frame(port, 20)
      assert(frame, why)
      if frame.opcode == 1 then
        local message = clench.json.decode(frame.payload)
        if message.id == number then return message end
        notes[#notes + 1] = message
      end
    end
  end, notes
end

return web_client
