--- Compliance of jaws that one motor closes: they stop at the first touch; then hand or object yields by shifting and turning, and the jaws close further until
--- both press and can come no closer.
--- source  Goldberg (1993), Orienting polygonal parts without sensors: a squeezed part turns to the angle at which the jaws come closest
local opposition = require "clench.plan.opposition"
local give_way = {}

--- Does one DOF close two fingers? Then it stops at the first touch of either.
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

local max_way, max_shifts = 0.05, 4  -- maximum shift of a hand to the side [m], and maximum number of shifts
local aside = 0.2                    -- minimum cosine between a contact normal and the axis of a side that is touched

-- On which sides is the object touched: by the thumb, in the direction of `axis`, and by the other fingers?
local function sides(contacts, axis)
  local thumb, others = false, false
  for _, contact in ipairs(contacts) do
    local push = contact.normal:dot(axis)
    thumb, others = thumb or push < -aside, others or push > aside
  end
  return thumb, others
end

--- Does a closed hand touch the object from one side only?
function give_way.touches_one_side(hand, object)
  local axis = opposition.thumb(hand)
  if not axis then return false end
  local thumb, others = sides(hand.world:contacts(hand, object), axis)
  return thumb ~= others
end

-- total travel of the closing DOFs
local function closed_by(hand, dofs)
  local closed, now = 0, hand.dofs
  for i, info in ipairs(hand.dof_info) do
    if info.default_velocity ~= 0 then closed = closed + math.abs(now[i] - dofs[i]) end
  end
  return closed
end

-- The distance along `way` after which the other side of the hand touches the object [m]; nil: it never does, or another body is touched first.
local function gap_beyond(hand, object, way)
  local X_WH = hand.pose
  local move = hand:move_to(clench.pose {xyz = way * max_way} * X_WH)
  hand.pose = X_WH
  for _, pair in ipairs(move.stopped_by) do
    if pair[2] == object then return move.fraction * max_way end
  end
end

-- Closes at a pose from `dofs`. While only one side touches, shifts the hand by half of the gap on the other side. The object does not move, so its supports
-- have no influence.
-- returns  the closing travel, the pose, and the contacts; nil: the hand collides, or only one side is ever touched
local function close_between(hand, object, pose, dofs)
  hand:set_posture(pose, dofs)
  local world, axis = hand.world, opposition.thumb(hand)
  if not axis or world:collides(hand) then return end
  for _ = 0, max_shifts do
    hand:autograsp()
    local contacts = world:contacts(hand, object)
    local thumb, others = sides(contacts, axis)
    if thumb and others then return closed_by(hand, dofs), hand.pose, contacts end
    if not thumb and not others then return end
    local way = axis * (others and -1 or 1)
    local gap = gap_beyond(hand, object, way)
    if not gap then return end
    hand.pose = clench.pose {xyz = way * (gap / 2)} * hand.pose
    if world:collides(hand) then return end
  end
end

local function middle_of(contacts)
  local sum = clench.vec3(0, 0, 0)
  for _, contact in ipairs(contacts) do sum = sum + contact.point end
  return sum / #contacts
end

--- Shifts the hand to the side, around a fixed object, until both sides touch.
---@param hand robot
---@param object body
---@param pose pose  of the hand in the world at the start
---@param dofs number[]  before it closes
---@return pose?  of the hand, in the world; nil: both sides never touch
function give_way.shift(hand, object, pose, dofs)
  return select(2, close_between(hand, object, pose, dofs))
end

--- Does one DOF close all fingers, as in jaws? Then a turn moves them closer together or farther apart.
function give_way.are_jaws(hand)
  local info, fingers, closes = hand.dof_info, 0, {}
  for _, chain in ipairs(hand.chains) do
    local own = {}
    for _, joint in ipairs(chain.joints) do
      if info[joint.dof].default_velocity ~= 0 then own[joint.dof] = true end
    end
    if next(own) then fingers = fingers + 1 end
    for dof in pairs(own) do closes[dof] = (closes[dof] or 0) + 1 end
  end
  for _, count in pairs(closes) do
    if count == fingers and fingers > 1 then return true end
  end
  return false
end

local turns = {0.06, 0.02, 0.007, 0.0025}  -- tried in this order; the last one aligns the edges of a pad of 20 mm to half of the contact threshold [rad]
local min_rate = 2e-4  -- closing rate above which a turn is tried [m per rad]

-- Rate at which jaws that touch on both sides close as they turn about an axis through `middle` while the hand shifts to the side [m per rad]: each contact
-- allows its jaw to recede along the normal, but not to advance.
local function closing_rate(contacts, across, middle, axis)
  local thumb, others = math.huge, math.huge
  for _, contact in ipairs(contacts) do
    local push = contact.normal:dot(across)
    local rate = -axis:cross(contact.point - middle):dot(contact.normal) / math.abs(push)
    if push < -aside then thumb = math.min(thumb, rate) elseif push > aside then others = math.min(others, rate) end
  end
  return (thumb + others) / 2
end

--- As give_way.shift; the hand also turns about its approach direction and about the axis across it, while that brings the jaws closer together.
function give_way.turn(hand, object, pose, dofs)
  local best, at, contacts = close_between(hand, object, pose, dofs)
  if not best then return end
  local middle = middle_of(contacts)
  local z, x = hand.approach.direction, opposition.thumb(hand)
  for _, angle in ipairs(turns) do
    for _, axis in ipairs {z, z:cross(x)} do
      local forth, back = closing_rate(contacts, x, middle, axis), closing_rate(contacts, x, middle, -axis)
      if math.max(forth, back) > min_rate then
        local about = clench.pose {xyz = middle}
        local turn = clench.pose {axis = axis, angle = forth >= back and angle or -angle}
        local closed, shifted, after = close_between(hand, object, about * turn * about:inverse() * at, dofs)
        if closed and closed > best + 1e-7 then best, at, contacts = closed, shifted, after end
      end
    end
  end
  return at
end

return give_way
