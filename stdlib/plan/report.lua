--- The report of a planner: counts by reason, best energy over the steps, and, if it found no grasps, the causes.
local circumstances = require "clench.plan.circumstances"
local class = require "clench.class"
local drives = require "clench.drives"
local facing = require "clench.plan.facing"
local optional_table = require "clench.optional_table"
local starts = require "clench.plan.starts"
local touch = require "clench.plan.touch"
local verification = require "clench.plan.verification"
local Report = class "report"

--- The best energy over the steps, as a figure.
function Report:chart(options)
  local steps, best = {}, {}
  for i, point in ipairs(self.trace) do steps[i], best[i] = point[1], point[2] end
  local drawing = {title = self.planner, x_label = "step", y_label = "best energy",
                   lines = {{x = steps, y = best}}}
  for key, value in pairs(optional_table("report:chart", options)) do drawing[key] = value end
  return clench.plot(drawing)
end

local function add(lines, format, ...) lines[#lines + 1] = format:format(...) end

local function share(part, whole) return whole > 0 and 100 * part / whole or 0 end

local function add_steps(lines, r)
  if not r.steps then return end
  add(lines, "%d steps in %.3g s, %.0f per second; %.0f %% accepted", r.steps, r.seconds, r.steps_per_second,
      share(r.accepted, r.steps))
  if r.first then add(lines, "energy %.4g at the start, %.4g at best", r.first, r.best) end
  add(lines, "neighbors in collision %d, near avoided states %d, steps without a legal neighbor %d", r.in_collision,
      r.avoided, r.stuck)
end

local function add_candidates(lines, r)
  if r.candidates then add(lines, "%d candidates in %.3g s", r.candidates, r.seconds) end
  if not r.rejected then return end
  local reasons = {}
  for reason in pairs(r.rejected) do reasons[#reasons + 1] = reason end
  table.sort(reasons)
  for _, reason in ipairs(reasons) do add(lines, "%s: %d", reason, r.rejected[reason]) end
end

function Report:__tostring()
  local lines = {("%s: %d grasps"):format(self.planner, self.grasps)}
  add_steps(lines, self)
  if self.primitives then add(lines, "primitives: %s", self.primitives) end
  add_candidates(lines, self)
  if self.shaken then add(lines, "%d of %d shaken grasps held in all 6 directions", self.survived, self.shaken) end
  if self.found > self.grasps + self.alike then
    add(lines, "%d of %d grasps found are kept: good ones from all sides", self.grasps, self.found)
  end
  if self.out_of_reach > 0 then add(lines, "%d more are out of the arm's reach", self.out_of_reach) end
  if self.alike > 0 then add(lines, "%d more were similar to one of these", self.alike) end
  if self.one_thread then add(lines, "an energy of the script ran on one thread") end
  for _, line in ipairs(self.assumptions and self.assumptions.lines or {}) do lines[#lines + 1] = line end
  local unlimited = drives.unlimited_text(self.unlimited_efforts)
  if unlimited then lines[#lines + 1] = unlimited end
  if self.stopped then lines[#lines + 1] = "interrupted: the list has the grasps found until then" end
  for _, cause in ipairs(self.causes) do lines[#lines + 1] = "why: " .. cause end
  return table.concat(lines, "\n")
end

-- Does the hand collide with itself at the start?
local function self_collision(job)
  local world = job.world:clone()
  local hand, object = world:robot(job.hand.name), world:body(job.object.name)
  for _, body in ipairs(world.bodies) do
    local is_part = body == hand.base
    for _, link in ipairs(hand.links) do is_part = is_part or body == link end
    if not is_part and body ~= object then world:set_collision(false, body) end
  end
  world:set_collision(false, object)
  local pair = world:colliding(hand)[1]
  return pair and ("the hand collides with itself at the start: %s and %s"):format(pair[1].name, pair[2].name)
end

local function nothing_closes(job)
  for _, info in ipairs(job.hand.dof_info) do
    if info.default_velocity ~= 0 then return end
  end
  return ("no DOF of %s closes: its file names no closing DOFs and none could be inferred; name them by the option close of its reader"):format(job.hand.name)
end

-- joints that close without force, if grasps are verified
local function nothing_presses(job, stats)
  if not stats.verify then return end
  local missing = drives.missing(job.hand)
  return drives.no_force(job.hand) or missing and ("joints that close %s exert no force: %s"):format(job.hand.name, missing)
end

local looked_at, friction = 400, 0.5  -- sampled points of the surface; friction coefficient of the cones that contain the line to the opposite point

local report = {}

--- The sentence that no part of the object fits between the pads of thumb and fingers; nil if one does.
function report.too_wide(job)
  if job.in_place or nothing_closes(job) then return end  -- in place: the world belongs to the script
  local hand, object = job.hand, job.object
  local open = starts.aperture(hand)
  local least = open and facing.narrowest(hand.world, object, looked_at, friction)
  if least and least > open - starts.clearance then
    return ("%s is too wide for %s: opposite points of its surface are at least %.0f mm apart, and the pads open to %.0f mm, of which %.0f mm must stay free"):format(
      object.name, hand.name, 1000 * least, 1000 * open, 1000 * starts.clearance)
  end
end

-- Would the grasps that were found hold smaller loads?
local function too_weak(stats)
  local count = stats.rejected and stats.rejected[verification.too_weak]
  if not count or not stats.best_load then return end
  return ("%d grasps in force closure are too weak against loads: the best holds %.6g times the object's weight in its weakest direction, with a sum of normal forces of %g weights and the motors within their limits, but %.6g times is required; see min_load and force_ratio of verify, --force-ratio of clench plan"):format(
    count, stats.best_load, stats.verify.force_ratio, stats.verify.min_load)
end

local function rejected_most(stats)
  if not stats.candidates then return end
  local most, why = 0, nil
  for reason, count in pairs(stats.rejected) do
    local comes_first = count > most or count == most and why and reason < why
    if comes_first and reason ~= "no time left" then most, why = count, reason end
  end
  if why then return ("most candidates were rejected: %s (%d of %d)"):format(why, most, stats.candidates) end
end

-- Were there grasps, but with links that the options exclude?
local function touch_causes(stats)
  for _, why in ipairs {touch.forbidden, touch.missing} do
    local count = stats.rejected and stats.rejected[why]
    if count then return ("%d grasps were rejected: %s; allow more in touch or contacts"):format(count, why) end
  end
end

local function arm_causes(stats)
  if stats.out_of_reach > 0 then
    return ("the arm reaches none of the %d grasps found: move the arm or the object"):format(stats.out_of_reach)
  end
end

local function search_causes(stats)
  if not stats.steps then return end
  if stats.steps == 0 then return "no legal state was found: all neighbors collide" end
  if stats.in_collision > 4 * stats.steps then
    return ("%d of %d neighbors collided: widen the limits, or move the obstacles"):format(stats.in_collision, stats.in_collision + stats.steps)
  end
  if stats.threshold and stats.best > stats.threshold then
    return ("the lowest energy was %.4g, and only states below %.4g are tried as grasps: use more steps, wider limits, or another energy"):format(stats.best, stats.threshold)
  end
end

local far = 0.02  -- maximum distance from which most closing fingers reach an object [m]

--- Do the limits of the position keep all fingers away from the object?
local function out_of_reach(job, stats)
  if stats.nearest and stats.nearest > far and not circumstances.too_short(stats) then
    return ("the hand is still %.0f mm from the object in its best states: it cannot reach the object within the limits of the search"):format(1000 * stats.nearest)
  end
end

-- causes of a search that ran to its end, the most certain ones first
local function causes_of(job, stats)
  local list = {}
  local function add(cause)
    if cause then list[#list + 1] = cause end
  end
  add(nothing_closes(job))
  add(nothing_presses(job, stats))
  add(stats.no_start)
  add(circumstances.is_arm(job))
  add(circumstances.collisions_off(job))
  add(circumstances.no_friction(job))
  add(arm_causes(stats))
  add(touch_causes(stats))
  add(self_collision(job))
  add(circumstances.too_short(stats))
  add(out_of_reach(job, stats))
  add(report.too_wide(job))
  add(stats.short)
  add(too_weak(stats))
  add(search_causes(stats))
  add(rejected_most(stats))
  add(circumstances.crowded(job, stats))
  return list
end

---@param job table
---@param stats table  planner, grasps, alike, and counts
function report.new(job, stats)
  stats.trace = stats.trace or {}
  stats.unlimited_efforts = job.unlimited_efforts
  stats.causes = {}
  stats.one_thread = job.in_place and (job.threads or 1) > 1 or nil
  if stats.steps then stats.steps_per_second = stats.steps / math.max(stats.seconds, 1e-9) end
  if stats.grasps == 0 and stats.stopped then
    stats.causes[1] = nothing_presses(job, stats) or stats.short or too_weak(stats)
  elseif stats.grasps == 0 and stats.late_start then
    stats.causes[1] = stats.late_start
  elseif stats.grasps == 0 then
    stats.causes = causes_of(job, stats)
    if #stats.causes == 0 then stats.causes[1] = "unknown; try more steps or another seed" end
  end
  stats.verify, stats.best_load, stats.no_start, stats.late_start, stats.short, stats.out_of_time = nil, nil, nil, nil, nil, nil
  return setmetatable(stats, Report)
end

return report
