--- Finds similar grasps: the distance between the hands is less than a given fraction of the object's radius, the angle less than that fraction of half a turn,
--- and no DOF differs by more than that fraction of its range.

-- ranges of a hand's DOFs; 0: unlimited
local function ranges_of(hand)
  local ranges = {}
  for i, limit in ipairs(hand.dof_limits) do
    local range = limit[2] - limit[1]
    ranges[i] = range < math.huge and range or 0
  end
  return ranges
end

---@param hand robot
---@param object body
---@param distance number
---@return fun(grasp: grasp): boolean is_new  true if it differs from all grasps that were new before
return function(hand, object, distance)
  local ranges = ranges_of(hand)
  local approach = hand.pose:inverse() * hand.approach.point  -- in the frame of the base
  local bounds = object.mesh.bounds
  local radius = math.max((bounds.high - bounds.low):norm() / 2, 1e-6)
  local kept = {}

  local function are_alike(a, b)
    if (a.point - b.point):norm() / radius >= distance then return false end
    for i, range in ipairs(ranges) do
      if range > 0 and math.abs(a.dofs[i] - b.dofs[i]) / range >= distance then return false end
    end
    return (a.pose:inverse() * b.pose):angle() / math.pi < distance
  end

  return function(grasp)
    local pose = grasp.pose
    local new = {pose = pose, point = pose * approach, dofs = grasp.dofs}
    for _, other in ipairs(kept) do
      if are_alike(new, other) then return false end
    end
    kept[#kept + 1] = new
    return true
  end
end
