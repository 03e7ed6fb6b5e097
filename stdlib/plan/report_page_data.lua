--- Data for the 3-D view of a report page: each mesh once, and the poses of the bodies in each grasp.
local page_meshes = require "clench.page.meshes"
local report_rows = require "clench.plan.report_rows"
local rounded, numbers = page_meshes.rounded, page_meshes.numbers

local function poses(bodies)
  local list = {}
  for i, body in ipairs(bodies) do list[i] = numbers(body.pose) end
  return list
end

---@param hand robot
---@param object body
---@param grasps grasp[]
---@param visit? fun(row: table)  called while the hand holds the object in the world
---@return table data, table[] rows, string[] notes  about large meshes
return function(hand, object, grasps, visit)
  local world = hand.world
  local data = {parts = {}, still = {}, grasps = {}}
  local meshes = page_meshes.new()
  data.meshes = meshes.list
  data.images = meshes.images
  local function add_part(body, kind) return {name = body.name, kind = kind, mesh = meshes:add(body)} end

  local moving = {}
  for _, body in ipairs(hand.bodies) do
    if body.visual_mesh then
      moving[#moving + 1] = body
      data.parts[#moving] = add_part(body, body == hand.base and "base" or "link")
    end
  end
  for _, body in ipairs {object, table.unpack(world.obstacles)} do
    if body.visual_mesh then
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
  return data, rows, meshes.notes
end
