--- Time control of a planner's job: a deadline, Ctrl-C, and pauses for other coroutines of the loop. The job has `began`, `seconds`, and if it moves a world of
--- the script, `before`, `given_world` and `world`.
local deadline = require "clench.deadline"
local is_stopped = require "clench.is_stopped"
local is_timeout = require "clench.is_timeout"
local Time = {}

-- Lets other coroutines of the loop run. Meanwhile the given world has the state in which the script left it.
function Time:rest()
  self:end_deadline()
  local paused_at, here = clench.clock(), self.before and self.world:snapshot()
  if here then self.given_world:restore(self.before) end
  coroutine.yield()
  if here then
    self.before = self.given_world:snapshot()
    self.world:restore(here)
  end
  self.began = self.began + clench.clock() - paused_at
  self:begin_deadline()
end

-- Starts the deadline: calls of the engine fail as by Ctrl-C once `seconds` have passed.
function Time:begin_deadline()
  self.deadline = self.seconds and deadline(self.began + self.seconds - clench.clock())
end

---@return boolean  true if the deadline has passed
function Time:end_deadline()
  local over = self.deadline and self.deadline:close() or false
  self.deadline = nil
  return over
end

--- Calls a function that the deadline stops.
---@return any result  of the function; nil if it was stopped
function Time:in_time(work)
  self:begin_deadline()
  local ok, result = pcall(work)
  local over = self:end_deadline()
  if ok then return result end
  -- Ctrl-C before the deadline is raised again
  if not (over and is_timeout(result)) then error(result, 0) end
end

--- Called between two pieces of work: returns false once the time is over or Ctrl-C was pressed.
function Time:goes_on()
  if self.in_loop and not self.stopped then self:rest() end
  return not self.stopped and self:has_time()
end

function Time:has_time() return self.seconds == nil or clench.clock() - self.began < self.seconds end

--- Prepares the first candidate: returns make(job, options), or nil if Ctrl-C or the deadline stopped it.
---@param make fun(job: table, options: table): any
function Time:prepare(make, options)
  return self:search_in_time(function() return make(self, options) end)
end

--- The message if the time ended before the first candidate; nil: it did not.
function Time:late_start()
  if self.stopped or self:has_time() then return end
  return ("the search ended before its first candidate: its start takes longer than the limit of %.6g s with this hand and object; increase the limit"):format(self.seconds)
end

local patience = 0.25  -- half of the time that a script may run on after Ctrl-C [s]

--- Is there time left to evaluate the grasps found before Ctrl-C?
function Time:has_patience() return not self.stopped or clench.clock() - self.stopped_at < patience end

-- Time left to close the hand from the states that were found [s]; nil: unlimited
function Time:time_to_close()
  if self.stopped then return self.stopped_at + patience - clench.clock() end
  return self.seconds and self.began + 1.1 * self.seconds + 1 - clench.clock()
end

--- Calls a search. Ctrl-C ends it, and the planner continues with the grasps found so far; any other error restores the hand.
---@return any result  of the search; nil if Ctrl-C ended it
function Time:interruptible(search)
  local ok, result = pcall(search)
  if ok then return result end
  if is_stopped(result) then
    self.stopped, self.stopped_at = true, clench.clock()
    return
  end
  self:finish()
  error(result, 0)
end

--- As interruptible; the deadline also ends the search.
---@return any result  of the search; nil if it was ended
function Time:search_in_time(search)
  return self:interruptible(function() return self:in_time(search) end)
end

function Time:elapsed() return clench.clock() - self.began end

return Time
