-- A server that several clients share: batches, snapshots and limits that keep them from waiting for each other.
local test, clench = require "test", require "clench"
local connect = dofile "tests/lua/rpc_client.lua"
local json, loop = clench.json, clench.loop

local function serve(on_connect)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  return clench.control.server {world = world, port = 0, on_connect = on_connect}, world
end

local function code(response) return response.error and response.error.code end

test("others are served between the requests of a batch, and its client's next request after it", function(t)
  local server <close> = serve()
  local client, other = connect(server), connect(server)
  local order = {}
  local batch = {}
  for i = 1, 300 do batch[i] = {jsonrpc = "2.0", id = i, method = "world.list"} end
  client.port:write(json.encode(batch) .. "\n" .. '{"jsonrpc":"2.0","id":"next","method":"world.hash"}\n')
  loop.spawn(function()
    local responses = client.receive()
    t.equal(#responses, 300)
    for i, response in ipairs(responses) do t.equal(response.id, i) end
    order[#order + 1] = "batch"
    t.equal(client.receive().id, "next")
    order[#order + 1] = "next"
  end)
  repeat
    other.get "world.hash"
    order[#order + 1] = "other"
  until order[#order - 1] == "next"
  t.ok(order[1] == "other" and order[5] == "other", table.concat(order, " "))
  local at = {}
  for i, word in ipairs(order) do at[word] = at[word] or i end
  t.ok(at.batch < at.next)
  -- a client that ends its side is answered all the same
  client.port:write(json.encode(batch) .. "\n")
  client.port:close()
  t.ok(other.get "world.hash")
end)

test("a batch ends when its client has gone, and not when it only sends no more", function(t)
  local server <close>, world = serve()
  local done = 0
  server.session:command {name = "test.slow", label = "Slow", reads = true, run = function()
    done = done + 1
    local last = clench.clock() + 0.003
    while clench.clock() < last do end
    return done
  end}
  local batch = {}
  for i = 1, 1000 do batch[i] = {jsonrpc = "2.0", id = i, method = "test.slow"} end
  local client, other = connect(server), connect(server)
  client.port:write(json.encode(batch) .. "\n")
  while done == 0 do loop.sleep(0) end
  client.port:close()
  local last = loop.time() + 20
  while #server.clients > 1 and loop.time() < last do other.get "world.hash" end
  local before = done
  loop.sleep(0.1)
  t.ok(done == before and done < 500, ("%d of 1000 requests were served"):format(done))
  -- the tool ends its side of the connection, and prints what it receives
  local few = test.path(".json")
  local file <close> = io.open(few, "w")
  file:write('{"jsonrpc":"2.0","id":"h","method":"hello","params":{"token":"', server.token, '"}}\n', json.encode(table.move(batch, 1, 100, 1, {})), "\n")
  file:close()
  local half = clench.job(function(port, path)
    local python = [[
import socket, sys
s = socket.create_connection(("127.0.0.1", int(sys.argv[1])))
s.sendall(open(sys.argv[2], "rb").read())
s.shutdown(socket.SHUT_WR)
out = b""
while True:
    part = s.recv(65536)
    if not part: break
    out += part
sys.stdout.buffer.write(out)
]]
    return io.popen(("python3 -c '%s' %d '%s'"):format(python, port, path)):read "a"
  end, {args = {server.port, few}})
  t.ok(loop.wait(half, 30))
  local lines = {}
  for line in half:result():gmatch "[^\n]+" do lines[#lines + 1] = json.decode(line) end
  t.equal({lines[1].id, #lines[2], lines[2][100].id}, {"h", 100, 100})
end)

test("one request reads at most 1000 fields", function(t)
  local server <close> = serve()
  local client = connect(server)
  local function names(count)
    local list = {}
    for i = 1, count do list[i] = "time" end
    return list
  end
  t.equal(client.get("get", {fields = names(1000)}).time, 0)
  t.equal(#client.get("read", {items = {{fields = names(500)}, {fields = names(500)}}}), 2)
  for _, case in ipairs {{"get", {fields = names(1001)}}, {"read", {items = {{fields = names(500)}, {fields = names(501)}}}}} do
    local response = client.call(table.unpack(case))
    t.equal(code(response), -32002)
    t.equal(response.error.message, "at most 1000 fields are read in one request, got 1001")
  end
  local empty = {}
  for i = 1, 1001 do empty[i] = {fields = {}} end
  t.equal(code(client.call("read", {items = empty})), -32002)
end)

test("many subscriptions of different rates leave time for requests", function(t)
  local server <close> = serve()
  local other = connect(server)
  local function cost()
    local began = os.clock()
    for _ = 1, 20 do
      other.get "world.hash"
      loop.sleep(0.005)
    end
    return (os.clock() - began) / 20
  end
  local clients = {}
  for c = 1, 4 do
    clients[c] = connect(server)
    for i = 1, 32 do clients[c].get("subscribe_state", {rate = 1000 - c - 0.1 * i, poses = true, contacts = true}) end
  end
  local groups = 0
  for _ in pairs(server.snapshot_groups) do groups = groups + 1 end
  t.equal(groups, 1)
  t.ok(cost() < 0.02, cost())
end)

test("requests with very many values are refused at once", function(t)
  local server <close> = serve()
  local client = connect(server)
  local function refused(method, params, code, words)
    local began = os.clock()
    local response = client.call(method, params)
    t.ok(os.clock() - began < 0.5, method)
    t.equal(response.error.code, code)
    t.ok(response.error.message:find(words, 1, true), response.error.message)
  end
  local function many(value, count)
    local list = {}
    for i = 1, count do list[i] = value end
    return list
  end
  refused("grasp.dofs", {dofs = many(1, 400000)}, -32002, "at most 50000 values")
  refused("step", {targets = {barrett = many(1, 400000)}}, -32002, "at most 50000 values")
  refused("world.average_contacts", {links = many("mug", 1001)}, -32002, "links: expected at most 1000 addresses, got 1001")
  refused("body.move", {body = ("/"):rep(900000), pose = {}}, -32000, "an address has at most 1000 bytes, got 900000")
end)

test("requests whose id is null are found between other requests", function(t)
  local null_ids = require "clench.control.rpc.null_ids"
  for _, case in ipairs {{'{"id":null}', {true}}, {' {"a":{"id":null},"b":[{"id" : null}]} ', {}}, {'{"a":"\\"id\\":null","id" : null}', {true}}, {'{"a":"\\"id\\":null"}', {}},
                         {'[{"id":1},{"a":[1,{"id":null}],"id":null},[{"id":null}],"}{",{"a":",\\\\","id":null}]', {[2] = true, [5] = true}}} do
    t.equal(null_ids(case[1]), case[2], case[1])
  end
end)

test("clients with the same rate share snapshots, and each has its own until it ends it", function(t)
  local server <close>, world = serve()
  local a, b, c = connect(server), connect(server), connect(server)
  b.get("subscribe", {event = "changed"})
  for _, client in ipairs {a, b} do client.subscription = client.get("subscribe_state", {rate = 200}).subscription end
  c.get("subscribe_state", {rate = 200, poses = true})
  local function next_state(client)
    world.objects[1].pose = world.objects[1].pose * clench.pose {xyz = {0, 0, 0.01}}
    local message
    repeat message = client.receive() until message.method == "snapshot" and message.params.value.objects[1].pose.xyz[3] == world.objects[1].pose.position.z
    return message.params
  end
  t.equal(next_state(a).subscription, 1)
  t.equal(next_state(b).subscription, 2)
  t.equal(#next_state(c).value.poses, #world.bodies)
  t.equal(next_state(b).value.poses, nil)
  a.get("unsubscribe", {subscription = a.subscription})
  next_state(b)
  a.notes = {}
  a.get "world.hash"
  next_state(b)
  a.get "world.hash"
  t.equal(#a.notes, 0)
  b.port:close()
  c.get("unsubscribe", {subscription = 1})
  local last = loop.time() + 10
  while next(server.snapshot_groups) and loop.time() < last do loop.sleep(0.01) end
  t.equal(next(server.snapshot_groups), nil)
end)

test("a client that has gone leaves nothing in memory, whatever it had subscribed to", function(t)
  local kept = setmetatable({}, {__mode = "k"})
  local server <close>, world = serve(function(client) kept[client] = true end)
  for _ = 1, 20 do
    local client = connect(server)
    for _, event in ipairs {"contact", "contact_lost", "limit", "changed", "diagnostic", "result"} do client.get("subscribe", {event = event}) end
    client.get("subscribe_state", {rate = 1000, poses = true, contacts = true})
    client.port:write('[{"jsonrpc":"2.0","id":1,"method":"world.hash"},{"jsonrpc":"2.0","id":2,"method":"world.list"}]\n{"jsonrpc":')
    client.port:close()
  end
  local last = loop.time() + 20
  repeat
    loop.sleep(0.01)
    collectgarbage()
    collectgarbage()
  until next(kept) == nil or loop.time() > last
  t.equal(next(kept), nil)
  t.equal(world.time, 0)
end)
