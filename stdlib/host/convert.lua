--- `clench convert`: what a file holds, written as another format.
local convert = {}

--- Writes `to`, and prints what it is.
---@param root string  where names in the files count from; "" when nothing is said
---@param unit string  of the mesh that is read; "" when nothing is said
---@return string?  what went wrong
function convert.file(from, to, root, unit)
  local options = {root = root ~= "" and root or nil, unit = unit ~= "" and unit or nil}
  local ok, kind = pcall(clench.convert, from, to, options)
  if not ok then return (tostring(kind):gsub("^[^:]*:%d+: ", "")) end
  print(("%s: %s, from %s"):format(to, kind, from))
end

return convert
