-- `clench mcp`: transcripts of clients of the Model Context Protocol, tools from signatures, and lines that make no sense.
local test, clench = require "test", require "clench"
local json = clench.json

local function run(command)
  local pipe = assert(io.popen(command .. " 2>&1"))
  local text = pipe:read "a"
  return pipe:close() == true, text
end

local program = select(2, run "readlink /proc/$PPID/exe"):gsub("%s+$", "")

-- `clench mcp` in the background, between two pipes
local function start(options)
  local folder = test.path()
  os.remove(folder)
  assert(os.execute(("mkdir -p '%s' && mkfifo '%s/in' '%s/out'"):format(folder, folder, folder)))
  os.execute(("'%s' -q mcp worlds/barrett_mug.wld --root . %s < '%s/in' > '%s/out' &"):format(program, options or "", folder, folder))
  local client = {input = assert(io.open(folder .. "/in", "w")), output = assert(io.open(folder .. "/out")), id = 0}
  client.input:setvbuf "no"
  function client.receive()
    local line = client.output:read "l"
    return line and json.decode(line)
  end
  -- the response to a request; notifications that come before it are kept
  function client.call(method, params)
    client.id, client.notes = client.id + 1, {}
    client.input:write(json.encode {jsonrpc = "2.0", id = client.id, method = method, params = params}, "\n")
    while true do
      local message = assert(client.receive(), "the server has ended")
      if message.id == client.id then return message end
      client.notes[#client.notes + 1] = message
    end
  end
  function client.tool(name, arguments, meta)
    local response = client.call("tools/call", {name = name, arguments = arguments, _meta = meta})
    if response.error then return nil, response.error end
    local result = response.result
    if result.isError then return nil, {message = result.content[1].text} end
    return json.decode(result.content[1].text)
  end
  return setmetatable(client, {__close = function()
    client.input:close()
    client.ended = client.output:read "a"
    client.output:close()
    os.execute(("rm -r '%s'"):format(folder))
  end})
end

local function opened(options)
  local client = start(options)
  assert(client.call("initialize", {protocolVersion = "2025-06-18", capabilities = {}, clientInfo = {name = "test", version = "1"}}).result)
  client.input:write '{"jsonrpc":"2.0","method":"notifications/initialized"}\n'
  return client
end

local function by_name(list)
  local named = {}
  for _, one in ipairs(list) do named[one.name] = one end
  return named
end

test("a transcript of a client is answered as the protocol says", function(t)
  local client <close> = start()
  t.equal(client.call("tools/list").error.code, -32600)
  t.equal(client.call("ping").result, {})
  local opening = client.call("initialize", {protocolVersion = "2025-03-26", capabilities = {}, clientInfo = {name = "test", version = "1"}}).result
  t.equal({opening.protocolVersion, opening.serverInfo.name, opening.serverInfo.version}, {"2025-03-26", "clench", clench.version})
  t.equal(opening.capabilities, {tools = {}})
  client.input:write '{"jsonrpc":"2.0","method":"notifications/initialized"}\n{"jsonrpc":"2.0","method":"notifications/of_a_later_revision"}\n'
  local tools = client.call("tools/list").result.tools
  for _, tool in ipairs(tools) do
    t.ok(tool.name:find "^[%w_-]+$" and #tool.name <= 64, tool.name)
    t.equal({tool.inputSchema.type, tool.annotations.readOnlyHint}, {"object", true}, tool.name)
  end
  local got = client.call("tools/call", {name = "get", arguments = {of = "barrett", fields = {"dofs"}}}).result
  t.equal({got.isError, got.content[1].type}, {false, "text"})
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  t.equal(json.decode(got.content[1].text).dofs, world.robots[1].dofs)
  t.equal(client.call("resources/list").error.code, -32601)
end)

test("a revision that is not supported is answered by the newest that begins with initialize", function(t)
  local client <close> = start()
  for asked, answered in pairs {["2024-11-05"] = "2024-11-05", ["2025-11-25"] = "2025-11-25", ["1.0"] = "2025-11-25", ["2026-07-28"] = "2025-11-25"} do
    t.equal(client.call("initialize", {protocolVersion = asked}).result.protocolVersion, answered)
  end
  t.equal(client.call("initialize", {}).error.code, -32602)
end)

test("requests that name their revision need no initialize", function(t)
  local client <close> = start()
  local function meta(version) return {["io.modelcontextprotocol/protocolVersion"] = version, ["io.modelcontextprotocol/clientCapabilities"] = {}} end
  local found = client.call("server/discover", {_meta = meta "2026-07-28"}).result
  t.equal({found.resultType, found.supportedVersions[1], found.cacheScope}, {"complete", "2026-07-28", "private"})
  t.equal(found._meta["io.modelcontextprotocol/serverInfo"].name, "clench")
  local listed = client.call("tools/list", {_meta = meta "2026-07-28"}).result
  t.equal({listed.resultType, listed.ttlMs}, {"complete", 0})
  t.ok(#listed.tools > 10)
  t.equal(client.call("tools/call", {name = "world-hash", _meta = meta "2026-07-28"}).result.resultType, "complete")
  local refused = client.call("tools/list", {_meta = meta "1999-01-01"}).error
  t.equal({refused.code, refused.data.requested, refused.data.supported[1]}, {-32022, "1999-01-01", "2026-07-28"})
  t.equal(client.call("tools/list").error.code, -32600)
end)

test("schemas of tools are made from signatures", function(t)
  local client <close> = opened "--control"
  local tools = by_name(client.call("tools/list").result.tools)
  local run_tool = tools["dynamics-run"].inputSchema
  t.equal(run_tool.properties.seconds, {type = "number", minimum = 0, maximum = 1e6, default = 1, description = "simulated time [s]"})
  t.equal(run_tool.required, nil)
  local move = tools["body-move"].inputSchema
  t.equal(move.required, {"body", "pose"})
  t.equal({move.properties.body.type, move.properties.pose.properties.xyz.maxItems, move.additionalProperties}, {"string", 3, false})
  t.equal(#tools["planner-anneal"].inputSchema.properties.position.enum, 5)
  t.equal(tools["body-move"].annotations, {readOnlyHint = false, destructiveHint = false, openWorldHint = false})
  for _, name in ipairs {"hello", "describe", "subscribe", "unsubscribe", "control-apply"} do t.equal(tools[name], nil) end
end)

test("without --control, no tool changes the world or the session", function(t)
  local client <close> = opened()
  local before, info = client.tool "world-hash", client.tool "session-info"
  for _, name in ipairs {"grasp-autograsp", "body-mass", "edit-undo", "edit-redo", "session-undo", "dynamics-play", "dynamics-run", "step", "world-save", "file-convert", "world-select",
                         "grasp-save_posture", "planner-sample"} do
    local _, problem = client.tool(name, {})
    t.equal({problem.code, problem.message:match "%-%-control$"}, {-32602, "--control"}, name)
  end
  local arguments = {get = {fields = {"time"}}, read = {items = {}}, ["body-distance"] = {a = "barrett", b = "mug"}, ["world-distance"] = {a = "barrett", b = "mug"},
                     ["world-raycast"] = {origin = {0, 0, 1}, direction = {0, 0, -1}}, ["world-average_contacts"] = {links = {"mug"}}, ["robot-jacobian"] = {link = "barrett/chain0_link2"},
                     ["robot-ik"] = {link = "barrett/chain0_link2", pose = {xyz = {0, 0, 0}}}, ["plan-start"] = {planner = "sample", options = {count = 1}}}
  for _, tool in ipairs(client.call("tools/list").result.tools) do
    local response = client.call("tools/call", {name = tool.name, arguments = arguments[tool.name] or tool.name:find "^job%-" and {job = 1} or nil})
    t.ok(response.result, tool.name)
  end
  t.equal(client.tool "world-hash", before)
  t.equal(client.tool "session-info", info)
end)

test("with --control, tools act as calls of a script, and can be undone", function(t)
  local client <close> = opened "--control"
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  local before = client.tool "world-hash"
  t.equal(client.tool("grasp-autograsp", {}).moved, true)
  world.robots[1]:autograsp()
  t.equal(client.tool "world-hash", world:hash())
  t.equal(client.tool "session-undo", "Auto Grasp")
  t.equal(client.tool "world-hash", before)
  -- failures are results that a model can read
  local _, problem = client.tool("body-mass", {body = "mgu", mass = 1})
  t.equal({problem.code, problem.message}, {nil, "session: there is no body or robot 'mgu'; did you mean 'mug'?"})
  _, problem = client.tool("body-mass", {mass = -1})
  t.ok(problem.code == nil and problem.message:find("expected a number >= 0 kg, got -1", 1, true), problem.message)
  _, problem = client.tool("world-save", {path = "x.wld"})
  t.ok(problem.message:find "reads and writes no files", problem.message)
  t.equal(client.call("tools/call", {name = "get", arguments = 5}).result.isError, true)
  t.equal(client.call("tools/call", {arguments = {}}).error.code, -32602)
  _, problem = client.tool("grasp.autograsp", {})
  t.equal(problem.code, -32602)
  _, problem = client.tool("grasp-autograps", {})
  t.ok(problem.message:find("did you mean 'grasp-autograsp'?", 1, true), problem.message)
end)

test("a long tool runs beside others, reports its progress, and is cancelled without an answer", function(t)
  local client <close> = opened "--control"
  client.input:write '{"jsonrpc":"2.0","id":"long","method":"tools/call","params":{"name":"dynamics-run","arguments":{"seconds":100000}}}\n'
  local before = client.tool "world-hash"
  client.input:write '{"jsonrpc":"2.0","method":"notifications/cancelled","params":{"requestId":"long","reason":"enough"}}\n'
  local last, state = os.time() + 20, nil
  repeat state = client.tool("job-state", {job = 1}).state until state == "stopped" or os.time() > last
  t.equal(state, "stopped")
  t.equal(client.notes, {})
  t.equal(client.tool "world-hash", before)
  -- two requests with one id, of which the last is cancelled: the other one is still answered
  for _ = 1, 2 do client.input:write '{"jsonrpc":"2.0","id":"twice","method":"tools/call","params":{"name":"dynamics-run","arguments":{"seconds":100000}}}\n' end
  client.tool "world-hash"
  client.input:write '{"jsonrpc":"2.0","method":"notifications/cancelled","params":{"requestId":"twice"}}\n'
  client.tool("job-stop", {job = 2})
  local answer = client.notes[1] or client.receive()
  t.equal({answer.id, answer.result.isError}, {"twice", true})
  t.equal(client.tool("dynamics-step", {count = 20}).applied, true)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  for _ = 1, 20 do world:run(world.time_step) end
  t.equal(client.tool "world-hash", world:hash())
  t.equal(client.tool "session-undo", "Apply a result")
end)

test("1000 malformed lines are answered, or are notifications", function(t)
  local client <close> = opened "--control"
  local random = clench.random(4)
  local good = {'{"jsonrpc":"2.0","id":7,"method":"tools/call","params":{"name":"get","arguments":{"of":"mug","fields":["pose"]}}}', '{"jsonrpc":"2.0","id":7,"method":"tools/list"}',
                '{"jsonrpc":"2.0","id":7,"method":"initialize","params":{"protocolVersion":"2025-06-18","capabilities":{}}}', '{"jsonrpc":"2.0","id":7,"method":"ping"}',
                '{"jsonrpc":"2.0","id":7,"method":"tools/call","params":{"name":"body-mass","arguments":{"body":"mug","mass":0.3},"_meta":{"progressToken":1}}}',
                '{"jsonrpc":"2.0","method":"notifications/cancelled","params":{"requestId":7}}',
                '{"jsonrpc":"2.0","id":7,"method":"server/discover","params":{"_meta":{"io.modelcontextprotocol/protocolVersion":"2026-07-28"}}}'}
  local answers, codes = 0, {}
  for i = 1, 1000 do
    local line = good[random:integer(1, #good)]
    for _ = 1, random:integer(1, 4) do
      local at = random:integer(1, #line)
      local byte = string.char(random:integer(0, 255)):gsub("\n", " ")
      local kind = random:integer(1, 3)
      line = line:sub(1, at - 1) .. (kind == 1 and "" or byte) .. line:sub(kind == 3 and at or at + 1)
    end
    client.input:write(line, '\n{"jsonrpc":"2.0","id":"mark","method":"ping"}\n')
    while true do
      local message = client.receive()
      t.ok(message, ("line %d ended the server: %q"):format(i, line))
      if message.id == "mark" then break end
      answers = answers + 1
      if message.error then
        codes[message.error.code] = true
        t.ok(message.error.code ~= -32603, message.error.message)
      end
    end
  end
  t.ok(answers > 500, answers)
  t.ok(codes[-32700] and codes[-32601] and codes[-32602])
end)

test("clench mcp ends with its input, and its mistakes are named", function(t)
  local ok, text = run(("printf '' | '%s' mcp worlds/barrett_mug.wld --root ."):format(program))
  t.equal({ok, text}, {true, ""})
  ok, text = run(("'%s' mcp no_such.wld </dev/null"):format(program))
  t.ok(not ok and text:find("clench mcp: ", 1, true) and text:find("no such file", 1, true), text)
  ok, text = run(("'%s' mcp </dev/null"):format(program))
  t.ok(not ok and text:find("clench mcp: WORLD is required", 1, true), text)
  t.fails(function() clench.control.server {world = clench.world(), port = 0, mcp = "read"} end, "mcp: requires stdio")
  t.fails(function() clench.control.server {world = clench.world(), stdio = true, mcp = "write"} end, "mcp must be 'read' or 'control'")
end)
