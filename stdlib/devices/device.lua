--- Functions shared by drivers of devices: the port, errors, and checks of values before they are sent.
local described = require "clench.described"
local raise = require "clench.raise"
local device = {}

--- The port of a driver: a path, which is opened as a serial line, or a port.
---@param subject string  "devices.barrett"
---@param given any
---@param baud integer
function device.port_of(subject, given, baud)
  if type(given) == "string" then return clench.port.serial {path = given, baud = baud} end
  local meta = debug.getmetatable(given)
  if type(given) ~= "table" or not meta or meta.__name ~= "port" then
    raise(("%s: port: expected the path of a serial line, or a port, got %s"):format(subject, described(given)))
  end
  return given
end

--- Raises an error because a port has ended, or because there was no answer.
---@param why string  "closed", "unplugged" or "timeout"
function device.fail(subject, port, why, doing)
  if why == "timeout" then raise(("%s: no valid answer from %s: %s"):format(subject, port.name, doing), "limit") end
  raise(("%s: %s is %s"):format(subject, port.name, why), "stale")
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

local max_silent = 10  -- attempts in a row to which a device sends nothing

--- Repeats an exchange until it yields an answer; damaged answers may be numerous on a noisy line, silence is not noise.
---@param driver table  with `port` and `attempts`
---@param exchange fun(): any, string?  the answer, or nil and the reason: "timeout" if nothing was received
---@param doing string  for messages
---@return any
function device.repeated(subject, driver, exchange, doing)
  local silent = 0
  for _ = 1, driver.attempts do
    local answer, why = exchange()
    if answer ~= nil then return answer end
    if why == "closed" or why == "unplugged" then device.fail(subject, driver.port, why, doing) end
    silent = why == "timeout" and silent + 1 or 0
    if silent == max_silent then break end
  end
  device.fail(subject, driver.port, "timeout", doing)
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

--- Sends bytes without waiting, for use when a script ends.
function device.send_last(port, bytes)
  if port.stream:descriptor() >= 0 then port.stream:write(bytes, 0) end
end

return device
