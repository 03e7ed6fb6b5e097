-- The text protocol of GraspIt!: every command, its errors, the old dialect, and misbehaving clients.
local test, clench = require "test", require "clench"
local loop = clench.loop

local function serve(options)
  options = options or {}
  options.world = options.world or clench.load("worlds/barrett_mug.wld", {root = "."})
  options.port = options.port or 0
  local server = clench.control.server(options)
  return server, options.world, options.world.robots[1]
end

local function connect(server)
  local client = clench.port.connect("127.0.0.1", server.port)
  -- sends lines; returns the given number of reply lines, and checks that no more follow
  local function ask(lines, count)
    client:write(lines .. "\n")
    local replies = {}
    for i = 1, count do
      local line, why = client:read_line(5)
      replies[i] = assert(line, why)
    end
    client:write "getRobotName 0 unfinished\n"
    assert(client:read_line(5) == "Error: getRobotName: one word too many: unfinished")
    return replies
  end
  return client, ask
end

local function numbers(line)
  local list = {}
  for word in line:gmatch "%S+" do list[#list + 1] = tonumber(word) end
  return list
end

test("names and DOF values are sent as lists, with their number if all are requested", function(t)
  local server <close>, world, hand = serve()
  local _, ask = connect(server)
  t.equal(ask("getRobotName 1 0", 1), {hand.name})
  t.equal(ask("getRobotName ALL", 2), {"1", hand.name})
  local names = ask("getBodyName ALL", 1 + #world.bodies)
  t.equal(names[1], tostring(#world.bodies))
  for i, body in ipairs(world.bodies) do t.equal(names[i + 1], body.name) end
  t.equal(ask("getBodyName 2 3 0", 2), {world.bodies[4].name, world.bodies[1].name})
  t.equal(ask("getBodyName 0", 0), {})
  local values = ask("getDOFVals 1 0", 5)
  t.equal(values[1], "4")
  for i, value in ipairs(hand.dofs) do t.close(tonumber(values[i + 1]), value, 1e-8) end
  t.equal(ask("getDOFVals ALL", 6)[1], "1")
end)

test("two commands in one packet have separate lists", function(t)
  local server <close>, _, hand = serve()
  local _, ask = connect(server)
  t.equal(ask("getRobotName 1 0\ngetRobotName 1 0\ngetRobotName ALL", 4), {hand.name, hand.name, "1", hand.name})
end)

test("moveDOFs moves in steps until the first contact", function(t)
  local server <close>, world, hand = serve()
  local _, ask = connect(server)
  local copy = world:clone()
  local same = hand:in_world(copy)
  local values = ask("moveDOFs 0 4 0 1.5 1.5 1.5 0.1 0.1 0.1 0.1", 4)
  same:move_dofs({0, 1.5, 1.5, 1.5}, {stop_at_contact = true})
  for i, value in ipairs(same.dofs) do t.close(tonumber(values[i]), value, 1e-6) end
  t.ok(#world:contacts(hand) > 0 and #world:colliding() == 0)
  -- a DOF with larger steps arrives before the others
  hand:open()
  values = ask("moveDOFs 0 4 0.2 0.1 0.2 0.3 0.1 0.001 0.1 0", 4)
  t.close(tonumber(values[1]), 0.2, 1e-8)
  t.close(tonumber(values[2]), 0.1, 1e-8)
  t.close(tonumber(values[4]), 0, 1e-8)  -- its step is 0
  -- targets beyond the limits: moves to the limits
  t.close(tonumber(ask("moveDOFs 0 4 0.2 -9 0.2 0 1 1 1 1", 4)[2]), hand.dof_limits[2][1], 1e-8)
end)

test("prismatic DOFs are in millimeters", function(t)
  local server <close>, _, hand = serve {world = clench.load("worlds/parallel_jaw_cube.wld", {root = "."})}
  local _, ask = connect(server)
  local slides
  for _, chain in ipairs(hand.chains) do
    for _, joint in ipairs(chain.joints) do slides = slides or joint.kind == "prismatic" and joint.dof end
  end
  t.ok(slides)
  local values = ask("getDOFVals 1 0", 1 + #hand.dofs)
  t.close(tonumber(values[1 + slides]), 1e3 * hand.dofs[slides], 1e-6)
end)

test("contacts have force, position and error, in the frames of the bodies", function(t)
  local server <close>, world, hand = serve()
  local _, ask = connect(server)
  hand:autograsp()
  for _ = 1, 3 do world:solve_velocities(world:move_bodies(0.001)) end
  for index, body in ipairs(world.bodies) do
    local contacts = body.contacts
    local lines = ask(("getContacts 3 1 %d"):format(index - 1), 1 + 3 * #contacts)
    t.equal(lines[1], tostring(#contacts))
    local mean, place = {0, 0, 0, 0, 0, 0}, clench.vec3(0, 0, 0)
    for i, contact in ipairs(contacts) do
      local wrench, at = numbers(lines[3 * i - 1]), numbers(lines[3 * i])
      local sign = contact.body == body and 1 or -1
      local force = clench.vec3(wrench[1], wrench[2], wrench[3])
      t.close(force:norm(), contact.force:norm(), 1e-6)
      t.close(wrench[3], sign * contact.force:dot(sign * contact.normal), 1e-6)  -- along the inward normal
      t.ok(wrench[3] >= -1e-9)
      local p = body.pose * clench.vec3(at[1] / 1e3, at[2] / 1e3, at[3] / 1e3)
      t.close((p - contact.point):norm(), sign > 0 and 0 or contact.gap, 1e-8)
      t.close(numbers(lines[3 * i + 1])[1], 1e3 * math.max(0, world.contact_threshold / 2 - contact.gap), 1e-8)
      for k = 1, 6 do mean[k] = mean[k] + wrench[k] / #contacts end
      place = place + clench.vec3(at[1], at[2], at[3]) / #contacts
    end
    lines = ask(("getAverageContacts 1 %d"):format(index - 1), 2)
    t.close(numbers(lines[1]), mean, 1e-7)
    t.close(numbers(lines[2]), {place.x, place.y, place.z}, 1e-6)
    t.equal(#ask(("getContacts 1 1 %d"):format(index - 1), 1 + #contacts), 1 + #contacts)
  end
  t.ok(#world:contacts(hand) > 1)
end)

test("the loop of the manual gives the same result as the calls of a script", function(t)
  local server <close>, world, hand = serve()
  local _, ask = connect(server)
  local copy = world:clone()
  local same = hand:in_world(copy)
  for _ = 1, 20 do
    local dt = ask("moveDynamicBodies 0.001", 1)[1]
    t.close(copy:move_bodies(0.001), tonumber(dt), 1e-12)
    t.equal(ask("setDOFForces 1 0 4 0 1e8 1e8 1e20", 4), {"0", "100000000", "100000000", ("%.9g"):format(hand.effort_ranges[4][2] * 1e9)})
    same.controller = "none"
    same:set_forces {0, 0.1, 0.1, hand.effort_ranges[4][2]}
    t.equal(ask("computeNewVelocities " .. dt, 1), {"0"})
    copy:solve_velocities(tonumber(dt))
  end
  t.equal(world:hash(), copy:hash())
  t.equal(ask("moveDynamicBodies", 1), {("%.9g"):format(world.time_step)})
end)

test("the dialect of version 0.9 is supported", function(t)
  local server <close>, world, hand = serve()
  local client, ask = connect(server)
  local time = world.time
  t.close(tonumber(ask("step dynamics", 1)[1]), world.time - time, 1e-12)
  local modern = ask("getContacts 1 ALL", 1 + #world.bodies)
  modern[#modern + 1] = "done"
  t.equal(ask("get contacts", #modern), modern)
  hand:autograsp()
  local lines = #ask("get contacts 2 1 0", 2 * #world.bodies[1].contacts + 2)
  t.ok(lines > 2)
  hand:open()
  for _, first in ipairs {"setDOFVals 1 0", "setDOFVals 1 0 4", "setDOFVals ALL"} do
    hand:open()
    local values = ask(first .. "\n4\n0.1\n0.2\n0.3\n0\n0.05\n0.05\n0.05\n0.05", 4)
    t.close({tonumber(values[1]), tonumber(values[2]), tonumber(values[3]), tonumber(values[4])}, {0.1, 0.2, 0.3, 0}, 1e-8)
  end
  t.equal(ask("setDOFVals 1 0\n4\n0.1\n0.2\n0.3\n0\n0.05 0.05 0.05\n0.05 7", 1), {"Error: setDOFVals: one word too many: 7"})
  t.equal(ask("setDOFVals 1 0\n3", 1), {"Error: robot has 4 DOF."})
  t.equal(ask("setDOFVals 1 0\ngetRobotName 1 0", 1), {hand.name})
  t.equal(ask("setDOFVals 1 3", 1), {"Error: Cannot find robot 3"})
  t.ok(client:is_open())
end)

test("every wrong line is answered by one error line", function(t)
  local server <close>, world, hand = serve()
  local _, ask = connect(server)
  local before = world:hash()
  for line, reply in pairs {
    ["getDOFVals 1 7"] = "Error: Cannot find robot 7",
    ["getBodyName 2 0 10"] = "Error: Cannot find body 10",
    ["moveDOFs 1 4 0"] = "Error: Robot does not exist.",
    ["moveDOFs 0 5 0"] = "Error: robot has 4 DOF.",
    ["setDOFForces 1 0 3 1 1 1"] = "Error: robot has 4 DOF.",
    ["setDOFForces 2 0 1 4 1 1 1 1"] = "Error: Cannot find robot 1",
    ["moveDOFs 0 4 1 1 1 1 1 1 1"] = "Error: moveDOFs: expected 4 numbers (steps), got 3",
    ["moveDOFs 0 4 nan 1 1 1 1 1 1 1"] = "Error: moveDOFs: expected a number, got nan",
    ["moveDOFs 0 4 0x1 1 1 1 1 1 1 1"] = "Error: moveDOFs: expected a number, got 0x1",
    ["moveDOFs 0 4 1e999 1 1 1 1 1 1 1"] = "Error: moveDOFs: expected a number, got 1e999",
    ["getContacts 4 ALL"] = "Error: getContacts: expected 1 to 3 data items, got 4",
    ["getBodyName 11" .. (" 0"):rep(11)] = "Error: getBodyName: expected at most 10 indices, got 11",
    ["getContacts 3 5000" .. (" 0"):rep(5000)] = "Error: getContacts: expected at most 10 indices, got 5000",
    ["setDOFForces 2 0 0 4 1 1 1 1 4 1 1 1 1"] = "Error: setDOFForces: expected at most 1 indices, got 2",
    ["getContacts 1 999999999999 0"] = "Error: getContacts: expected 999999999999 indices, got 1",
    ["getContacts 1 99999999999999999999"] = "Error: getContacts: expected ALL or the number of indices below 2^63",
    ["getContacts"] = "Error: getContacts: expected the number of data items, 1 to 3, got the end of the line",
    ["getBodyName -1"] = "Error: getBodyName: expected ALL or the number of indices, got -1",
    ["moveDynamicBodies 0"] = "Error: moveDynamicBodies: expected a time > 0 s, got 0",
    ["moveDynamicBodies 1e-9"] = "Error: world:move_bodies: dt: expected a time from 1e-07 to 1000000 s, got 1e-09",
    ["computeNewVelocities -1"] = "Error: computeNewVelocities: expected a time > 0 s, got -1",
    ["getbodyname ALL"] = "Error: there is no command 'getbodyname'",
    ["step"] = "Error: there is no command 'step '",
    ["get lost"] = "Error: there is no command 'get lost'",
    ["\27[2J"] = "Error: there is no command '?[2J'",
    [("x"):rep(1000)] = "Error: there is no command '" .. ("x"):rep(40) .. "...'",
  } do t.equal(ask(line, 1), {reply}) end
  t.equal(world:hash(), before)
  t.equal(ask("render", 0), {})
  t.equal(ask("moveToContacts", 0), {})
  t.equal(ask("\r\n   ", 0), {})
  t.equal(ask("getRobotName 1 0\r", 1), {hand.name})
  local empty <close> = clench.control.server {session = clench.session(), port = 0}
  local _, ask_empty = connect(serve {world = clench.world()})
  t.equal(ask_empty("getBodyName ALL", 1), {"0"})
  t.equal(ask_empty("moveToContacts", 1), {"Error: Robot does not exist."})
  local client = clench.port.connect("127.0.0.1", empty.port)
  client:write "getBodyName ALL\n"
  t.equal(client:read_line(5), "Error: no world is open")
end)

test("clients are served in the order of connection, in turns of one line", function(t)
  local order = {}
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  local session = clench.session(world)
  local server <close> = clench.control.server {session = session, port = 0}
  local clients = {}
  for i = 1, 3 do
    clients[i] = clench.port.connect("127.0.0.1", server.port)
    clients[i]:write "getRobotName 1 0\n"
    clients[i]:read_line(5)
  end
  for i = 3, 1, -1 do clients[i]:write(("moveDOFs 0 4 0.%d 0 0 0 1 1 1 1\n"):format(i):rep(2)) end
  session:subscribe("changed", function() end)
  loop.spawn(function()
    for i = 1, 3 do
      for _ = 1, 2 do order[#order + 1] = {i, clients[i]:read_line(5)} for _ = 1, 3 do clients[i]:read_line(5) end end
    end
  end)
  loop.run(0.5)
  t.equal(#order, 6)
  for _, item in ipairs(order) do t.close(tonumber(item[2]), item[1] / 10, 1e-8) end
  t.close(world.robots[1].dofs[1], 0.3, 1e-12)  -- the last one of the last round
end)

test("a command has at most 65536 bytes", function(t)
  local server <close>, _, hand = serve()
  local _, ask = connect(server)
  t.equal(ask("getRobotName" .. (" "):rep(65000) .. "1 0", 1), {hand.name})
  local long = clench.port.connect("127.0.0.1", server.port)
  long:write("getRobotName" .. (" "):rep(65536) .. "1 0\ngetRobotName 1 0\n")
  t.equal(long:read_line(5), "Error: a line has more than 65536 bytes")
  t.equal({long:read_line(5)}, {nil, "closed"})
  t.equal(ask("getRobotName 1 0", 1), {hand.name})
end)

test("misbehaving clients are dropped, and others continue", function(t)
  local gone = {}
  local server <close>, _, hand = serve {max_clients = 3, max_line = 2000, max_queue = 20000, on_close = function(client) gone[#gone + 1] = client.reason end}
  local _, ask = connect(server)
  t.equal(ask("getRobotName 1 0", 1), {hand.name})
  local page = clench.port.connect("127.0.0.1", server.port)
  page:write "POST / HTTP/1.1\r\nHost: localhost:4765\r\n\r\nmoveDOFs 0 4 1 1 1 1 1 1 1 1\n"
  t.equal({page:read_some(5)}, {nil, "closed"})
  t.close(hand.dofs[1], 0, 0)
  local long = clench.port.connect("127.0.0.1", server.port)
  long:write(("x"):rep(1000000))
  t.equal(long:read_line(5), "Error: a line has more than 2000 bytes")
  local deaf = clench.port.connect("127.0.0.1", server.port)
  loop.spawn(function() deaf:write(("getBodyName ALL\n"):rep(200000), 10) end)
  local last = loop.time() + 20
  while #gone < 3 and loop.time() < last do
    t.equal(ask("getRobotName 1 0", 1), {hand.name})
    loop.sleep(0.01)
  end
  t.equal(gone, {"an HTTP request", "a line was too long", "it does not receive"})
  local others = {}
  for i = 1, 3 do others[i] = clench.port.connect("127.0.0.1", server.port) end
  t.equal(others[3]:read_line(5), "Error: the server has 3 clients and accepts no more")
  -- half a line, and an end of input that still gets its replies
  others[1]:write "getRobot"
  others[1]:close()
  loop.sleep(0.02)
  t.equal(ask("getRobotName 1 0", 1), {hand.name})
  server:close()
  loop.run(1)
  t.equal(#server.clients, 0)
end)

test("options of the server are checked", function(t)
  local world = clench.world()
  t.fails(function() clench.control.server {} end, "clench.control.server: world: expected a world, got nothing")
  t.fails(function() clench.control.server {world = 5} end, "world must be a world, got 5")
  t.fails(function() clench.control.server {session = 5} end, "session must be a session, got 5")
  t.fails(function() clench.control.server {world = world, session = clench.session()} end, "expected either a world or a session, got both")
  t.fails(function() clench.control.server {world = world, port = 70000} end, "port must be a whole number from 0 to 65535, got 70000")
  t.fails(function() clench.control.server {world = world, host = "0.0.0.0", token = false} end, "only a server on loopback may have none")
  t.fails(function() clench.control.server {world = world, token = "short"} end, "expected at least 16 letters and digits")
  t.fails(function() clench.control.server {world = world, hots = "x"} end, "unknown key 'hots'", "did you mean 'host'?")
  local first <close> = clench.control.server {world = world, port = 0}
  t.fails(function() clench.control.server {world = world, port = first.port} end, "Address already in use")
  t.ok(#first.token >= 32)
end)

test("lines that arrive together are all answered before the connection is closed", function(t)
  local server <close>, _, hand = serve()
  local client = connect(server)
  client:write(("getRobotName 1 0\n"):rep(3000) .. "GET / HTTP/1.1\n" .. "getRobotName 1 0\n")
  for _ = 1, 3000 do t.equal(client:read_line(10), hand.name) end
  t.equal({client:read_line(10)}, {nil, "closed"})
end)

test("the units of a robot are those of its joints, also if it takes the name of another", function(t)
  local world = clench.world()
  local server <close> = clench.control.server {world = world, port = 0}
  local _, ask = connect(server)
  local function unit_of_first(path)
    local robot = world:add_robot(path, {name = "hand"})
    local low, high = table.unpack(robot.dof_limits[1])
    local values = robot.dofs
    values[1] = (low + high) / 2
    robot:set_dofs(values)
    local reply = ask("getDOFVals 1 0", 1 + #robot.dofs)
    world:remove(robot)
    return tonumber(reply[2]) / values[1]
  end
  t.close(unit_of_first "models/hands/barrett/barrett.cfg", 1, 1e-8)
  t.close(unit_of_first "models/hands/parallel_jaw/parallel_jaw.cfg", 1000, 1e-5)
  t.close(unit_of_first "models/hands/barrett/barrett.cfg", 1, 1e-8)
end)
