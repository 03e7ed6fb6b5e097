--- Points of an object's surface that face each other: on both sides of a solid, of a wall, or of everything along a ray, so that a vessel is held by its rim
--- as well as around its neck.
local facing = {}

local max_hits = 16  -- maximum number of hits per ray
local clear = 1e-5   -- offset at which a ray continues behind a hit [m]

-- Exits of the ray from a point of the surface into the object, within the friction cone and not farther away than `widest`.
local function opposite(world, object, at, inward, friction, widest)
  local point, along = object.pose * at.point, object.pose:rotate(inward)
  local list, gone, steepest = {}, clear, math.cos(math.atan(friction))
  for _ = 1, max_hits do
    local hit = gone < widest and world:raycast(point + along * gone, along, widest - gone)
    if not hit then break end
    gone = gone + hit.distance
    if hit.body == object and gone >= 1e-4 and hit.normal:dot(along) >= steepest then list[#list + 1] = {gone, hit.normal} end
    gone = gone + clear
  end
  return list, point, along
end

-- a direction within the friction cone
local function tilted(inward, random, friction)
  local side = inward:cross(random:direction())
  if side:norm() < 1e-3 then return inward end
  return clench.pose {axis = side / side:norm(), angle = random:uniform(0, math.atan(friction))}:rotate(inward)
end

--- A point opposite a point of the surface, along the normal there or, with equal probability, along a direction within the friction cone: walls of a cone face
--- each other along no normal. Flat pads align best with the mean of the two normals.
---@param at {point: vec3, normal: vec3}  of the object's mesh
---@param friction number  coefficient of the cones that contain the line between both points
---@return vec3? middle, vec3? across, number? width  in the object: midpoint; mean of the normals, from the first point to the second; distance of the points along this mean
function facing.pair(world, object, at, random, friction, widest)
  local inward = -at.normal
  if random:uniform() < 0.5 then inward = tilted(inward, random, friction) end
  local list, point, along = opposite(world, object, at, inward, friction, widest)
  if #list == 0 then return end
  local gone, normal = table.unpack(list[#list == 1 and 1 or random:integer(1, #list)])
  local X_OW = object.pose:inverse()
  local across = X_OW:rotate(normal) - at.normal
  across = across / across:norm()
  return X_OW * (point + along * (gone / 2)), across, gone * X_OW:rotate(along):dot(across)
end

--- The minimum distance of two points that face each other, from `count` random samples [m]; nil: no points face each other.
function facing.narrowest(world, object, count, friction)
  local bounds, least = object.mesh.bounds, nil
  local far = (bounds.high - bounds.low):norm()
  for _, at in ipairs(object.mesh:sample(clench.random(1), count)) do
    local first = opposite(world, object, at, -at.normal, friction, far)[1]
    if first and (not least or first[1] < least) then least = first[1] end
  end
  return least
end

return facing
