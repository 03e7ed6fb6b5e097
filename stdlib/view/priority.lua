--- Frames of views come before jobs: while a view is open, threads that `clench.job` and `clench.parallel.map` start have a lower priority.
local priority = {}

local level = 10  -- niceness of these threads, unless the user has chosen one
local views, is_set = 0, false

-- after the last view, the niceness is that of before, unless it has been changed since
local function give_back()
  views = views - 1
  if views > 0 or not is_set then return end
  if clench.parallel.nice() == level then clench.parallel.nice(0) end
  is_set = false
end

--- Called when a view opens.
---@return {finish: function} # to be called when it closes
function priority.take()
  views = views + 1
  if views == 1 and clench.parallel.nice() == 0 then
    clench.parallel.nice(level)
    is_set = true
  end
  return {finish = give_back}
end

return priority
