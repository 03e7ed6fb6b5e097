local begin_connect = require "clench.begin_connect"
local check = require "clench.port.check"
local loop = clench.loop
local new_port = require "clench.port.port"
local raise = require "clench.raise"
local resolve = require "clench.resolve_host"

local subject = "clench.port.connect"

-- numeric addresses of a host; names are looked up in a job, as that may take seconds
local function addresses_of(host, last)
  local found = resolve(host, true)
  if #found > 0 then return found end
  if host:find "[%z\1-\32]" then raise(("%s: host: expected a name or an address, got '%s'"):format(subject, (host:gsub("%c", "?")))) end
  local job = clench.job(function(name) return require "clench.resolve_host"(name, false) end, {args = {host}, name = "look up " .. host})
  if not loop.wait(job, math.max(0, last - loop.time())) then
    job:stop()
    raise(("%s: the host '%s' was not found in time"):format(subject, host), "file")
  end
  found = job:result()
  if #found == 0 then raise(("%s: there is no host '%s'"):format(subject, host), "file") end
  return found
end

-- a port, or nil and the reason if there is none
local function try(last, ...)
  local ok, stream = pcall(begin_connect, ...)
  if not ok then return nil, stream end
  if not loop.wait(stream:descriptor(), math.max(0, last - loop.time()), "writable") then return nil, "no answer in time" end
  local why = stream:connect_error()
  if why then return nil, stream:name() .. ": " .. why end
  return new_port(stream)
end

--- Connects to a server.
---@param host string  a name or an address; without `port`, the path of a Unix socket
---@param port? integer [1 to 65535]  of the server
---@param seconds? number  maximum waiting time; 10 by default [s]
---@return port
---@effect edits
--- > listener = clench.port.listen {}
--- > client = clench.port.connect("127.0.0.1", listener.port)
--- > server = listener:accept(1)
--- > server:write "hello\n"
--- > client:read_line(1)  --> hello
--- > listener:close()
--- > clench.port.connect("127.0.0.1", 1)  --> error: 127.0.0.1:1: Connection refused
return function(host, port, seconds)
  check.string(subject, "host", host)
  if port ~= nil then port = check.integer(subject, "port", port, 1, 65535) end
  check.seconds(subject, seconds)
  local last = loop.time() + (seconds or 10)
  local tried = {}
  for _, address in ipairs(port and addresses_of(host, last) or {host}) do
    local made, why = try(last, address, port)
    if made then return made end
    tried[#tried + 1] = type(why) == "string" and why or why.sentence
  end
  raise(("%s: %s"):format(subject, table.concat(tried, "; ")), "file")
end
