--- Checks of arguments, shared by the functions and methods of ports.
local described = require "clench.described"
local raise = require "clench.raise"
local check = {}

--- A maximum waiting time; nil: no limit.
function check.seconds(subject, seconds)
  if seconds == nil then return end
  if type(seconds) ~= "number" or not (seconds >= 0 and seconds < math.huge) then
    raise(("%s: seconds: expected a time >= 0, got %s"):format(subject, described(seconds)))
  end
end

--- A string that is not empty.
function check.string(subject, name, value)
  if type(value) ~= "string" or value == "" then raise(("%s: %s: expected a string, got %s"):format(subject, name, described(value))) end
end

--- An integer within bounds.
function check.integer(subject, name, value, min, max)
  local whole = type(value) == "number" and math.tointeger(value)
  if not whole or whole < min or whole > max then
    raise(("%s: %s: expected an integer from %d to %d, got %s"):format(subject, name, min, max, described(value)))
  end
  return whole
end

return check
