--- A hand and an object as plain numbers, for other engines: links as a tree of joints with meshes, masses and inertias.
local describe = {}

local function list(v) return {v.x, v.y, v.z} end

-- position [m] and quaternion, w first
local function pose_of(X) return {list(X.position), {X.quat[1], X.quat[2], X.quat[3], X.quat[4]}} end

local function surface(body)
  if not body.mesh then return nil end
  local vertices, triangles = {}, {}
  for i, v in ipairs(body.mesh.vertices) do vertices[i] = list(v) end
  for i, t in ipairs(body.mesh.triangles) do triangles[i] = {t[1] - 1, t[2] - 1, t[3] - 1} end
  return {vertices = vertices, triangles = triangles}
end

local function body_of(body)
  return {name = body.name, mass = body.mass, com = list(body.com), inertia = body.inertia, mesh = surface(body)}
end

-- the joint of a link: its velocity relative to its parent, from both Jacobians at the link's origin
local function joint_of(hand, link, parent)
  local J, K = hand:jacobian(link, {0, 0, 0}), nil
  if parent ~= hand.base then K = hand:jacobian(parent, parent.pose:inverse() * link.pose.position) end
  local found
  for dof = 1, #hand.dofs do
    local v = {}
    for row = 1, 6 do v[row] = J[row][dof] - (K and K[row][dof] or 0) end
    local linear, angular = clench.vec3(v[1], v[2], v[3]), clench.vec3(v[4], v[5], v[6])
    local turns = angular:norm() > 1e-9
    if turns or linear:norm() > 1e-9 then
      assert(not found, link.name .. ": several joints in a row")
      local axis = turns and angular or linear
      -- the point of the axis nearest to the link's origin
      local point = link.pose.position + (turns and angular:cross(linear) / angular:dot(angular) or clench.vec3(0, 0, 0))
      found = {kind = turns and "revolute" or "prismatic", dof = dof - 1, ratio = axis:norm(), axis = list(axis / axis:norm()), point = list(point)}
    end
  end
  return found
end

--- Poses and joint axes of links in the current posture, in the frame of the base, which must be the world's.
function describe.hand(hand)
  assert(hand.pose:angle() == 0 and hand.pose.position:norm() == 0)
  local number, links, by_name = {[hand.base.name] = 0}, {}, {}
  local base = body_of(hand.base)
  base.parent, base.pose = -1, pose_of(hand.base.pose)
  links[1] = base
  for _, chain in ipairs(hand.chains) do
    local parent = chain.parent
    for _, link in ipairs(chain.links) do
      local one = body_of(link)
      one.parent, one.pose, one.joint = number[parent.name], pose_of(link.pose), joint_of(hand, link, parent)
      links[#links + 1], by_name[link.name] = one, one
      number[link.name], parent = #links - 1, link
    end
  end
  local dofs = {}
  for i, info in ipairs(hand.dof_info) do
    dofs[i] = {min = hand.dof_limits[i][1], max = hand.dof_limits[i][2], value = hand.dofs[i], max_effort = info.max_effort}
    dofs[i].damping, dofs[i].friction, dofs[i].armature, dofs[i].joints = 0, 0, 0, 0
  end
  for _, chain in ipairs(hand.chains) do
    for _, joint in ipairs(chain.joints) do
      local dof = dofs[joint.dof]
      dof.joints = dof.joints + 1
      for _, name in ipairs {"damping", "friction", "armature"} do dof[name] = dof[name] + (joint[name] or 0) end
    end
  end
  return {links = links, dofs = dofs}
end

describe.body, describe.pose = body_of, pose_of
return describe
