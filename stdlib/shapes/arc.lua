-- stdlib/shapes/arc.lua
--- Cosine and sine of step k of n over a quarter turn, exact at both ends so that neighbors weld.
---@param k integer  0 to n
---@param n integer
---@return number cosine, number sine
return function(k, n)
  if k == 0 then return 1.0, 0.0 end
  if k == n then return 0.0, 1.0 end
  local angle = 0.5 * math.pi * k / n
  return math.cos(angle), math.sin(angle)
end
