--- A client of a server: receives its lines as they arrive, and sends replies without waiting.
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
  local _, ending = self.port:fill()
  if ending then
    self.has_ended = true
    stop_reading(self)
  elseif self.port.stream:size() > max_waiting(self) then
    stop_reading(self)
  end
  self.on_input(self)
end

local function start_reading(self)
  if not self.watch and not self.has_ended and not self.is_closed then
    self.watch = loop.on(self.port.stream:descriptor(), function() read(self) end)
  end
end

--- Takes the next line.
---@return string? line  nil: there is none
---@return string? reason  "too long"
function Client:take_line()
  if self.is_closed then return nil end
  local line, why = self.port:take_line()
  if not self.watch and self.port.stream:size() <= max_waiting(self) then start_reading(self) end
  return line, why
end

--- Sends text. A client that does not receive its replies is disconnected.
function Client:send(text)
  if self.is_closed then return end
  local ok, why = self.port:send(text)
  if not ok then self:close(why == "full" and "it does not receive" or why) end
end

--- Closes the connection at once.
---@param reason? string  for the server's log
function Client:close(reason)
  if self.is_closed then return end
  self.is_closed, self.reason = true, reason or "closed"
  stop_reading(self)
  self.port:close()
  self.on_close(self)
end

--- Closes the connection once all replies are sent, or after some seconds.
function Client:finish(reason)
  if self.is_closed or self.is_finishing then return end
  self.is_finishing = true
  stop_reading(self)
  if self.port.queued == 0 then return self:close(reason) end
  loop.spawn(function()
    self.port:drain(5)
    self:close(reason)
  end)
end

---@param port port
---@param number integer
---@param on_input fun(client: table)  called when something has arrived
---@param on_close fun(client: table)
return function(port, number, on_input, on_close)
  local client = setmetatable({port = port, number = number, on_input = on_input, on_close = on_close}, Client)
  start_reading(client)
  return client
end
