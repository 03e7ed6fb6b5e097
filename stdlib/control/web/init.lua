--- The live page of a server, over HTTP: one request per connection, for the page itself or for the WebSocket that carries the same JSON-RPC as the port.
local find_three = require "clench.page.three"
local is_loopback = require "clench.control.is_loopback"
local is_stopped = require "clench.is_stopped"
local loop = clench.loop
local raise = require "clench.raise"
local request = require "clench.control.web.request"
local rpc = require "clench.control.rpc"
local run = require "clench.page.run"
local socket = require "clench.control.web.socket"
local token = require "clench.control.token"
local web = {}

local page_seconds = 60  -- time in which a browser must receive the page

local words_of = {[101] = "Switching Protocols", [200] = "OK", [400] = "Bad Request", [403] = "Forbidden", [404] = "Not Found", [405] = "Method Not Allowed",
                  [426] = "Upgrade Required", [431] = "Request Header Fields Too Large", [500] = "Internal Server Error", [503] = "Service Unavailable",
                  [505] = "HTTP Version Not Supported"}
local common = "Connection: close\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n"
local more = {[405] = "Allow: GET\r\n", [426] = "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"}

local function response(status, kind, body, fields)
  return ("HTTP/1.1 %d %s\r\nContent-Type: %s; charset=utf-8\r\nContent-Length: %d\r\n%s%s%s\r\n"):format(
    status, words_of[status], kind, #body, common, more[status] or "", fields or "") .. body
end

--- The response to a browser when the server has its maximum number of clients.
function web.busy(words) return response(503, "text/plain", words) end

local function refuse(client, status, reason)
  client:send_raw(response(status, "text/plain", reason .. "\n"))
  client:finish(reason)
end

-- --- the page ---

-- Only one page is made at a time, on a copy of the world, while others are served.
local function make_page(server)
  local made = server.web
  while made.is_busy do loop.sleep(0.01) end
  made.is_busy = true
  local _ <close> = setmetatable({}, {__close = function() made.is_busy = false end})
  local job = clench.job(function(...) return require "clench.control.web.page".text(...) end,
                         {args = {server.session.world, {three = made.three, control = made.control}}, name = "page"})
  loop.wait(job)
  return job:result()
end

-- the Content-Security-Policy of the page; no other page may show it in a frame if no token protects its controls
local function policy_of(server, host)
  return ("Content-Security-Policy: %s; connect-src 'self' ws://%s wss://%s%s\r\n"):format(run.policy, host, host, server.token and "" or "; frame-ancestors 'none'")
end

local function serve_nothing() return false end

local function send_page(server, client, asked)
  client.serve = serve_nothing
  loop.spawn(function()
    local ok, made = pcall(make_page, server)
    if not ok and is_stopped(made) then error(made, 0) end
    if not ok then return refuse(client, 500, "the page could not be made: " .. tostring(made)) end
    client:send_raw(response(200, "text/html", made, policy_of(server, asked.fields.host)))
    client:finish("the page is sent", page_seconds)
  end)
end

-- --- the WebSocket ---

local function serve_frame(server, client)
  local some, message = socket.take(client)
  if message then rpc.answer(server, client, message) end
  return some
end

local function has_word(field, word)
  for one in (field or ""):lower():gmatch "[^%s,]+" do
    if one == word then return true end
  end
  return false
end

-- status and reason of a refusal; nil: the connection may become a WebSocket
local function fault_of_upgrade(client, asked)
  local fields = asked.fields
  local origin, host = fields.origin, fields.host:lower()
  if origin and origin:lower() ~= "http://" .. host and origin:lower() ~= "https://" .. host then return 403, "Origin: another page may not connect" end
  if not has_word(fields.upgrade, "websocket") or not has_word(fields.connection, "upgrade") then return 426, "expected a WebSocket" end
  if fields["sec-websocket-version"] ~= "13" then return 426, "Sec-WebSocket-Version: expected 13" end
  if not (fields["sec-websocket-key"] or ""):find "^[%w+/]+==$" or #fields["sec-websocket-key"] ~= 24 then return 400, "Sec-WebSocket-Key: expected 16 bytes as base64" end
  if client.port.stream:size() > 0 then return 400, "bytes follow the request before it is answered" end
end

local function open_socket(server, client, asked)
  local status, reason = fault_of_upgrade(client, asked)
  if status then return refuse(client, status, reason) end
  client:send_raw(("HTTP/1.1 101 %s\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: %s\r\n\r\n"):format(
    words_of[101], socket.accept_key(asked.fields["sec-websocket-key"])))
  client.only_reads, client.protocol, client.serve, client.wrap = not server.web.control, rpc, serve_frame, socket.message
end

-- --- requests ---

-- the name of a field "Host", without the port
local function host_of(field) return field:match "^%[(.*)%]" or field:match "^[^:]*" end

-- status and reason of a refusal. Without a token, the name must be one of this machine: a web site whose name resolves to it cannot connect.
local function fault_of(server, asked)
  if server.token and not token.equal(asked.parameters.token, server.token) then return 403, "the token is missing or not that of this server" end
  if not server.token and not is_loopback(host_of(asked.fields.host):lower()) then return 403, "Host: expected a name of this machine" end
end

local function answer(server, client, head)
  local asked, status, reason = request.read(head)
  if not asked then return refuse(client, status, reason) end
  status, reason = fault_of(server, asked)
  if status then return refuse(client, status, reason) end
  if asked.path == "/" then return send_page(server, client, asked) end
  if asked.path == "/socket" then return open_socket(server, client, asked) end
  refuse(client, 404, "there is nothing here")
end

--- Serves the first and only request of a connection.
function web.serve(server, client)
  local stream = client.port.stream
  local at = stream:find "\r\n\r\n"
  if (at or stream:size()) > request.max_head then
    refuse(client, 431, "the request is too long")
    return true
  end
  if not at then return false end
  answer(server, client, stream:take(at + 4):sub(1, at))
  return true
end

-- sends a ping to a WebSocket client that is silent, and disconnects it if it does not answer
local function check_socket(client, now, timeout)
  if now - math.max(client.heard, client.pinged or 0) <= timeout then return end
  if client.pinged and client.pinged > client.heard then return client:close "no answer to a ping" end
  client.pinged = now
  socket.ping(client)
end

local function check_silent(server)
  local timeout, now = server.web.timeout, loop.time()
  for _, client in ipairs {table.unpack(server.clients)} do
    if client.is_finishing then
      -- it has a limit of its own
    elseif client.serve == web.serve and now - client.began > timeout then
      client:close "no request in time"
    elseif client.serve == serve_frame then
      check_socket(client, now, timeout)
    end
  end
end

--- Disconnects clients that remain silent.
---@return fun() # ends it
function web.watch(server)
  local timer = loop.every(server.web.timeout / 4, function() check_silent(server) end)
  return function() timer:remove() end
end

--- Settings of the live page, in the server's field `web`; raises an error where three.js is not installed.
function web.prepare(subject, control, timeout)
  local three, missing = find_three()
  if not three then raise(("%s: http: %s"):format(subject, missing), "file") end
  return {three = three, control = control, timeout = timeout, is_busy = false}
end

return web
