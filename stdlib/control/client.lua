--- A client of a server: its requests are received and wait to be served; replies are sent without waiting, several at once if further requests wait. Its field `serve`, a function of server and client,
--- handles one line, request or frame that has arrived, and returns false if there is none; its field `wrap` turns a reply into a message.
local class = require "clench.class"
local loop = clench.loop

local Client = class "client"

function Client:__tostring() return ("client %d, %s"):format(self.number, self.port.name) end

-- no more is read while so much waits to be handled [bytes]
local function max_waiting(self) return self.port.max_line + (1 << 16) end

local function stop_reading(self)
  if self.watch then self.watch:remove() end
  self.watch = nil
end

local function read(self)
  local count, ending = self.port:fill()
  if count > 0 then self.heard = loop.time() end
  if ending then
    self.has_ended = true
    stop_reading(self)
  elseif self.port.stream:size() > max_waiting(self) then
    stop_reading(self)
  end
  self.on_input(self)
end

local function start_reading(self)
  if not self.watch and not self.has_ended and not self.is_closed and not self.is_finishing then
    self.watch = loop.on(self.port.stream:descriptor(), function() read(self) end)
  end
end

--- Resumes reading, which stops while too many bytes wait.
function Client:read_on()
  if not self.watch and self.port.stream:size() <= max_waiting(self) then start_reading(self) end
end

--- Holds back further requests until `release`, while a task answers one.
function Client:hold()
  self:flush()
  self.is_held = true
end

function Client:release()
  self.is_held = false
  if not self.is_closed then self.on_input(self) end
end

local max_gathered = 1 << 14  -- replies that are sent together [bytes]

-- the gathered replies, which are removed
local function take_gathered(self)
  local bytes = table.concat(self.gathered)
  self.gathered, self.gathered_size = {}, 0
  return bytes
end

local function send_now(self, bytes)
  local ok, why = self.port:send(bytes)
  if not ok then self:close(why == "full" and "it does not receive" or why) end
end

--- Sends the gathered replies.
function Client:flush()
  self.gathers = false
  if self.gathered_size > 0 and not self.is_closed then send_now(self, take_gathered(self)) end
end

--- Sends bytes; while `gathers` is set, with those that follow. A client that does not receive its replies is disconnected.
function Client:send_raw(bytes)
  if self.is_closed then return end
  if not self.gathers and self.gathered_size == 0 then return send_now(self, bytes) end
  self.gathered[#self.gathered + 1] = bytes
  self.gathered_size = self.gathered_size + #bytes
  if not self.gathers or self.gathered_size > max_gathered then self:flush() end
end

--- Sends a reply.
function Client:send(text) self:send_raw(self.wrap and self.wrap(text) or text) end

local probe_period = 0.05  -- [s]

--- Has the client gone? One that only sends no more still receives: a space before its answer, which JSON permits, finds that out.
function Client:has_gone()
  if not self.has_ended or self.is_closed then return self.is_closed == true end
  if self.wrap then
    self:close "closed by the client"
  elseif loop.time() >= (self.next_probe or 0) then
    self.next_probe = loop.time() + probe_period
    self:send_raw " "
    self:flush()
  end
  return self.is_closed == true
end

--- Closes the connection at once.
---@param reason? string  for the server's log
function Client:close(reason)
  if self.is_closed then return end
  self.is_closed, self.reason = true, reason or "closed"
  stop_reading(self)
  if self.gathered_size > 0 then self.port:send(take_gathered(self)) end
  self.port:close()
  self.on_close(self)
end

--- Closes the connection once all replies are sent, or after some seconds.
---@param reason string
---@param seconds? number  5 by default
function Client:finish(reason, seconds)
  self:flush()
  if self.is_closed or self.is_finishing then return end
  self.is_finishing = true
  stop_reading(self)
  if self.port.queued == 0 then return self:close(reason) end
  loop.spawn(function()
    self.port:drain(seconds or 5)
    self:close(reason)
  end)
end

---@param port port
---@param number integer
---@param serve fun(server: table, client: table): boolean
---@param on_input fun(client: table)  called when something has arrived
---@param on_close fun(client: table)
return function(port, number, serve, on_input, on_close)
  local client = setmetatable({port = port, number = number, serve = serve, began = loop.time(), heard = loop.time(),
                               gathered = {}, gathered_size = 0, on_input = on_input, on_close = on_close}, Client)
  start_reading(client)
  return client
end
