--- Pads: the parts of fingertips that face the space between thumb and fingers. Their positions give the opening of a hand, and the point at which it holds
--- objects.
local opposition = require "clench.plan.opposition"
local pads = {}

local samples = 400       -- sampled points per fingertip
local facing = 0.8        -- minimum cosine between the normals of a pad and its direction
local depth = 0.001       -- of the pad below its foremost point [m]

-- the last link of each finger, and points of its surface, in its frame
local function tips_of(hand)
  local tips = {}
  for _, finger in ipairs(opposition.fingers(hand)) do
    local link = finger.links[#finger.links]
    if link then tips[#tips + 1] = {link = link, points = link.mesh and link.mesh:sample(clench.random(1), samples) or {}} end
  end
  return tips
end

-- the pad of a fingertip at its present pose: its middle, and half of its length along the approach, in the world
local function pad_of(tip, inward, approach)
  local pose = tip.link.pose
  local at = pose:inverse():rotate(inward)
  local front, seen = -math.huge, {}
  for _, sample in ipairs(tip.points) do
    if sample.normal:dot(at) >= facing then
      local height = sample.point:dot(at)
      seen[#seen + 1] = {sample.point, height}
      front = math.max(front, height)
    end
  end
  if #seen == 0 then
    local bounds = tip.link.bounds_in_world
    return bounds and (bounds.low + bounds.high) * 0.5 or pose.position, 0
  end
  local along, sum, count, low, high = pose:inverse():rotate(approach), clench.vec3(0, 0, 0), 0, math.huge, -math.huge
  for _, other in ipairs(seen) do
    if other[2] > front - depth then
      sum, count = sum + other[1], count + 1
      low, high = math.min(low, other[1]:dot(along)), math.max(high, other[1]:dot(along))
    end
  end
  local middle = sum / count
  return pose * (middle + at * (front - middle:dot(at))), (high - low) / 2
end

--- Describes the opening of a hand between its pads.
---@param hand robot
---@return fun(dofs: number[], thumb: vec3, finger: integer): vec3, number, number  with these DOFs: the midpoint between the thumb's pad and the others', in the world; their distance along `thumb`, negative if they passed each other; half the length of the shortest pad along the approach [m]
function pads.of(hand)
  local tips, world = tips_of(hand), hand.world
  return function(dofs, thumb, finger)
    local here <close> = world:snapshot()
    hand:set_dofs(dofs)
    local approach, reach = hand.approach.direction, math.huge
    local own, others, count = nil, clench.vec3(0, 0, 0), 0
    for i, tip in ipairs(tips) do
      local at, half = pad_of(tip, i == finger and -thumb or thumb, approach)
      if half > 0 then reach = math.min(reach, half) end
      if i == finger then own = at else others, count = others + at, count + 1 end
    end
    world:restore(here)
    others = others / count
    return (own + others) * 0.5, (own - others):dot(thumb), reach < math.huge and reach or 0
  end
end

return pads
