--- A vec3 as a list {x, y, z}; anything else as it is.
local described = require "clench.described"

---@param value any
---@return any
return function(value)
  if described(value) == "a vec3" then return {value.x, value.y, value.z} end
  return value
end
