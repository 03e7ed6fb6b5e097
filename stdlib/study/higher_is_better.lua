--- Tells for each measure if larger values are better.
---@return table<string, boolean>  by name, for all measures of grasp:quality
return function()
  local by_name = {}
  for _, measure in ipairs(clench.measures()) do by_name[measure.name] = measure.higher_is_better end
  return by_name
end
