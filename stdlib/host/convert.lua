--- `clench convert`: writes the content of a file in another format.
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local printable = require "clench.printable"
local reading = require "clench.reading"
local convert = {}

-- "a,b" as a list; nil if empty
local function names_in(text)
  if text == "" then return nil end
  local list = {}
  for name in text:gmatch "[^,]+" do list[#list + 1] = name end
  return list
end

--- Writes `to`, and prints its kind.
---@param root string  this and the next four: options of readers, "" if not given
---@param format string  format of a list of grasps; `dof_order`: names separated by commas; "" if not given
---@return integer  the exit code
function convert.main(root, folder, package, unit, strict, from, to, format, dof_order)
  local said = {root = root, folder = folder, package = package, unit = unit, strict = strict ~= ""}
  local ok, kind = pcall(function()
    local options = reading(clench.file_kind(from), said)
    if format ~= "" then options.format = format end
    options.dof_order = names_in(dof_order)
    return clench.session():run("file.convert", {from = from, to = to, options = options})
  end)
  if not ok then
    if is_stopped(kind) then error(kind, 0) end
    io.stderr:write("clench convert: ", printable(error_text(kind), "\n"), "\n")
    return 1
  end
  print(printable(("%s: %s, from %s"):format(to, kind, from)))
  return 0
end

return convert
