-- Connections that end at any byte, clients that never speak, and servers that are killed: nothing is carried out in part, and who comes next is served.
local test, clench = require "test", require "clench"
local connect = dofile "tests/lua/rpc_client.lua"
local find_three = require "clench.page.three"
local web_client = dofile "tests/lua/web_client.lua"
local json, loop = clench.json, clench.loop

local is_full = os.getenv "CLENCH_HOSTILE_LINES" ~= nil  -- every byte; by default every seventh

local function load() return clench.load("worlds/barrett_mug.wld", {root = "."}) end

local function line_of(method, params) return json.encode {jsonrpc = "2.0", id = 1, method = method, params = params} end

-- waits until only the good client is left
local function settle(server, good)
  local last = loop.time() + 10
  repeat good.get "world.hash" until #server.clients == 1 or loop.time() > last
  return #server.clients
end

-- sends the beginning of `bytes` for each length and closes the connection; calls check(length) for each, when the server has noticed
local function cut_everywhere(t, server, good, port, bytes, check)
  for size = 0, #bytes, is_full and 1 or 7 do
    local client = clench.port.connect("127.0.0.1", port)
    client:write(bytes:sub(1, size))
    client:close()
    t.equal(settle(server, good), 1, size)
    check(size)
  end
end

local opened, closed = {0, 0.2, 0.2, 0.2}, {0, 0.7, 0.7, 0.7}

test("a connection that ends at any byte carries out complete requests only, of both protocols", function(t)
  local world = load()
  local server <close> = clench.control.server {world = world, port = 0}
  local hand, good = world.robots[1], connect(server)
  for _, case in ipairs {
    {before = line_of("hello", {token = server.token}) .. "\n", edit = line_of("grasp.dofs", {dofs = closed}) .. "\n"},
    {before = "getRobotName 1 0\n", edit = "moveDOFs 0 4 0 0.7 0.7 0.7 1 1 1 1\n"},
  } do
    hand:set_dofs(opened)
    local start = #case.before
    cut_everywhere(t, server, good, server.port, case.before .. case.edit .. case.edit:sub(1, 20), function(size)
      local is_moved = math.abs(hand.dofs[2] - 0.7) < 1e-6
      if size < start + #case.edit then t.equal(hand.dofs, opened, size) else t.ok(is_moved or hand.dofs[2] == opened[2], hand.dofs[2]) end
      hand:set_dofs(opened)
    end)
  end
end)

test("a WebSocket that ends at any byte, of its request or of a frame, leaves nothing", function(t)
  local three, missing = find_three()
  if not three then t.skip(missing) end
  local world = load()
  local server <close> = clench.control.server {world = world, port = 0, http = 0, control = true}
  local good, hand = connect(server), world.robots[1]
  local head = ("GET /socket?token=%s HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    .. "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"):format(server.token, server.http)
  hand:set_dofs(opened)
  cut_everywhere(t, server, good, server.http, head, function() t.equal(hand.dofs, opened) end)
  local frames = web_client.frame(1, line_of("hello", {token = server.token})) .. web_client.frame(1, line_of("grasp.dofs", {dofs = closed}))
  for size = 0, #frames - 1, is_full and 1 or 7 do
    local port = web_client.open(server.http, "/socket?token=" .. server.token)
    port:write(frames:sub(1, size))
    port:close()
    t.equal(settle(server, good), 1, size)
    t.equal(hand.dofs, opened, size)
  end
  local port = web_client.open(server.http, "/socket?token=" .. server.token)
  port:write(frames)
  for _ = 1, 2 do t.ok(web_client.read_frame(port, 10).payload:find("result", 1, true)) end
  t.equal(hand.dofs, closed)
end)

test("clients that never speak yield their places, and those that have spoken keep theirs", function(t)
  local reasons = {}
  local server <close> = clench.control.server {world = load(), port = 0, max_clients = 4, on_close = function(client) reasons[#reasons + 1] = client.reason end}
  local known, text = connect(server), clench.port.connect("127.0.0.1", server.port)
  text:write "getRobotName 1 0\n"
  t.equal(text:read_line(5), "barrett")
  local silent = clench.port.connect("127.0.0.1", server.port)
  local guest = connect(server, false)  -- speaks, but does not know the token
  t.equal(guest.call("world.hash").error.code, -32001)
  local early = clench.port.connect("127.0.0.1", server.port)
  t.equal(early:read_line(5), "Error: the server has 4 clients and accepts no more")
  server.max_silence = 0
  local a, b = connect(server), connect(server)
  t.equal({silent:read_line(5)}, {nil, "closed"})
  t.equal({guest.receive()}, {nil, "closed"})
  t.equal(reasons, {"another client took its place", "another client took its place"})
  for _, client in ipairs {known, a, b} do t.ok(client.get "world.hash") end
  local late = clench.port.connect("127.0.0.1", server.port)
  t.equal(late:read_line(5), "Error: the server has 4 clients and accepts no more")
  text:write "getRobotName 1 0\n"
  t.equal(text:read_line(5), "barrett")
end)

local function first_line(command)
  local pipe <close> = io.popen(command)
  return pipe:read "l"
end

-- a process of `clench serve`: its number, its port and its token
local function start(program, options, token_file)
  local pipe = io.popen(("echo $$; exec '%s' -q serve worlds/barrett_mug.wld --root . %s --token-file '%s' 2>&1"):format(program, options, token_file))
  local process, first, second = pipe:read("l", "l", "l")
  return {pipe = pipe, process = process, port = tonumber(first:match ":(%d+)$"), token = second and second:match "token=(%w+)", words = first}
end

test("a server that was killed can be started again at once, at the same port and socket, and its clients know", function(t)
  local program, folder = first_line "readlink /proc/$PPID/exe", test.path()
  assert(os.execute(("mkdir -p '%s'"):format(folder)))
  local port = "0"
  for _, options in ipairs {"--port ", "--socket " .. folder .. "/socket --port "} do
    local is_socket = options:find "socket"
    local last_token
    for round = 1, 3 do
      local server = start(program, is_socket and options:gsub(" %-%-port ", "") or options .. port, folder .. "/token")
      t.ok(server.token, server.words)
      t.ok(server.token ~= last_token)
      t.equal(first_line("cat " .. folder .. "/token"), server.token)
      local client = is_socket and clench.port.connect(folder .. "/socket") or clench.port.connect("127.0.0.1", server.port)
      client:write(line_of("hello", {token = server.token}) .. "\n")
      t.ok(client:read_line(10):find("result", 1, true))
      client:write(line_of("dynamics.run", {seconds = 0.5}) .. "\n" .. line_of("world.hash"):sub(1, 20))
      os.execute("kill -9 " .. server.process)
      local _, why
      repeat _, why = client:read_some(10) until why
      t.equal(why, "closed", round)
      server.pipe:close()
      port, last_token = tostring(server.port or 0), server.token
    end
  end
end)
