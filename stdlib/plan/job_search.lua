--- Methods of a planner's job: energies and annealing chains, closing the hand from a state, and finishing.
local raise = require "clench.raise"
local on_behalf_of = require "clench.on_behalf_of"
local deadline = require "clench.deadline"
local is_timeout = require "clench.is_timeout"
local closing = require "clench.plan.closing"
local job_time = require "clench.plan.job_time"
local quiet = require "clench.plan.quiet"
local touch = require "clench.plan.touch"
local Job = setmetatable({}, {__index = job_time})
Job.__index = Job

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

--- Restores the given world if the planner moved it.
function Job:finish()
  if self.before then self.given_world:restore(self.before) end
end

return Job
