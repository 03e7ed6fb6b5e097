-- The live page: requests of HTTP and frames of RFC 6455, right ones and hostile ones; each refusal ends one connection and nothing else.
local test, clench = require "test", require "clench"
local find_three = require "clench.page.three"
local loop = clench.loop
local request = require "clench.control.web.request"
local sha1 = require "clench.control.web.sha1"
local socket = require "clench.control.web.socket"
local web_client = dofile "tests/lua/web_client.lua"
local frame, read_frame = web_client.frame, web_client.read_frame

local three, missing = find_three()
local world = clench.load("worlds/barrett_mug.wld", {root = "."})

local function serve(t, options)
  if not three then t.skip(missing) end
  options = options or {}
  options.world, options.port, options.http = options.world or world, 0, 0
  local server = clench.control.server(options)
  if server.token then return server, "/socket?token=" .. server.token, "/?token=" .. server.token end
  return server, "/socket", "/"
end

-- an open WebSocket, after hello
local function talk(server, target)
  local port = web_client.open(server.http, target)
  local call, notes = web_client.caller(port)
  assert(call("hello", {token = server.token}).result)
  return port, call, notes
end

-- status and body of the response to a request; nil if there is none
local function ask(server, bytes)
  local port = clench.port.connect("127.0.0.1", server.http)
  port:write(bytes)
  local answer = web_client.read_all(port, 10)
  port:close()
  return tonumber(answer:match "^HTTP/1%.1 (%d+) "), answer:match "\r\n\r\n(.*)", answer
end

local function get(target, more) return "GET " .. target .. " HTTP/1.1\r\nHost: 127.0.0.1:7000\r\n" .. (more or "") .. "\r\n" end

local function hexadecimal(bytes) return (bytes:gsub(".", function(c) return ("%02x"):format(c:byte()) end)) end

test("SHA-1 has the digests of FIPS 180 and RFC 3174, and those of sha1sum at all lengths about a block", function(t)
  t.equal(hexadecimal(sha1 ""), "da39a3ee5e6b4b0d3255bfef95601890afd80709")
  t.equal(hexadecimal(sha1 "abc"), "a9993e364706816aba3e25717850c26c9cd0d89d")
  t.equal(hexadecimal(sha1 "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"), "84983e441c3bd26ebaae4aa1f95129e5e54670f1")
  t.equal(hexadecimal(sha1(("0123456701234567012345670123456701234567012345670123456701234567"):rep(10))), "dea356a2cddd90c7a7ecedc5ebb563934f460452")
  local path = test.path()
  for _, size in ipairs {1, 54, 55, 56, 57, 63, 64, 65, 119, 120, 128, 1000} do
    local bytes = {}
    for i = 1, size do bytes[i] = string.char(i * i % 251) end
    bytes = table.concat(bytes)
    clench.files.save_text(path, bytes)
    local sum <close> = io.popen("sha1sum " .. path)
    t.equal(hexadecimal(sha1(bytes)), sum:read "a":match "^%x+", size)
  end
end)

test("the handshake and the mask are those of the examples of RFC 6455", function(t)
  t.equal(socket.accept_key "dGhlIHNhbXBsZSBub25jZQ==", "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=")  -- section 1.3
  t.equal(socket.masked("\x7f\x9f\x4d\x51\x58", "\x37\xfa\x21\x3d"), "Hello")             -- section 5.7
  t.equal(socket.message "Hello", "\x81\x05Hello")
  t.equal(socket.message(("x"):rep(256)):sub(1, 4), "\x81\x7e\x01\x00")
  t.equal(socket.message(("x"):rep(65536)):sub(1, 10), "\x81\x7f\0\0\0\0\0\1\0\0")
  local random = clench.random(1)
  for _, size in ipairs {0, 1, 3, 4, 5, 191, 192, 193, 1000} do
    local bytes, key = {}, {}
    for i = 1, size do bytes[i] = string.char(random:integer(0, 255)) end
    for i = 1, 4 do key[i] = string.char(random:integer(0, 255)) end
    bytes, key = table.concat(bytes), table.concat(key)
    t.equal(frame(1, bytes, {key = key}):sub(-size - 1):sub(2), size > 0 and socket.masked(bytes, key) or "", size)
  end
end)

test("the page has the world's shapes, and is shown to those who know the token", function(t)
  local server <close>, _, home = serve(t)
  t.equal(server.url, ("http://127.0.0.1:%d/?token=%s"):format(server.http, server.token))
  local status, page, whole = ask(server, get(home))
  t.equal(status, 200)
  local data = clench.json.decode(page:match '<script type="application/json" id="data">(.-)</script>')
  t.equal(#data.parts, #world.bodies)
  t.equal(data.control, false)
  for _, part in ipairs(data.parts) do
    local body = world.bodies[part.body + 1]
    t.equal({part.name, part.robot}, {body.name, body.robot and "barrett" or nil})
  end
  t.ok(page:find("THREE", 1, true))
  t.ok(not page:find("https?://[^\"'%s]*[\"'][^>]*></script>"))  -- nothing is loaded from elsewhere
  local head = whole:match "^(.-)\r\n\r\n"
  t.ok(head:find("default-src 'none'", 1, true) and head:find("connect-src 'self' ws://127.0.0.1:7000 ", 1, true) and head:find("no-referrer", 1, true))
  t.equal(tonumber(head:match "Content%-Length: (%d+)"), #page)
  for _, target in ipairs {"/", "/?token=", "/?token=" .. server.token:sub(1, -2), "/?token=" .. server.token .. "0", "/?tokens=" .. server.token, "/socket", "/none"} do
    t.equal(ask(server, get(target)), 403, target)
  end
  t.equal(ask(server, get("/none?token=" .. server.token)), 404)
  t.equal(#server.clients, 0)
end)

test("requests that are no plain GET are refused", function(t)
  local server <close>, target, home = serve(t)
  local long = "X: " .. ("x"):rep(200) .. "\r\n"
  for name, case in pairs {
    post = {405, "POST " .. home .. " HTTP/1.1\r\nHost: a\r\n\r\n"},
    options = {405, "OPTIONS " .. home .. " HTTP/1.1\r\nHost: a\r\n\r\n"},
    old = {505, "GET " .. home .. " HTTP/1.0\r\nHost: a\r\n\r\n"},
    new = {505, "GET " .. home .. " HTTP/2.0\r\nHost: a\r\n\r\n"},
    words = {400, "getDOFVals ALL\r\n\r\n"},
    json = {400, '{"jsonrpc":"2.0","id":1,"method":"hello"}\r\n\r\n'},
    empty = {400, "\r\n\r\n"},
    ["no host"] = {400, "GET " .. home .. " HTTP/1.1\r\n\r\n"},
    ["two hosts"] = {400, get(home, "Host: b\r\n")},
    ["strange host"] = {400, "GET " .. home .. " HTTP/1.1\r\nHost: a b\r\n\r\n"},
    ["script in host"] = {400, "GET " .. home .. " HTTP/1.1\r\nHost: a;script-src\r\n\r\n"},
    ["a body"] = {400, get(home, "Content-Length: 5\r\n") .. "hello"},
    ["two lengths"] = {400, get(home, "Content-Length: 0\r\nContent-Length: 5\r\n")},
    chunks = {400, get(home, "Transfer-Encoding: chunked\r\n") .. "0\r\n\r\n"},
    ["chunks and length"] = {400, get(home, "Content-Length: 4\r\nTransfer-Encoding : chunked\r\n")},
    ["folded line"] = {400, get(home, "A: b\r\n c: d\r\n")},
    ["bare LF"] = {400, get(home, "A: b\nContent-Length: 5\r\n")},
    ["bare CR"] = {400, get(home, "A: b\rContent-Length: 5\r\n")},
    zero = {400, get(home, "A: b\0\r\n")},
    control = {400, get(home, "A: \27[1m\r\n")},
    ["no name"] = {400, get(home, ": b\r\n")},
    ["no colon"] = {400, get(home, "abc\r\n")},
    ["absolute target"] = {400, "GET http://127.0.0.1/ HTTP/1.1\r\nHost: a\r\n\r\n"},
    ["two tokens"] = {400, get(home .. "&token=x")},
    ["many fields"] = {431, get(home, ("A: b\r\n"):rep(101))},
    ["huge head"] = {431, get(home, long:rep(100))},
    ["huge line"] = {431, "GET /" .. ("a"):rep(20000)},
    ["no end"] = {431, get(home, "X: " .. ("x"):rep(17000)):sub(1, -5)},
    ["not a socket"] = {426, get(target)},
  } do
    local status, _, answer = ask(server, case[2])
    t.equal(status, case[1], name .. ": " .. answer)
    local _, count = answer:gsub("HTTP/1%.1 %d", "")
    t.equal(count, 1, name)
  end
  -- what follows a request is not one: neither answered nor run
  local _, _, answer = ask(server, get(home) .. get(home))
  local _, count = answer:gsub("HTTP/1%.1 %d", "")
  t.equal(count, 1)
  t.equal(ask(server, get(home)), 200)
end)

test("fields are read as RFC 9112 has them", function(t)
  local read = request.read
  local asked = read "GET /a/b?x=1&y= HTTP/1.1\r\nhOsT:h:1\r\nA: \t b c \t\r\na:d\r\nE:"
  t.equal(asked.path, "/a/b")
  t.equal(asked.parameters, {x = "1", y = ""})
  t.equal(asked.fields, {host = "h:1", a = "b c, d", e = ""})
  t.equal(read("GET / HTTP/1.1\r\nHost: [::1]:70").fields.host, "[::1]:70")
  t.equal({read "GET / HTTP/1.1\r\nA B: c"}, {nil, 400, "line 2 is no header field"})
  t.equal({read "GET / HTTP/1.1\r\nHost : c"}, {nil, 400, "line 2 is no header field"})
  t.equal({read "GET /?a&a HTTP/1.1\r\nHost: c"}, {nil, 400, "the parameter 'a' is given twice"})
  -- every head of the permitted size is read in some milliseconds
  local function repeated(text) return text:rep(16000 // #text) end
  for _, head in ipairs {"GET / HTTP/1.1\r\nHost: a\r\nA: x" .. repeated " " .. "x", "GET /?" .. repeated "a" .. " HTTP/1.1\r\nHost: a", "GET /?" .. repeated "a=" .. " HTTP/1.1\r\nHost: a",
                         "GET " .. repeated "/" .. " HTTP/1.1\r\nHost: a", "GET / HTTP/1.1\r\nHost: a\r\n" .. repeated ":", "GET / HTTP/1.1\r\nHost: " .. repeated "a", repeated "G", repeated "\r\n"} do
    local began = os.clock()
    read(head)
    t.ok(os.clock() - began < 0.1, ("%.0f ms: %s"):format(1e3 * (os.clock() - began), head:sub(1, 40)))
  end
end)

test("a WebSocket needs the token, an origin that is this page, and the right fields", function(t)
  local server <close>, target = serve(t)
  local here = "127.0.0.1:" .. server.http
  local function status_of(where, fields)
    local port, head = web_client.open(server.http, where, fields)
    port:close()
    return tonumber((head or ""):match "^HTTP/1.1 (%d+)")
  end
  local port, head = web_client.open(server.http, target)
  t.ok(head:find("Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=", 1, true), head)
  port:close()
  t.equal(status_of(target, {Origin = "http://" .. here}), 101)
  t.equal(status_of(target, {Origin = "https://" .. here:upper()}), 101)
  t.equal(status_of(target, {Upgrade = "WebSocket", Connection = "keep-alive, Upgrade"}), 101)
  for _, origin in ipairs {"http://example.org", "null", "http://127.0.0.1", "http://127.0.0.1:1", "http://" .. here .. ".example.org", "file://", ""} do
    t.equal(status_of(target, {Origin = origin}), 403, origin)
  end
  for _, where in ipairs {"/socket", "/socket?token=", "/socket?token=" .. server.token:upper() .. "x", "/socket?token=" .. ("0"):rep(48)} do t.equal(status_of(where), 403, where) end
  t.equal(status_of("/other?token=" .. server.token), 404)
  t.equal(status_of(target, {Upgrade = "h2c"}), 426)
  t.equal(status_of(target, {Connection = "close"}), 426)
  t.equal(status_of(target, {["Sec-WebSocket-Version"] = "8"}), 426)
  t.equal(status_of(target, {["Sec-WebSocket-Version"] = false}), 426)
  t.equal(status_of(target, {["Sec-WebSocket-Key"] = "abc"}), 400)
  t.equal(status_of(target, {["Sec-WebSocket-Key"] = false}), 400)
  -- frames that are sent before the answer might be for another reader of the request
  local early = ("GET %s HTTP/1.1\r\nHost: %s\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"):format(target, here)
  t.equal(ask(server, early .. frame(1, "{}")), 400)
end)

test("without a token only names of this machine lead to the page, which no other page may frame", function(t)
  local server <close>, target = serve(t, {token = false})
  local _, _, answer = ask(server, get "/")
  t.ok(answer:find("frame-ancestors 'none'", 1, true))
  for _, host in ipairs {"localhost", "LOCALHOST:7000", "127.0.0.1", "127.1.2.3:7000", "[::1]:7000"} do
    t.equal(ask(server, "GET / HTTP/1.1\r\nHost: " .. host .. "\r\n\r\n"), 200, host)
  end
  for _, host in ipairs {"example.org", "127.0.0.1.example.org:7000", "localhost.example.org", "127.example.org", "192.168.1.1:7000"} do
    t.equal(ask(server, "GET / HTTP/1.1\r\nHost: " .. host .. "\r\n\r\n"), 403, host)
    local port, head = web_client.open(server.http, target, {Host = host, Origin = "http://" .. host})
    t.ok(head:find "^HTTP/1.1 403", host)
    port:close()
  end
  t.ok(talk(server, target))
end)

test("the WebSocket carries the requests of the port, and without control those that only read", function(t)
  local before = world:hash()
  local server <close>, target = serve(t)
  local port, call, notes = talk(server, target)
  t.equal(call("get", {of = "barrett", fields = {"dofs"}}).result.dofs, world.robots[1].dofs)
  t.equal(#call("world.list").result.bodies, #world.bodies)
  t.ok(call("describe", {method = "get"}).result.reads)
  for method, params in pairs {["grasp.dofs"] = {dofs = {0, 1, 1, 1}}, ["grasp.autograsp"] = {}, ["session.undo"] = {}, step = {dt = 0.001}, ["world.new"] = {}, ["plan.start"] = {planner = "random"},
                              ["dynamics.run"] = {seconds = 0.01}, ["edit.undo"] = {}, ["dynamics.play"] = {}, ["file.check"] = {path = "x"}, ["job.stop"] = {job = 1}} do
    local response = call(method, params)
    t.equal(response.error and response.error.code, -32002, method)
    t.ok(response.error.message:find("shows the world only", 1, true))
  end
  t.equal(call "no.such".error.code, -32601)
  t.equal(world:hash(), before)
  call("subscribe_state", {rate = 1000, poses = true, contacts = true})
  while #notes == 0 do call "world.hash" end
  local state = notes[1].params.value
  t.equal(#state.poses, #world.bodies)
  t.equal(#state.contacts, 0)
  t.close(state.poses[#state.poses][3], world.bodies[#world.bodies].pose.position.z, 1e-12)
  t.equal(#state.poses[1], 7)
  port:close()
  local open <close>, other = serve(t, {control = true, world = world:clone()})
  local _, edit = talk(open, other)
  t.equal(edit("grasp.dofs", {dofs = {0, 0.7, 0.6, 0.8}}).error, nil)
  t.equal(open.session.world.robots[1].dofs, {0, 0.7, 0.6, 0.8})
  t.ok(edit "session.undo".result)
end)

test("hello has the server's token here, too, and wrong ones end the connection", function(t)
  local server <close>, target = serve(t)
  local port = web_client.open(server.http, target)
  local call = web_client.caller(port)
  t.equal(call("world.state").error.code, -32001)
  for _ = 1, 5 do t.equal(call("hello", {token = "no"}).error.code, -32001) end
  t.equal({read_frame(port, 10)}, {nil, "closed"})
end)

local request_text = '{"jsonrpc":"2.0","id":"ä€𝄞","method":"world.hash"}'

test("messages come whole, in fragments of any size, and with pings between them", function(t)
  local server <close>, target = serve(t)
  local port = talk(server, target)
  local function id_of()
    local got = read_frame(port, 10)
    t.equal(got.opcode, 1)
    return clench.json.decode(got.payload).id
  end
  for size = 1, #request_text do
    port:write(frame(1, request_text:sub(1, size), {last = size == #request_text}))
    if size < #request_text then
      port:write(frame(9, "are you there?"))
      t.equal(read_frame(port, 10), {opcode = 10, payload = "are you there?"})
      port:write(frame(0, "", {last = false}))
      port:write(frame(0, request_text:sub(size + 1)))
    end
    t.equal(id_of(), "ä€𝄞")
  end
  for byte in frame(1, request_text):gmatch "." do
    port:write(byte)
    loop.sleep(0)
  end
  t.equal(id_of(), "ä€𝄞")
  port:write(frame(10, "nobody asked"))
  port:write(frame(1, request_text):rep(50))
  for _ = 1, 50 do t.equal(id_of(), "ä€𝄞") end
  port:write(frame(1, "{]") .. frame(1, "") .. frame(1, request_text))  -- an empty message asks nothing
  t.equal(clench.json.decode(read_frame(port, 10).payload).error.code, -32700)
  t.equal(id_of(), "ä€𝄞")
  port:write(frame(8, "\x03\xe8bye"))
  t.equal(read_frame(port, 10), {opcode = 8, payload = "\x03\xe8"})
  t.equal({read_frame(port, 10)}, {nil, "closed"})
end)

test("frames that break RFC 6455 are answered by the code of the fault, and end the connection", function(t)
  local server <close>, target = serve(t, {max_line = 100000})
  local good, ask_good = talk(server, target)
  for name, case in pairs {
    ["no mask"] = {1002, frame(1, request_text, {key = ""})},
    ["reserved bit"] = {1002, frame(1, request_text, {reserved = 64})},
    ["unknown kind"] = {1002, frame(3, "")},
    ["unknown control"] = {1002, frame(11, "")},
    binary = {1003, frame(2, request_text)},
    ["no beginning"] = {1002, frame(0, request_text)},
    ["two beginnings"] = {1002, frame(1, "{", {last = false}) .. frame(1, request_text)},
    ["ping in fragments"] = {1002, frame(9, "", {last = false})},
    ["long ping"] = {1002, frame(9, ("x"):rep(126))},
    ["not UTF-8"] = {1007, frame(1, "\xff\xfe")},
    surrogate = {1007, frame(1, '"\xed\xa0\x80"')},
    ["cut UTF-8"] = {1007, frame(1, "\xc3", {last = false}) .. frame(0, "")},
    ["too long"] = {1009, frame(1, ("x"):rep(100001))},
    ["said to be too long"] = {1009, frame(1, "x", {size = 1 << 40})},
    ["said to be negative"] = {1009, frame(1, "x", {size = 1 << 63})},
    ["too long in parts"] = {1009, frame(1, ("x"):rep(60000), {last = false}) .. frame(0, ("x"):rep(60000))},
    ["too many parts"] = {1008, frame(1, "", {last = false}) .. frame(0, "", {last = false}):rep(1001)},
    ["close with a byte"] = {1002, frame(8, "\x03")},
    ["close with a code of nobody"] = {1002, frame(8, "\x03\xed")},
    ["close that is not UTF-8"] = {1002, frame(8, "\x03\xe8\xff")},
  } do
    local port = talk(server, target)
    port:write(case[2])
    local got = read_frame(port, 10)
    t.equal(got and got.opcode, 8, name)
    t.equal((">I2"):unpack(got.payload), case[1], name .. ": " .. got.payload:sub(3))
    t.ok(#got.payload > 5)
    local _, why = web_client.read_all(port, 10)
    t.equal(why, "closed", name)
  end
  t.ok(ask_good("world.hash").result)
  good:close()
end)

test("a closed connection, an empty close and a lost one leave nothing", function(t)
  local server <close>, target = serve(t)
  local port = talk(server, target)
  port:write(frame(8, ""))
  t.equal(read_frame(port, 10), {opcode = 8, payload = ""})
  local lost, call = talk(server, target)
  call("subscribe_state", {rate = 1000})
  lost:write(frame(1, request_text):sub(1, 9))
  lost:close()
  local last = loop.time() + 10
  while #server.clients > 0 and loop.time() < last do loop.sleep(0.01) end
  t.equal(#server.clients, 0)
end)

test("a browser that sends half a request or answers no ping is dropped; others are served", function(t)
  local reasons = {}
  local server <close>, target, home = serve(t, {http_timeout = 0.4, on_close = function(client) reasons[client.reason] = true end})
  local half = clench.port.connect("127.0.0.1", server.http)
  half:write(get(home):sub(1, 20))
  local silent = talk(server, target)
  local good, ask_good = talk(server, target)
  local last = loop.time() + 10
  repeat
    t.ok(ask_good("world.hash").result)
    good:write(frame(10, ""))
    loop.sleep(0.02)
  until #server.clients == 1 or loop.time() > last
  t.equal(#server.clients, 1)
  t.ok(reasons["no request in time"] and reasons["no answer to a ping"], clench.json.encode(reasons))
  t.ok(half and silent)
end)

test("a browser that reads nothing is dropped", function(t)
  local reason
  local server <close>, target = serve(t, {max_queue = 100000, on_close = function(client) reason = client.reason end})
  local deaf = talk(server, target)
  local last = loop.time() + 20
  while not reason and loop.time() < last do
    deaf:send(frame(1, '{"jsonrpc":"2.0","id":1,"method":"describe"}'):rep(10))
    loop.sleep(0.01)
  end
  t.equal(reason, "it does not receive")
end)

test("of too many browsers the last is told so", function(t)
  local server <close>, target, home = serve(t, {max_clients = 2})
  local a, b = talk(server, target), talk(server, target)
  local status, words = ask(server, get(home))
  t.equal(status, 503)
  t.ok(words:find("the server has 2 clients and accepts no more", 1, true))
  a:close()
  b:close()
end)

test("the scene's text changes with bodies and shapes, and not with where they are", function(t)
  local own = clench.load("worlds/barrett_mug.wld", {root = "."})
  local server <close>, target = serve(t, {world = own, control = true})
  local _, call = talk(server, target)
  local function scene() return call("world.list").result.scene end
  local before = scene()
  call("grasp.dofs", {dofs = {0, 0.3, 0.3, 0.3}})
  own.objects[1].pose = clench.pose {xyz = {0.1, 0, 0}}
  t.equal(scene(), before)
  own:add_obstacle(clench.shapes.box {0.1, 0.1, 0.1}, {name = "box"})
  local with_box = scene()
  t.ok(with_box ~= before)
  own:remove(own:body "box")
  t.equal(scene(), before)
  own:add_obstacle(clench.shapes.box {0.1, 0.1, 0.2}, {name = "box"})
  t.ok(scene() ~= with_box)
end)

test("a server without a world has a page, too", function(t)
  if not three then t.skip(missing) end
  local session = clench.session()
  local server <close> = clench.control.server {session = session, port = 0, http = 0}
  local status, page = ask(server, get("/?token=" .. server.token))
  t.equal(status, 200)
  t.equal(clench.json.decode(page:match 'id="data">(.-)</script>').scene, "")
end)

test("faults of the options are named", function(t)
  if not three then t.skip(missing) end
  t.fails(function() clench.control.server {world = world, http = 70000} end, "http")
  t.fails(function() clench.control.server {world = world, stdio = true, http = 0} end, "stdio: expected either stdio, or a path, host, port or http")
  t.fails(function() clench.control.server {world = world, port = 0, http = 0, http_timeout = 0} end, "http_timeout")
  local server <close> = serve(t)
  t.fails(function() clench.control.server {world = world, port = 0, http = server.http} end, "Address already in use")
end)

local function first_line(command)
  local pipe <close> = io.popen(command)
  return pipe:read "l"
end

test("clench serve --http prints the address of the page, and refuses options without a meaning", function(t)
  if not three then t.skip(missing) end
  local verb = ("'%s' -q serve worlds/barrett_mug.wld --root . "):format(first_line "readlink /proc/$PPID/exe")
  local pipe <close> = io.popen(("echo $$; exec %s --port 0 --token-file '%s' --http 0"):format(verb, test.path()))
  local process, _, page, address = pipe:read("l", "l", "l", "l")
  os.execute("kill " .. process)
  t.ok(page:find("^live page: http://127%.0%.0%.1:%d+/%?token=" .. address:match "token=(%w+)$" .. "$"), page)
  t.equal(first_line(verb .. "--port 0 --control 2>&1"), "clench serve: --control: expected --http, too: it lets the live page move DOFs")
  t.ok(first_line(verb .. "--stdio --http 0 2>&1"):find("stdio: expected either stdio, or a path, host, port or http", 1, true))
end)
