--- `clench convert`: what a file holds, written as another format.
local convert = {}

--- Writes `to`, and prints what it is.
---@param root string  where names in the files count from; "" when nothing is said
---@param unit string  of the mesh that is read; "" when nothing is said
function convert.file(from, to, root, unit)
  local kind = clench.convert(from, to, {root = root ~= "" and root or nil, unit = unit ~= "" and unit or nil})
  print(("%s: %s, from %s"):format(to, kind, from))
end

return convert
