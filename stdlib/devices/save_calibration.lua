local described = require "clench.described"
local raise = require "clench.raise"

local function check(calibration)
  local fits = type(calibration) == "table" and type(calibration.slopes) == "table" and type(calibration.intercepts) == "table" and
    #calibration.slopes > 0 and #calibration.slopes == #calibration.intercepts
  if not fits then raise("devices.save_calibration: calibration: expected {slopes, intercepts}, got " .. described(calibration)) end
  local count = type(calibration.slopes[1]) == "table" and #calibration.slopes[1] or 0
  for d, row in ipairs(calibration.slopes) do
    if type(row) ~= "table" or #row ~= count or count == 0 then raise(("devices.save_calibration: slopes[%d]: expected %d numbers"):format(d, math.max(count, 1))) end
    for _, x in ipairs {calibration.intercepts[d], table.unpack(row)} do
      if type(x) ~= "number" or x - x ~= 0 then raise(("devices.save_calibration: DOF %d: expected finite numbers, got %s"):format(d, described(x))) end
    end
  end
  return count
end

--- Writes a calibration in GraspIt!'s format, with all digits: `clench.files.glove_calibration` reads the same numbers.
---@param path string  file to write
---@param calibration table  {slopes, intercepts}, as of clench.devices.calibrate
--- > path = os.tmpname()
--- > clench.devices.save_calibration(path, {slopes = {{0.1, 0}}, intercepts = {1 / 3}})
--- > clench.files.glove_calibration(path).intercepts[1] == 1 / 3  --> true
--- > os.remove(path)  --> true
return function(path, calibration)
  if type(path) ~= "string" or path == "" then raise("devices.save_calibration: path: expected the name of a file, got " .. described(path)) end
  local count = check(calibration)
  local lines = {("%d %d"):format(#calibration.slopes, count)}
  local function add(row)
    local words = {}
    for i, x in ipairs(row) do words[i] = ("%.17g"):format(x) end
    lines[#lines + 1] = table.concat(words, " ")
  end
  for _, row in ipairs(calibration.slopes) do add(row) end
  add(calibration.intercepts)
  clench.files.save_text(path, table.concat(lines, "\n") .. "\n")
end
