-- JSON-RPC 2.0: commands and queries by name, errors, batches, subscriptions, jobs, steps, and restrictions for unauthorized clients.
local test, clench = require "test", require "clench"
local json, loop = clench.json, clench.loop

local function serve(options)
  options = options or {}
  options.world = options.world or clench.load("worlds/barrett_mug.wld", {root = "."})
  options.port = 0
  local server = clench.control.server(options)
  return server, options.world, options.world.robots[1]
end

local connect = dofile "tests/lua/rpc_client.lua"

local function code(response) return response.error and response.error.code end

test("before hello with the token every request is rejected, and wrong tokens end the connection", function(t)
  local server <close>, world = serve()
  local before = world:hash()
  local client = connect(server, false)
  for _, method in ipairs {"grasp.autograsp", "world.state", "describe", "no.such.method", "subscribe"} do t.equal(code(client.call(method)), -32001) end
  t.equal(code(client.call "hello"), -32001)
  t.equal(code(client.call("hello", {token = server.token:sub(1, -2)})), -32001)
  t.equal(code(client.call("hello", {token = server.token .. "0"})), -32001)
  t.equal(world:hash(), before)
  t.equal(client.get("hello", {token = server.token}).version, clench.version)
  t.ok(client.get "world.state")
  local guesser = connect(server, false)
  for _ = 1, 5 do t.equal(code(guesser.call("hello", {token = ("0"):rep(48)})), -32001) end
  t.equal({guesser.receive()}, {nil, "closed"})
  local open <close> = serve {token = false}
  t.equal(connect(open, false).get("hello").protocol, 1)
end)

test("malformed requests have the standard errors", function(t)
  local server <close> = serve()
  local client = connect(server)
  for line, expected in pairs {
    ['{"jsonrpc":"2.0","id":1,"method":'] = {-32700},
    ['{"jsonrpc":"2.0","id":1,"method":"hello"} x'] = {-32700},
    ["{]"] = {-32700},
    ["nonsense"] = {-32700},
    ["[]"] = {-32600},
    ["5"] = {-32600},
    ["{}"] = {-32600},
    ['{"id":1,"method":"hello"}'] = {-32600, 1},
    ['{"jsonrpc":"1.0","id":"x","method":"hello"}'] = {-32600, "x"},
    ['{"jsonrpc":"2.0","id":1,"method":5}'] = {-32600, 1},
    ['{"jsonrpc":"2.0","id":{},"method":"hello"}'] = {-32600},
    ['{"jsonrpc":"2.0","id":2,"method":"world.state","params":[1]}'] = {-32602, 2},
    ['{"jsonrpc":"2.0","id":2,"method":"world.state","params":7}'] = {-32602, 2},
    ['{"jsonrpc":"2.0","id":3,"method":"wrold.state"}'] = {-32601, 3},
    ['{"jsonrpc":"2.0","id":4,"method":"world.distance","params":{"c":1}}'] = {-32602, 4},
    ['{"jsonrpc":"2.0","id":5,"method":"grasp.autograsp","params":{"speeed":1}}'] = {-32602, 5},
    ['{"jsonrpc":"2.0","id":6,"method":"grasp.autograsp","params":{"speed":"fast"}}'] = {-32602, 6},
    ['{"jsonrpc":"2.0","id":7,"method":"body.mass","params":{"body":"nobody","mass":1}}'] = {-32000, 7},
    ['{"jsonrpc":"2.0","id":8,"method":"control.apply","params":{}}'] = {-32601, 8},
    ['{"jsonrpc":"2.0","id":null,"method":"no.such"}'] = {-32601},
    [("["):rep(2000)] = {-32700},
  } do
    client.port:write(line .. "\n")
    local message = client.receive()
    t.equal({message.error.code, message.id}, expected, line)
    t.ok(#message.error.message > 5)
  end
  client.port:write "\n  \n"
  local unknown = client.call "wrold.state"
  t.ok(unknown.error.message:find("did you mean 'world.state'?", 1, true), unknown.error.message)
  t.equal(client.call("body.mass", {body = "nobody", mass = 1}).error.data.kind, "input")
end)

test("a message that is not UTF-8 is refused, and the server goes on", function(t)
  local server <close> = serve()
  local client = connect(server)
  for _, line in ipairs {'{"jsonrpc":"2.0","id":"\xFF","method":"world.hash"}', '{"jsonrpc":"2.0","id":1,"method":"\xC0\x80"}', '[{"jsonrpc":"2.0","id":"\xED\xA0\x80","method":"world.hash"}]'} do
    client.port:write(line .. "\n")
    local message = client.receive()
    t.equal({message.error.code, message.id}, {-32700})
    t.ok(message.error.message:find "^byte %d+ is not UTF%-8$", message.error.message)
  end
  t.ok(client.get "world.hash")
end)

test("a request whose id is null is answered, and no other one without an id", function(t)
  local server <close> = serve()
  local client = connect(server)
  local function ids(line)
    client.port:write(line .. '\n{"jsonrpc":"2.0","id":"mark","method":"world.hash"}\n')
    local count = 0
    while true do
      local message = client.receive()
      if message.id == "mark" then return count end
      count = count + math.max(#message, 1)
    end
  end
  local form = '{"jsonrpc":"2.0","method":"world.hash",%s}'
  t.equal(ids(form:format '"id":null'), 1)
  t.equal(ids(form:format '"params":{"id":null}'), 0)
  t.equal(ids(form:format '"params":{"x":"\\\\\\"id\\":null"}'), 0)
  t.equal(ids("[" .. form:format '"params":{}' .. "," .. form:format '"id" : null' .. ',{"jsonrpc":"2.0","method":"read","params":{"items":[[],{"id":null}]}}]'), 1)
end)

test("what is not a list or an address is refused, not passed over", function(t)
  local server <close>, world = serve()
  local client = connect(server)
  for _, case in ipairs {
    {"read", {items = {a = 1}}, "items: expected a list"}, {"read", {items = {{fields = {a = "time"}}}}, "fields: expected a list"},
    {"read", {items = {{of = 5, fields = {"time"}}}}, "expected a body or robot, or its address, got 5"},
    {"read", {items = {{of = {time = 1}, fields = {"time"}}}}, "or its address, got a table with names"}, {"get", {fields = {a = "time"}}, "fields: expected a list"},
    {"world.select", {addresses = {5}}, "or its address, got 5"}, {"world.select", {addresses = {a = "mug"}}, "addresses: expected a list"},
    {"world.average_contacts", {links = {a = "mug"}}, "links: expected a list"}, {"step", {efforts = {{0, 0, 0, 0}}}, "efforts: expected an object of numbers by robot"},
  } do
    local problem = client.call(case[1], case[2]).error
    t.ok(problem.message:find(case[3], 1, true) and problem.code ~= -32603, problem.message)
  end
  -- one of two things may be left out, either one
  client.get "grasp.autograsp"
  t.ok(#client.get("world.contacts", {a = "mug"}) > 0)
  t.equal(client.get("world.contacts", {b = "mug"}), client.get("world.contacts", {a = "mug"}))
  world.objects[1].pose = world.robots[1].pose
  t.ok(#client.get("world.colliding", {a = "mug"}) > 0)
  t.equal(client.get("world.colliding", {b = "mug"}), client.get("world.colliding", {a = "mug"}))
end)

test("a batch has a response for each request, and none for notifications", function(t)
  local server <close>, _, hand = serve()
  local client = connect(server)
  local function batch(list)
    client.port:write(json.encode(list) .. "\n")
    return client.receive()
  end
  local got = batch {{jsonrpc = "2.0", id = "a", method = "world.hash"}, {jsonrpc = "2.0", method = "world.hash"}, {jsonrpc = "2.0", id = "b", method = "nope"}, 5,
                     {jsonrpc = "2.0", id = "c", method = "dynamics.run", params = {seconds = 0.002}}, {jsonrpc = "2.0", id = "d", method = "get", params = {fields = {"time"}}}}
  t.equal(#got, 5)
  t.equal(got[2].error.code, -32601)
  t.equal(got[3].error.code, -32600)
  t.equal(got[4].result.applied, true)
  t.close(got[5].result.time, 0.002, 1e-12)
  client.port:write(json.encode {{jsonrpc = "2.0", method = "grasp.open"}} .. "\n")
  t.equal(client.call("get", {of = hand.name, fields = {"dofs"}}).result.dofs, hand.dofs)
  local many = {}
  for i = 1, 1001 do many[i] = {jsonrpc = "2.0", id = i, method = "world.hash"} end
  t.equal(batch(many).error.code, -32600)
  many[1001] = nil
  t.equal(#batch(many), 1000)
end)

test("while a batch is served, others are answered, and its client waits", function(t)
  local server <close>, world = serve()
  local client, other = connect(server), connect(server)
  local steps = {}
  for i = 1, 1000 do steps[i] = {jsonrpc = "2.0", id = i, method = "step", params = {dt = 0.01, state = false}} end
  client.port:write(json.encode(steps) .. '\n{"jsonrpc":"2.0","id":"next","method":"get","params":{"fields":["time"]}}\n')
  repeat until other.get("get", {fields = {"time"}}).time > 0
  t.ok(other.get("get", {fields = {"time"}}).time < 5)
  t.equal(#client.receive(), 1000)
  t.close(client.receive().result.time, 10, 1e-6)
  t.close(world.time, 10, 1e-6)
end)

test("commands act on the session, by addresses, and can be undone", function(t)
  local server <close>, world, hand = serve()
  local client = connect(server)
  local before = world:hash()
  local result = client.get("grasp.autograsp", {hand = hand.name})
  t.equal(result.moved, true)
  t.equal(result.stopped_by[1][1]:match "^barrett/chain%d_link%d$" ~= nil, true)
  local copy = world:clone()
  hand:in_world(copy):open()
  hand:in_world(copy):autograsp()
  t.ok(world:hash() ~= before)
  client.get("body.mass", {body = "mug", mass = 0.25})
  t.close(world:body("mug").mass, 0.25, 0)
  client.get("body.move", {body = "mug", pose = {xyz = {1, 2, 3}}})
  t.close(world:body("mug").pose.position, {1, 2, 3}, 1e-12)
  t.equal(client.get "session.undo", server.session.commands["body.move"].label)
  client.get "session.undo"
  client.get "session.undo"
  t.equal(world:hash(), before)
  t.equal(client.get "session.redo", server.session.commands["grasp.autograsp"].label)
  t.ok(client.get("session.script"):find("autograsp()", 1, true))
  t.equal(client.get("session.info").hand, "barrett")
end)

test("queries return the values that scripts read", function(t)
  local server <close>, world, hand = serve()
  local client = connect(server)
  hand:autograsp()
  local mug, tip = world:body "mug", hand:link "chain1_link2"
  t.equal(client.get("get", {of = "barrett/chain1_link2", fields = {"name"}}).name, tip.name)
  local got = client.get("read", {items = {{of = "barrett", fields = {"dofs", "dof_limits"}}, {of = "mug", fields = {"mass", "pose", "robot"}}, {fields = {"time", "gravity"}}}})
  t.equal(got[1].dofs, hand.dofs)
  t.equal(got[1].dof_limits, hand.dof_limits)
  t.equal(got[2].mass, mug.mass)
  t.close(got[2].pose.xyz, {0, 0, 0}, 1e-12)
  t.close(got[3].gravity, {0, 0, -9.81}, 1e-12)
  t.equal(client.get("world.hash"), world:hash())
  local contacts = client.get("world.contacts", {a = "barrett", b = "mug"})
  local expected = world:contacts(hand, mug)
  t.equal(#contacts, #expected)
  for i, contact in ipairs(expected) do
    t.close(contacts[i].point, {contact.point.x, contact.point.y, contact.point.z}, 0)
    t.equal({contacts[i].body, contacts[i].mu}, {"mug", contact.mu})
  end
  t.equal(#client.get "world.contacts", #expected)
  t.close(client.get("world.distance", {a = "barrett", b = "mug"}).distance, world:distance(hand, mug), 0)
  t.equal(client.get("world.raycast", {origin = {0, 0, 9}, direction = {0, 0, 1}}), nil)
  t.equal(#client.get("robot.jacobian", {link = "barrett/chain1_link2"}), #hand:jacobian(tip))
  t.equal(client.get("world.colliding"), {})
  local held = clench.grasp(hand, mug):contact_forces {load = {0, 0, -9.81 * mug.mass, 0, 0, 0}}
  t.equal(client.get("grasp.forces").status, held.status)
  t.close(client.get("grasp.quality"), clench.grasp(hand, mug):quality "epsilon", 0)
  local state = client.get "world.state"
  t.equal(state.robots[1].dofs, hand.dofs)
  t.equal(state.objects[1].body, "mug")
  t.equal(code(client.call("get", {fields = {"run"}})), -32602)
  t.equal(code(client.call("get", {fields = {"tmie"}})), -32000)
  t.equal(code(client.call("get", {fields = {5}})), -32602)
  t.equal(code(client.call("read", {items = {5}})), -32602)
  local described = client.get("describe", {method = "dynamics.run"})
  t.equal({described.long, described.parameters[1].name, described.parameters[1].unit}, {true, "seconds", "s"})
  local methods, seen = client.get("hello", {token = server.token}).methods, {}
  t.equal(#client.get "describe", #methods)
  for _, name in ipairs(methods) do
    t.ok(not seen[name], name)
    seen[name] = true
  end
  server.session:command {name = "job.stop", run = function() end, replace = true}
  t.equal(#client.get("hello", {token = server.token}).methods, #methods)
end)

test("a control loop steps and reads in one round trip, bit-identically to a script", function(t)
  local server <close>, world, hand = serve()
  local client = connect(server)
  local copy = world:clone()
  local same = hand:in_world(copy)
  same.controller = "none"
  for i = 1, 20 do
    local efforts = {0, 0.01 * i, 0.02, 0.03}
    local state = client.get("step", {efforts = {barrett = efforts}, dt = 0.002})
    same:set_forces(efforts)
    copy:run(0.002)
    t.equal(state.robots[1].dofs, same.dofs)
  end
  t.equal(world:hash(), copy:hash())
  client.get("step", {targets = {barrett = {dof2 = 0.9}}, state = false})
  t.equal(code(client.call("step", {dt = 10})), -32602)
  client.get("world.settings", {time_step = 1e-7})
  t.ok(client.call("step", {dt = 0.1}).error.message:find "dt: 0.1 s are more than 1000 time steps of 1e%-07 s")
  client.get "session.undo"
  t.equal(code(client.call("step", {efforts = {barrett = 5}})), -32602)
  t.equal(code(client.call("step", {efforts = {nobody = {1}}})), -32000)
end)

test("long commands run in parallel, and are applied as one edit if nothing has changed since", function(t)
  local server <close>, world = serve()
  local client, other = connect(server), connect(server)
  local before = world:hash()
  local copy = world:clone()
  copy:run(0.05)
  local result = client.get("dynamics.run", {seconds = 0.05})
  t.equal(result.applied, true)
  t.equal(world:hash(), copy:hash())
  t.equal(client.get("session.undo"), "Apply a result")
  t.equal(world:hash(), before)
  -- another client changes the world meanwhile
  client.port:write '{"jsonrpc":"2.0","id":"long","method":"dynamics.run","params":{"seconds":0.05}}\n'
  other.get("body.mass", {body = "mug", mass = 0.5})
  local changed = world:hash()
  local message
  repeat message = client.receive() until message.id == "long"
  t.equal(message.result.applied, false)
  t.equal(world:hash(), changed)
  t.equal(client.get("job.result", {job = message.result.job}).applied, false)
  t.equal(code(client.call("dynamics.run", {seconds = -1})), -32602)
  client.get("session.undo")
  t.equal(client.get("dynamics.run", {seconds = 0.01}).applied, true)
  t.ok(client.get("session.script"):find("world:run(0.01)", 1, true))
end)

test("many steps are one long command, and long queries leave the world and others alone", function(t)
  local server <close>, world, hand = serve {world = clench.load("worlds/dlr_flask.wld", {root = "."}), folder = test.path():match "^(.*)/"}
  local client, other = connect(server), connect(server)
  local copy = world:clone()
  for _ = 1, 30 do copy:run(copy.time_step) end
  t.equal(client.get("dynamics.step", {count = 30}).applied, true)
  t.equal(world:hash(), copy:hash())
  t.equal(client.get("session.undo"), "Apply a result")
  client.get "grasp.autograsp"
  -- of the current object, which is not the first one of the world
  local box = world:add_object(clench.shapes.box {0.02, 0.02, 0.02}, {pose = {xyz = {0, 0, 2}}, name = "a box"})
  client.get("grasp.select_object", {object = "flask"})
  local before, edits = world:hash(), #server.session.history.done
  client.port:write '{"jsonrpc":"2.0","id":"long","method":"grasp.measures"}\n'
  local answered, began, worst, message = 0, loop.time(), 0, nil
  local waiting = loop.spawn(function() repeat message = client.receive() until message.id == "long" end)
  while waiting.status ~= "done" and loop.time() < began + 60 do
    local asked = loop.time()
    other.get "world.hash"
    answered, worst = answered + 1, math.max(worst, loop.time() - asked)
  end
  local expected = clench.grasp(hand, world:body "flask"):quality_all()
  for name, value in pairs(expected) do
    if type(value) == "number" and value - value == 0 then t.equal(message.result[name], value, name) end
  end
  t.ok(answered > 5 and worst < 5, ("%d requests, the slowest %.3f s"):format(answered, worst))
  t.equal({world:hash(), #server.session.history.done}, {before, edits})
  t.equal(client.get("describe", {method = "grasp.measures"}).long, true)
  client.get("grasp.select_object", {object = box.name})
  t.equal(client.get("grasp.measures").epsilon, 0)
  t.ok(expected.epsilon > 0)
  local name = test.path():match "[^/]+$"
  client.get("world.save_image", {path = name, options = {size = {64, 48}, quality = "draft"}})
  local picture <close> = assert(io.open(server.folder .. "/" .. name .. ".png", "rb"))
  t.equal(picture:read(4), "\137PNG")
  os.remove(server.folder .. "/" .. name .. ".png")
end)

test("searches are jobs with states and events, and can be stopped", function(t)
  local server <close> = serve()
  local client = connect(server)
  local job = client.get("plan.start", {planner = "sample", options = {count = 1, seed = 1, refine = 1}}).job
  local grasps, last = 0, loop.time() + 60
  repeat
    local state = client.get("job.state", {job = job}).state
    loop.sleep(0.02)
  until state == "done" or state == "failed" or loop.time() > last
  client.get "world.hash"
  for _, note in ipairs(client.notes) do
    if note.method == "job.event" then grasps = grasps + 1 t.ok(note.params.event.dofs) end
  end
  t.ok(grasps >= 1, grasps)
  t.equal(#client.get("job.result", {job = job}).grasps, 1)
  local endless = client.get("plan.start", {planner = "sample", options = {count = 1000000, seed = 1}}).job
  t.equal(code(client.call("job.result", {job = endless})), -32000)
  client.get("job.pause", {job = endless})
  client.get("job.resume", {job = endless})
  client.get("job.stop", {job = endless})
  repeat loop.sleep(0.02) until client.get("job.state", {job = endless}).state == "stopped" or loop.time() > last
  t.equal(#client.get "job.list", 2)
  client.get("job.forget", {job = endless})
  t.equal(code(client.call("job.state", {job = endless})), -32602)
  t.equal(code(client.call("plan.start", {planner = "smaple"})), -32602)
  t.equal(code(client.call("plan.start", {planner = "list", options = {path = "/etc/passwd"}})), -32602)
  t.equal(code(client.call("plan.start", {planner = "primitive", options = {primitives = "/etc/passwd"}})), -32002)
end)

test("subscribers get every event in order, and the latest state", function(t)
  local server <close>, world, hand = serve()
  local client, watcher = connect(server), connect(server)
  local before = #server.session.subscribers.changed
  local changed = watcher.get("subscribe", {event = "changed"}).subscription
  watcher.get("subscribe", {event = "contact"})
  local state = watcher.get("subscribe_state", {rate = 200}).subscription
  for i = 1, 50 do client.get("body.mass", {body = "mug", mass = i / 100}) end
  world.gravity = {0, 0, 0}
  hand:autograsp {dynamic = true}
  local expected = {}
  world:on("contact", function(e) expected[#expected + 1] = e.b.name end)
  for _ = 1, 30 do client.get("step", {dt = 0.05, state = false}) end
  local commands, touched, snapshots = 0, {}, 0
  watcher.get "world.hash"
  loop.sleep(0.05)
  watcher.get "world.hash"
  local newest
  for _, note in ipairs(watcher.notes) do
    if note.method == "event" and note.params.subscription == changed then commands = commands + 1 end
    if note.method == "event" and note.params.event == "contact" then touched[#touched + 1] = note.params.value.b end
    if note.method == "snapshot" then snapshots, newest = snapshots + 1, note.params end
  end
  t.equal(commands, 50)
  t.equal(#touched, #expected)
  t.ok(#touched > 0)
  for i, name in ipairs(expected) do t.ok(name:find(touched[i]:match "[^/]+$", 1, true), name .. " " .. touched[i]) end
  t.ok(snapshots >= 2, snapshots)
  t.equal(newest.subscription, state)
  t.close(newest.value.time, world.time, 0)
  watcher.get("unsubscribe", {subscription = state})
  t.equal(code(watcher.call("unsubscribe", {subscription = state})), -32602)
  t.equal(code(watcher.call("subscribe", {event = "contcat"})), -32602)
  for _ = 1, 30 do watcher.get("subscribe", {event = "changed"}) end
  t.equal(code(watcher.call("subscribe", {event = "changed"})), -32002)
  watcher.port:close()
  loop.sleep(0.02)
  client.get("body.mass", {body = "mug", mass = 1})
  t.equal(#server.session.subscribers.changed, before)
end)

test("requests read and write files only below the server's folder, and none without one", function(t)
  local server <close> = serve()
  local client = connect(server)
  for _, method in ipairs {"world.open", "world.save", "world.import_robot", "world.import_object"} do t.equal(code(client.call(method, {path = "worlds/barrett_mug.wld"})), -32002) end
  local folder = os.tmpname()
  os.remove(folder)
  assert(os.execute("mkdir -p " .. folder .. "/sub"))
  local secret = os.tmpname()
  clench.files.save_text(secret, "secret")
  assert(os.execute(("mkdir %s/out && ln -s /tmp %s/away"):format(folder, folder)))
  assert(os.execute(("cp models/objects/mug.iv %s/sub/mug.iv && ln -s %s %s/link.iv"):format(folder, secret, folder)))
  local open <close>, world = serve {folder = folder}
  local reader = connect(open)
  t.equal(reader.get("world.import_object", {path = "sub/mug.iv"}), "mug_2")
  for _, path in ipairs {"../x.iv", "/etc/passwd", "sub/../../x.iv", secret, "a\nb"} do t.equal(code(reader.call("world.import_object", {path = path})), -32002, path) end
  t.equal(code(reader.call("world.import_object", {path = "link.iv"})), -32002)
  t.equal(code(reader.call("world.save", {path = "away/x.wld"})), -32002)
  t.equal(code(reader.call("world.import_object", {path = "sub/no.iv"})), -32000)
  open.session:command {name = "mine.load", parameters = {{name = "file", type = "string"}}, run = function() error "it ran" end}
  t.equal(code(reader.call("mine.load", {file = "sub/mug.iv"})), -32002)
  t.equal(code(reader.call("world.import_object", {path = "sub/mug.iv", options = {confine = "/"}})), -32002)
  t.equal(code(reader.call("world.save", {path = "../out.wld"})), -32002)
  t.equal(code(reader.call("world.save")), -32602)
  -- links to nothing, to which an ending is appended, and folders of meshes may lead out, too
  assert(os.execute(("ln -s %s.wld %s/l.wld && ln -s loop %s/loop && ln -s %s.png %s/l.png && ln -s /tmp %s/m_files"):format(secret, folder, folder, secret, folder, folder)))
  for _, path in ipairs {"l", "l.wld"} do t.equal(code(reader.call("world.save_as", {path = path})), -32002) end
  t.ok(code(reader.call("world.save", {path = "loop/x.wld"})))
  t.equal(code(reader.call("world.save_image", {path = "l", options = {size = {16, 16}}})), -32002)
  for _, path in ipairs {"m.wld", "m.xml", "m.lua"} do t.equal(code(reader.call("world.save", {path = path})), -32002, path) end
  t.equal(code(reader.call("file.convert", {from = "sub/mug.iv", to = "m.xml"})), -32002)
  t.ok(not io.open(secret .. ".wld") and not io.open(secret .. ".png"))
  -- what is saved once has its file
  t.equal(reader.get("world.save_as", {path = "n"}), folder .. "/n.wld")
  t.equal(reader.get "world.save", folder .. "/n.wld")
  open.session.path = "/tmp/elsewhere.wld"
  t.equal(code(reader.call("world.save")), -32602)
  -- meshes next to it, and another path of a command that a script has replaced
  open.session.path = folder .. "/m.xml"
  t.equal(code(reader.call("world.save")), -32602)
  local saver = open.session.commands["world.save_as"]
  local preview = {name = "preview", type = "string", optional = true, files = {writes = true}}
  open.session:command {name = "world.save_as", replace = true, reads = true, parameters = {saver.parameters[1], preview}, run = function() error "it ran" end}
  t.equal(code(reader.call("world.save_as", {path = "n", preview = "/tmp/p.png"})), -32002)
  t.equal(code(reader.call("world.save_as", {path = "n"})), -32002)
  reader.get "grasp.find_virtual"
  t.equal(reader.get("grasp.save_virtual", {path = "v.vgr"}), folder .. "/v.vgr")
  reader.get("grasp.load_virtual", {path = "v.vgr"})
  t.equal(code(reader.call("grasp.load_virtual", {path = "away/v.vgr"})), -32002)
  t.ok(#world.bodies > 0)
  os.execute("rm -rf " .. folder .. " " .. secret)
end)

test("clients that send very long lines or do not read are dropped, and others continue", function(t)
  local gone = {}
  local server <close> = serve {max_line = 5000, max_queue = 50000, on_close = function(client) gone[#gone + 1] = client.reason end}
  local client, long, deaf = connect(server), connect(server), connect(server)
  long.port:write(("x"):rep(100000) .. "\n")
  local message = long.receive()
  t.equal({message.error.code, message.id}, {-32600, nil})
  t.equal(long.receive(), nil)
  loop.spawn(function() deaf.port:write((json.encode {jsonrpc = "2.0", id = 1, method = "describe"} .. "\n"):rep(2000), 10) end)
  local last = loop.time() + 20
  while #gone < 2 and loop.time() < last do client.get "world.hash" end
  t.equal(gone, {"a line was too long", "it does not receive"})
end)
