--- Reads an option that is a vec3 or a list of three numbers, of at most the given length.

---@param read table  of clench.options
return function(read, name, default, longest, unit)
  local value = read:get(name, default)
  local vector = type(value) == "table" and clench.vec3(table.unpack(value)) or value
  if not (vector:norm() <= longest) then
    read:expected(name, ("a vector of at most %g%s"):format(longest, unit or ""), vector:norm())
  end
  return vector
end
