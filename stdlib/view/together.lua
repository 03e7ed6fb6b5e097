--- Drags of several bodies and robots as one rigid group, by one displacement that ends where the first of them touches something else.
local contains = require "clench.contains"
local together = {}

local halvings = 12  -- of a step that contact shortens

local function mover(thing) return clench.type(thing) == "body" and thing.robot or thing end

-- is a robot carried, directly or not, by another one of a list?
local function is_carried(robot, list)
  local below = robot.parent
  while below and not contains(list, below) do below = below.parent end
  return below ~= nil
end

--- The bodies and robots that a drag of a target moves, if the target is one of several selected ones; otherwise nil, or nil and the reason.
---@return (body|robot)[]? members
---@return string? problem
function together.members(view, target)
  local all, members = {}, {}
  for _, thing in ipairs(view.session.selection) do
    if not contains(all, mover(thing)) then all[#all + 1] = mover(thing) end
  end
  if #all < 2 or not contains(all, target) then return nil end
  for _, thing in ipairs(all) do
    local parent = clench.type(thing) == "robot" and thing.parent
    if not parent then
      members[#members + 1] = thing
    elseif not is_carried(thing, all) then
      return nil, ("%s is mounted on %s: select %s, too, or %s alone"):format(thing.name, parent.name, parent.name, thing.name)
    end
  end
  return members
end

--- Begins a drag of several, tried on a copy of the world in which they do not collide with each other.
---@param center vec3  that moves along straight lines, and about which they turn
function together.begin(view, members, center)
  local world = view.session.world:clone()
  local group, things = {center = clench.pose {xyz = center}, reached = clench.pose {}}, {}
  for i, thing in ipairs(members) do
    group[i] = {thing = thing, copy = thing:in_world(world), start = thing.pose}
    things[i] = group[i].copy
  end
  for _, robot in ipairs(world.robots) do
    if is_carried(robot, things) then things[#things + 1] = robot end
  end
  for i, one in ipairs(things) do
    for k = i + 1, #things do world:set_collision(false, one, things[k]) end
  end
  return group
end

-- Moves the copies by a displacement since the start; returns the first result that contact has shortened, nil if there is none.
local function try(group, displacement)
  for _, member in ipairs(group) do member.copy.pose = group.reached * member.start end
  for _, member in ipairs(group) do
    local result = member.copy:move_to(displacement * member.start)
    if result.fraction < 1 then return result end
  end
end

-- the displacement at a fraction of the path from the last one that was reached: its center along a straight line, with the shortest turn
local function part_way(group, displacement, fraction)
  local from, to = group.reached * group.center, displacement * group.center
  return from:interpolate(to, fraction) * group.center:inverse()
end

--- Moves all towards a displacement since the start.
---@return table result  of the move_to that was shortened, or {}
function together.move(group, displacement)
  local stop = try(group, displacement)
  if stop then
    local low, high = 0, 1
    for _ = 1, halvings do
      local middle = (low + high) / 2
      local shortened = try(group, part_way(group, displacement, middle))
      if shortened then high, stop = middle, shortened else low = middle end
    end
    displacement = part_way(group, displacement, low)
  end
  for _, member in ipairs(group) do member.thing.pose = displacement * member.start end
  group.reached = displacement
  return stop or {}
end

return together
