--- Places of bodies and robots among others: straight down until contact, a free spot on a support, or beside everything else.
local placing = {}

local lift = 1e-3  -- height above a support from which a body is lowered [m]
local gap = 0.02  -- between the bounds of neighbors on a support [m]
local spots = 24  -- of a grid on a support, along each axis
local steps = 200  -- beside the others, at most

-- is a robot mounted on another one, or on what that one carries?
local function is_carried_by(robot, other)
  local below = robot.parent
  while below and below ~= other do below = below.parent end
  return below ~= nil
end

-- the bodies that move with a body or robot, by name
local function parts_of(thing)
  if clench.type(thing) == "body" then return {[thing.name] = true} end
  local parts = {}
  for _, robot in ipairs(thing.world.robots) do
    for _, body in ipairs((robot == thing or is_carried_by(robot, thing)) and robot.bodies or {}) do parts[body.name] = true end
  end
  return parts
end

local function merged(all, one)
  if not (all and one) then return all or one end
  local low, high = {}, {}
  for i = 1, 3 do low[i], high[i] = math.min(all.low[i], one.low[i]), math.max(all.high[i], one.high[i]) end
  return {low = clench.vec3(table.unpack(low)), high = clench.vec3(table.unpack(high))}
end

-- bounds of what moves with a thing, and the other bodies that have bounds
local function survey(thing)
  local parts, bounds, others = parts_of(thing), nil, {}
  for _, body in ipairs(thing.world.bodies) do
    local own = body.bounds_in_world
    if parts[body.name] then
      bounds = merged(bounds, own)
    elseif own then
      others[#others + 1] = {body = body, bounds = own}
    end
  end
  return bounds, others, parts
end

--- The smallest box around a body or robot, with all that it carries; nil if it has no surface.
---@return {low: vec3, high: vec3}?
function placing.bounds(thing) return (survey(thing)) end

local function shifted(pose, x, y, z) return clench.pose {xyz = {x, y, z}} * pose end

--- Names of the bodies and robots that a thing overlaps; bodies of one robot count once.
---@return string[] names
function placing.overlapped(thing)
  local names, seen, parts = {}, {}, parts_of(thing)
  for _, pair in ipairs(thing.world:colliding(thing)) do
    for _, body in ipairs(pair) do
      local name = (body.robot or body).name
      if not parts[body.name] and not seen[name] then
        seen[name] = true
        names[#names + 1] = name
      end
    end
  end
  return names
end

-- the body other than its own parts that stopped a motion
local function stopper(result, parts)
  for _, pair in ipairs(result.stopped_by or {}) do
    for _, body in ipairs(pair) do
      if not parts[body.name] then return body end
    end
  end
end

local function lower(thing, bounds, others, parts)
  local least = math.huge
  for _, other in ipairs(others) do least = math.min(least, other.bounds.low.z) end
  if least > bounds.high.z then return nil end
  local start = thing.pose
  local touched = stopper(thing:move_to(shifted(start, 0, 0, least - bounds.high.z - lift)), parts)
  if not touched then thing.pose = start end
  return touched
end

--- Moves a body or robot straight down, along -z, until it touches something.
---@return body? touched  nil: there is nothing below it, and it stays where it is
function placing.drop(thing)
  local bounds, others, parts = survey(thing)
  return bounds and lower(thing, bounds, others, parts)
end

-- do the ranges of two boxes along an axis overlap, with a distance added?
local function near(a, b, axis, distance) return a.low[axis] < b.high[axis] + distance and b.low[axis] < a.high[axis] + distance end

-- the box of a thing above a spot of a support
local function above(bounds, support, x, y)
  local half = (bounds.high - bounds.low) / 2
  local z = support.high.z + lift + half.z
  return {low = clench.vec3(x, y, z) - half, high = clench.vec3(x, y, z) + half}
end

-- spots of a support, nearest to a wish first
local function spots_on(support, size, wish)
  local list, ranges = {}, {}
  for i, axis in ipairs {"x", "y"} do
    local margin = math.min(size[axis] / 2, (support.high[axis] - support.low[axis]) / 2)
    ranges[i] = {support.low[axis] + margin, support.high[axis] - margin}
  end
  local function clamped(value, range) return math.max(range[1], math.min(range[2], value)) end
  local near_x, near_y = clamped(wish.x, ranges[1]), clamped(wish.y, ranges[2])
  list[1] = {near_x, near_y, 0}
  for i = 0, spots - 1 do
    for k = 0, spots - 1 do
      local x = ranges[1][1] + (ranges[1][2] - ranges[1][1]) * i / (spots - 1)
      local y = ranges[2][1] + (ranges[2][2] - ranges[2][1]) * k / (spots - 1)
      list[#list + 1] = {x, y, (x - near_x) ^ 2 + (y - near_y) ^ 2}
    end
  end
  table.sort(list, function(a, b)
    if a[3] ~= b[3] then return a[3] < b[3] end
    if a[1] ~= b[1] then return a[1] < b[1] end
    return a[2] < b[2]
  end)
  return list
end

local function belongs(body, support) return body == support or body.robot ~= nil and body.robot == support end

local function is_free(box, others, support)
  for _, other in ipairs(others) do
    if not belongs(other.body, support) and near(box, other.bounds, "x", gap) and near(box, other.bounds, "y", gap) and near(box, other.bounds, "z", 0) then return false end
  end
  return true
end

--- Lowers a body or robot on a support: at the free spot nearest to where it is, or to the middle of the support if it is not above that. If there is no such
--- spot, it stays where it is.
---@param support body|robot
---@return boolean placed
function placing.on(thing, support)
  local bounds, others, parts = survey(thing)
  local top = placing.bounds(support)
  if not (bounds and top) then return false end
  local start, middle, wish = thing.pose, (bounds.low + bounds.high) / 2, nil
  local is_above = middle.x > top.low.x and middle.x < top.high.x and middle.y > top.low.y and middle.y < top.high.y
  wish = is_above and middle or (top.low + top.high) / 2
  for _, spot in ipairs(spots_on(top, bounds.high - bounds.low, wish)) do
    local box = above(bounds, top, spot[1], spot[2])
    if is_free(box, others, support) then
      local by = (box.low + box.high) / 2 - middle
      thing.pose = shifted(start, by.x, by.y, by.z)
      local touched = #placing.overlapped(thing) == 0 and lower(thing, box, others, parts)
      if touched and belongs(touched, support) then return true end
    end
  end
  thing.pose = start
  return false
end

-- does an obstacle stand on another one?
local function is_covered(bounds, obstacles)
  for _, other in ipairs(obstacles) do
    local b = other.bounds_in_world
    if b and math.abs(b.low.z - bounds.high.z) < 0.05 and near(b, bounds, "x", 0) and near(b, bounds, "y", 0) then return true end
  end
  return false
end

--- Obstacles on which a new body can be put, best first: those that are at least as wide as the body in both directions, by their area seen from above; those
--- that carry other obstacles come last.
---@return body[]
function placing.supports(thing)
  local bounds, obstacles = placing.bounds(thing), thing.world.obstacles
  local size = bounds and bounds.high - bounds.low
  local list, areas = {}, {}
  for _, obstacle in ipairs(size and obstacles or {}) do
    local own = obstacle.bounds_in_world
    local extent = own and own.high - own.low
    if obstacle ~= thing and own and extent.x >= size.x and extent.y >= size.y then
      list[#list + 1] = obstacle
      areas[obstacle.name] = extent.x * extent.y * (is_covered(own, obstacles) and 1e-6 or 1)
    end
  end
  table.sort(list, function(a, b)
    if areas[a.name] ~= areas[b.name] then return areas[a.name] > areas[b.name] end
    return a.name < b.name
  end)
  return list
end

--- Moves a body or robot along +x until it overlaps nothing, with a gap to the others.
function placing.beside(thing)
  local bounds, others = survey(thing)
  if not bounds then return end
  local start, step = thing.pose, math.max(gap, (bounds.high.x - bounds.low.x) / 4)
  local farthest = -math.huge
  for _, other in ipairs(others) do farthest = math.max(farthest, other.bounds.high.x) end
  for i = 1, steps do
    thing.pose = shifted(start, i * step, 0, 0)
    if #placing.overlapped(thing) == 0 then
      thing.pose = shifted(start, i * step + gap, 0, 0)
      if #placing.overlapped(thing) == 0 then return end
    end
    if bounds.low.x + i * step > farthest then break end
  end
  thing.pose = shifted(start, math.max(0, farthest - bounds.low.x) + gap, 0, 0)
end

return placing
