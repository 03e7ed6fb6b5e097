--- "held in 5 of 6 directions": the outcome of a test that moves a grasp, for tables, pages, sheets and verdicts.
---@param held integer
---@param count integer
---@param noun? string  plural; "directions" by default
---@return string
return function(held, count, noun) return ("held in %d of %d %s"):format(held, count, noun or "directions") end
