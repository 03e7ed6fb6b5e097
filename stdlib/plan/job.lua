--- Input shared by all planners: a hand, an object and the world that they move, which is a clone unless a function of the script
--- reads the world itself.
local drives = require "clench.drives"
local raise = require "clench.raise"
local on_behalf_of = require "clench.on_behalf_of"
local read_options = require "clench.options"
local deadline = require "clench.deadline"
local is_stopped = require "clench.is_stopped"
local is_timeout = require "clench.is_timeout"
local closing = require "clench.plan.closing"
local quiet = require "clench.plan.quiet"
local loop_task = require "clench.loop_task"
local script_line = require "clench.script_line"
local supports = require "clench.plan.supports"
local touch = require "clench.plan.touch"
local Job = {}
Job.__index = Job

-- options of clench.annealing
local space_keys = {"position", "posture", "semi_axes", "limits", "jumps", "values", "targets", "fixed", "start",
                    "variables", "collisions", "max_tries"}

local largest_energy = 1e30

--- The energy of this name; a value that is not a string is returned unchanged.
function Job:energy_of(energy)
  if type(energy) ~= "string" then return energy end
  local known, make = pcall(function() return clench.energy[energy] end)
  if not known then raise(("%s: energy: %s"):format(self.subject, make.sentence)) end
  return on_behalf_of(self.subject, make, {hand = self.hand, object = self.object})
end

--- Another annealing chain, in a separate world or in the job's.
---@param options table  of clench.annealing; they override the options of the planner
function Job:annealing(options)
  local all = {hand = self.hand, object = self.object, world = self.world}
  for key, value in pairs(self.space) do all[key] = value end
  for key, value in pairs(options) do all[key] = value end
  -- states of infinite energy are never kept
  local best = {max_energy = largest_energy}
  for key, value in pairs(type(all.best) == "table" and all.best or {}) do best[key] = value end
  if all.best == nil or type(all.best) == "table" then all.best = best end
  return on_behalf_of(self.subject, clench.annealing, all)
end

-- Lets other coroutines of the loop run. Meanwhile the given world has the state in which the script left it.
function Job:rest()
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
function Job:begin_deadline()
  self.deadline = self.seconds and deadline(self.began + self.seconds - clench.clock())
end

---@return boolean  true if the deadline has passed
function Job:end_deadline()
  local over = self.deadline and self.deadline:close() or false
  self.deadline = nil
  return over
end

--- Calls a function that the deadline stops.
---@return any result  of the function; nil if it was stopped
function Job:in_time(work)
  self:begin_deadline()
  local ok, result = pcall(work)
  local over = self:end_deadline()
  if ok then return result end
  -- Ctrl-C before the deadline is raised again
  if not (over and is_timeout(result)) then error(result, 0) end
end

--- Called between two pieces of work: returns false once the time is over or Ctrl-C was pressed.
function Job:goes_on()
  if self.in_loop and not self.stopped then self:rest() end
  return not self.stopped and self:has_time()
end

function Job:has_time() return self.seconds == nil or clench.clock() - self.began < self.seconds end

--- Prepares the first candidate: returns make(job, options), or nil if Ctrl-C or the deadline stopped it.
---@param make fun(job: table, options: table): any
function Job:prepare(make, options)
  return self:search_in_time(function() return make(self, options) end)
end

--- The message if the time ended before the first candidate; nil: it did not.
function Job:late_start()
  if self.stopped or self:has_time() then return end
  return ("the search ended before its first candidate: its start takes longer than the limit of %.6g s with this hand and object; increase the limit"):format(self.seconds)
end

local patience = 0.25  -- half of the time that a script may run on after Ctrl-C [s]

--- Is there time left to evaluate the grasps found before Ctrl-C?
function Job:has_patience() return not self.stopped or clench.clock() - self.stopped_at < patience end

-- Time left to close the hand from the states that were found [s]; nil: unlimited
function Job:time_to_close()
  if self.stopped then return self.stopped_at + patience - clench.clock() end
  return self.seconds and self.began + 1.1 * self.seconds + 1 - clench.clock()
end

--- Calls a search. Ctrl-C ends it, and the planner continues with the grasps found so far; any other error restores the hand.
---@return any result  of the search; nil if Ctrl-C ended it
function Job:interruptible(search)
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
function Job:search_in_time(search)
  return self:interruptible(function() return self:in_time(search) end)
end

--- Closes the hand from a state; reasons for rejected grasps are counted in `stats.rejected`.
---@param stats table  of clench.plan.report
---@param approach? number  as of closing.close [m]
function Job:close(hand, object, state, stats, approach)
  local silence <close> = quiet()
  local left = self:time_to_close()
  local limit = left and deadline(left)
  local ok, grasp, why = pcall(closing.close, hand, object, state, {approach = approach, grasp = self.grasp_options})
  local over = limit and limit:close()
  if not ok then
    if not (over and is_timeout(grasp)) then error(grasp, 0) end
    grasp, why = nil, "no time left"
  end
  why = why or touch.fault(self.touch, grasp)
  if not why then return grasp end
  stats.rejected = stats.rejected or {}
  stats.rejected[why] = (stats.rejected[why] or 0) + 1
end

function Job:elapsed() return clench.clock() - self.began end

--- Restores the given world if the planner moved it.
function Job:finish()
  if self.before then self.given_world:restore(self.before) end
end

-- Checks the options once, before the search, except a list of normal forces: its length depends on the grasp.
local function check_grasp_options(job)
  local silence <close> = quiet()
  local options = {}
  for name, value in pairs(job.grasp_options) do
    if name ~= "normal_force" or type(value) ~= "table" then options[name] = value end
  end
  on_behalf_of(job.subject .. ": grasp", clench.grasp, job.hand, job.object, options)
end

local function is_part_of(robot, body)
  for _, part in ipairs(robot.bodies) do
    if part == body then return true end
  end
  return false
end

--- A clone of the world without the arm that carries the hand.
local function freed(world, name)
  local free = world:clone()
  local hand = free:robot(name)
  local arm = hand.parent
  hand:dismount()
  free:remove(arm)
  return free
end

-- Names of the pairs in which a body or robot overlaps others, except robots that move in the search and supports of an object; false if there are no such
-- pairs.
local function overlaps(world, thing, moved, stands_on)
  local names = {}
  for _, pair in ipairs(world:colliding(thing)) do
    local a, b = pair[1].robot, pair[2].robot
    local stands = stands_on and (stands_on[pair[1].name] or stands_on[pair[2].name])
    if not (stands or a and moved[a.name] or b and moved[b.name]) then
      names[#names + 1] = ("%s and %s"):format(pair[1].name, pair[2].name)
    end
  end
  return #names > 0 and table.concat(names, ", ")
end

local function warn_of_overlaps(subject, world, hand, object)
  local moved = {[hand.name] = true}
  local of_arm = hand.parent and overlaps(world, hand.parent, {})
  if of_arm then
    clench.log.warning(script_line() .. ("%s: '%s' collides before anything moves; grasps are not rejected for these collisions: %s"):format(
      subject, hand.parent.name, of_arm))
  end
  if hand.parent then moved[hand.parent.name] = true end
  local stands_on = {}
  for _, body in ipairs(supports.of(hand, object).touched) do stands_on[body.name] = true end
  local of_object = overlaps(world, object, moved, stands_on)
  if of_object then
    clench.log.warning(script_line() .. ("%s: the object overlaps other bodies before anything moves; grasps are not rejected for these overlaps: %s"):format(
      subject, of_object))
  end
end

---@param subject string  "plan.anneal"
---@param given table
---@param own? fun(read: table, job: table)  reads the planner's own options
return function(subject, given, own)
  local read = read_options(subject, given)
  local job = setmetatable({subject = subject, space = {}}, Job)
  local hand, object = read:get "hand", read:get "object"
  local world = read:get("world", hand.world)
  if hand.world ~= world or object.world ~= world then
    read:fail("hand and object must be in the same world")
  end
  if is_part_of(hand, object) then read:fail("object: '%s' is a part of the hand", object.name) end
  job.given_world, job.arm = world, hand.parent
  for _, name in ipairs {"seed", "threads", "seconds"} do job[name] = read:has(name) and read:get(name) or nil end
  job.grasp_options = read:get "grasp" or {}
  job.touch = touch.read(read, hand)
  job.max_effort = read:get "max_effort"
  for _, key in ipairs(space_keys) do
    if read:has(key) then job.space[key] = read:checked(key) end
  end
  if own then own(read, job) end
  read:done()
  warn_of_overlaps(subject, world, hand, object)

  local energy = job.energy
  local has_function = type(energy) == "function" or clench.type(energy) == "energy" and not energy.any_thread
  job.in_place = has_function
  if has_function then
    job.world, job.before = world, world:snapshot()
  else
    job.world = job.arm and freed(world, hand.name) or world:clone()
  end
  job.hand, job.object = job.world:robot(hand.name), job.world:body(object.name)
  job.given_hand, job.given_object = hand, object
  if job.max_effort then job.hand.max_effort = job.max_effort end
  job.unlimited_efforts = drives.unlimited(job.hand)
  check_grasp_options(job)
  job.in_loop = coroutine.running() == loop_task.thread
  job.began = clench.clock()
  return job
end
