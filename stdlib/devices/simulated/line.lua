--- The line of a simulated device: a pseudo-terminal that delays, changes and loses bytes in both directions.
local class = require "clench.class"
local loop = clench.loop
local new_options = require "clench.options"

local Line = class "simulated device"

function Line:__tostring() return ("simulated %s at %s"):format(self.name, self.path) end

-- the bytes as they leave the line
local function distorted(self, bytes)
  if self.flip_bytes == 0 and self.lose_bytes == 0 then return bytes end
  local out = {}
  for i = 1, #bytes do
    local byte = bytes:byte(i)
    if self.random:uniform() < self.flip_bytes then byte = byte ~ (1 << self.random:integer(0, 7)) end
    if self.random:uniform() >= self.lose_bytes then out[#out + 1] = string.char(byte) end
  end
  return table.concat(out)
end

--- Bytes that a program has sent; nil: the device is unplugged.
function Line:receive(seconds)
  local bytes, why = self.port:read_some(seconds)
  return bytes and distorted(self, bytes), why
end

--- Sends bytes to the program.
function Line:send(bytes)
  if self.delay > 0 then loop.sleep(self.delay) end
  self.port:send(distorted(self, bytes))
end

--- Unplugs the device: the program's line is lost.
function Line:unplug() self.port:close() end

--- Ends the simulation.
function Line:close() self.port:close() end

Line.__close = function(self) self:close() end

---@param name string  "barrett"
---@param options? table  of the caller
---@param read fun(o: table): table  reads the device's own options, and returns its fields
---@param serve fun(line: table)  simulates the device, in a coroutine
return function(name, options, read, serve)
  local o = new_options("devices.simulated." .. name, options or {})
  local fields = read(o)
  fields.name, fields.flip_bytes, fields.lose_bytes = name, o:get "flip_bytes", o:get "lose_bytes"
  fields.delay = o:get "delay"
  fields.random = clench.random(o:get "seed")
  o:done()
  fields.port = clench.port.pty()
  fields.path = fields.port.path
  local line = setmetatable(fields, Line)
  loop.spawn(function() serve(line) end)
  return line
end
