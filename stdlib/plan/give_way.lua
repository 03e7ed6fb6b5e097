--- What jaws do that one motor closes: they stop where the first of them touches, and go on when hand or object gives way, to the side and
--- by turning, until both press and can come no closer.
--- source  Goldberg (1993), Orienting polygonal parts without sensors: squeezed, a part turns to where the jaws come closest
local opposition = require "clench.plan.opposition"
local give_way = {}

--- does one DOF close two fingers? then it stops where the first of them touches
function give_way.is_coupled(hand)
  local info, chain_of = hand.dof_info, {}
  for number, chain in ipairs(hand.chains) do
    for _, joint in ipairs(chain.joints) do
      local other = chain_of[joint.dof]
      if other and other ~= number and info[joint.dof].default_velocity ~= 0 then return true end
      chain_of[joint.dof] = number
    end
  end
  return false
end

local max_way, max_shifts = 0.05, 4  -- how far a hand gives way to the side [m], and how often
local pressed = 0.5                  -- net push of the unit normals, above which one side alone touches

-- how far the DOFs have closed, and the sum of normals on the object across the approach
local function close(hand, object, dofs)
  hand:autograsp()
  local closed, now = 0, hand.dofs
  for i, info in ipairs(hand.dof_info) do
    if info.default_velocity ~= 0 then closed = closed + math.abs(now[i] - dofs[i]) end
  end
  local push, z, count = clench.vec3(0, 0, 0), hand.approach.direction, 0
  for _, contact in ipairs(hand.world:contacts(hand, object)) do
    push, count = push + contact.normal, count + 1
  end
  return closed, push - z * push:dot(z), count  -- to the side: what stops the palm is no reason
end

-- Closes at a pose from `dofs`, and shifts the hand by half of what is left on the other side while one side alone touches.
-- returns  how far it closed, and the pose; nil: something is in the way, or only one side is ever touched
local function close_between(hand, object, pose, dofs)
  hand:set_posture(pose, dofs)
  local world, X_WO, axis = hand.world, object.pose, opposition.thumb(hand)
  if not axis or world:collides(hand) then return end
  for _ = 0, max_shifts do
    local closed, push, count = close(hand, object, dofs)
    if count == 0 then return end
    local side = push:dot(axis)
    if math.abs(side) < pressed * math.min(count, 2) / 2 then return closed, hand.pose end
    local way = axis * (side > 0 and 1 or -1)
    local move = object:move_to(clench.pose {xyz = way * max_way} * X_WO)
    object.pose = X_WO
    if not move.touched then return end
    local left = move.fraction * max_way
    if left < 1e-4 then return closed, hand.pose end  -- the other side touches as well
    hand.pose = clench.pose {xyz = way * (-left / 2)} * hand.pose
    if world:collides(hand) then return end
  end
end

local turns = {0.06, 0.02}  -- that are tried, one after the other [rad]

--- Lets the hand give way around an object that stays: it shifts to where both sides touch, then turns about the approach and across it as
--- long as the jaws come closer by that. The hand is left closed there.
---@param hand robot
---@param object body
---@param pose pose  of the hand in the world, where it begins
---@param dofs number[]  before it closes
---@return pose?  of the hand, in the world; nil: both sides never touch
function give_way.hand(hand, object, pose, dofs)
  local best, at = close_between(hand, object, pose, dofs)
  if not best then return end
  local z, x = hand.approach.direction, opposition.thumb(hand)
  local axes = {z, z:cross(x)}
  for _, angle in ipairs(turns) do
    for _, axis in ipairs(axes) do
      for _, sign in ipairs {1, -1} do
        local about = clench.pose {xyz = hand.approach.point}
        local points = hand.world:contacts(hand, object)
        if #points > 0 then
          local sum = clench.vec3(0, 0, 0)
          for _, contact in ipairs(points) do sum = sum + contact.point end
          about = clench.pose {xyz = sum / #points}
        end
        local turned = about * clench.pose {axis = axis, angle = sign * angle} * about:inverse() * at
        local closed, shifted = close_between(hand, object, turned, dofs)
        if closed and closed > best + 1e-6 then
          best, at = closed, shifted
          break
        end
      end
    end
  end
  return select(2, close_between(hand, object, at, dofs))
end

return give_way
