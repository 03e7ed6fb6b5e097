--- Serial lines that exist, for hints: USB adapters and boards.
local serial_lines = {}

local names = {}
for _, kind in ipairs {"ttyUSB", "ttyACM"} do
  for number = 0, 9 do names[#names + 1] = "/dev/" .. kind .. number end
end

-- errno of a file "in" the line: the line exists, but is no folder. Opening the line itself might reset the device.
local is_no_folder = 20

local function exists(path)
  local ok, _, _, code = pcall(io.open, path .. "/x")
  return ok and code == is_no_folder
end

--- Paths of the lines that exist.
---@return string[]
function serial_lines.list()
  local found = {}
  for _, path in ipairs(names) do
    if exists(path) then found[#found + 1] = path end
  end
  return found
end

--- A hint for the field of a path.
function serial_lines.hint()
  local found = serial_lines.list()
  return #found > 0 and table.concat(found, ", ") or "no /dev/ttyUSB or /dev/ttyACM exists"
end

--- Advice for a line that cannot be opened, as the end of a sentence; "" if the reason says enough.
---@param reason string  of the system
function serial_lines.advice(reason)
  if reason:find "Permission denied" then return "; the lines belong to the group dialout" end
  if not reason:find "No such file" then return "" end
  local found = serial_lines.list()
  if #found > 0 then return "; these lines exist: " .. table.concat(found, ", ") end
  return "; no serial line exists: connect the device or its USB adapter"
end

return serial_lines
