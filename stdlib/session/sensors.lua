--- Devices of a session: a glove, a tracker and a real hand. A coroutine of `clench.loop` serves each of them and keeps its last reading, which
--- commands and frames use: none of them waits for a serial line.
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local raise = require "clench.raise"
local real_hands = require "clench.session.real_hands"
local serial_lines = require "clench.session.serial_lines"
local sensors = {}

local timeout = 1  -- for an answer; the loop may be late while a frame is drawn [s]

-- baud: of the line; open(port, options): returns the driver, and a function that prepares it before the first reading; read(driver); period: between
-- readings [s]
local kinds = {
  glove = {baud = 38400, period = 0.02, read = function(glove) return glove:read() end,
           open = function(port)
             local glove = clench.devices.cyberglove {port = port, timeout = timeout}
             return glove, function() if not glove:is_ready() then raise "the glove is not ready" end end
           end},
  tracker = {baud = 115200, period = 0.02, read = function(flock) return flock:read() end,
             open = function(port, options) return clench.devices.flock {port = port, timeout = timeout, birds = options.birds}, function() end end},
  hand = {period = 0.1, read = function(hand) return hand:read() end,
          open = function(port, options) return real_hands.drivers[options.driver].open(port, options.ids) end},
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
  local prepare
  sensor.device, prepare = kind.open(sensor.port, sensor.options)
  prepare()
  while not sensor.is_closed do
    sensor.reading, sensor.state, sensor.count = kind.read(sensor.device), "connected", sensor.count + 1
    if clench.loop.time() > sensor.reported + report_interval then notify(session, sensor) end
    if sensor.task then advance(session, sensor) end
    clench.loop.sleep(sensor.task and 0.02 or kind.period)
  end
end

-- the line of a device; the error for one that cannot be opened says what to do
local function open_line(path, baud)
  if path == "" then raise("session: path: expected a serial line, such as /dev/ttyUSB0; " .. serial_lines.hint()) end
  local ok, port = pcall(clench.port.serial, {path = path, baud = baud})
  if ok then return port end
  if is_stopped(port) then error(port, 0) end
  local reason = type(port) == "table" and port.sentence or error_text(port)
  raise(reason .. serial_lines.advice(reason), type(port) == "table" and port.kind or nil)
end

-- no two devices have one line; a real hand that stops still uses its line
local function check_free(session, kind, path)
  for other, name in pairs(names) do
    local sensor = session.sensors[other]
    local is_replaced = other == kind and kind ~= "hand"
    if sensor and sensor.path == path and sensor.port:is_open() and not is_replaced then
      raise(("session: %s uses %s; disconnect it first"):format(name, path))
    end
  end
end

-- stops a hand, which is asked for some seconds if it does not answer, and closes the line
local function close(session, sensor)
  local ok, stopped = pcall(sensor.device.close, sensor.device)
  sensor.port:close()
  if is_stopped(stopped) then error(stopped, 0) end
  if ok and stopped ~= false then return end
  session:emit("diagnostic", {severity = "error", text = ("%s at %s has not confirmed that it has stopped"):format(names[sensor.kind], sensor.path), count = 1})
end

--- Connects a device, instead of the one of its kind. It is served while `clench.loop` runs.
---@param kind "glove"|"tracker"|"hand"
---@param path string  of its serial line
---@param options table  {baud: that of the device by default; tracker: birds; hand: driver, ids, dofs, signs, offsets}
function sensors.connect(session, kind, path, options)
  local driver = kind == "hand" and real_hands.check(options.driver, options.ids) or kinds[kind]
  check_free(session, kind, path)
  local old = session.sensors[kind]
  if old and old.path == path then sensors.disconnect(session, kind) end
  local port = open_line(path, options.baud or driver.baud)
  sensors.disconnect(session, kind)
  local sensor = {kind = kind, path = path, port = port, options = options, state = "connecting", count = 0, reported = -math.huge}
  session.sensors[kind] = sensor
  clench.loop.spawn(function()
    local ok, problem = pcall(serve, session, sensor, kinds[kind])
    if ok or sensor.is_closed then return end
    sensor.state, sensor.reading, sensor.task = "lost", nil, nil
    report(session, sensor, problem)
    if kind == "hand" and sensor.device and port:is_open() then close(session, sensor) end
    port:close()
  end)
end

--- Disconnects a device; a real hand is stopped while `clench.loop` runs. Without such a device, nothing happens.
function sensors.disconnect(session, kind)
  local sensor = session.sensors[kind]
  if not sensor then return end
  session.sensors[kind], sensor.is_closed = nil, true
  -- beside the caller: it does not wait for a hand that does not answer
  if kind == "hand" and sensor.device and sensor.port:is_open() then return clench.loop.spawn(function() close(session, sensor) end) end
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
