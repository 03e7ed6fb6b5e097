--- Work of a thread on a few starts: the hand closes from each; grasps in force closure are refined and verified, if the options say so. For
--- clench.parallel.map.
local closing = require "clench.plan.closing"
local neighbor = require "clench.plan.neighbor"
local opposition = require "clench.plan.opposition"
local quiet = require "clench.plan.quiet"
local touch = require "clench.plan.touch"
local verification = require "clench.plan.verification"

-- Measure that refinement increases: epsilon or, for two fingers, the load in the worst direction. The epsilon of two fingers is limited by torques about the
-- line between them, which hardly depend on the distance of that line from the center of mass; the load decreases with this distance.
local function merit_of(hand, object, shared)
  local verify = shared.verify
  if not (verify and verify.min_load > 0 and #opposition.fingers(hand) == 2) then return function(grasp) return grasp.epsilon end end
  return function(grasp)
    if grasp.epsilon < verify.min_epsilon then return 0 end
    return verification.load(object, grasp, verify.force_ratio)
  end
end

-- random local search: keeps a neighbor with a higher measure; the steps shrink after each failure and grow after a success
local function improve(hand, object, state, grasp, random, shared)
  local center = grasp.pose * (hand.pose:inverse() * hand.approach.point)
  local size, kept, merit = 1, state, merit_of(hand, object, shared)
  local best = merit(grasp)
  local quick = {approach = shared.approach, back = shared.back, grasp = shared.grasp, turn = false}
  for _ = 1, shared.refine do
    local try = neighbor(kept, center, random, size, hand, object)
    local better = closing.close(hand, object, try, quick)
    local value = better and better.collision_free and not touch.fault(shared.touch, better) and merit(better)
    if value and value > best then
      grasp, kept, best, size = better, try, value, math.min(1, size * 1.5)
    else
      size = size * 0.8
    end
  end
  return grasp, kept
end

local hopeless = 0.4  -- fraction of the required load: small changes cannot repair weaker grasps

---@param states {pose: pose, dofs: number[], retreat?: number, number: integer}[]
---@param shared {hand: robot, object: body, approach?: number, back?: table, grasp?: table, refine: integer, verify?: table, touch?: table, seed: integer, over?: number}  over: time of clench.clock at which the search ends
---@return {grasps: table[], rejected: table<string, integer>, best_load?: number}  grasps: {grasp, number, numbers, start}; best_load: largest load of the grasps that are too weak [weights]
return function(states, shared)
  local silence <close> = quiet()
  local hand, object = shared.hand, shared.object
  local found, rejected, best_load = {}, {}, nil
  local function reject(why) rejected[why] = (rejected[why] or 0) + 1 end
  local function note_load(load) best_load = math.max(load, best_load or 0) end
  local function is_hopeless(grasp)
    local asked = shared.verify and shared.refine > 0 and shared.verify.min_load or 0
    if asked <= 0 then return false end
    local load = verification.load(object, grasp, shared.verify.force_ratio)
    if load < hopeless * asked then note_load(load) end
    return load < hopeless * asked
  end
  for _, state in ipairs(states) do
    if shared.over and clench.clock() >= shared.over then
      reject "no time left"
    else
      local grasp, why = closing.close(hand, object, state, shared)
      if not grasp then
        reject(why)
      elseif grasp.epsilon <= 0 then
        reject "no force closure"
      elseif touch.fault(shared.touch, grasp) then
        reject(touch.fault(shared.touch, grasp))
      elseif is_hopeless(grasp) then
        reject(verification.too_weak)
      else
        local numbers, number = nil, state.number
        if shared.refine > 0 then
          grasp, state = improve(hand, object, state, grasp, clench.random(shared.seed, 2 * number + 1), shared)
          grasp:apply(hand.world)
        end
        local load
        if shared.verify then numbers, why, load = verification.check(hand, object, grasp, shared.verify) end
        if load then note_load(load) end
        if shared.verify and not numbers then
          reject(why)
        else
          found[#found + 1] = {grasp = grasp, number = number, numbers = numbers, start = state}
        end
      end
    end
  end
  return {grasps = found, rejected = rejected, best_load = best_load}
end
