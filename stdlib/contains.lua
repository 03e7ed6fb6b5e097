--- Does a list contain an item?
---@param list any[]
---@param item any
---@return boolean
return function(list, item)
  for _, other in ipairs(list) do
    if other == item then return true end
  end
  return false
end
