--- Calls the functions that take part in a world's steps when they are due; errors name the function.
local explained = require "clench.explained"
local calls = {tiny = 1e-9}  -- tolerance for rounding, in periods and in seconds

function calls.call(handle, ...)
  local ok, problem = xpcall(handle.fn, function(problem)
    return explained(problem, handle.running or handle.name, debug.traceback("", 2):sub(2))
  end, ...)
  if not ok then error(problem, 0) end
end

-- Is a function due? Periods are multiples of 1 / rate of the world's time, even after the world was restored to an earlier time.
function calls.is_due(handle, time)
  local rate = handle.rate
  if not rate then return true end
  if not handle.next or time < handle.last then handle.next = math.ceil(time * rate - calls.tiny) end
  handle.last = time
  if time * rate < handle.next - calls.tiny then return false end
  handle.next = math.floor(time * rate + calls.tiny) + 1
  return true
end

-- Calls waiting functions in order; functions that are added meanwhile start with the next step.
function calls.each(list, visit)
  for i = 1, list and #list or 0 do
    if list[i].status == "waiting" then visit(list[i]) end
  end
end

function calls.observers(world, list)
  calls.each(list, function(handle)
    if calls.is_due(handle, world.time) then calls.call(handle, world) end
  end)
end

return calls
