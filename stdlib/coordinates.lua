--- Converts a vec3 to a list {x, y, z}; other values are returned unchanged.

---@param value any
---@return any
return function(value)
  if clench.type(value) == "vec3" then return {value.x, value.y, value.z} end
  return value
end
