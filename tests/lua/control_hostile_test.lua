-- Clients that send invalid data at the same time and disconnect at any point: each line is answered or its client dropped, and the server continues.
local test, clench = require "test", require "clench"
local find_three = require "clench.page.three"
local web_client = dofile "tests/lua/web_client.lua"
local json, loop = clench.json, clench.loop

local lines = tonumber(os.getenv "CLENCH_HOSTILE_LINES" or 1500)
local world = clench.load("worlds/barrett_mug.wld", {root = "."})
local body_names = #world.bodies

-- valid lines, to be mutated
local text_lines = {"getContacts 3 ALL", "getDOFVals 1 0", "moveDOFs 0 4 0 0.1 0.1 0.1 1 1 1 1", "setDOFForces 1 0 4 0 1 1 1", "getBodyName 2 0 1",
                    "moveDynamicBodies 0.001", "computeNewVelocities 0.001", "get contacts", "step dynamics", "setDOFVals 1 0", "getAverageContacts ALL"}
local function request(method, params) return json.encode {jsonrpc = "2.0", id = 7, method = method, params = params} end
local rpc_lines = {request("get", {of = "barrett", fields = {"dofs", "pose"}}), request("world.contacts"), request("body.move", {body = "mug", pose = {xyz = {0, 0, 0}}}),
                   request("step", {efforts = {barrett = {0, 0, 0, 0}}}), request("describe", {method = "get"}), request("subscribe", {event = "changed"}),
                   request("unsubscribe", {subscription = 1}), request("robot.jacobian", {link = "barrett/chain1_link2"}), request("session.undo"),
                   request("grasp.dofs", {dofs = {0, 0.1, 0.1, 0.1}}), "[" .. request "world.hash" .. "," .. request "nope" .. "]"}

-- a line with changed, lost, repeated and inserted bytes, still a single line
local function spoiled(line, random)
  for _ = 1, random:integer(1, 4) do
    local at = random:integer(1, math.max(1, #line))
    local kind = random:integer(1, 4)
    local byte = string.char(random:integer(0, 255)):gsub("\n", " ")
    if kind == 1 then line = line:sub(1, at - 1) .. byte .. line:sub(at + 1) end
    if kind == 2 then line = line:sub(1, at - 1) .. line:sub(at + 1) end
    if kind == 3 then line = line:sub(1, at) .. line:sub(at) end
    if kind == 4 then line = line:sub(1, at) .. byte .. line:sub(at + 1) end
  end
  return line
end

local function connect(server) return clench.port.connect("127.0.0.1", server.port) end

test("every mutated line of the text protocol is answered, or its client dropped", function(t)
  local server <close> = clench.control.server {world = world, port = 0}
  local random = clench.random(1)
  local client, dropped = connect(server), 0
  for i = 1, lines do
    local line = spoiled(text_lines[random:integer(1, #text_lines)], random)
    client:write(line .. "\nmark\n")
    local reply
    repeat reply = client:read_line(10) until not reply or reply == "Error: there is no command 'mark'" or reply:find "mark"
    if not reply then
      t.ok(not client:is_open(), ("line %d has no answer: %q"):format(i, line))
      client, dropped = connect(server), dropped + 1
    end
  end
  t.ok(dropped < lines / 10, dropped)
  t.equal(#world.bodies, body_names)
end)

test("every mutated request of JSON-RPC is answered, or is a notification", function(t)
  local server <close> = clench.control.server {world = world, port = 0}
  local random = clench.random(2)
  local client
  local function open()
    client = connect(server)
    client:write(request("hello", {token = server.token}) .. "\n")
    assert(client:read_line(10))
  end
  open()
  local codes, answers = {}, 0
  for i = 1, lines do
    local line = spoiled(rpc_lines[random:integer(1, #rpc_lines)], random)
    local mark = '{"jsonrpc":"2.0","id":"mark","method":"world.hash"}'
    client:write(line .. "\n" .. mark .. "\n")
    while true do
      local reply = client:read_line(10)
      t.ok(reply, ("line %d has no answer: %q"):format(i, line))
      local message = json.decode(reply)
      if message.id == "mark" then break end
      if not message.method then answers = answers + 1 end
      if message.error then
        codes[message.error.code] = (codes[message.error.code] or 0) + 1
        t.ok(message.error.code ~= -32603, reply)
      end
    end
  end
  t.ok(answers > lines / 2, answers)
  t.ok(codes[-32700] and codes[-32601] and codes[-32602])
end)

-- bytes, some of them changed, lost or inserted
local function damaged(bytes, random)
  for _ = 1, random:integer(1, 3) do
    local at, byte = random:integer(1, math.max(1, #bytes)), string.char(random:integer(0, 255))
    local kind = random:integer(1, 3)
    if kind == 1 then bytes = bytes:sub(1, at - 1) .. byte .. bytes:sub(at + 1) end
    if kind == 2 then bytes = bytes:sub(1, at - 1) .. bytes:sub(at + 1) end
    if kind == 3 then bytes = bytes:sub(1, at) .. byte .. bytes:sub(at + 1) end
  end
  return bytes
end

test("every damaged request of the live page and every damaged frame is answered, or its client dropped", function(t)
  local three, missing = find_three()
  if not three then t.skip(missing) end
  local reasons = {}
  local server <close> = clench.control.server {world = world, port = 0, http = 0, on_close = function(client) reasons[client.reason] = (reasons[client.reason] or 0) + 1 end}
  local target, before, random = "/socket?token=" .. server.token, world:hash(), clench.random(4)
  local function shake() return (web_client.open(server.http, target)) end
  local head = ("GET /?token=%s HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nContent-Length: 0\r\nTransfer-Encoding: chunked\r\n\r\n"):format(server.token)
  local statuses = {}
  for i = 1, lines // 4 do
    local port = clench.port.connect("127.0.0.1", server.http)
    local bytes = damaged(head, random)
    port:write(bytes)
    -- where the end of the request is damaged, the server waits for it
    local answer = port:read_until("\r\n\r\n", bytes:find("\r\n\r\n", 1, true) and 10 or 0.001)
    local status = answer and answer:match "^HTTP/1.1 (%d+) "
    t.ok(status or not bytes:find("\r\n\r\n", 1, true), ("request %d: %q"):format(i, bytes))
    if status then statuses[status] = (statuses[status] or 0) + 1 end
    port:close()
  end
  t.ok(statuses["400"] and not statuses["101"] and not statuses["500"], json.encode(statuses))
  -- pong, close or "closed"; "waits" if a damaged size swallows the ping
  local function outcome_of(port)
    while true do
      local ok, got, why = pcall(web_client.read_frame, port, 0.02)
      if not ok or not got then return why == "closed" and "closed" or "waits" end
      if got.opcode == 8 or got.opcode == 10 then return got.opcode == 8 and "refused" or "answered" end
    end
  end
  local ping, outcomes = web_client.frame(9, "still there?"), {answered = 0, refused = 0, closed = 0, waits = 0}
  for _ = 1, lines // 5 do
    local port = shake()
    local bytes = web_client.frame(1, request("hello", {token = server.token})) .. web_client.frame(1, rpc_lines[random:integer(1, #rpc_lines)], {last = random:uniform() < 0.9})
    port:write(damaged(bytes, random) .. ping)
    local outcome = outcome_of(port)
    outcomes[outcome] = outcomes[outcome] + 1
    port:close()
  end
  t.ok(outcomes.answered > lines // 150 and outcomes.refused > lines // 20 and outcomes.waits < lines // 10, json.encode(outcomes))
  local last = loop.time() + 20
  while #server.clients > 0 and loop.time() < last do loop.sleep(0.01) end
  t.equal(#server.clients, 0)
  t.equal(reasons["an internal error"], nil)
  t.equal(world:hash(), before)
  local port = shake()
  port:write(ping)
  t.equal(web_client.read_frame(port, 10), {opcode = 10, payload = "still there?"})
end)

test("64 clients that connect and disconnect at any point do not disturb each other", function(t)
  local server <close> = clench.control.server {world = world, port = 0, max_clients = 64}
  local random = clench.random(3)
  local good, answered, worst = connect(server), 0, 0
  local tasks = {}
  for i = 1, 62 do
    tasks[i] = loop.spawn(function()
      for _ = 1, 5 do
        local ok, client = pcall(connect, server)
        if ok then
          local list = i % 2 == 0 and text_lines or rpc_lines
          for _ = 1, 5 do
            local line = list[random:integer(1, #list)] .. "\n"
            client:write(line:sub(1, random:integer(1, #line)), 1)
            if random:uniform() < 0.5 then client:read_some(0.01) end
          end
          client:close()
        end
        loop.sleep(0.002)
      end
    end)
  end
  local function busy()
    for _, task in ipairs(tasks) do
      if task.status ~= "done" and task.status ~= "failed" then return true end
    end
  end
  while busy() do
    local began = loop.time()
    good:write "getRobotName 1 0\n"
    t.equal(good:read_line(10), "barrett")
    answered, worst = answered + 1, math.max(worst, loop.time() - began)
  end
  for _, task in ipairs(tasks) do t.equal(task.status, "done") end
  t.ok(answered > 5, answered)
  local last = loop.time() + 10
  while #server.clients > 1 and loop.time() < last do loop.sleep(0.01) end
  t.equal(#server.clients, 1)
  if os.getenv "CLENCH_HOSTILE_LINES" then print(("%d short requests, the slowest %.0f ms"):format(answered, 1e3 * worst)) end
end)

-- number of descriptors that this process has open
local function descriptors()
  local file <close> = assert(io.open "/proc/self/stat")
  local list <close> = io.popen(("ls /proc/%d/fd | wc -l"):format(file:read "n"))
  return list:read "n"
end

test("closing a server ends everything that it has started", function(t)
  for _ = 1, 3 do
    loop.sleep(0.01)
    collectgarbage()
  end
  local before = descriptors()
  for _ = 1, 20 do
    local server = clench.control.server {world = world, port = 0}
    local client = connect(server)
    client:write(request("hello", {token = server.token}) .. "\n" .. request("subscribe_state", {rate = 1000}) .. "\n" .. request("subscribe", {event = "contact"}) .. "\n")
    for _ = 1, 3 do client:read_line(5) end
    server:close()
    t.ok(not server.listener:is_open())
    client:close()
  end
  local began = loop.time()
  loop.run(5)
  t.ok(loop.time() - began < 4)  -- nothing is left to wait for
  local last, after = loop.time() + 5, nil
  repeat
    loop.sleep(0.01)
    collectgarbage()
    after = descriptors()
  until after <= before or loop.time() > last  -- those of the tests above may have closed meanwhile, too
  t.ok(after <= before, ("%d descriptors before, %d after"):format(before, after))
end)
