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
  if not is_finite(sum) then raise(("%s: DOF %d: expected a finite value, got %s"):format(subject, d, described(sum))) end
  return sum
end

--- The option `dofs`: pairs {DOF of the hand, row of the calibration}, in the order of DOFs.
---@param count integer  of DOFs
---@param rows integer  of the calibration
---@return integer[][]
function calibration.read_map(o, count, rows)
  local given, out = o:raw "dofs", {}
  if given == nil then
    for d = 1, math.min(count, rows) do out[d] = {d, d} end
    return out
  end
  if type(given) ~= "table" or next(given) == nil then o:expected("dofs", "rows of the calibration by the numbers of DOFs", given) end
  for d, row in pairs(given) do
    if math.type(d) ~= "integer" or d < 1 or d > count then o:expected("dofs", ("numbers of DOFs from 1 to %d"):format(count), d) end
    if math.type(row) ~= "integer" or row < 1 or row > rows then o:expected(("dofs[%d]"):format(d), ("a row from 1 to %d"):format(rows), row) end
    out[#out + 1] = {d, row}
  end
  table.sort(out, function(a, b) return a[1] < b[1] end)
  return out
end

return calibration
