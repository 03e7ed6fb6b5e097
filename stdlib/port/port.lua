--- A port: a stream of bytes whose reads and writes wait in the event loop. The end of a stream is a result: nil and the reason, "closed"
--- (by this side or the other), "unplugged" (the device or connection was lost) or "timeout".
local check = require "clench.port.check"
local class = require "clench.class"
local described = require "clench.described"
local loop = clench.loop
local raise = require "clench.raise"
local recording = require "clench.port.recording"

local Port = class "port"

local default_max_line = 1 << 20    -- [bytes]
local default_max_queue = 4 << 20   -- maximum size of data that wait to be sent [bytes]
local max_read = 1 << 26            -- maximum of one read by count [bytes]
local max_discard = 1 << 20         -- maximum that arrives while earlier bytes are discarded [bytes]

function Port:__tostring() return ("port %s%s"):format(self.name, self:is_open() and "" or " (closed)") end

-- waits until the stream is ready; false: timeout
local function wait(self, last, event)
  local left = last and last - loop.time()
  if left and left <= 0 then return false end
  local stream = self.stream
  return loop.wait(event == "writable" and stream:write_descriptor() or stream:descriptor(), left, event)
end

-- Reads until found(self, x) returns a result, or nil and a reason; returns the same.
local function receive(self, method, seconds, found, x)
  check.seconds("port:" .. method, seconds)
  if self.is_reading then raise(("port:%s: another coroutine reads from %s"):format(method, self.name)) end
  local stream, last = self.stream, seconds and loop.time() + seconds
  self.is_reading = true
  local _ <close> = self.reading
  while true do
    local result, why = found(self, x)
    if result then return result end
    if why then return nil, why end
    if self:fill() == 0 then
      if stream:ending() then return nil, stream:ending() end
      if not wait(self, last, "readable") then return nil, "timeout" end
    end
  end
end

local function find_count(self, count)
  if self.stream:size() >= count then return self.stream:take(count) end
end

local function find_any(self)
  local size = self.stream:size()
  if size > 0 then return self.stream:take(size) end
end

-- drops the rest of a line that was too long; false: its end has not arrived yet
local function skip(self, delimiter)
  local stream = self.stream
  local at = stream:find(delimiter)
  stream:take(at and at + #delimiter or math.max(stream:size() - #delimiter + 1, 0))
  self.is_skipping = not at
  return at ~= nil
end

local function find_delimiter(self, delimiter)
  if self.is_skipping and not skip(self, delimiter) then return nil end
  local stream = self.stream
  local at = stream:find(delimiter)
  if (at or stream:size()) > self.max_line then
    skip(self, delimiter)
    return nil, "too long"
  end
  if at then return stream:take(at + #delimiter):sub(1, at) end
end

--- Reads a number of bytes.
---@param count integer
---@param seconds? number  maximum waiting time [s]
---@return string? bytes  nil if fewer have arrived; these can still be read
---@return string? reason  "timeout", "closed" or "unplugged"
function Port:read(count, seconds)
  return receive(self, "read", seconds, find_count, check.integer("port:read", "count", count, 1, max_read))
end

--- Reads the bytes that have arrived; waits for at least one.
---@param seconds? number  maximum waiting time [s]
function Port:read_some(seconds) return receive(self, "read_some", seconds, find_any) end

--- Reads up to a delimiter, which is removed and not returned.
---@param delimiter string
---@param seconds? number  maximum waiting time [s]
---@return string? text
---@return string? reason  as of read; "too long": a text of more than max_line bytes was dropped
function Port:read_until(delimiter, seconds)
  check.string("port:read_until", "delimiter", delimiter)
  return receive(self, "read_until", seconds, find_delimiter, delimiter)
end

-- a line without the "\r" of its end
local function without_return(line, why)
  if not line then return nil, why end
  if line:byte(-1) == 13 then return line:sub(1, -2) end
  return line
end

--- Reads a line, without its end, "\n" or "\r\n".
---@param seconds? number  maximum waiting time [s]
function Port:read_line(seconds)
  return without_return(receive(self, "read_line", seconds, find_delimiter, "\n"))
end

--- Buffers the bytes that have arrived, without waiting.
---@return integer count  number of bytes that have arrived; 0: none
---@return string? reason  "closed" or "unplugged": no more will arrive
function Port:fill()
  local count = self.stream:fill()
  if count > 0 and self.on_received then self.on_received(self.stream:tail(count)) end
  return count, self.stream:ending()
end

--- Takes a line from the bytes that fill has read, without waiting.
---@return string? line  nil if no line has arrived yet
---@return string? reason  "too long", as of read_until
function Port:take_line()
  return without_return(find_delimiter(self, "\n"))
end

--- Removes all bytes that have arrived and were not read, and returns them; of a stream that never pauses, only up to a limit.
function Port:discard()
  local left = max_discard
  repeat
    local count = self:fill()
    left = left - count
  until count == 0 or left <= 0
  return self.stream:take(self.stream:size())
end

local function stop_flushing(self)
  if self.flushing then self.flushing:remove() end
  self.flushing = nil
end

-- sends as much of the queue as the system accepts
local function flush(self)
  local queue = self.queue
  while queue.first <= queue.last do
    local bytes = queue[queue.first]
    local count = self.stream:write(bytes, queue.from)
    queue.from, self.queued, self.sent = queue.from + count, self.queued - count, self.sent + count
    if queue.from < #bytes then break end
    queue[queue.first] = nil
    queue.first, queue.from = queue.first + 1, 0
  end
  if self.stream:write_ending() then
    self.queue, self.queued = {first = 1, last = 0, from = 0}, 0
  end
  if self.queued == 0 then stop_flushing(self) end
end

-- appends bytes to the queue, and sends as many as possible now
local function put(self, bytes)
  if self.check_sent then self.check_sent(bytes) end
  if self.on_sent then self.on_sent(bytes) end
  self.put = self.put + #bytes
  local count = 0
  if self.queued == 0 then
    count = self.stream:write(bytes, 0)
    self.sent = self.sent + count
    if count == #bytes then return end
  end
  local queue = self.queue
  queue.last, queue.from = queue.last + 1, self.queued == 0 and count or queue.from
  queue[queue.last] = bytes
  self.queued = self.queued + #bytes - count
  if not self.flushing then
    flush(self)
    if self.queued > 0 then self.flushing = loop.on(self.stream:write_descriptor(), function() flush(self) end, "writable") end
  end
end

local function check_bytes(method, bytes)
  if type(bytes) ~= "string" then raise(("port:%s: bytes: expected a string, got %s"):format(method, described(bytes))) end
end

local function fits(self, bytes) return self.queued == 0 or self.queued + #bytes <= self.max_queue end

--- Sends bytes without waiting: those that the system does not accept now are queued, and sent by the loop.
---@param bytes string
---@return boolean? ok
---@return string? reason  "full": more than max_queue bytes would be queued, so none of these are sent; "closed" or "unplugged"
function Port:send(bytes)
  check_bytes("send", bytes)
  local ending = self.stream:write_ending()
  if ending then return nil, ending end
  if not fits(self, bytes) then return nil, "full" end
  put(self, bytes)
  ending = self.stream:write_ending()
  if ending then return nil, ending end
  return true
end

local function wait_until(self, last, is_over)
  while not is_over() do
    local ending = self.stream:write_ending()
    if ending then return nil, ending end
    if not wait(self, last, "writable") then return nil, "timeout" end
    flush(self)
  end
  return true
end

--- Sends bytes, and waits until the system has accepted all of them.
---@param bytes string
---@param seconds? number  maximum waiting time [s]
---@return boolean? ok
---@return string? reason  "timeout", "closed" or "unplugged"; after a timeout the loop sends the rest
function Port:write(bytes, seconds)
  check_bytes("write", bytes)
  check.seconds("port:write", seconds)
  local last = seconds and loop.time() + seconds
  local ok, why = wait_until(self, last, function() return fits(self, bytes) end)
  if ok and self.stream:write_ending() then ok, why = nil, self.stream:write_ending() end
  if not ok then return nil, why end
  put(self, bytes)
  local goal = self.put
  return wait_until(self, last, function() return self.sent >= goal end)
end

--- Waits until all bytes that are queued have been sent.
---@param seconds? number  maximum waiting time [s]
function Port:drain(seconds)
  check.seconds("port:drain", seconds)
  local goal = self.put
  return wait_until(self, seconds and loop.time() + seconds, function() return self.sent >= goal end)
end

--- False if it is known that no more will arrive.
function Port:is_open() return self.stream:ending() == nil end

--- Closes the port. Coroutines that wait for it continue, with the reason "closed".
function Port:close()
  if self.stream:descriptor() >= 0 then
    loop.release(self.stream:descriptor())
    loop.release(self.stream:write_descriptor())
  end
  self.flushing = nil
  self.stream:close()
  flush(self)
  self:stop_recording()
  if self.on_close then self.on_close() end
end

Port.__close = function(self) self:close() end

--- Records all bytes sent and received from now on, with their times, for `clench.port.replay`.
---@param path string  file to write
function Port:record(path)
  check.string("port:record", "path", path)
  self:stop_recording()
  local writer = recording.create(path)
  self.on_received = function(bytes) writer("<", bytes) end
  self.on_sent = function(bytes) writer(">", bytes) end
  self.is_recorded = true
end

--- Ends the recording.
function Port:stop_recording()
  if self.is_recorded then self.on_received, self.on_sent, self.is_recorded = nil, nil, nil end
end

---@param stream userdata  as returned by clench.open_serial and similar functions
---@param fields? table  additional fields of the port
return function(stream, fields)
  local port = {stream = stream, name = stream:name(), queue = {first = 1, last = 0, from = 0}, queued = 0, put = 0, sent = 0,
                max_line = default_max_line, max_queue = default_max_queue}
  for key, value in pairs(fields or {}) do port[key] = value end
  port.reading = setmetatable({}, {__close = function() port.is_reading = false end})
  return setmetatable(port, Port)
end
