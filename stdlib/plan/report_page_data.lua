--- What the 3-D view of a report page draws: each mesh once, and where the bodies stand in each grasp.
local base64 = require "clench.base64"
local report_rows = require "clench.plan.report_rows"

local large = 200000  -- triangles of a mesh that a page is slow with

-- numbers in packs of some hundred: string.pack takes no more at once
local function packed(format, count, number)
  local parts, values = {}, {}
  for i = 1, count do
    values[#values + 1] = number(i)
    if #values == 192 or i == count then
      parts[#parts + 1] = string.pack("<" .. format:rep(#values), table.unpack(values))
      values = {}
    end
  end
  return table.concat(parts)
end

local function packed_mesh(mesh)
  local flat = {}
  for _, v in ipairs(mesh.vertices) do
    flat[#flat + 1], flat[#flat + 2], flat[#flat + 3] = v.x, v.y, v.z
  end
  local indices = {}
  for _, t in ipairs(mesh.triangles) do
    for k = 1, 3 do indices[#indices + 1] = t[k] - 1 end
  end
  local wide = #flat // 3 > 65536
  return {positions = base64(packed("f", #flat, function(i) return flat[i] end)),
          indices = base64(packed(wide and "I4" or "I2", #indices, function(i) return indices[i] end)), wide = wide}
end

local function rounded(x)
  local value = math.floor(x * 1e6 + 0.5) / 1e6
  return value == 0 and 0 or value
end

-- seven numbers: x y z [m], then the quaternion w x y z
local function numbers(pose)
  local p, q = pose.position, pose.quat
  return {rounded(p.x), rounded(p.y), rounded(p.z), rounded(q[1]), rounded(q[2]), rounded(q[3]), rounded(q[4])}
end

local function poses(bodies)
  local list = {}
  for i, body in ipairs(bodies) do list[i] = numbers(body.pose) end
  return list
end

---@param hand robot
---@param object body
---@param grasps grasp[]
---@param visit? fun(row: table)  called while the hand holds the object in the world
---@return table data, table[] rows, string[] notes  of meshes that are large
return function(hand, object, grasps, visit)
  local world = hand.world
  local data = {meshes = {}, parts = {}, still = {}, grasps = {}}
  local notes, number_of = {}, {}
  local function add_part(body, kind)
    local mesh = packed_mesh(body.mesh)
    local key = mesh.positions .. mesh.indices
    if not number_of[key] then
      data.meshes[#data.meshes + 1] = mesh
      number_of[key] = #data.meshes
    end
    if body.mesh.triangle_count > large then
      notes[#notes + 1] = ("the mesh of %s has %d triangles: the page is large and may turn slowly"):format(body.name, body.mesh.triangle_count)
    end
    return {name = body.name, kind = kind, mesh = number_of[key] - 1}
  end

  local moving = {}
  for _, body in ipairs(hand.bodies) do
    if body.mesh then
      moving[#moving + 1] = body
      data.parts[#moving] = add_part(body, body == hand.base and "base" or "link")
    end
  end
  for _, body in ipairs {object, table.unpack(world.obstacles)} do
    if body.mesh then
      local part = add_part(body, body == object and "object" or "obstacle")
      part.pose = numbers(body.pose)
      data.still[#data.still + 1] = part
    end
  end
  data.object_pose = numbers(object.pose)
  local bounds = object.mesh.bounds
  data.object_radius = rounded((bounds.high - bounds.low):norm() / 2)

  local rows = report_rows(hand, object, grasps, function(row, grasp)
    local direction = hand.approach.direction
    local item = {poses = poses(moving), links = grasp.links, points = {},
                  approach = {rounded(direction.x), rounded(direction.y), rounded(direction.z)}}
    for i, c in ipairs(grasp.points) do
      item.points[i] = {rounded(c.point.x), rounded(c.point.y), rounded(c.point.z),
                        rounded(c.normal.x), rounded(c.normal.y), rounded(c.normal.z), rounded(c.mu)}
    end
    if visit then visit(row) end
    local before = grasp.pregrasp
    if before then
      hand:set_posture(object.pose * before.pose, before.dofs)
      item.before = poses(moving)
    end
    data.grasps[#data.grasps + 1] = item
  end)
  return data, rows, notes
end
