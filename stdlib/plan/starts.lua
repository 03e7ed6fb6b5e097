--- Starts of the hand: in front of a point of the object's surface, facing it, or around two points that face each other; opened more or less. See
--- plan.neighbor for starts near successful ones.
local facing = require "clench.plan.facing"
local level = require "clench.plan.level"
local opposition = require "clench.plan.opposition"
local pads = require "clench.plan.pads"
local supports = require "clench.plan.supports"
local starts = {}

local far_away = clench.pose {xyz = {0, 0, 9.5}}  -- away from all bodies except the hand

-- Pairs of the hand's own parts that collide with these DOFs.
local function self_collisions(hand, dofs)
  hand:set_posture(far_away * hand.pose, dofs)
  return #hand.world:colliding(hand)
end

-- With more links, moving one DOF at a time takes too long: its time grows with the fourth power of the number of links.
local many_links = 64

-- Moves all closing DOFs back together, by the smallest fraction of their ranges that leaves the fewest collisions.
local function freed_together(hand, dofs, count)
  local best, limits, info = dofs, hand.dof_limits, hand.dof_info
  for part = 0.1, 0.9, 0.1 do
    if count == 0 then break end
    local moved = {}
    for i, value in ipairs(dofs) do
      local low, high = table.unpack(limits[i])
      local far = math.abs(value - low) > math.abs(value - high) and low or high
      local closes = info[i].default_velocity ~= 0 and high - low < math.huge
      moved[i] = closes and value + part * (far - value) or value
    end
    local left = self_collisions(hand, moved)
    if left < count then best, count = moved, left end
  end
  return best
end

-- For hands that collide with themselves when open (a thumb in the palm): moves back the DOF that resolves most collisions by the smallest motion, then the
-- next one.
local function freed(hand, dofs)
  local world = hand.world
  local here <close> = world:snapshot()
  local count = self_collisions(hand, dofs)
  if #hand.links > many_links then
    dofs = freed_together(hand, dofs, count)
    world:restore(here)
    return dofs
  end
  local limits = hand.dof_limits
  for _ = 1, #dofs do
    if count == 0 then break end
    local best
    for part = 0.1, 0.6, 0.1 do
      for i, value in ipairs(dofs) do
        local low, high = limits[i][1], limits[i][2]
        if high - low < math.huge then
          local far = math.abs(value - low) > math.abs(value - high) and low or high
          dofs[i] = value + part * (far - value)
          local left = self_collisions(hand, dofs)
          if left < count then count, best = left, {i, dofs[i]} end
          dofs[i] = value
        end
      end
      if best then break end
    end
    if not best then break end
    dofs[best[1]] = best[2]
  end
  world:restore(here)
  return dofs
end

--- Returns the DOFs of the open hand, free of collision with itself if possible, and which DOFs move in closing.
function starts.opened(hand)
  local world = hand.world
  local here <close> = world:snapshot()
  world:set_collision(false, hand)
  hand:open()
  local open = hand.dofs
  world:restore(here)
  local closes = {}
  for i, info in ipairs(hand.dof_info) do closes[i] = info.default_velocity ~= 0 end
  return freed(hand, open), closes
end

-- The DOFs, closed by a fraction of the range (one number, or one per DOF), and spread by a fraction of the distance to `values` in the range.
local function posture(hand, closed, spread, values)
  local dofs = {}
  for i, value in ipairs(hand.open) do
    local low, high = hand.limits[i][1], hand.limits[i][2]
    if not (high - low < math.huge) then
      dofs[i] = value
    elseif hand.closes[i] then
      local far = math.abs(value - low) > math.abs(value - high) and low or high
      dofs[i] = value + (type(closed) == "table" and closed[i] or closed) * (far - value)
    else
      dofs[i] = spread == 0 and value or value + spread * (low + values[i] * (high - low) - value)
    end
  end
  return dofs
end

local max_closed = 0.35  -- maximum closed fraction of a start

-- Closed by a random fraction, at most `max`; DOFs that do not move in closing (a spread) get random values, or values nearer to the open posture if the hand
-- would otherwise collide with itself.
local function random_posture(hand, random, max)
  local closed, values = random:uniform(0, max), {}
  for i in ipairs(hand.open) do values[i] = random:uniform() end
  for spread = 1, 0, -0.25 do
    local dofs = posture(hand, closed * spread, spread, values)
    hand.robot:set_posture(far_away * hand.robot.pose, dofs)
    local free = not hand.robot.world:collides(hand.robot)
    hand.robot.world:restore(hand.before)
    if free then return dofs end
  end
  return hand.open
end

starts.clearance = 0.002  -- free space that is left on both sides together of an object between the pads [m]
local closing_steps = 12  -- number of steps at which the distance between the pads is computed

-- The hand as it closes in free air: distance between its pads in decreasing order, and the pose of the base relative to the frame of approach and thumb in the
-- middle between the pads.
local function closings(self, thumb, finger)
  local measure, list = pads.of(self.robot), {}
  for i = 0, closing_steps do
    local closed = i / closing_steps
    local middle, width, pad = measure(posture(self, closed, 0), thumb, finger)
    local last = list[#list]
    if last and width >= last.width then
      if i > closing_steps / 2 or width <= 0 then break end
      list = {}  -- it opens first
    end
    list[#list + 1] = {closed = closed, width = width, pad = pad, X_FH = opposition.base_in_frame(self.robot, middle, self.across)}
    if width <= 0 then break end
  end
  return list
end

-- Data shared by all starts of a hand. The thumb is identified on the open hand; the hand holds objects between the pads of thumb and fingers.
local function describe(hand)
  local before = hand.world:snapshot()
  local open, closes = starts.opened(hand)
  hand:set_dofs(open)
  local thumb, finger = opposition.thumb(hand)
  hand.world:restore(before)
  local self = {robot = hand, before = before, open = open, closes = closes, limits = hand.dof_limits, has_thumb = thumb ~= nil}
  local z = hand.approach.direction
  self.across = thumb or z:cross(math.abs(z.z) < 0.9 and clench.vec3(0, 0, 1) or clench.vec3(1, 0, 0))
  local middle = hand.approach.point
  if thumb then
    self.closings = closings(self, thumb, finger)
    self.aperture = self.closings[1].width
    self.is_two_fingered = #opposition.fingers(hand) == 2
    self.thumb = finger
    middle = opposition.middle(hand, posture(self, 0.5, 0), finger)
  end
  self.X_FH = opposition.base_in_frame(hand, middle, self.across)
  return self
end

--- The opening width of the hand between thumb and fingers [m]; nil: it has no thumb.
function starts.aperture(hand)
  return describe(hand).aperture
end

-- The hand with this distance between its pads: closed fraction, pose of the base in the frame of approach and thumb at their middle, and half of the length of
-- the pads.
local function holding(self, width)
  local list = self.closings
  local i = 1
  while i < #list and list[i + 1].width >= width do i = i + 1 end
  local a, b = list[i], list[i + 1] or list[i]
  local part = a.width > b.width and math.max(0, math.min(1, (a.width - width) / (a.width - b.width))) or 0
  -- the frames differ by a translation only
  local shift = (b.X_FH.position - a.X_FH.position) * part
  return a.closed + part * (b.closed - a.closed), clench.pose {xyz = shift} * a.X_FH, a.pad
end

local surface_points = 4096  -- number of points sampled on the surface, from which starts are chosen

local function any_of(list, random) return list[random:integer(1, #list)] end

local function unit(v)
  local size = v:norm()
  return size > 1e-3 and v / size or nil
end

local function across(direction, random) return unit(direction:cross(random:direction())) end

local max_upward = 0.3  -- cosine between approach and up direction: steeper approaches from below are rejected

--- An approach direction across a line, from any side. If the object has a support, never from below, and straight down in half of the cases.
local function approach_across(hand, line, random)
  local up = hand.up
  if not up then return across(line, random) end
  if random:uniform() < 0.5 then
    local down = unit(line * up:dot(line) - up)
    if down then return down end
  end
  local direction = across(line, random)
  return direction and direction:dot(up) > 0 and -direction or direction
end

--- A start in front of a point of the surface, along its normal or tilted.
local function before_surface(hand, surface, random, standoff)
  local at = any_of(surface, random)
  local direction = -at.normal
  if hand.up and direction:dot(hand.up) > max_upward then return end
  local axis = across(direction, random)
  if axis then direction = clench.pose {axis = axis, angle = random:normal() * 0.4}:rotate(direction) end
  local side = across(direction, random)
  if not side then return end
  return {pose = opposition.frame(at.point - direction * standoff, direction, side) * hand.X_FH,
          dofs = random_posture(hand, random, max_closed), retreat = math.max(0, random:uniform(-0.03, 0.03))}
end

local to_palm = 0.06      -- maximum further travel until the palm touches [m]
local approach_distances = {0, 0.025, 0.06}  -- distances before the closing pose at which the hand must also be free of collision [m]

-- Does the hand reach its closing pose without collision, so that the chosen points get between its pads?
local function gets_there(hand, object, direction, pose, dofs)
  local robot, X_WO = hand.robot, object.pose
  local free = true
  for _, back in ipairs(approach_distances) do
    robot:set_posture(X_WO * clench.pose {xyz = direction * -back} * pose, dofs)
    free = not robot.world:collides(robot)
    if not free then break end
  end
  robot.world:restore(hand.before)
  return free
end

local max_points = 12  -- maximum number of points from which two fingers choose one

-- lever arm of the weight about the normal line of a point of the surface [m]
local function lever_at(at, com) return (com - at.point):cross(at.normal):norm() end

-- A random point of the surface. Two fingers resist torques about the line between them by friction only, so for them several points are sampled, and the point
-- whose normal passes nearest to the center of mass is taken.
local function surface_point(hand, object, surface, random)
  local best = any_of(surface, random)
  if not hand.is_two_fingered then return best end
  local com = object.com
  local least = lever_at(best, com)
  for _ = 2, random:integer(2, max_points) do
    local other = any_of(surface, random)
    local lever = lever_at(other, com)
    if lever < least then best, least = other, lever end
  end
  return best
end

local sides = 4                -- number of approach directions that are tried for two points
local shallow = -0.85          -- depth at which little more than the ends of the pads reach the points [half pads]
local finger_clearance = 0.006  -- free distance that a finger needs beside a point [m]

local behind = 1e-3  -- depth below the surface at which a ray for obstacles begins: more than the gap to a support [m]

-- Is there enough free space for a finger beside a point of the object?
-- point, direction, inside  point of the surface and unit vector out of the object, in the world; depth at which the ray begins [m]
local function is_clear(world, object, point, direction, inside)
  local passed, reach = 0, inside + finger_clearance
  for _ = 1, 4 do
    local hit = world:raycast(point + direction * (passed - inside), direction, reach - passed)
    if not hit then return true end
    passed = passed + hit.distance
    local enters = hit.normal:dot(direction) < 0 and passed > inside + 1e-5
    if hit.body ~= object or enters then return false end
    passed = passed + 1e-6
    if passed >= reach then return true end
  end
  return true
end

-- Is there enough free space for a finger beside each of two points?
-- middle, line, apart  midpoint of the points, unit vector from one to the other, and their distance [m], in the object's frame
local function is_clear_beside(world, object, middle, line, apart)
  local inside = math.min(behind, apart / 2)
  for _, sign in ipairs {-1, 1} do
    local direction = object.pose:rotate(line * sign)
    if not is_clear(world, object, object.pose * (middle + line * (sign * apart / 2)), direction, inside) then return false end
  end
  return true
end

-- Finds a direction across the line from which jaws reach the points without collision: at a random depth, or else with little more than the ends of their
-- pads.
-- returns  the approach direction, and the distance from the middle of the points to the middle of the pads along it [m]; nil without such a direction
local function free_side(hand, object, middle, line, pad, X_FH, dofs, random)
  for _ = 1, sides do
    local direction, part = approach_across(hand, line, random), random:uniform(-0.7, 0.7)
    for _, deeper in ipairs(direction and {part * pad, shallow * pad} or {}) do
      local pose = opposition.frame(middle + direction * deeper, direction, line) * X_FH
      if gets_there(hand, object, direction, pose, dofs) then return direction, deeper end
    end
  end
end

--- A start with the thumb on one of two points that face each other and the fingers on the other, from any side across that line.
---@param checked boolean  for jaws: only directions from which the hand reaches the points without collision
local function about_two_points(hand, world, object, surface, random, options, checked, is_level)
  local width = math.min(options.width, hand.aperture - starts.clearance)
  local middle, line, apart = facing.pair(world, object, surface_point(hand, object, surface, random), random, options.friction, width)
  if not middle or hand.up and not is_clear_beside(world, object, middle, line, apart) then return end
  if hand.level and checked and is_level then
    local function reaches(direction, pose, dofs) return gets_there(hand, object, direction, pose, dofs) end
    return level.start(hand, {middle = middle, line = line, apart = apart}, random, options.standoff, starts.clearance, reaches)
  end
  local closed, X_FH, pad = holding(hand, apart + starts.clearance)
  local dofs = random:uniform() < 0.5 and hand.open or random_posture(hand, random, math.min(max_closed, closed))
  local direction, deeper
  if hand.is_two_fingered and checked then
    direction, deeper = free_side(hand, object, middle, line, pad, X_FH, dofs, random)
  else
    direction = approach_across(hand, line, random)
    deeper = hand.is_two_fingered and random:uniform(-0.7, 0.7) * pad or random:uniform(-0.01, 0.02)
  end
  if not direction then return end
  if hand.is_two_fingered and random:uniform() < 0.3 then deeper = to_palm end
  local start = middle - direction * options.standoff
  return {pose = opposition.frame(start, direction, line) * X_FH, dofs = dofs, reach = options.standoff + deeper}
end

-- The mean normal of an object's supports, in its frame; nil: it has no support, or its supports oppose each other.
local function up_of(on, object)
  local sum = clench.vec3(0, 0, 0)
  for _, normal in ipairs(on.normals) do sum = sum + normal / #on.normals end
  return sum:norm() > 0.7 and object.pose:inverse():rotate(sum / sum:norm()) or nil
end

local max_tries = 200  -- maximum number of attempts to find two points that face each other

--- The start with a given number, which depends only on the seed and this number.
---@param job table  of clench.plan.job
---@param options {standoff: number, friction: number, width: number, kind: string}  kind: "antipodal", or "both" in alternation
---@return fun(number: integer): table?
function starts.random(job, options)
  local hand, object, world = describe(job.hand), job.object, job.world
  hand.up = up_of(supports.of(job.hand, object), object)
  if hand.up and hand.has_thumb and not hand.is_two_fingered then
    hand.level = level.of(hand, object, hand.thumb, function(parts) return posture(hand, parts, 0) end)
  end
  local surface = object.mesh:sample(clench.random(job.seed, 0), surface_points)
  return function(number)
    local paired = hand.has_thumb and (options.kind == "antipodal" or number % (hand.is_two_fingered and 8 or 2) ~= 1)
    for try = 1, max_tries do
      local random = clench.random(job.seed, number * max_tries + try)
      local state
      if paired then
        state = about_two_points(hand, world, object, surface, random, options, try < max_tries, number % 4 ~= 0)
      else
        state = before_surface(hand, surface, random, options.standoff)
      end
      if state then return state end
      -- an object without such pairs, or without pairs that the hand can reach, is approached along its normals
      if try == max_tries // 2 and options.kind ~= "antipodal" then paired = false end
    end
  end
end

return starts
