--- Is x a number from -largest to largest? math.abs would let the least integer pass, whose opposite it is itself.
---@param x any
---@param largest number
---@return boolean
return function(x, largest) return type(x) == "number" and -largest <= x and x <= largest end
