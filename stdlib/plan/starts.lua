--- Where a hand may begin: before a point of the object's surface, looking at it, more or less opened.
local starts = {}

--- A pose whose +z is a direction, turned about it by an angle.
function starts.looking(point, direction, angle)
  local z = direction / direction:norm()
  local side = math.abs(z.z) < 0.9 and clench.vec3(0, 0, 1) or clench.vec3(1, 0, 0)
  local turned = clench.pose {axis = z, angle = angle}:rotate(side)
  return clench.pose {xyz = point, z_axis = z, x_axis = turned}
end

--- Which DOFs closing moves, and how the hand is when it is open.
function starts.opened(hand)
  local world = hand.world
  local here <close> = world:snapshot()
  world:set_collision(false, hand)
  hand:open()
  local open = hand.dofs
  world:restore(here)
  local closes = {}
  for i, info in ipairs(hand.dof_info) do closes[i] = info.default_velocity ~= 0 end
  return open, closes
end

--- The pose of the hand's base in its approach frame.
function starts.base_in_approach(hand)
  local approach = hand.approach
  local frame = starts.looking(approach.point, approach.direction, 0)
  return frame:inverse() * hand.pose
end

return starts
