-- A server under load, from another process: requests per second beside a bare echo of lines in the same process, the cost of states at 500 Hz, and how long a
-- client waits among 64.
--   clench -q run tests/bench/serve.lua [--seconds S] [--check] [--csv FILE]    S: duration of a measurement
local clench = require "clench"
local json, loop = clench.json, clench.loop

local seconds, check, csv = 0.5, false, nil
do
  local i = 1
  while arg[i] do
    if arg[i] == "--seconds" then i = i + 1; seconds = tonumber(arg[i])
    elseif arg[i] == "--check" then check = true
    elseif arg[i] == "--csv" then i = i + 1; csv = arg[i]
    else error("usage: serve.lua [--seconds S] [--check] [--csv FILE], got " .. arg[i]) end
    i = i + 1
  end
end

local function output(command)
  local pipe <close> = io.popen(command)
  return pipe:read "l"
end

local program = output "readlink /proc/$PPID/exe"

-- --- the measured process ---

local Served = {}
Served.__index = Served
Served.__close = function(self)
  os.execute("kill " .. self.process)
  self.pipe:close()
end

local function start(options)
  local self = setmetatable({pipe = io.popen(("exec '%s' -q run tests/bench/served.lua %s"):format(program, options or ""))}, Served)
  self.process, self.port, self.echo, self.token = self.pipe:read("n", "n", "n", "l")
  self.token = self.token:match "%w+"
  return self
end

-- processor time that it has used [s]
function Served:time()
  local file <close> = io.open(("/proc/%d/stat"):format(self.process))
  local fields = file:read "a":match "%) (.*)"
  local user, system = fields:match("^" .. ("%S+ "):rep(11) .. "(%d+) (%d+)")
  return (tonumber(user) + tonumber(system)) / 100
end

local function request(method, params) return json.encode {jsonrpc = "2.0", id = 1, method = method, params = params} .. "\n" end

-- a client; of JSON-RPC after hello
function Served:connect(options)
  local port = clench.port.connect("127.0.0.1", self.port)
  if options.rpc then
    port:write(request("hello", {token = self.token}))
    assert(port:read_line(10):find "result")
  end
  return port
end

-- --- requests per second ---

local function lines_in(bytes) return select(2, bytes:gsub("\n", "")) end

-- sends a request again and again, with `depth` of them under way, for some time: rate [1/s], processor time of a request [s]
local function rate_of(served, port, line, reply_lines, depth)
  local began, used = loop.time(), served:time()
  local last, sent, received = began + seconds, 0, 0
  repeat
    local open = sent - received // reply_lines
    if open < depth and loop.time() < last then
      port:write(line:rep(depth - open))
      sent = sent + depth - open
    end
    received = received + lines_in(port:read_some(10))
  until received == sent * reply_lines and loop.time() >= last
  return sent / (loop.time() - began), (served:time() - used) / sent
end

local function median(list)
  table.sort(list)
  return list[(#list + 1) // 2]
end

local rows, failures = {}, {}

local function add(name, value, unit, aim, is_most)
  local is_missed = aim and (is_most and value >= aim or not is_most and value < aim)
  rows[#rows + 1] = {question = name, value = value, unit = unit, aim = aim or ""}
  if is_missed then failures[#failures + 1] = name end
  print(("%-62s %10.4g %-6s %s"):format(name, value, unit, aim and ("aim: %s %g%s"):format(is_most and "below" or "at least", aim, is_missed and "  MISSED" or "") or ""))
end

local small = {
  {name = "getRobotName", line = "getRobotName 1 0\n", lines = 1},
  {name = "getDOFVals", line = "getDOFVals 1 0\n", lines = 5},
  {name = "get dofs", rpc = true, line = request("get", {of = "barrett", fields = {"dofs"}}), lines = 1},
  {name = "world.hash", rpc = true, line = request "world.hash", lines = 1},
}

local function compare_rates(served)
  for _, depth in ipairs {1, 100} do
    for _, case in ipairs(small) do
      local echo <close> = clench.port.connect("127.0.0.1", served.echo)
      local port <close> = served:connect(case)
      local ratios, rates, echoes = {}, {}, {}
      for i = 1, 5 do
        echoes[i] = rate_of(served, echo, case.line, 1, depth)
        rates[i] = rate_of(served, port, case.line, case.lines, depth)
        ratios[i] = rates[i] / echoes[i]
      end
      local name = ("%s, %s"):format(case.name, depth == 1 and "one at a time" or depth .. " at a time")
      add(name, median(rates), "1/s")
      add(name .. ", ratio to echo", median(ratios), "", 1 / 3)
    end
  end
end

-- --- states at 500 Hz ---

local hertz, subscribers = 500, 8

local function measure_states()
  local served <close> = start(hertz)
  local before = served:time()
  loop.sleep(4 * seconds)
  local alone = served:time() - before
  local bytes, ports = 0, {}
  for i = 1, subscribers do
    local port = served:connect {rpc = true}
    port:write(request("subscribe_state", {rate = hertz}))
    port:read_line(10)
    ports[i] = port
    loop.spawn(function()
      while true do
        local some = port:read_some()
        if not some then return end
        bytes = bytes + lines_in(some)
      end
    end)
  end
  bytes, before = 0, served:time()
  local began = loop.time()
  loop.sleep(4 * seconds)
  local took, used = loop.time() - began, served:time() - before
  local count = bytes
  for _, port in ipairs(ports) do port:close() end
  add(("states per second and client, %d clients at %d Hz"):format(subscribers, hertz), count / took / subscribers, "1/s", 0.9 * hertz)
  add("processor time of these", 100 * (used - alone) / took, "%", 10, true)
end

-- --- waits among 64 clients ---

local clients = 64

-- the longest wait for an answer, while all others send requests, too: half of them one at a time, the others without waiting
local function longest_wait(served)
  local last, worst, count, tasks = loop.time() + 4 * seconds, 0, 0, {}
  for i = 1, clients do
    local case = small[i % #small + 1]
    local port = served:connect(case)
    tasks[i] = loop.spawn(function()
      while loop.time() < last do
        local asked, repeated = loop.time(), i % 2 == 0 and 20 or 1
        port:write(case.line:rep(repeated))
        for _ = 1, repeated * case.lines do port:read_line(10) end
        if repeated == 1 then worst, count = math.max(worst, loop.time() - asked), count + 1 end
      end
      port:close()
    end)
  end
  repeat loop.sleep(0.02) until not (function() for _, task in ipairs(tasks) do if task.status ~= "done" then return true end end end)()
  return worst, count
end

local function measure_waits(served)
  local waits = {}
  for i = 1, 3 do waits[i] = 1e3 * longest_wait(served) end
  add(("longest wait of a client among %d, median of three runs"):format(clients), median(waits), "ms", 50, true)
end

do
  local served <close> = start()
  compare_rates(served)
  measure_waits(served)
end
measure_states()

if csv then clench.csv.write(csv, rows, {columns = {"question", "value", "unit", "aim"}}) end
if check and #failures > 0 then
  print("FAILED: " .. table.concat(failures, "; "))
  os.exit(1)
end
