--- A hand and an object as plain numbers, for engines that know nothing of ours: links as a tree of joints with meshes, masses and inertias.
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

-- the joint of a link: what its velocity has beside its parent's, found from both Jacobians at the link's origin
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
      -- the nearest point of the axis
      local point = link.pose.position + (turns and angular:cross(linear) / angular:dot(angular) or clench.vec3(0, 0, 0))
      found = {kind = turns and "revolute" or "prismatic", dof = dof - 1, ratio = axis:norm(), axis = list(axis / axis:norm()), point = list(point)}
    end
  end
  return found
end

--- Links where they are as the hand stands, in the frame of its base, which must be the world's; axes as well.
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
    dofs[i].damping, dofs[i].friction, dofs[i].armature = 0, 0, 0
  end
  for _, chain in ipairs(hand.chains) do
    for _, joint in ipairs(chain.joints) do
      local dof = dofs[joint.dof]
      for _, name in ipairs {"damping", "friction", "armature"} do dof[name] = dof[name] + (joint[name] or 0) end
    end
  end
  return {links = links, dofs = dofs}
end

local function beyond(links, number)
  local names = {}
  for n, link in ipairs(links) do
    local at = n - 1
    while at >= 0 and at ~= number do at = links[at + 1].parent end
    if at == number then names[link.name] = true end
  end
  return names
end

--- The torque of each joint of a description, in the order of its links, that balances contact forces: joints of one DOF balance
--- each its own, as engines that know no DOFs move them one by one.
---@param described table  of describe.hand
---@param hand robot  as it holds the object
---@param forces table[]  of grasp:contact_forces
function describe.torques(described, hand, forces)
  local by_name, torques = {}, {}
  for _, link in ipairs(hand.links) do by_name[link.name] = link end
  for i, link in ipairs(described.links) do
    local joint = link.joint
    if joint then
      local moved = by_name[link.name].pose * clench.pose {xyz = link.pose[1], quat = link.pose[2]}:inverse()
      local point = clench.vec3(table.unpack(joint.point))
      local from = moved * point
      local axis, carried, torque = moved * (point + clench.vec3(table.unpack(joint.axis))) - from, beyond(described.links, i - 1), 0
      for _, held in ipairs(forces) do
        if carried[held.contact.link.name] then
          local lever = joint.kind == "revolute" and axis:cross(held.contact.point - from) or axis
          torque = torque + lever:dot(held.force)
        end
      end
      torques[#torques + 1] = torque
    end
  end
  return torques
end

describe.body, describe.pose = body_of, pose_of
return describe
