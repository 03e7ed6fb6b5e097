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
  refused("grasp.dofs", {dofs = many(1, 400000)}, -32002, "at most 20000 values")
  refused("step", {targets = {barrett = many(1, 400000)}}, -32002, "at most 20000 values")
  refused("read", {items = many({}, 20001)}, -32002, "at most 20000 values")
  for _, case in ipairs {{"world.average_contacts", "links"}, {"world.select", "addresses"}} do
    refused(case[1], {[case[2]] = many("mug", 1001)}, -32000, case[2] .. ": expected at most 11 addresses, of different bodies and robots, got 1001")
  end
  refused("body.move", {body = ("/"):rep(900000), pose = {}}, -32000, "an address has at most 1000 bytes, got 900000")
end)

test("the id of a request is found also if its values are too many to be decoded, and a batch of such requests is answered one by one", function(t)
  local server <close> = serve()
  local client, other = connect(server), connect(server)
  local ones = "[" .. ("1,"):rep(30000) .. "1]"
  local function large(id) return ('{"jsonrpc":"2.0","method":"grasp.dofs","params":{"dofs":%s}%s}'):format(ones, id and ',"id":' .. id or "") end
  local good = '{"jsonrpc":"2.0","id":"good","method":"world.hash"}'
  local function answers(line)
    client.port:write(line .. "\n" .. good .. "\n")
    local list = {}
    while true do
      local message = client.receive()
      if message.id == "good" then return list end
      list[#list + 1] = message
    end
  end
  for _, case in ipairs {{"7", 7}, {'"a b"', "a b"}, {"null", nil}, {"{}", nil}, {ones, nil}} do
    local got = answers(large(case[1]))
    t.equal({#got, code(got[1]), got[1].id}, {1, -32002, case[2]})
  end
  t.equal(answers(large()), {})  -- a notification
  local batch = answers("[" .. table.concat({large "1", large(), "5", '{"jsonrpc":"2.0","id":"b","method":"world.hash"}', large "null", "[]"}, ",") .. "]")[1]
  local codes = {}
  for i, response in ipairs(batch) do codes[i] = code(response) or response.id end
  t.equal(codes, {-32002, -32600, "b", -32002, -32600})
  t.equal(code(answers("[" .. ("1,"):rep(30000) .. "1]")[1]), -32600)
  t.equal(code(answers("[" .. large "1" .. ",{]]")[1][2]), -32700)
  t.equal(code(answers("[" .. large "1" .. ",{")[1]), -32700)
  t.ok(other.get "world.hash")
end)

test("no line costs the server more than some milliseconds before it is refused", function(t)
  local server <close> = serve()
  local client, guest = connect(server), connect(server, false)
  local size = (1 << 20) - 200
  local function filled(item) return "[" .. (item .. ","):rep(size // (#item + 1) - 1) .. item .. "]" end
  local function with(value) return ('{"jsonrpc":"2.0","id":1,"method":"get","params":{"fields":%s}}'):format(value) end
  for name, line in pairs {
    numbers = with(filled "1"), lists = with(filled "[]"), deep = with(filled(("["):rep(80) .. ("]"):rep(80))), objects = with(filled '{"a":1}'), batch = filled "{}",
    blanks = with((" "):rep(size)), ["blanks after an id"] = '{"id":null,"a":' .. (" "):rep(size) .. "1}", ["null ids"] = filled '{"id":null}', quotes = with('"' .. ('\\"'):rep(size // 2) .. '"'),
    brackets = ("["):rep(size), ["a string"] = '"' .. ("x"):rep(size) .. '"',
  } do
    for who, one in pairs {client = client, guest = guest} do
      local cost = math.huge
      for _ = 1, 3 do
        one.port:write(line)
        loop.sleep(0.02)  -- the server has received it, except for its end
        local began = os.clock()
        one.port:write "\n"
        t.ok(one.receive().error, name)
        cost = math.min(cost, os.clock() - began)
      end
      t.ok(cost < 0.1, ("%s of a %s: %.0f ms"):format(name, who, 1e3 * cost))
    end
  end
end)

test("a field that is read repeatedly in one request is made once, and results are limited", function(t)
  local server <close>, world = serve()
  local client = connect(server)
  local function items(count, fields)
    local list = {}
    for i = 1, count do list[i] = {of = "barrett", fields = fields} end
    return list
  end
  t.equal(client.get("read", {items = {{of = "mug", fields = {"mass", "robot", "mass"}}, {of = "", fields = {"time"}}, {fields = {}}}}), {{mass = world.objects[1].mass}, {time = 0}, {}})
  client.get("grasp.find_virtual", {count_per_link = 100})
  local began = os.clock()
  client.port.max_line = 1 << 24
  t.equal(#client.get("read", {items = items(30, {"virtual_contacts"})}), 30)
  local response = client.call("read", {items = items(1000, {"virtual_contacts"})})
  t.ok(os.clock() - began < 2)
  t.equal(code(response), -32002)
  t.ok(response.error.message:find "items%[%d+%]: the result has more than 4194304 bytes", response.error.message)
  -- the answers to a batch, too: requests beyond the limit are refused, not run
  local batch = {}
  for i = 1, 9 do batch[i] = {jsonrpc = "2.0", id = i, method = "read", params = {items = items(30, {"virtual_contacts"})}} end
  batch[10] = {jsonrpc = "2.0", id = 10, method = "body.mass", params = {body = "mug", mass = 5}}
  client.port:write(json.encode(batch) .. "\n")
  local responses = client.receive()
  t.equal(#responses, 10)
  t.ok(responses[1].result and responses[2].result)
  t.equal(code(responses[10]), -32002)
  t.ok(responses[10].error.message:find("the answers to the previous requests of this batch have more than 4194304 bytes", 1, true))
  t.ok(world.objects[1].mass ~= 5)
end)

test("of several long lines only one is served in each round, and short ones meanwhile", function(t)
  local server <close> = serve()
  local short, clients, order, done = connect(server), {}, {}, 0
  server.session:command {name = "test.note", reads = true, parameters = {{name = "who", type = "integer"}, {name = "rest", type = "string"}}, run = function(_, args) order[#order + 1] = args.who end}
  for i = 1, 6 do clients[i] = connect(server) end
  for i, client in ipairs(clients) do
    local long = json.encode {jsonrpc = "2.0", id = 1, method = "test.note", params = {who = i, rest = ("x"):rep(9000)}} .. "\n"
    client.port:send(long:rep(3))  -- all before the loop runs
    loop.spawn(function()
      for _ = 1, 3 do t.equal(client.receive().id, 1) end
      done = done + 1
    end)
  end
  while done < #clients do short.get("test.note", {who = 0, rest = ""}) end
  -- each has one turn per round, and before each turn the short lines that have arrived
  local turns = {}
  for _, who in ipairs(order) do turns[#turns + 1] = who > 0 and who or nil end
  for i = 1, 18 do t.equal(turns[i], (i - 1) % 6 + 1, table.concat(turns, " ")) end
  -- batches share their turns
  local batch = {}
  for i = 1, 200 do batch[i] = {jsonrpc = "2.0", id = i, method = "world.list"} end
  for _, client in ipairs(clients) do client.port:write(json.encode(batch) .. "\n") end
  local received, waits = 0, {}
  for _, client in ipairs(clients) do
    loop.spawn(function()
      t.equal(#client.receive(), 200)
      received = received + 1
    end)
  end
  while received < #clients do
    local began = os.clock()
    short.get "world.hash"
    waits[#waits + 1] = os.clock() - began
  end
  table.sort(waits)
  t.ok(#waits > 10 and waits[#waits // 2] < 0.02, ("%d waits, median %.1f ms"):format(#waits, 1e3 * waits[#waits // 2]))
end)

test("a job that ends just after a wait for it has timed out is noticed", function(t)
  local jobs, wait = require "clench.control.rpc.jobs", loop.wait
  local job, ended = {name = "search", state = "running", events = function() return {} end}, 0
  loop.wait = function(what, seconds)
    if what ~= job then return wait(what, seconds) end
    job.state = "done"
    return false
  end
  local _ <close> = setmetatable({}, {__close = function() loop.wait = wait end})
  local context = {server = {jobs = {}, job_count = 0}}
  t.equal(jobs.keep(context, job, function(kept) ended = ended + (kept.job == job and 1 or 0) end), 1)
  loop.sleep(0.01)
  t.equal(ended, 1)
end)

test("the description of all methods follows the commands of the session", function(t)
  local server <close> = serve()
  local client, page = connect(server), connect(server)
  local function names()
    local out = {}
    for i, method in ipairs(client.get "describe") do out[i] = method.name end
    return out
  end
  local before = names()
  t.equal(client.get("hello", {token = server.token}).methods, before)
  t.equal(page.get "describe", client.get "describe")
  server.session:command {name = "mine.first", label = "Mine", run = function() end}
  local after = names()
  t.equal(#after, #before + 1)
  t.equal(client.get("hello", {token = server.token}).methods, after)
  server.session:command {name = "mine.first", label = "Changed", run = function() end, replace = true}
  t.equal(client.get("describe", {method = "mine.first"}).text, "Changed")
  for _, method in ipairs(client.get "describe") do
    if method.name == "mine.first" then t.equal(method.text, "Changed") end
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
