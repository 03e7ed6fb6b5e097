--- Supports of an object: the bodies, other than the hand, that it touches or overlaps by at most the contact threshold, and the directions in which they allow
--- it to move.
local Supports = {}
Supports.__index = Supports
local supports = {}

-- heights to which an object is raised until it is free of a support [contact thresholds]
local raises = {0, 0.25, 0.5, 0.75, 1.05}
local grazing = 1e-3  -- sine of the angle below which a motion into a support counts as sliding

local function moved(pose, way) return clench.pose {xyz = way} * pose end

-- the direction against gravity; +z without gravity
local function upwards(world)
  local gravity = world.gravity
  local size = gravity:norm()
  return size > 0 and gravity / -size or clench.vec3(0, 0, 1)
end

local function are_near(a, b, distance)
  if not a or not b then return false end
  for _, axis in ipairs {"x", "y", "z"} do
    if a.low[axis] > b.high[axis] + distance or b.low[axis] > a.high[axis] + distance then return false end
  end
  return true
end

-- bodies other than the hand and the object that are near enough to be supports
local function neighbors(hand, object)
  local world, is_hand, list = hand.world, {}, {}
  for _, body in ipairs(hand.bodies) do is_hand[body.name] = true end
  local bounds = object.bounds_in_world
  for _, body in ipairs(world.bodies) do
    if body ~= object and not is_hand[body.name] and are_near(body.bounds_in_world, bounds, world.contact_threshold) then
      list[#list + 1] = body
    end
  end
  return list
end

-- Contact normals of a body on the object, pointing into the object, at the lowest height where the two do not collide.
-- returns  nil: they overlap by more than the contact threshold
local function normals_of(body, object, X_WO, up)
  local world = object.world
  for _, part in ipairs(raises) do
    object.pose = moved(X_WO, up * (part * world.contact_threshold))
    if #world:colliding(object, body) == 0 then
      local normals = {}
      for i, contact in ipairs(world:contacts(body, object)) do normals[i] = contact.normal end
      return normals
    end
  end
end

--- The supports of an object at its present pose. A body that it overlaps by more than the contact threshold
--- restricts no motion.
---@param hand robot
---@param object body
---@return table
function supports.of(hand, object)
  local world = hand.world
  local here <close> = world:snapshot()
  local self = setmetatable({touched = {}, overlapped = {}, normals = {}}, Supports)
  local X_WO, up = object.pose, upwards(world)
  for _, body in ipairs(neighbors(hand, object)) do
    local normals = normals_of(body, object, X_WO, up)
    if not normals then
      table.insert(self.overlapped, body)
    elseif #normals > 0 then
      table.insert(self.touched, body)
      table.move(normals, 1, #normals, #self.normals + 1, self.normals)
    end
  end
  world:restore(here)
  return self
end

--- Do the supports allow a motion in this direction: away from them, or along them?
---@param direction vec3  of length 1
function Supports:permit(direction)
  for _, normal in ipairs(self.normals) do
    if direction:dot(normal) < -grazing then return false end
  end
  return true
end

--- Projects a further motion of a displaced object so that it slides along supports instead of entering them.
---@param displaced vec3  displacement so far [m]
---@param way vec3  further motion [m]
---@return vec3 way  [m]; zero if the object is wedged
function Supports:slide(displaced, way)
  local to = displaced + way
  for _ = 1, 4 do
    local deepest = 0
    for _, normal in ipairs(self.normals) do
      local depth = -to:dot(normal)
      if depth > 0 then to = to + normal * depth end
      deepest = math.max(deepest, depth)
    end
    if deepest <= grazing * way:norm() then return to - displaced end
  end
  return clench.vec3(0, 0, 0)  -- wedged
end

--- Disables collisions of the object with its supports, so that it can be moved along them.
function Supports:release(object)
  for _, list in ipairs {self.touched, self.overlapped} do
    for _, body in ipairs(list) do object.world:set_collision(false, object, body) end
  end
end

--- Does the object now overlap a support by more than the contact threshold, as after sliding along a concave surface?
function Supports:entered_by(object)
  local world = object.world
  for _, body in ipairs(self.touched) do
    if world:distance(object, body) == 0 and world:penetration(object, body) > world.contact_threshold then return true end
  end
  return false
end

return supports
