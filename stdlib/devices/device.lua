--- Functions shared by drivers of devices: the port, errors, and checks of values before they are sent.
local described = require "clench.described"
local is_stopped = require "clench.is_stopped"
local raise = require "clench.raise"
local device = {}

-- the port of a driver: a path, which is opened as a serial line, or a port
local function port_of(subject, given, baud)
  if type(given) == "string" then return clench.port.serial {path = given, baud = baud} end
  local meta = debug.getmetatable(given)
  if type(given) ~= "table" or not meta or meta.__name ~= "port" then
    raise(("%s: port: expected the path of a serial line, or a port, got %s"):format(subject, described(given)))
  end
  return given
end

--- Adds to a driver the fields that all have, from the options of its caller, and opens its port.
---@param subject string  "devices.barrett"
---@param o table  options, of which all others have been read
---@param driver table
function device.new(subject, o, driver)
  local given, baud = o:raw "port", o:get "baud"
  driver.subject, driver.timeout, driver.attempts = subject, o:get "timeout", o:get "attempts"
  o:done()
  driver.port, driver.owns_port = port_of(subject, given, baud), type(given) == "string"
  return driver
end

--- Closes the port if the driver has opened it.
function device.close(driver)
  if driver.owns_port then driver.port:close() end
end

--- Waits until no other coroutine exchanges bytes with a device, so that a stop can be sent between the queries of a motion. The result is closed after the
--- exchange: `local _ <close> = device.use(driver)`.
---@param driver table  with `timeout`
function device.use(driver)
  local last = clench.loop.time() + 2 * driver.timeout + 1  -- a coroutine that was abandoned does not block others
  while driver.is_used and clench.loop.time() < last do clench.loop.sleep(0.001) end
  driver.is_used = true
  return setmetatable({}, {__close = function() driver.is_used = false end})
end


--- Raises an error because the port has ended, or because there was no answer.
---@param why string  "closed", "unplugged" or "timeout"
---@param doing string  for the message: "reading registers"
function device.fail(driver, why, doing)
  local subject, name = driver.subject, driver.port.name
  if why == "timeout" then raise(("%s: no valid answer from %s: %s"):format(subject, name, doing), "limit") end
  raise(("%s: %s is %s"):format(subject, name, why), "stale")
end

--- Raises an error if the reason for a failure is that the port has ended.
---@param why? string  as returned by port:read
function device.check_lost(driver, why)
  if why == "closed" or why == "unplugged" then device.fail(driver, why) end
end

--- Repeats an exchange until it succeeds, at most `driver.attempts` times; raises an error if it never does. Damaged answers may be numerous on a noisy line, but
--- a device that answers also damaged commands is absent if it sends nothing `driver.max_silent` times in a row.
---@param doing string  for the message
---@param exchange fun(driver: table, ...): any?, string?  the answer; or nil and the reason, as returned by port:read: "timeout" if nothing was received, or "damaged"
function device.ask(driver, doing, exchange, ...)
  local silent = 0
  for _ = 1, driver.attempts do
    local answer, why = exchange(driver, ...)
    if answer ~= nil then return answer end
    device.check_lost(driver, why)
    silent = why == "timeout" and silent + 1 or 0
    if silent == driver.max_silent then break end
  end
  device.fail(driver, "timeout", doing)
end

--- Bytes up to a delimiter; nil and "damaged" if some were received without it, "timeout" if none were.
function device.read_until(port, delimiter, seconds)
  local bytes, why = port:read_until(delimiter, seconds)
  if not bytes and why == "timeout" and port:read_some(0) then why = "damaged" end
  return bytes, why
end

--- Checks numbers before they are sent.
---@param names string[]  of the numbers, for messages
---@param low number[]
---@param high number[]
---@param unit string
function device.check_numbers(subject, values, names, low, high, unit)
  if type(values) ~= "table" or #values ~= #names then
    raise(("%s: expected %d numbers (%s), got %s"):format(subject, #names, table.concat(names, ", "), described(values)))
  end
  for i, name in ipairs(names) do
    local value = values[i]
    -- a value at a limit may be off by rounding
    if type(value) ~= "number" or not (value >= low[i] - 1e-9 and value <= high[i] + 1e-9) then
      raise(("%s: %s: expected %.6g to %.6g %s, got %s"):format(subject, name, low[i], high[i], unit, described(value)))
    end
  end
end

--- The median of several readings, number by number.
---@param readings number[][]  at least one
function device.median(readings)
  local out = {}
  for i in ipairs(readings[1]) do
    local column = {}
    for r, reading in ipairs(readings) do column[r] = reading[i] end
    table.sort(column)
    out[i] = column[(#column + 1) // 2]
  end
  return out
end

local function send_now(port, bytes)
  if port.stream:descriptor() >= 0 then port.stream:write(bytes, 0) end
end

--- Sends the bytes that stop a device without waiting, unless the driver is closed; for use when a script ends.
function device.send_last(driver, bytes)
  if not driver.is_closed then send_now(driver.port, bytes) end
end

device.max_closing_time = 3  -- of a stop that is not confirmed [s]

-- stops a device, repeatedly until it confirms it; false: it has not done so in time
local function stop_confirmed(driver, stop)
  local last = clench.clock() + math.min(driver.attempts * driver.timeout, device.max_closing_time)
  for _ = 1, driver.attempts do
    local left = last - clench.clock()
    if left <= 0 then return false end
    local is_confirmed, why = stop(driver, math.min(driver.timeout, left))
    if is_confirmed then return true end
    if why == "closed" or why == "unplugged" then return false end
  end
  return false
end

-- stops a device, also while another coroutine waits for an answer; false and the reason: it could not wait for the device
local function stop_and_wait(driver, stop, last)
  local until_then = clench.clock() + device.max_closing_time
  while true do
    local ok, stopped = pcall(stop_confirmed, driver, stop)
    if ok then return stopped end
    send_now(driver.port, last)  -- its answer ends the other wait
    if is_stopped(stopped) or clench.clock() > until_then or not pcall(clench.loop.sleep, 0.05) then return false, stopped end
  end
end

--- Stops a device and closes its port. A stop that the device does not confirm is repeated for at most three seconds; a warning is reported if it never does.
---@param stop fun(driver: table, seconds: number): boolean?, string?  one attempt: true if the device has confirmed it, otherwise the reason, as returned by port:read
---@param last string  bytes that stop the device
---@return boolean stopped  false: the device has not confirmed it
function device.stop_and_close(driver, stop, last)
  if driver.is_closed then return true end
  driver.is_closed = true
  local stopped, why = stop_and_wait(driver, stop, last)
  device.close(driver)
  if is_stopped(why) then error(why, 0) end
  if not stopped then clench.log.warning(("%s: the device at %s has not confirmed that it has stopped"):format(driver.subject, driver.port.name)) end
  return stopped
end

return device
