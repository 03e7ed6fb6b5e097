--- Tendons of a hand as straight lines between their points: length, passive force, and torques that a pull exerts on the DOFs. Posts are ignored.
local routes = {}

--- The points of a tendon, in the world.
function routes.points(tendon)
  local points = {}
  for i, at in ipairs(tendon.points) do points[i] = at.link.pose * at.point end
  return points
end

--- Its length [m].
function routes.length(tendon)
  local points, length = routes.points(tendon), 0
  for i = 2, #points do length = length + (points[i] - points[i - 1]):norm() end
  return length
end

--- The force by which it resists its stretch [N].
function routes.passive_force(tendon)
  if not tendon.rest_length then return 0 end
  return tendon.stiffness * math.max(0, routes.length(tendon) - tendon.rest_length)
end

-- velocities of a point of a tendon per DOF: three rows, or nil on the base
local function velocities_of(hand, at)
  if at.link == hand.base then return nil end
  return hand:jacobian(at.link, at.point)
end

--- Torques of a unit pull: per DOF, the rate at which the tendon becomes shorter [N m per N, or N per N].
function routes.arms(hand, tendon)
  local points, arms, velocities = routes.points(tendon), {}, {}
  for i, at in ipairs(tendon.points) do velocities[i] = velocities_of(hand, at) or false end
  for dof = 1, #hand.dofs do
    local function velocity(i) return velocities[i] and clench.vec3(velocities[i][1][dof], velocities[i][2][dof], velocities[i][3][dof]) or clench.vec3(0, 0, 0) end
    arms[dof] = 0
    for i = 2, #points do
      local along = points[i] - points[i - 1]
      if along:norm() > 0 then arms[dof] = arms[dof] - along:unit():dot(velocity(i) - velocity(i - 1)) end
    end
  end
  return arms
end

return routes
