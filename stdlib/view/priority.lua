--- Frames of views come before jobs: while a view is open, threads that `clench.job` and `clench.parallel.map` start have a lower priority.
local priority = {}

local level = 10  -- niceness of these threads, unless the user has chosen one
local views, is_set = 0, false

--- Called when a view opens.
function priority.take()
  views = views + 1
  if views == 1 and clench.parallel.nice() == 0 then
    clench.parallel.nice(level)
    is_set = true
  end
end

--- Called when a view closes: after the last one, the niceness is that of before, unless it has been changed since.
function priority.give_back()
  views = views - 1
  if views > 0 or not is_set then return end
  if clench.parallel.nice() == level then clench.parallel.nice(0) end
  is_set = false
end

return priority
