--- What a thread does with a few starts: from each the hand closes; what is in force closure is made better and verified,
--- as asked. For clench.parallel.map.
local closing = require "clench.plan.closing"
local verification = require "clench.plan.verification"

-- a state near another: the place where the hand touched, moved and turned a little, and the DOFs
local function neighbour(state, random, size, limits)
  local turn = clench.pose {axis = random:direction(), angle = random:normal() * 0.15 * size}
  local move = clench.vec3(random:normal(), random:normal(), random:normal()) * (0.006 * size)
  local dofs = {}
  for i, value in ipairs(state.dofs) do
    local low, high = limits[i][1], limits[i][2]
    local range = high - low
    local new = range < math.huge and value + random:normal() * 0.06 * size * range or value
    dofs[i] = math.max(low, math.min(high, new))
  end
  local position = state.pose.position + move
  return {pose = clench.pose {xyz = position, quat = (state.pose * turn).quat}, dofs = dofs, retreat = state.retreat}
end

-- keeps what is better, from one try to the next nearer to what is kept
local function improve(hand, object, state, grasp, random, shared)
  local limits = hand.dof_limits
  local size, kept = 1, state
  for _ = 1, shared.refine do
    local try = neighbour(kept, random, size, limits)
    local better = closing.close(hand, object, try, shared)
    if better and better.collision_free and better.epsilon > grasp.epsilon then
      grasp, kept, size = better, try, math.min(1, size * 1.5)
    else
      size = size * 0.8
    end
  end
  return grasp
end

---@param states {pose: pose, dofs: number[], retreat?: number, number: integer}[]
---@param shared {hand: robot, object: body, approach?: number, back?: table, grasp?: table, refine: integer, verify?: table, seed: integer, over?: number}  over: when there is no time left, of clench.clock
---@return {grasps: table[], rejected: table<string, integer>}  grasps: {grasp, number, numbers}
return function(states, shared)
  local hand, object = shared.hand, shared.object
  local found, rejected = {}, {}
  local function reject(why) rejected[why] = (rejected[why] or 0) + 1 end
  for _, state in ipairs(states) do
    if shared.over and clench.clock() >= shared.over then
      reject "no time left"
    else
      local grasp, why = closing.close(hand, object, state, shared)
      if not grasp then
        reject(why)
      elseif grasp.epsilon <= 0 then
        reject "no force closure"
      else
        local numbers
        if shared.refine > 0 then
          grasp = improve(hand, object, state, grasp, clench.random(shared.seed, 2 * state.number + 1), shared)
          grasp:apply(hand.world)
        end
        if shared.verify then numbers, why = verification.check(hand, object, grasp, shared.verify) end
        if shared.verify and not numbers then
          reject(why)
        else
          found[#found + 1] = {grasp = grasp, number = state.number, numbers = numbers}
        end
      end
    end
  end
  return {grasps = found, rejected = rejected}
end
