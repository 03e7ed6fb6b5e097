-- How long short requests wait while seven other clients send the worst requests of a kind without pause; for tests/bench/serve.lua.
local clench = require "clench"
local requests = dofile "tests/bench/serve_requests.lua"
local web_client = dofile "tests/lua/web_client.lua"
local loop = clench.loop

local attackers = 7
local size = (1 << 20) - 300  -- of the longest lines [bytes]

local function filled(item) return "[" .. (item .. ","):rep(size // (#item + 1) - 1) .. item .. "]" end

local function repeated(item, count)
  local list = {}
  for i = 1, count do list[i] = item end
  return list
end

local function get(fields) return ('{"jsonrpc":"2.0","id":1,"method":"get","params":{"fields":%s}}\n'):format(fields) end

local function batch(one, count) return clench.json.encode(repeated(one, count)) .. "\n" end

local read = {jsonrpc = "2.0", id = 1, method = "read", params = {items = repeated({of = "barrett", fields = {"dofs", "pose", "dof_limits"}}, 300)}}
local state = {jsonrpc = "2.0", id = 1, method = "world.state"}

local function everything()
  local list = {}
  for _, event in ipairs {"contact", "contact_lost", "limit", "changed", "diagnostic", "result"} do
    for _ = 1, 4 do list[#list + 1] = requests.request("subscribe", {event = event}) end
  end
  for i = 1, 8 do list[#list + 1] = requests.request("subscribe_state", {rate = 1000 - 100 * i, poses = true, contacts = true}) end
  return table.concat(list)
end

local function random_bytes(count)
  local random, bytes = clench.random(1), {}
  for i = 1, count do bytes[i] = string.char(random:integer(0, 255)) end
  return table.concat(bytes)
end

-- Lines that one client sends again and again. is_text: without hello; rest: the client reconnects each time
local lines = {
  {name = "lines of 1 MB: numbers", bytes = get(filled "1")},
  {name = "lines of 1 MB: empty lists", bytes = get(filled "[]")},
  {name = "lines of 1 MB: nested lists", bytes = get(filled(("["):rep(80) .. ("]"):rep(80)))},
  {name = "lines of 1 MB: objects", bytes = get(filled '{"a":1}')},
  {name = "lines of 1 MB: one string", bytes = get('["' .. ("x"):rep(size) .. '"]')},
  {name = "lines of 1 MB: blanks and a null id", bytes = '{"id":null,"a":' .. (" "):rep(size) .. "1}\n"},
  {name = "batches of 1 MB", bytes = "[" .. ('{"jsonrpc":"2.0","id":null,"method":"get","params":{"fields":[1,1]}},'):rep(990) .. "1]\n"},
  {name = "batches of 1000 states", bytes = batch(state, 1000)},
  {name = "batches of 200 reads of 900 fields", bytes = batch(read, 50)},
  {name = "reads of 900 fields", bytes = clench.json.encode(read) .. "\n"},
  {name = "describe", bytes = requests.request "describe" .. requests.request "hello"},
  {name = "subscriptions to everything", bytes = everything(), once = requests.request("step", {dt = 0.005, state = false})},
  {name = "text: lines of 60 KB", bytes = "getContacts 3 25000 " .. ("0 "):rep(25000) .. "\n", is_text = true},
  {name = "text: getContacts ALL", bytes = "getContacts 3 ALL\n", is_text = true},
  {name = "binary data", bytes = random_bytes(1 << 18) .. "\n", is_text = true},
}

-- sends without waiting for answers, which are discarded
local function flood(connect, bytes, is_over, once)
  loop.spawn(function()
    while not is_over() do
      local port <close> = connect()
      local reader = loop.spawn(function() while port:read_some() do end end)
      repeat
        if not port:write(bytes, 5) then break end
        bytes = once or bytes
        loop.sleep(0.002)
      until is_over() or not port:is_open()
      reader:remove()
    end
  end)
end

local function web_cases(server)
  local function shake() return (web_client.open(server.http, "/socket?token=" .. server.token)) end
  local hello = web_client.frame(1, requests.request("hello", {token = server.token}))
  local parts = {web_client.frame(1, "{", {last = false})}
  for i = 2, 900 do parts[i] = web_client.frame(0, (" "):rep(1000), {last = false}) end
  parts[901] = web_client.frame(0, "}")
  local head = "GET /?token=" .. server.token .. " HTTP/1.1\r\nHost: 127.0.0.1\r\n"
  local function plain() return clench.port.connect("127.0.0.1", server.http) end
  return {
    {name = "WebSocket: frames of 1 MB", connect = shake, bytes = hello .. web_client.frame(1, get(filled "[]"):sub(1, -2))},
    {name = "WebSocket: messages of 900 fragments", connect = shake, bytes = table.concat(parts)},
    {name = "WebSocket: pings", connect = shake, bytes = web_client.frame(9, ("x"):rep(125)):rep(500)},
    {name = "HTTP: blanks in a field", connect = plain, bytes = head .. "A: x" .. (" "):rep(15000) .. "x\r\n\r\n"},
    {name = "HTTP: a long query", connect = plain, bytes = "GET /?" .. ("a"):rep(16000) .. " HTTP/1.1\r\nHost: a\r\n\r\n"},
    {name = "HTTP: requests without an end", connect = plain, bytes = head .. ("A: b\r\n"):rep(50)},
  }
end

-- the longest wait of short requests, and the longest processor time of the server during one [s]
local function worst_of(server, case, seconds)
  local over = false
  local connect = case.connect or function() return requests.connect(server.port, not case.is_text and server.token) end
  for _ = 1, attackers do flood(connect, case.bytes, function() return over end, case.once) end
  local ports, worst, busiest, count = {}, 0, 0, 0
  for i, small in ipairs(requests.small) do ports[i] = requests.connect(server.port, small.rpc and server.token) end
  local last = loop.time() + seconds
  repeat
    for i, small in ipairs(requests.small) do
      local asked, used = loop.time(), server:time()
      ports[i]:write(small.line)
      for _ = 1, small.lines do assert(ports[i]:read_line(30)) end
      worst, busiest, count = math.max(worst, loop.time() - asked), math.max(busiest, server:time() - used), count + 1
    end
  until loop.time() > last
  over = true
  for _, port in ipairs(ports) do port:close() end
  loop.sleep(0.1)
  return worst, busiest, count
end

--- Calls visit(name, longest wait, longest processor time of the server, number of short requests) for each kind of worst requests.
return function(server, seconds, visit)
  local cases = table.move(lines, 1, #lines, 1, {})
  if server.http then
    for _, case in ipairs(web_cases(server)) do cases[#cases + 1] = case end
  end
  for _, case in ipairs(cases) do visit(case.name, worst_of(server, case, seconds)) end
end
