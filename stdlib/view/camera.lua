--- The camera of a view: projection, rays and navigation. A camera is a table {eye, target, up, field_of_view}, as clench.render takes it; that of
--- one eye of a stereoscopic picture has its shift `aside`, as a fraction of the height.
local raise = require "clench.raise"
local camera = {}

local min_distance = 1e-4  -- of eye and target [m]

local function is_vector(x) return clench.type(x) == "vec3" end

-- do the vectors of a camera span its axes?
local function is_sound(c)
  local back = c.eye - c.target
  return back:norm() > 0 and c.up:cross(back):norm() > 0
end

--- A camera of a script, which may lack fields or have lists for points, as clench.render reads it; errors name what is wrong.
---@param size number[]  of the screen [pixels]
function camera.complete(world, size, c)
  if type(c) == "table" and is_vector(c.eye) and is_vector(c.target) and is_vector(c.up) and type(c.field_of_view) == "number" and is_sound(c) then return c end
  local read = clench.camera(world, {size = {size[1], size[2]}, camera = c})
  if not is_sound(read) then raise "camera: eye and target must be two points, and up must point aside from the view" end
  return read
end

--- A string that is equal for equal cameras only.
function camera.key(c)
  local e, t, u = c.eye, c.target, c.up
  return ("dddddddddddd"):pack(e.x, e.y, e.z, t.x, t.y, t.z, u.x, u.y, u.z, c.field_of_view or 0, c.orthographic or 0, c.aside or 0)
end

--- Axes of a camera in the world: right, up, and backwards, from target to eye.
function camera.axes(c)
  local back = (c.eye - c.target):unit()
  local right = c.up:cross(back):unit()
  return right, back:cross(right), back
end

--- Height of the visible part of the plane through the target [m].
function camera.height(c)
  return c.orthographic or 2 * (c.eye - c.target):norm() * math.tan(c.field_of_view / 2)
end

--- Pixel of a point; nil behind the camera.
---@param size number[]  of the screen [pixels]
function camera.project(c, size, point)
  local right, up, back = camera.axes(c)
  local p = point - c.eye
  local depth = -p:dot(back)
  local scale
  if c.orthographic then
    scale = size[2] / c.orthographic
  else
    if depth <= 0 then return nil end
    scale = size[2] / (2 * depth * math.tan(c.field_of_view / 2))
  end
  return size[1] / 2 + (c.aside or 0) * size[2] + p:dot(right) * scale, size[2] / 2 - p:dot(up) * scale
end

--- The ray through a pixel: its origin and unit direction.
function camera.ray(c, size, x, y)
  local right, up, back = camera.axes(c)
  local scale = camera.height(c) / size[2]
  local offset = right * ((x - size[1] / 2 - (c.aside or 0) * size[2]) * scale) + up * ((size[2] / 2 - y) * scale)
  if c.orthographic then return c.eye + offset, back * -1 end
  return c.eye, (c.target + offset - c.eye):unit()
end

local function with_eye(c, eye, target, up)
  return {eye = eye, target = target or c.target, up = up or c.up, field_of_view = c.field_of_view, orthographic = c.orthographic}
end

--- Pose of a camera, which looks along -z, with +y up.
function camera.pose(c)
  local right, _, back = camera.axes(c)
  return clench.pose {xyz = c.eye, x_axis = right, z_axis = back}
end

--- The camera at a pose, with its target at the same distance.
function camera.at(c, pose)
  local target = pose * (clench.vec3(0, 0, -1) * (c.eye - c.target):norm())
  return with_eye(c, pose.position, target, pose:rotate(clench.vec3(0, 1, 0)))
end

--- The camera turned about its target.
---@param yaw number  about the vertical axis [rad]
---@param pitch number  upwards [rad]; it ends before the poles
function camera.orbited(c, yaw, pitch)
  local z = clench.vec3(0, 0, 1)
  local offset = c.eye - c.target
  local distance = offset:norm()
  local elevation = math.asin(math.max(-1, math.min(1, offset.z / distance)))
  local azimuth = math.atan(offset.y, offset.x)
  elevation = math.max(-1.55, math.min(1.55, elevation + pitch))
  azimuth = azimuth - yaw
  local turned = clench.vec3(math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation)) * distance
  return with_eye(c, c.target + turned, nil, z)
end

--- The camera moved across its view by pixels.
function camera.panned(c, size, dx, dy)
  local right, up = camera.axes(c)
  local scale = camera.height(c) / size[2]
  local shift = right * (-dx * scale) + up * (dy * scale)
  return with_eye(c, c.eye + shift, c.target + shift)
end

--- The camera at a distance from its target that is multiplied by a factor.
function camera.zoomed(c, factor)
  local offset = c.eye - c.target
  if offset:norm() * factor < min_distance then return c end
  local nearer = with_eye(c, c.target + offset * factor)
  if c.orthographic then nearer.orthographic = c.orthographic * factor end
  return nearer
end

--- The camera that shows in a rectangle of a screen what another one shows on a screen of the rectangle's size.
---@param size number[]  of the whole screen [pixels]
function camera.within(c, size, x, y, width, height)
  if width < 1 or height < 1 or width == size[1] and height == size[2] then return c end
  return camera.panned(camera.zoomed(c, size[2] / height), size, x + (width - size[1]) / 2, y + (height - size[2]) / 2)
end

--- The camera with a new target, at the same distance and from the same direction.
function camera.centered(c, target) return with_eye(c, target + (c.eye - c.target), target) end

return camera
