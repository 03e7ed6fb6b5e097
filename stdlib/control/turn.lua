--- Work in turns: between two of them other coroutines of the loop run, such as those that serve other clients, jobs and timers.
local loop = clench.loop
local turn = {}

local max_turn = 0.002   -- [s]
local min_pause = 0.0002 -- between two rounds of shared turns: longer than the loop takes from one coroutine to the next [s]

--- Starts a turn of the calling coroutine.
---@param before_pause? function  called before others run
---@return fun(): boolean pause  to be called between parts of the work: lets others run if the turn has been long, and starts the next; did it?
function turn.new(before_pause)
  local began = loop.time()
  return function()
    if loop.time() - began < max_turn then return false end
    if before_pause then before_pause() end
    coroutine.yield()
    began = loop.time()
    return true
  end
end

local waiting = {}                   -- one table per coroutine that waits for a shared turn, in order
local round_began, last_end = 0, 0   -- [s]

-- may a shared turn begin now? In one round of the loop, as many begin as take max_turn together.
local function may_begin()
  local now = loop.time()
  if now - last_end > min_pause then round_began = now end
  return now - round_began < max_turn
end

local function wait_for_turn()
  local own = {}
  waiting[#waiting + 1] = own
  while waiting[1] ~= own or not may_begin() do coroutine.yield() end
  table.remove(waiting, 1)
end

--- Waits for a turn of the calling coroutine, and starts it. However many coroutines share turns, others wait for about one turn only.
---@return fun(): boolean pause  as of turn.new
---@return fun() finish  to be called at the end of the work
function turn.new_shared()
  wait_for_turn()
  local began = loop.time()
  local function finish() last_end = loop.time() end
  return function()
    if loop.time() - began < max_turn then return false end
    finish()
    wait_for_turn()
    began = loop.time()
    return true
  end, finish
end

return turn
