-- A server under load, from other processes: requests per second beside a bare echo of lines in the same process, the cost of states at 500 Hz, and how long a
-- client waits among 64, and beside others that send the worst requests of each kind.
--   clench -q run tests/bench/serve.lua [--seconds S] [--check] [--csv FILE]    S: duration of a measurement
local clench = require "clench"
local requests = dofile "tests/bench/serve_requests.lua"
local loop = clench.loop

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

-- --- other processes ---

local function first_line(command)
  local pipe <close> = io.popen(command)
  return pipe:read "l"
end

local program = first_line "readlink /proc/$PPID/exe"

local Process = {}
Process.__index = Process
Process.__close = function(self)
  os.execute("kill " .. self.number)
  self.pipe:close()
end

-- a script that runs until it is closed, and the first line that it prints
local function start(script, ...)
  local pipe = io.popen(("echo $$; exec '%s' -q run tests/bench/%s %s 2>/dev/null"):format(program, script, table.concat({...}, " ")))
  local number, line = pipe:read("l", "l")
  return setmetatable({pipe = pipe, number = number}, Process), line
end

-- processor time that the main thread of a process has used [s]
function Process:time()
  local file <close> = io.open(("/proc/%s/schedstat"):format(self.number))
  return file:read "n" / 1e9
end

local function start_server(hertz)
  local process, line = start("served.lua", hertz)
  local port, echo, http, token = line:match "(%d+)%s+(%d+)%s+(%d+)%s+(%w+)"
  process.port, process.echo, process.http, process.token = tonumber(port), tonumber(echo), http ~= "0" and tonumber(http), token
  return process
end

-- --- the table ---

local rows, missed = {}, {}

local function add(name, value, unit, aim, is_most)
  local is_missed = aim and (is_most and value >= aim or not is_most and value < aim)
  rows[#rows + 1] = {question = name, value = value, unit = unit, aim = aim or ""}
  if is_missed then missed[#missed + 1] = name end
  print(("%-64s %8.4g %-4s%s"):format(name, value, unit, aim and (" aim: %s %.3g%s"):format(is_most and "below" or "at least", aim, is_missed and "  MISSED" or "") or ""))
end

local function median(list)
  table.sort(list)
  return list[(#list + 1) // 2]
end

-- --- requests per second ---

local function lines_in(bytes) return select(2, bytes:gsub("\n", "")) end

-- sends a request again and again, with `depth` of them under way, for some time: rate [1/s], processor time of a request [s]
local function rate_of(server, port, case, reply_lines, depth)
  local began, used = loop.time(), server:time()
  local last, sent, received = began + seconds, 0, 0
  repeat
    local open = sent - received // reply_lines
    if open <= depth // 2 and loop.time() < last then
      port:write(case.line:rep(depth - open))
      sent = sent + depth - open
    end
    received = received + lines_in(port:read_some(10))
  until received == sent * reply_lines and loop.time() >= last
  return sent / (loop.time() - began), (server:time() - used) / sent
end

-- a request beside the same line that is sent back, in turn
local function compare(server, case, depth)
  local echo <close> = requests.connect(server.echo)
  local port <close> = requests.connect(server.port, case.rpc and server.token)
  local rates, ratios, costs, echo_costs = {}, {}, {}, {}
  for i = 1, 5 do
    local echo_rate
    echo_rate, echo_costs[i] = rate_of(server, echo, case, 1, depth)
    rates[i], costs[i] = rate_of(server, port, case, case.lines, depth)
    ratios[i] = rates[i] / echo_rate
  end
  local name = ("%s, %s"):format(case.name, depth == 1 and "one at a time" or depth .. " at a time")
  add(name, median(rates), "1/s")
  add(name .. ", processor time", 1e6 * median(costs), "us")
  add(name .. ", rate / rate of echo", median(ratios), "", 1 / 3)
  add(name .. ", processor time of echo / processor time", median(echo_costs) / median(costs), "")
end

-- --- states at 500 Hz ---

local hertz, subscribers = 500, 8

local function measure_states()
  local server <close> = start_server(hertz)
  local before = server:time()
  loop.sleep(4 * seconds)
  local alone, count, ports = server:time() - before, 0, {}
  for i = 1, subscribers do
    local port = requests.connect(server.port, server.token)
    port:write(requests.request("subscribe_state", {rate = hertz}))
    port:read_line(10)
    ports[i] = port
    loop.spawn(function()
      while true do
        local some = port:read_some()
        if not some then return end
        count = count + lines_in(some)
      end
    end)
  end
  count, before = 0, server:time()
  local began = loop.time()
  loop.sleep(4 * seconds)
  local took, used, sent = loop.time() - began, server:time() - before, count
  for _, port in ipairs(ports) do port:close() end
  local rate = sent / took / subscribers
  add(("states per client, %d clients at %d Hz"):format(subscribers, hertz), rate, "1/s", 0.9 * hertz)
  -- fewer are sent while other programs use the cores: the time of one, for all that were asked for
  add("their processor time at this rate, of a core", 100 * (used - alone * took / (4 * seconds)) / sent * hertz * subscribers, "%", 10, true)
end

-- --- waits among 64 clients ---

local clients = 64

-- the longest wait for an answer while all others send requests, and the longest time for which the server was busy meanwhile
local function longest_wait(server)
  local load <close>, ready = start("serve_load.lua", server.port, server.token, clients - 1)
  assert(ready == "ready")
  local worst, busiest, last, ports = 0, 0, loop.time() + 4 * seconds, {}
  for i, case in ipairs(requests.small) do ports[i] = requests.connect(server.port, case.rpc and server.token) end
  while loop.time() < last do
    for i, case in ipairs(requests.small) do
      local asked, used = loop.time(), server:time()
      ports[i]:write(case.line)
      for _ = 1, case.lines do ports[i]:read_line(10) end
      worst, busiest = math.max(worst, loop.time() - asked), math.max(busiest, server:time() - used)
    end
  end
  for _, port in ipairs(ports) do port:close() end
  return worst, busiest
end

local function measure_waits(server)
  local waits, times = {}, {}
  for i = 1, 3 do waits[i], times[i] = longest_wait(server) end
  add(("longest wait of a client among %d, median of three runs"):format(clients), 1e3 * median(waits), "ms", 50, true)
  add("longest processor time of the server during a wait", 1e3 * median(times), "ms")
end

-- waits beside the worst requests of each kind
local function measure_worst(server)
  local worst, busiest = 0, 0
  dofile "tests/bench/serve_worst.lua"(server, 2 * seconds, function(name, wait, busy)
    add(("wait beside 7 clients that send %s"):format(name), 1e3 * wait, "ms")
    add("  processor time of the server meanwhile", 1e3 * busy, "ms")
    worst, busiest = math.max(worst, wait), math.max(busiest, busy)
  end)
  add("longest wait beside others' worst requests", 1e3 * worst, "ms")
  add("longest processor time of the server during such a wait", 1e3 * busiest, "ms", 50, true)
end

do
  local server <close> = start_server()
  for _, depth in ipairs {1, 100} do
    for _, case in ipairs(requests.small) do compare(server, case, depth) end
  end
end
do
  local server <close> = start_server()
  measure_waits(server)
  measure_worst(server)
end
measure_states()

if csv then clench.csv.write(csv, rows, {columns = {"question", "value", "unit", "aim"}}) end
if check and #missed > 0 then
  print("FAILED: " .. table.concat(missed, "; "))
  os.exit(1)
end
