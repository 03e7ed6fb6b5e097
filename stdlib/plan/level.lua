--- Starts of hands with several fingers around objects that lie on a support and are lower than a fingertip. The hand moves straight down, tilted so that
--- the ends of thumb and fingers are at the same height just above the support, and closes parallel to it.
local opposition = require "clench.plan.opposition"
local level = {}

local samples = 400        -- number of points sampled on each fingertip
local directions = 48      -- number of directions in which the farthest of these points is kept
local coarse = 20          -- number of points sampled on each other link
local steps = 16           -- number of closing steps at which the ends are computed
local curls = {0, 0.4, 1}  -- closing of distal joints as a fraction of that of the first joint
local max_tilt = 0.7       -- minimum cosine between the approach direction of the hand and the direction in which it moves down
local min_low = 0.04       -- objects up to this height are low for every hand [m]
local steepest = 0.5       -- maximum sine of the angle between the support and the line between two points
local heights = {0.001, 0.003}  -- minimum and maximum height of the ends above the support [m]
local turn_spread = 0.25   -- standard deviation of the rotation about the upward direction [rad]
local wider = 0.004        -- maximum additional opening beyond the distance of the points and the clearance [m]

-- Evenly distributed directions, on a spiral around the sphere.
local function spiral(count)
  local out, turn = {}, math.pi * (3 - math.sqrt(5))
  for k = 1, count do
    local z = 1 - (2 * k - 1) / count
    local r = math.sqrt(1 - z * z)
    out[k] = clench.vec3(r * math.cos(k * turn), r * math.sin(k * turn), z)
  end
  return out
end

-- The point farthest along a direction, its coordinate along it, and its index.
local function end_of(points, direction)
  local best, far = 1, -math.huge
  for i, point in ipairs(points) do
    local along = point:dot(direction)
    if along > far then best, far = i, along end
  end
  return points[best], far, best
end

-- The points that are farthest along one of the directions, each once, in their order.
local function extreme(points, directions)
  local is_extreme, out = {}, {}
  for _, direction in ipairs(directions) do
    local _, _, best = end_of(points, direction)
    is_extreme[best] = true
  end
  for i, point in ipairs(points) do
    if is_extreme[i] then out[#out + 1] = point end
  end
  return out
end

local function part_of(link, is_tip)
  local points = {}
  for k, sample in ipairs(link.mesh:sample(clench.random(1), is_tip and samples or coarse)) do points[k] = sample.point end
  return {link = link, points = is_tip and extreme(points, spiral(directions)) or points, is_tip = is_tip}
end

-- Sampled points of the thumb and of all other fingers, per link, in the frames of the links.
local function links_of(hand, thumb)
  local own, others = {}, {}
  for i, finger in ipairs(opposition.fingers(hand)) do
    local list, is_tip = i == thumb and own or others, true
    for k = #finger.links, 1, -1 do
      local link = finger.links[k]
      if link.mesh then
        list[#list + 1] = part_of(link, is_tip)
        is_tip = false
      end
    end
  end
  return own, others
end

local function in_world(list)
  local out = {}
  for _, part in ipairs(list) do
    local pose = part.link.pose
    for _, point in ipairs(part.points) do out[#out + 1] = pose * point end
  end
  return out
end

-- Does the point with this index belong to a fingertip? The lowest point of a strongly curled finger is a knuckle.
local function is_on_tip(list, number)
  for _, part in ipairs(list) do
    number = number - #part.points
    if number <= 0 then return part.is_tip end
  end
end

-- The direction, in the plane of approach and thumb, along which the ends of thumb and fingers reach equally far.
-- returns  this direction, and the direction perpendicular to it from the fingers to the thumb; nil: it is tilted too far from the approach direction
local function level_direction(thumb, others, approach, across)
  local z, x = approach, across
  for _ = 1, 4 do
    local to_thumb = end_of(thumb, z) - end_of(others, z)
    to_thumb = to_thumb - z:cross(x) * to_thumb:dot(z:cross(x))
    if to_thumb:dot(x) <= 0 then return end
    local y = z:cross(x)
    x = to_thumb / to_thumb:norm()
    z = x:cross(y)
  end
  if z:dot(approach) >= max_tilt then return z, x end
end

-- Of the points within `height` of the end along z: the maximum along x, the middle of the range along y, and the coordinate of the end.
local function front_of(points, z, x, y, height)
  local _, far = end_of(points, z)
  local front, low, high = -math.huge, math.huge, -math.huge
  for _, point in ipairs(points) do
    if point:dot(z) > far - height then
      front = math.max(front, point:dot(x))
      low, high = math.min(low, point:dot(y)), math.max(high, point:dot(y))
    end
  end
  return front, (low + high) / 2, far
end

-- For the current posture: the distance between the ends of thumb and fingers, and the pose of the base in the frame between them. nil: they are not level.
local function ends_of(self, own, others, height)
  local thumb, fingers = in_world(own), in_world(others)
  local z, x = level_direction(thumb, fingers, self.robot.approach.direction, self.across)
  if not z or not is_on_tip(own, select(3, end_of(thumb, z))) or not is_on_tip(others, select(3, end_of(fingers, z))) then return end
  local y = z:cross(x)
  local near, beside, far = front_of(thumb, z, -x, y, height)
  local other_near, other_beside, other_far = front_of(fingers, z, x, y, height)
  local middle = x * ((other_near - near) / 2) + y * ((beside + other_beside) / 2) + z * math.max(far, other_far)
  return -near - other_near, opposition.frame(middle, z, x):inverse() * self.robot.pose
end

-- Length of the shortest fingertip: the longest side of its bounding box [m].
local function tip_length(hand)
  local shortest = math.huge
  for _, finger in ipairs(opposition.fingers(hand)) do
    for i = #finger.links, 1, -1 do
      local mesh = finger.links[i].mesh
      if mesh then
        local size = mesh.bounds.high - mesh.bounds.low
        shortest = math.min(shortest, math.max(size.x, size.y, size.z))
        break
      end
    end
  end
  return shortest
end

-- Minimum and maximum coordinate of the object along a direction in its frame [m].
local function extent(object, up)
  local low, high = math.huge, -math.huge
  for _, vertex in ipairs(object.mesh.vertices) do
    local height = up:dot(vertex)
    low, high = math.min(low, height), math.max(high, height)
  end
  return low, high
end

-- For each DOF that moves in closing: is it distal (not the first of its finger), and does it belong to the thumb?
local function roles(hand, thumb)
  local info, distal, of_thumb = hand.dof_info, {}, {}
  for i, finger in ipairs(opposition.fingers(hand)) do
    local is_first = true
    for _, joint in ipairs(finger.joints) do
      if info[joint.dof].default_velocity ~= 0 then
        if distal[joint.dof] == nil then distal[joint.dof] = not is_first end
        of_thumb[joint.dof] = i == thumb
        is_first = false
      end
    end
  end
  return distal, of_thumb
end

--- The postures in which the ends of the fingertips are level, with the distances between thumb and fingers.
---@param self table  of plan.starts, with `up`
---@param object body
---@param thumb integer  index of the thumb among the fingers
---@param posture fun(closed: number[]): number[]  DOFs of the hand, each closed by a fraction of its range
---@return {support: number, families: table[], at: fun(dofs: number[]): number?, pose?}?  height of the support [m];
---  postures by closing, one family per curl of thumb and fingers; distance between the ends [m] and pose of the base between them. nil: the object is not low
function level.of(self, object, thumb, posture)
  local hand = self.robot
  local low, high = extent(object, self.up)
  if high - low > math.max(tip_length(hand), min_low) then return end
  local here <close> = hand.world:snapshot()
  local own, others = links_of(hand, thumb)
  local distal, of_thumb = roles(hand, thumb)
  local out = {support = low, families = {}}
  function out.at(dofs)
    hand:set_dofs(dofs)
    return ends_of(self, own, others, high - low)
  end
  local function dofs_of(closed, thumb_curl, finger_curl)
    local parts = {}
    for i in ipairs(self.open) do parts[i] = closed * (distal[i] and (of_thumb[i] and thumb_curl or finger_curl) or 1) end
    return posture(parts)
  end
  for _, thumb_curl in ipairs(curls) do
    for _, finger_curl in ipairs(curls) do
      local family = {}
      for i = 0, steps do
        local dofs = dofs_of(i / steps, thumb_curl, finger_curl)
        family[#family + 1] = {width = out.at(dofs) or -1, dofs = dofs}
      end
      out.families[#out.families + 1] = family
    end
  end
  hand.world:restore(here)
  return out
end

-- DOFs at which the ends have about this distance, from a family chosen at random.
local function dofs_at(families, width, random)
  local all = {}
  for _, family in ipairs(families) do
    for i = 1, #family - 1 do
      local a, b = family[i], family[i + 1]
      if a.width >= width and b.width >= 0 and b.width < width then all[#all + 1] = {a, b} end
    end
  end
  if #all == 0 then return end
  local a, b = table.unpack(all[random:integer(1, #all)])
  local part, dofs = (a.width - width) / (a.width - b.width), {}
  for i, value in ipairs(a.dofs) do dofs[i] = value + part * (b.dofs[i] - value) end
  return dofs
end

--- A start straight above two points that face each other parallel to the support.
---@param self table  of plan.starts, with `up` and `level`
---@param between {middle: vec3, line: vec3, apart: number}  the points, in the object's frame
---@param clearance number  [m]
---@param reaches fun(direction: vec3, pose: pose, dofs: number[]): boolean  is the hand free of collision there and on its approach?
---@return table?
function level.start(self, between, random, standoff, clearance, reaches)
  local up, line = self.up, between.line
  if math.abs(line:dot(up)) > steepest then return end
  line = line - up * line:dot(up)
  line = line / line:norm() * (random:uniform() < 0.5 and -1 or 1)
  -- the row of fingers need not be perpendicular to the direction to the thumb
  line = clench.pose {axis = up, angle = random:normal() * turn_spread}:rotate(line)
  local dofs = dofs_at(self.level.families, between.apart + clearance + random:uniform(0, wider), random)
  if not dofs then return end
  local width, X_LH = self.level.at(dofs)
  self.robot.world:restore(self.before)
  if not width then return end
  local middle = between.middle
  local at = middle + up * (self.level.support + random:uniform(table.unpack(heights)) - middle:dot(up))
  local pose = opposition.frame(at, -up, line) * X_LH
  if not reaches(-up, pose, dofs) then return end
  return {pose = opposition.frame(at + up * standoff, -up, line) * X_LH, dofs = dofs, reach = standoff}
end

return level
