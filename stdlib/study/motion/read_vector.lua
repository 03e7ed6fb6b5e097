--- A vector among options, as a vec3 or a list of three numbers, no longer than `longest` of its unit.

---@param read table  of clench.options
return function(read, name, default, longest, unit)
  local value = read:raw(name)
  if value == nil then return default end
  local ok, vector = pcall(function() return type(value) == "table" and clench.vec3(value[1], value[2], value[3]) or value end)
  if not ok or clench.type(vector) ~= "vec3" then read:expected(name, "a vector {x, y, z}", value) end
  if not (vector:norm() <= longest) then
    read:expected(name, ("a vector of at most %g%s"):format(longest, unit or ""), vector:norm())
  end
  return vector
end
