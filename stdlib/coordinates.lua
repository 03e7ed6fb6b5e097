--- A vec3 as a list {x, y, z}; anything else as it is.

---@param value any
---@return any
return function(value)
  if clench.type(value) == "vec3" then return {value.x, value.y, value.z} end
  return value
end
