--- `clench convert`: what a file holds, written as another format.
local reading = require "clench.host.reading"
local convert = {}

--- Writes `to`, and prints what it is. What is said of reading is "" when nothing is.
---@return string?  what went wrong
function convert.file(from, to, root, folder, package, unit)
  local said = {root = root, folder = folder, package = package, unit = unit}
  local ok, kind = pcall(function()
    return clench.convert(from, to, reading(clench.file_kind(from), said))
  end)
  if not ok then return (tostring(kind):gsub("^stdlib/host/convert.lua:%d+: ", "")) end
  print(("%s: %s, from %s"):format(to, kind, from))
end

return convert
