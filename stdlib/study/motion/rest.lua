--- Detects that everything in a world has come to rest. A touching body at rest stays bit-exactly in its place, and a step from the same state under the same
--- forces gives the same state: such a simulation no longer changes, so the rest of its time need not be simulated.
local rest = {}

local parts_at_rest = 4  -- number of successive parts of a simulation without motion

local function is_zero(v) return v.x == 0 and v.y == 0 and v.z == 0 end

-- Do all objects and DOFs have the velocity 0?
local function are_at_rest(world)
  for _, object in ipairs(world.objects) do
    local velocity = object.velocity
    if not (is_zero(velocity.linear) and is_zero(velocity.angular)) then return false end
  end
  for _, robot in ipairs(world.robots) do
    for _, speed in ipairs(robot.dof_velocities) do
      if speed ~= 0 then return false end
    end
  end
  return true
end

-- poses of all objects, and all DOFs
local function coordinates(world)
  local list = {}
  for _, object in ipairs(world.objects) do
    local pose = object.pose
    for _, v in ipairs {pose.position, pose:rotate(clench.vec3(1, 0, 0)), pose:rotate(clench.vec3(0, 1, 0))} do
      table.move({v.x, v.y, v.z}, 1, 3, #list + 1, list)
    end
  end
  for _, robot in ipairs(world.robots) do
    local dofs = robot.dofs
    table.move(dofs, 1, #dofs, #list + 1, list)
  end
  return list
end

local function are_equal(a, b)
  for i, value in ipairs(a) do
    if value ~= b[i] then return false end
  end
  return true
end

---@param world world
---@return fun(): boolean  called after each part of a simulation: has everything been bit-exactly at rest in the last few parts?
function rest.detector(world)
  local count, last = 0, nil
  return function()
    if not are_at_rest(world) then
      count, last = 0, nil
      return false
    end
    local now = coordinates(world)
    count = last and are_equal(now, last) and count + 1 or 0
    last = now
    return count >= parts_at_rest
  end
end

return rest
