--- Diagnoses a search without grasps: counts how many of the candidates that hold too little would hold with more friction, more normal force, or stronger
--- motors. Only some candidates are examined, in the order of their numbers.
local closing = require "clench.plan.closing"
local quiet = require "clench.plan.quiet"
local share_friction = require "clench.study.motion.share_friction"
local verification = require "clench.plan.verification"
local diagnosis = {}

local levels = {2, 4}   -- factors of the friction and of the normal force
local max_looked_at = 24  -- candidates
local max_tries = 400     -- starts, until there are that many candidates

-- Which changes make a grasp hold the required load?
-- returns  booleans by level for each change; nil: it holds without any change
local function cures(hand, object, grasp, verify, options)
  local function holds(placed, force_ratio, torque_limits)
    if #placed.points == 0 or placed:quality "epsilon" <= 0 then return false end
    return not verify or verification.load(object, placed, force_ratio, torque_limits) >= verify.min_load
  end
  local force_ratio = verify and verify.force_ratio or 0
  if holds(grasp, force_ratio, true) then return nil end
  local out = {force_ratio = {}, friction = {}, effort = {holds(grasp, force_ratio, false)}}
  local world = hand.world
  local here <close> = world:snapshot()
  for i, level in ipairs(levels) do
    out.force_ratio[i] = holds(grasp, level * force_ratio, true)
    share_friction(hand, object, level)
    out.friction[i] = holds(clench.grasp(hand, object, options), force_ratio, true)
    world:restore(here)
  end
  return out
end

--- Closes the hand from starts of a search, and counts the candidates that would hold after each change.
---@param job table  of clench.plan.job
---@param next_state fun(number: integer): table?
---@param options {approach?: number, back?: table, verify?: table}
---@param seconds number  time limit [s]
---@return {looked_at: integer, friction: integer[], force_ratio: integer[], effort: integer[]}  numbers of candidates that would hold, by level
function diagnosis.of(job, next_state, options, seconds)
  local silence <close> = quiet()
  local hand, object, world = job.hand, job.object, job.world
  local here <close> = world:snapshot()
  local counts, over = {looked_at = 0, friction = {0, 0}, force_ratio = {0, 0}, effort = {0}}, clench.clock() + seconds
  local how = {approach = options.approach, back = options.back, grasp = job.grasp_options}
  for number = 1, max_tries do
    local state = clench.clock() < over and counts.looked_at < max_looked_at and next_state(number)
    if not state then break end
    local grasp = closing.close(hand, object, state, how)
    local cured = grasp and grasp.collision_free and cures(hand, object, grasp, options.verify, job.grasp_options)
    if cured then
      counts.looked_at = counts.looked_at + 1
      for name, by_level in pairs(cured) do
        for i, is_cure in ipairs(by_level) do counts[name][i] = counts[name][i] + (is_cure and 1 or 0) end
      end
    end
    world:restore(here)
  end
  return counts
end

--- The result of a diagnosis in a sentence; nil if no candidate was examined.
---@param counts table  of diagnosis.of
---@param assumed table  of clench.plan.assumptions
---@return string?
function diagnosis.text(counts, assumed)
  if counts.looked_at == 0 then return nil end
  local parts = {}
  -- the smallest level that is enough for any candidate
  local function add(by_level, format, value)
    for i, count in ipairs(by_level) do
      if count > 0 then
        parts[#parts + 1] = {count, ("%d with "):format(count) .. format:format(value and levels[i] * value, value)}
        return
      end
    end
  end
  if assumed.friction then add(counts.friction, "a friction of %.3g instead of %.3g (--friction)", assumed.friction) end
  if assumed.force_ratio then add(counts.force_ratio, "normal forces of %.4g instead of %.4g weights (--force-ratio)", assumed.force_ratio) end
  add(counts.effort, "motors without limits of effort")
  if #parts == 0 then
    return ("of %d closed candidates that hold too little, none would hold with %d times the friction, %d times the normal force or unlimited efforts"):format(
      counts.looked_at, levels[#levels], levels[#levels])
  end
  table.sort(parts, function(a, b) return a[1] > b[1] end)
  for i, part in ipairs(parts) do parts[i] = part[2] end
  return ("of %d closed candidates that hold too little, %s would hold"):format(counts.looked_at, table.concat(parts, ", "))
end

return diagnosis
