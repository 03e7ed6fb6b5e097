--- Calibrations of gloves, {slopes, intercepts}: DOF = intercept + slopes * raw.
local described = require "clench.described"
local raise = require "clench.raise"
local calibration = {}

local function is_finite(x) return type(x) == "number" and x - x == 0 end

--- Raises an error if a value is not a calibration.
---@param subject string  "devices.glove_map"
---@param hint? string  ", or ...": what else may be given
---@return integer count  of sensors
function calibration.check(subject, value, hint)
  local fits = type(value) == "table" and type(value.slopes) == "table" and type(value.intercepts) == "table" and #value.slopes > 0 and
    #value.slopes == #value.intercepts
  if not fits then raise(("%s: calibration: expected {slopes, intercepts}%s, got %s"):format(subject, hint or "", described(value))) end
  local count = type(value.slopes[1]) == "table" and #value.slopes[1] or 0
  for d, row in ipairs(value.slopes) do
    if type(row) ~= "table" or #row ~= count or count == 0 then raise(("%s: slopes[%d]: expected %d numbers"):format(subject, d, math.max(count, 1))) end
    for _, x in ipairs {value.intercepts[d], table.unpack(row)} do
      if not is_finite(x) then raise(("%s: DOF %d: expected finite numbers, got %s"):format(subject, d, described(x))) end
    end
  end
  return count
end

--- The value of a DOF; sensors that are missing count as 0.
---@param raw number[]
function calibration.dof(subject, value, d, raw)
  local sum = value.intercepts[d]
  for s, slope in ipairs(value.slopes[d]) do
    local x = raw[s] or 0
    if not is_finite(x) then raise(("%s: sensor %d: expected a finite number, got %s"):format(subject, s, described(x))) end
    sum = sum + slope * x
  end
  return sum
end

return calibration
