local check = require "clench.port.check"
local class = require "clench.class"
local loop = clench.loop
local new_options = require "clench.options"
local new_port = require "clench.port.port"
local on_behalf_of = require "clench.on_behalf_of"
local open_acceptor = require "clench.open_acceptor"
local raise = require "clench.raise"
local resolve = require "clench.resolve_host"

local subject = "clench.port.listen"
local Listener = class "listener"

function Listener:__tostring() return ("listener %s%s"):format(self.name, self:is_open() and "" or " (closed)") end

--- Waits for the next client.
---@param seconds? number  maximum waiting time [s]
---@return port? client
---@return string? reason  "timeout" or "closed"
function Listener:accept(seconds)
  check.seconds("listener:accept", seconds)
  local last = seconds and loop.time() + seconds
  while true do
    if not self:is_open() then return nil, "closed" end
    local stream = self.acceptor:accept()
    if stream then return new_port(stream) end
    local left = last and last - loop.time()
    if left and left <= 0 or not loop.wait(self.acceptor:descriptor(), left) then return nil, "timeout" end
  end
end

function Listener:is_open() return self.acceptor:descriptor() >= 0 end

--- Closes the socket; clients that were accepted stay connected.
function Listener:close()
  if not self:is_open() then return end
  loop.release(self.acceptor:descriptor())
  self.acceptor:close()
end

Listener.__close = function(self) self:close() end

local function address_of(host)
  local found = resolve(host, true)
  if #found == 0 then raise(("%s: host: expected a numeric address or 'localhost', got '%s'"):format(subject, host)) end
  return found[1]
end

--- Listens for clients.
---@param options table
---@option host? string = "127.0.0.1"  an address of this machine; "0.0.0.0" lets other machines connect
---@option port? integer [0 to 65535] = 0  0: the system chooses one, the listener's field `port`
---@option path? string  of a Unix socket, instead of host and port; only programs of the same user may connect
---@return listener listener # `accept`, `close`, `name`, `port`
---@effect edits, files
--- > listener = clench.port.listen {port = 0}
--- > listener.port > 0  --> true
--- > listener:accept(0)  --> nil, timeout
--- > listener:close()
--- > clench.port.listen {host = "example"}  --> error: expected a numeric address or 'localhost'
return function(options)
  local o = new_options(subject, options)
  local host, port, path = o:raw "host", o:raw "port", o:raw "path"
  o:done()
  if path ~= nil then
    check.string(subject, "path", path)
    if host ~= nil or port ~= nil then raise(subject .. ": path: expected either a path or host and port") end
  end
  if host ~= nil then check.string(subject, "host", host) end
  if port ~= nil then port = check.integer(subject, "port", port, 0, 65535) end
  local acceptor = path and on_behalf_of(subject, open_acceptor, path)
    or on_behalf_of(subject, open_acceptor, address_of(host or "127.0.0.1"), port or 0)
  return setmetatable({acceptor = acceptor, name = acceptor:name(), port = acceptor:port()}, Listener)
end
