-- stdlib/plan/start.lua
local clock = clench.clock
local class = require "clench.class"
local described = require "clench.described"
local raise = require "clench.raise"
local running = require "clench.plan.running"

local Search = class "search"

function Search:__tostring()
  return ("%s, %s after %.3g s"):format(self.planner, self.done and "done" or "paused", self.elapsed)
end

local function check_seconds(seconds)
  if seconds ~= nil and not (type(seconds) == "number" and seconds >= 0) then
    raise(("search:resume: seconds must be a number >= 0, got %s"):format(described(seconds)))
  end
end

function Search:resume(seconds)
  check_seconds(seconds)
  if self.done then return true end
  if self.is_running then raise "search:resume: the search is running" end
  local began = clock()
  self.pause_at, self.is_running = seconds and began + seconds, true
  local ok, result = coroutine.resume(self.thread)
  self.is_running, self.elapsed = false, self.elapsed + clock() - began
  if not ok then
    self.done = true
    error(result, 0)
  end
  if coroutine.status(self.thread) == "dead" then self.done, self.run = true, result end
  return self.done
end

function Search:pause() self.pause_at = 0 end

function Search:cancel()
  self.cancelled = true
  if not self.is_running then self:resume() end
  return self.run
end

--- A planner that is run piece by piece. It pauses between two pieces of work (1000 steps of annealing, 64 starts), and whether it
--- paused changes no byte of what it finds.
---@param planner string  "sample", "anneal", ...
---@param options table  of that planner; its `seconds` count while it runs, not while it is paused
---@return table search # paused. `search:resume(seconds?)` goes on, to the end or for so long, and says whether it is done; `search:pause()`, called by on_grasp or an energy, lets it pause at the next piece; `search:cancel()` ends it and gives the run with what was found so far. `done`; `run`, {grasps, report} once it is done; `elapsed` [s]
--- > search = clench.plan.start("sample", {hand = hand, object = flask, count = 2, refine = 2})
--- > while not search:resume(0.05) do end
--- > search.done, #search.run.grasps > 0  --> true, true
--- > clench.plan.start("sample", {hand = hand}):resume()  --> error: object must be a body, got nothing
--- > clench.plan.start("smple", {})  --> error: plan.start: planner: there is no 'smple'
return function(planner, options)
  if type(planner) ~= "string" then raise(("plan.start: planner: expected a name, got %s"):format(described(planner))) end
  if planner == "online" or planner == "start" then
    raise(("plan.start: planner: '%s' is no search that ends"):format(planner))
  end
  local known, plan = pcall(function() return clench.plan[planner] end)
  if not known then raise((tostring(plan):gsub("^.-plan: there", "plan.start: planner: there"))) end
  local search = setmetatable({planner = "plan." .. planner, elapsed = 0, done = false}, Search)
  search.thread = coroutine.create(function() return plan(options) end)
  running[search.thread] = search
  return search
end
