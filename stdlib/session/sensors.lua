--- Devices of a session: a glove, a tracker and a real hand. A coroutine of `clench.loop` serves each of them and keeps its last reading, which
--- commands and frames use: none of them waits for a serial line.
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local raise = require "clench.raise"
local sensors = {}

local timeout = 1  -- for an answer; the loop may be late while a frame is drawn [s]

-- baud: of the line; open(port): returns the driver; prepare(driver): before the first reading; read(driver); period: between readings [s]
local kinds = {
  glove = {baud = 38400, period = 0.02, open = function(port) return clench.devices.cyberglove {port = port, timeout = timeout} end,
           prepare = function(glove) if not glove:is_ready() then raise "the glove is not ready" end end,
           read = function(glove) return glove:read() end},
  tracker = {baud = 115200, period = 0.02, open = function(port) return clench.devices.flock {port = port, timeout = timeout} end,
             prepare = function() end, read = function(flock) return flock:read()[1] end},
  hand = {baud = 9600, period = 0.1, open = function(port) return clench.devices.barrett {port = port, timeout = timeout} end,
          prepare = function(hand) hand:initialize() end, read = function(hand) return hand:read() end},
}
local report_interval = 0.1  -- between two events of readings [s]
local names = {glove = "the glove", tracker = "the tracker", hand = "the real hand"}

local function notify(session, sensor)
  sensor.reported = clench.loop.time()
  session:emit("progress", {command = "sensors.connect_" .. sensor.kind, sensor = sensor})
end

-- keeps the problem, which becomes a diagnostic
local function report(session, sensor, problem)
  if is_stopped(problem) then error(problem, 0) end
  sensor.problem = error_text(problem)
  session:emit("diagnostic", {severity = "error", text = ("%s: %s"):format(names[sensor.kind], sensor.problem), count = 1})
  notify(session, sensor)
end

-- one turn of a task, which returns true once it is done; if it fails, the device remains connected
local function advance(session, sensor)
  local task = sensor.task
  local ok, done = pcall(task, sensor.device)
  if not ok then report(session, sensor, done) end
  if (done or not ok) and sensor.task == task then sensor.task = nil end
end

local function serve(session, sensor, kind)
  sensor.device = kind.open(sensor.port)
  kind.prepare(sensor.device)
  while not sensor.is_closed do
    sensor.reading, sensor.state, sensor.count = kind.read(sensor.device), "connected", sensor.count + 1
    if clench.loop.time() > sensor.reported + report_interval then notify(session, sensor) end
    if sensor.task then advance(session, sensor) end
    clench.loop.sleep(sensor.task and 0.02 or kind.period)
  end
end

--- Connects a device, instead of the one of its kind. It is served while `clench.loop` runs.
---@param kind "glove"|"tracker"|"hand"
---@param path string  of its serial line
---@param baud? integer
function sensors.connect(session, kind, path, baud)
  local port = clench.port.serial {path = path, baud = baud or kinds[kind].baud}
  sensors.disconnect(session, kind)
  local sensor = {kind = kind, path = path, port = port, state = "connecting", count = 0, reported = -math.huge}
  session.sensors[kind] = sensor
  clench.loop.spawn(function()
    local ok, problem = pcall(serve, session, sensor, kinds[kind])
    if ok or sensor.is_closed then return end
    sensor.state, sensor.reading, sensor.task = "lost", nil, nil
    port:close()
    report(session, sensor, problem)
  end)
end

--- Disconnects a device; a real hand is stopped. Without such a device, nothing happens.
function sensors.disconnect(session, kind)
  local sensor = session.sensors[kind]
  if not sensor then return end
  session.sensors[kind], sensor.is_closed = nil, true
  if sensor.device then sensor.device:close() end
  sensor.port:close()
end

--- The last reading of a device.
function sensors.reading(session, kind)
  local sensor = session.sensors[kind]
  if not sensor then raise(("session: %s is not connected"):format(names[kind])) end
  if not sensor.reading then raise(("session: %s is %s"):format(names[kind], sensor.state)) end
  return sensor.reading
end

--- Condition of commands: has the device a reading?
function sensors.has_reading(kind)
  return function(session)
    local sensor = session.sensors[kind]
    return sensor ~= nil and sensor.reading ~= nil, names[kind] .. " is not connected"
  end
end

return sensors
