--- The grasp frame of a hand: its approach direction, the direction across it from the fingers to the thumb, and the point between them at which it holds
--- objects.
local opposition = {}

--- The frame at a point, +z along the approach and +x towards the thumb, as closely as orthogonality allows.
function opposition.frame(point, direction, thumb)
  return clench.pose {xyz = point, z_axis = direction, x_axis = thumb}
end

local function mean(points)
  local sum = clench.vec3(0, 0, 0)
  for _, p in ipairs(points) do sum = sum + p end
  return sum / #points
end

--- Chains with a closing DOF: palms, wrists and chains that only mark a frame are not fingers. All chains if nothing closes.
function opposition.fingers(hand)
  local info, fingers = hand.dof_info, {}
  for _, chain in ipairs(hand.chains) do
    local is_finger = false
    for _, joint in ipairs(chain.joints) do is_finger = is_finger or info[joint.dof].default_velocity ~= 0 end
    if is_finger then fingers[#fingers + 1] = chain end
  end
  return #fingers > 0 and fingers or hand.chains
end

local function tips_of(hand)
  local tips = {}
  for _, chain in ipairs(opposition.fingers(hand)) do
    local last = chain.links[#chain.links]
    if last then
      local bounds = last.bounds_in_world  -- nil for a frame without a surface, by which URDF files mark a tip
      tips[#tips + 1] = bounds and (bounds.low + bounds.high) * 0.5 or last.pose.position
    end
  end
  return tips
end

local function all_but(points, number)
  local others = {}
  for i, p in ipairs(points) do
    if i ~= number then others[#others + 1] = p end
  end
  return others
end

--- The direction to the finger whose tip is farthest from the mean of the others, across the approach, in the world.
---@return vec3? direction, integer? finger  index of the tip; nil: no two fingers are apart
function opposition.thumb(hand)
  local z = hand.approach.direction
  local tips = tips_of(hand)
  local thumb, far, number = nil, 1e-6, nil
  for i, tip in ipairs(tips) do
    local others = all_but(tips, i)
    if #others > 0 then
      local way = tip - mean(others)
      way = way - z * way:dot(z)
      -- of two equal fingers the first is taken
      if way:norm() > far * (1 + 1e-9) then thumb, far, number = way / way:norm(), way:norm(), i end
    end
  end
  return thumb, number
end

--- The midpoint between the thumb's tip and the mean of the others with these DOFs, in the world.
---@param finger integer  the thumb, as of opposition.thumb
function opposition.middle(hand, dofs, finger)
  local world = hand.world
  local here <close> = world:snapshot()
  hand:set_dofs(dofs)
  local tips = tips_of(hand)
  local others = mean(all_but(tips, finger))
  world:restore(here)
  return (tips[finger] + others) * 0.5
end

--- The pose of the hand's base at which its frame of approach and thumb, now at a given point of the world, coincides with the world frame.
function opposition.base_in_frame(hand, point, thumb)
  return opposition.frame(point, hand.approach.direction, thumb):inverse() * hand.pose
end

return opposition
