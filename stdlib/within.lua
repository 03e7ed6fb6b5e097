--- Is x a number from -largest to largest? Does not use math.abs, which returns the smallest integer unchanged.
---@param x any
---@param largest number
---@return boolean
return function(x, largest) return type(x) == "number" and -largest <= x and x <= largest end
