--- Suppresses warnings, for example of soft contacts at an edge, while a planner tries thousands of grasps and discards them.
local shown = {debug = true, info = true, warning = true}

--- Suppresses warnings until the to-be-closed variable that holds the result goes out of scope.
return function()
  local before = clench.log.level()
  if shown[before] then clench.log.level "error" end
  return setmetatable({}, {__close = function() clench.log.level(before) end})
end
