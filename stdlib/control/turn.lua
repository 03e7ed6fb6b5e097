--- Work in turns: between two of them other coroutines of the loop run, such as those that serve other clients, jobs and timers.
local loop = clench.loop

local max_turn = 0.002  -- [s]

--- Starts a turn of the calling coroutine.
---@param before_pause? function  called before others run
---@return fun(): boolean pause  to be called between parts of the work: lets others run if the turn has been long, and starts the next; did it?
return function(before_pause)
  local began = loop.time()
  return function()
    if loop.time() - began < max_turn then return false end
    if before_pause then before_pause() end
    coroutine.yield()
    began = loop.time()
    return true
  end
end
