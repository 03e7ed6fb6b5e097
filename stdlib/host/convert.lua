--- `clench convert`: what a file holds, written as another format.
local error_text = require "clench.host.error_text"
local printable = require "clench.printable"
local reading = require "clench.host.reading"
local convert = {}

--- Writes `to`, and prints what it is.
---@param root string  this and the next four: what is said of reading, "" when nothing is
---@return integer  the exit code
function convert.main(root, folder, package, unit, strict, from, to)
  local said = {root = root, folder = folder, package = package, unit = unit, strict = strict ~= ""}
  local ok, kind = pcall(function()
    return clench.convert(from, to, reading(clench.file_kind(from), said))
  end)
  if not ok then
    io.stderr:write("clench convert: ", printable(error_text(kind), "\n"), "\n")
    return 1
  end
  print(printable(("%s: %s, from %s"):format(to, kind, from)))
  return 0
end

return convert
