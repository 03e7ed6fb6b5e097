--- How a hand is turned: its approach direction, and across it the way from the fingers to the thumb.
local opposition = {}

--- The frame at a point, +z along the approach and +x towards the thumb, as nearly as a right angle allows.
function opposition.frame(point, direction, thumb)
  return clench.pose {xyz = point, z_axis = direction, x_axis = thumb}
end

local function mean(points)
  local sum = clench.vec3(0, 0, 0)
  for _, p in ipairs(points) do sum = sum + p end
  return sum / #points
end

--- The direction to the chain whose tip stands farthest from the others' mean, across the approach, in the world.
function opposition.thumb(hand)
  local z = hand.approach.direction
  local tips = {}
  for _, chain in ipairs(hand.chains) do
    local last = chain.links[#chain.links]
    if last then
      local bounds = last.bounds_in_world
      tips[#tips + 1] = (bounds.low + bounds.high) * 0.5
    end
  end
  local thumb, far = nil, 1e-6
  for i, tip in ipairs(tips) do
    local others = {}
    for j, other in ipairs(tips) do
      if j ~= i then others[#others + 1] = other end
    end
    if #others > 0 then
      local way = tip - mean(others)
      way = way - z * way:dot(z)
      -- of two fingers alike the first counts
      if way:norm() > far * (1 + 1e-9) then thumb, far = way / way:norm(), way:norm() end
    end
  end
  return thumb
end

--- The pose of the hand's base where its frame of approach and thumb is the unit frame.
function opposition.base_in_frame(hand, thumb)
  local approach = hand.approach
  return opposition.frame(approach.point, approach.direction, thumb):inverse() * hand.pose
end

return opposition
