local check = require "clench.devices.calibration".check
local described = require "clench.described"
local raise = require "clench.raise"

--- Writes a calibration in GraspIt!'s format, with all digits: `clench.files.glove_calibration` reads the same numbers.
---@param path string  file to write
---@param calibration table  {slopes, intercepts}, as of clench.devices.calibrate
---@effect files
--- > path = os.tmpname()
--- > clench.devices.save_calibration(path, {slopes = {{0.1, 0}}, intercepts = {1 / 3}})
--- > clench.files.glove_calibration(path).intercepts[1] == 1 / 3  --> true
--- > os.remove(path)  --> true
return function(path, calibration)
  if type(path) ~= "string" or path == "" then raise("devices.save_calibration: path: expected the name of a file, got " .. described(path)) end
  local count = check("devices.save_calibration", calibration)
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
