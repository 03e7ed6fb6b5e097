local check = require "clench.port.check"
local class = require "clench.class"
local classes = require "clench.classes"
local described = require "clench.described"
local error_text = require "clench.error_text"
local is_loopback = require "clench.control.is_loopback"
local is_stopped = require "clench.is_stopped"
local loop = clench.loop
local mcp = require "clench.control.mcp"
local new_client = require "clench.control.client"
local new_options = require "clench.options"
local new_port = require "clench.port.port"
local open_stdio = require "clench.open_stdio"
local rpc = require "clench.control.rpc"
local text = require "clench.control.text"
local token = require "clench.control.token"
local turn = require "clench.control.turn"
local web = require "clench.control.web"
local getmetatable = debug.getmetatable

local subject = "clench.control.server"
local Server = class "server"

function Server:__tostring()
  return ("server at %s, %d clients%s"):format(self.name, #self.clients, self.is_closed and " (closed)" or "")
end

local methods = {"GET", "POST", "HEAD", "PUT", "DELETE", "OPTIONS", "CONNECT", "PATCH", "TRACE"}

-- a web page can make a browser send such lines to any port
local function looks_like_http(line)
  for _, method in ipairs(methods) do
    if line:find("^" .. method .. "%s") then return true end
  end
  return line:find "HTTP/%d" ~= nil
end

local function answer_text(self, client, line)
  if looks_like_http(line) then return client:close "an HTTP request" end
  if not self.serves_text then
    client:send "Error: commands without a token are accepted on loopback only\n"
    return client:finish "text from another machine"
  end
  client.state = client.state or {}
  local reply = text.answer(self.session, client.state, line)
  if reply ~= "" then client:send(reply) end
end

local text_protocol = {answer = answer_text, max_line = 1 << 16}

function text_protocol.refuse_long(client)
  client:send(("Error: a line has more than %d bytes\n"):format(math.min(client.port.max_line, text_protocol.max_line)))
end

-- the first line determines the protocol of a client
local function protocol_of(client, line)
  client.protocol = client.protocol or line:find "^%s*[%[{]" and rpc or text_protocol
  return client.protocol
end

local function refuse_long(client)
  (client.protocol or text_protocol).refuse_long(client)
  client:finish "a line was too long"
end

-- serves a line of a client; false if no line has arrived
local function serve_line(self, client)
  local line, why = client.port:take_line()
  local protocol = line and protocol_of(client, line)
  if why or line and #line > (protocol.max_line or math.huge) then
    refuse_long(client)
  elseif line then
    protocol.answer(self, client, line)
  end
  return line ~= nil
end

-- Serves one line, request or frame of a client; false if none has arrived. Replies are sent once all that has arrived is answered.
local function serve_one(self, client)
  if client.is_closed or client.is_finishing or client.is_held then return false end
  client.gathers = true
  local some = client.serve(self, client)
  if not some or client.port.stream:size() == 0 then client:flush() end
  client:read_on()
  if not some and client.has_ended then client:finish "closed by the client" end
  return some
end

-- the same; an internal error ends the connection of the client that caused it, not the server
local function serve_safely(self, client)
  local ok, some = pcall(serve_one, self, client)
  if ok then return some end
  if is_stopped(some) then error(some, 0) end
  clench.log.warning(("server: client %d was disconnected after an internal error: %s"):format(client.number, error_text(some)))
  client:close "an internal error"
  return true
end

local max_short = 1 << 12  -- line or frame [bytes]

-- is the next line or frame of a client long?
local function has_long(client)
  if client.header then return client.header.size > max_short end
  local stream = client.port.stream
  return stream:size() > max_short and (stream:find "\n" or 0) > max_short
end

-- serves the next of the clients whose lines are long, after the last one in the order of their connections; false: none has arrived completely
local function serve_long(self, clients)
  for _, is_later in ipairs {true, false} do
    for _, client in ipairs(clients) do
      if (client.number > self.last_long) == is_later and serve_safely(self, client) then
        self.last_long = client.number
        return true
      end
    end
  end
  return false
end

-- Serves one line of each client, but only one long line of all of them, so that short ones wait for no more than that. false: there are no lines
local function serve_each(self, clients)
  local some, long = false, {}
  for _, client in ipairs(clients) do
    if has_long(client) then long[#long + 1] = client else some = serve_safely(self, client) or some end
  end
  return #long > 0 and serve_long(self, long) or some
end

-- Serves clients in the order of their connections, one line of each in turn, until no lines are left.
local function serve(self)
  local count, clients
  local pause = turn.new(function()
    for _, client in ipairs(clients) do client:flush() end
  end)
  repeat
    if count ~= self.count then count, clients = self.count, {table.unpack(self.clients)} end
    local some = serve_each(self, clients)
    if some and pause() then count = nil end
  until not some
  self.is_serving = false
end

local function start_serving(self)
  if self.is_serving or self.is_closed then return end
  self.is_serving = true
  loop.spawn(function() serve(self) end)
end

local function remove(self, client)
  for i, other in ipairs(self.clients) do
    if other == client then table.remove(self.clients, i) break end
  end
  rpc.drop(client)
  if self.on_close then self.on_close(client) end
end

-- a client that has not identified itself in time, by the text protocol or by `hello`
local function find_silent(self)
  for _, client in ipairs(self.clients) do
    local is_known = client.is_authorized or client.protocol == text_protocol or client.is_finishing
    if not is_known and loop.time() - client.began > self.max_silence then return client end
  end
end

-- serve: function that serves a client of this protocol
local function add(self, port, serve)
  local silent = #self.clients >= self.max_clients and find_silent(self)
  if silent then silent:close "another client took its place" end
  if #self.clients >= self.max_clients then
    local words = ("Error: the server has %d clients and accepts no more\n"):format(self.max_clients)
    port:send(serve == serve_line and words or web.busy(words))
    return port:close()
  end
  port.max_line, port.max_queue = self.max_line, self.max_queue
  self.count = self.count + 1
  local client = new_client(port, self.count, serve, function() start_serving(self) end, function(client) remove(self, client) end)
  table.insert(self.clients, client)
  if self.on_connect then self.on_connect(client) end
end

-- the one client of standard input and output: the program that has started this one; when it disconnects, the server ends
local function add_parent(self)
  self.name, self.max_clients = "standard input and output", 1
  local close = self.on_close
  self.on_close = function(client)
    if close then close(client) end
    self:close()
  end
  add(self, new_port(open_stdio()), serve_line)
  self.clients[1].protocol = self.mcp and mcp or rpc
end

local function listen(self, where)
  self.listener = clench.port.listen(where)
  self.name, self.port = self.listener.name, self.listener.port
end

local function listen_http(self, where)
  self.http_listener = clench.port.listen(where)
  self.http = self.http_listener.port
  self.url = ("http://%s/%s"):format(self.http_listener.name, self.token and "?token=" .. self.token or "")
end

local function accept_clients(self, listener, serve)
  while true do
    local ok, port, why = pcall(listener.accept, listener)
    if not ok then
      if is_stopped(port) then error(port, 0) end
      loop.sleep(0.1)  -- out of descriptors: waits until one is closed
    elseif port then
      add(self, port, serve)
    elseif why == "closed" then
      return
    end
  end
end

--- Closes the server and the connections of its clients.
function Server:close()
  if self.is_closed then return end
  self.is_closed = true
  if self.listener then self.listener:close() end
  if self.http_listener then self.http_listener:close() end
  if self.stop_watching then self.stop_watching() end
  self.stop_counting()
  for _, client in ipairs {table.unpack(self.clients)} do client:close "the server was closed" end
  for _, kept in pairs(self.jobs) do kept.job:stop() end
end

Server.__close = function(self) self:close() end

local function read_session(o)
  local world, session = o:raw "world", o:raw "session"
  if world ~= nil and session ~= nil then o:fail "expected either a world or a session, got both" end
  if world == nil and session == nil then o:fail "world: expected a world, got nothing" end
  if world ~= nil then
    if clench.type(world) ~= "world" then o:expected("world", "a world", world) end
    return clench.session(world)
  end
  if not classes.session or getmetatable(session) ~= classes.session then o:expected("session", "a session", session) end
  return session
end

local function read_token(o, is_local)
  local given = o:raw "token"
  if given == nil then return token.new() end
  if given == false then
    if not is_local then o:fail "token: only a server on loopback may have none" end
    return nil
  end
  if type(given) ~= "string" or #given < 16 or given:find "[^%w_-]" then
    o:fail("token: expected at least 16 letters and digits, or false, got %s", type(given) == "string" and "another string" or described(given))
  end
  return given
end

local function read_folder(o)
  local folder = o:raw "folder"
  if folder ~= nil and type(folder) ~= "string" then o:expected("folder", "the name of a folder", folder) end
  return folder
end

-- port and settings of the live page
local function read_http(o, server, host)
  local http, control, timeout = o:get "http", o:get "control", o:get "http_timeout"
  if http == nil then return nil end
  server.web = web.prepare(subject, control, timeout)
  return {host = host, port = http}
end

local function read_options(options)
  local o = new_options(subject, options)
  local session = read_session(o)
  local port, host, path = o:get "port", o:raw "host", o:raw "path"
  if host ~= nil then check.string(subject, "host", host) end
  local is_local = path ~= nil or is_loopback(host or "localhost")
  local server = {session = session, token = read_token(o, is_local), serves_text = is_local, clients = {}, count = 0, max_silence = 10, last_long = 0, jobs = {}, job_count = 0, folder = read_folder(o),
                  max_clients = o:get "max_clients", max_line = o:get "max_line",
                  max_queue = o:get "max_queue", on_connect = o:get "on_connect", on_close = o:get "on_close"}
  local stdio = o:get "stdio"
  server.mcp = o:get "mcp"
  local http = read_http(o, server, host)
  o:done()
  if server.mcp and not stdio then o:fail "mcp: requires stdio" end
  if stdio then
    if path ~= nil or host ~= nil or http then o:fail "stdio: expected either stdio, or a path, host, port or http" end
    server.token = nil
    return server
  end
  local where = path ~= nil and {path = path} or {host = host, port = port}
  return server, where, http
end

--- A server by which other programs control a world while the loop runs: by JSON-RPC 2.0, and on loopback also by the text protocol
--- of GraspIt!. The first byte from a client selects the protocol.
---@param options table
---@option world? world  the controlled world; or a session
---@option session? session  the session whose commands clients run
---@option port? integer [0 to 65535] = 4765  0: the system chooses one, the server's field `port`
---@option host? string = "127.0.0.1"  address on which it listens
---@option path? string  of a Unix socket, instead of host and port
---@option stdio? boolean = false  true: JSON-RPC over standard input and output with the program that has started this one, without a token
---@option mcp? "read"|"control"  the Model Context Protocol over standard input and output, instead; "read": only tools that change nothing; "control": all
---@option token? string|boolean  the secret of JSON-RPC clients; by default it is generated, and is the server's field `token`. false, only on loopback: none
---@option http? integer [0 to 65535]  port of the live page, which shows the world in a browser; none by default. 0: the system chooses one, the server's field `http`
---@option control? boolean = false  true: the live page moves DOFs, and takes all other requests; otherwise it shows the world only
---@option http_timeout? number [0.1 to 3600, s] = 30  after which a browser that sends no request, or answers no ping, is dropped
---@option folder? string  below which requests may read and write files; none by default
---@option max_clients? integer [1 to 1000] = 64  maximum number of connected clients
---@option max_line? integer [1000 to 268435456, bytes] = 1048576  longest request
---@option max_queue? integer [1000 to 1073741824, bytes] = 4194304  maximum size of replies that a client has not received, beyond which it is disconnected
---@option on_connect? function  called with each new client
---@option on_close? function  called with each client that has disconnected; its field `reason` states why
---@return server server # `port`, `http`, `url` (of the live page), `token`, `session`, `close()`
---@effect edits
--- > server = clench.control.server {world = world, port = 0}
--- > client = clench.port.connect("127.0.0.1", server.port)
--- > client:write "getRobotName 1 0\n"
--- > client:read_line(1) == hand.name  --> true
--- > server:close()
--- > clench.control.server {}  --> error: world: expected a world, got nothing
return function(options)
  local server, where, http = read_options(options)
  setmetatable(server, Server)
  if where then listen(server, where) end
  if http then
    local ok, problem = pcall(listen_http, server, http)
    if not ok then
      server.listener:close()
      error(problem, 0)
    end
  end
  server.stop_counting = rpc.prepare(server)
  if not where then
    add_parent(server)
    return server
  end
  loop.spawn(function() accept_clients(server, server.listener, serve_line) end)
  if http then
    loop.spawn(function() accept_clients(server, server.http_listener, web.serve) end)
    server.stop_watching = web.watch(server)
  end
  return server
end
