--- Lets an interrupt reach the running coroutine: resume and wrap report to `track` which coroutine they enter and leave.
local create, resume, running = coroutine.create, coroutine.resume, coroutine.running
local close, status = coroutine.close, coroutine.status
local type, error = type, error

---@param track fun(thread: thread)
return function(track)
  local function back(here, ...)
    track(here)
    return ...
  end

  function coroutine.resume(co, ...)
    if type(co) ~= "thread" then return resume(co, ...) end
    local here = running()
    track(co)
    return back(here, resume(co, ...))
  end

  -- as in plain Lua: the error of a dead coroutine is passed to the caller, with the caller's line
  local function pass(co, ok, ...)
    if ok then return ... end
    if status(co) == "dead" then close(co) end
    local message = ...
    error(message, type(message) == "string" and 2 or 0)
  end

  function coroutine.wrap(f)
    local co = create(f)
    return function(...)
      local here = running()
      track(co)
      return pass(co, back(here, resume(co, ...)))
    end
  end
end
