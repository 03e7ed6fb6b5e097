--- Drags of bodies and robots: the pose requested by the mouse, and the motion towards it, which contact stops.
local camera = require "clench.view.camera"
local manipulator = require "clench.view.manipulator"
local together = require "clench.view.together"
local drags = {}

local rotate_speed = math.pi / 300  -- [rad per pixel]
local step, angle_step = 0.01, math.pi / 12  -- steps of snapping [m, rad]
local edge_on = 0.15  -- minimum sine of the angle between the view and the plane of a ring

local function snapped(value, by, snaps) return snaps and math.floor(value / by + 0.5) * by or value end

local function about(center, axis, angle)
  return clench.pose {xyz = center} * clench.pose {axis = axis, angle = angle} * clench.pose {xyz = center * -1}
end

--- The point of a line that is nearest to the ray of a pixel, by its distance along the line from a point [m]; nil for a line along the view.
function drags.along(view, point, axis, x, y)
  local origin, direction = camera.ray(view.camera, view.ui.size, x, y)
  local cosine = axis:dot(direction)
  local square = 1 - cosine * cosine
  if square < 1e-4 then return nil end
  local between = point - origin
  return (cosine * direction:dot(between) - axis:dot(between)) / square
end

-- intersection of the ray of a pixel with a plane; nil for a plane seen edge-on
local function on_plane(view, point, normal, x, y, least)
  local origin, direction = camera.ray(view.camera, view.ui.size, x, y)
  local cosine = direction:dot(normal)
  if math.abs(cosine) < (least or 1e-9) then return nil end
  return origin + direction * ((point - origin):dot(normal) / cosine)
end

--- Measures the angle by which the mouse turns about an axis: each call returns the angle since the start, which may exceed a turn [rad].
---@return fun(x: number, y: number): number
function drags.turning(view, center, axis, x, y)
  local start = on_plane(view, center, axis, x, y, edge_on)
  if not start then
    -- seen edge-on: along the line of the ring on the screen
    local radius = manipulator.length
    local right, up, back = camera.axes(view.camera)
    local tangent = axis:cross(back):unit()
    return function(to_x, to_y) return ((to_x - x) * tangent:dot(right) - (to_y - y) * tangent:dot(up)) / radius end
  end
  local last, total = start - center, 0
  return function(to_x, to_y)
    local point = on_plane(view, center, axis, to_x, to_y, edge_on)
    local now = point and point - center
    if now and now:norm() > 0 then
      total = total + math.atan(axis:dot(last:cross(now)), last:dot(now))
      last = now
    end
    return total
  end
end

-- the angle of a rotation about an axis, of all that differ by full turns the one nearest to another angle [rad]
local function angle_about(rotation, axis, near)
  local q = rotation.quat
  local angle = 2 * math.atan(axis.x * q[2] + axis.y * q[3] + axis.z * q[4], q[1])
  return angle + 2 * math.pi * math.floor((near - angle) / (2 * math.pi) + 0.5)
end

-- each of these returns a function from pixel and modifiers to the requested pose, and to a function that describes the displacement that was reached
local kinds = {}

function kinds.arrow(view, drag, handle)
  local start = drags.along(view, handle.center, handle.axis, drag.x, drag.y)
  return function(x, y, snaps)
    local now = drags.along(view, handle.center, handle.axis, x, y)
    local distance = start and now and snapped(now - start, step, snaps) or 0
    return clench.pose {xyz = handle.axis * distance} * drag.pose, function(shift) return ("%s %+.1f mm"):format(handle.name, handle.axis:dot(shift) * 1000) end
  end
end

function kinds.ring(view, drag, handle)
  local angle_at = drags.turning(view, handle.center, handle.axis, drag.x, drag.y)
  return function(x, y, snaps)
    local angle = snapped(angle_at(x, y), angle_step, snaps)
    return about(handle.center, handle.axis, angle) * drag.pose, function(_, rotation) return ("%s %+.1f°"):format(handle.name, math.deg(angle_about(rotation, handle.axis, angle))) end
  end
end

-- the axis of the world with the largest part of a displacement, and this part alone
local function along_one_axis(shift)
  local best = 1
  for i = 2, 3 do
    if math.abs(shift[i]) > math.abs(shift[best]) then best = i end
  end
  return clench.vec3(best == 1 and shift.x or 0, best == 2 and shift.y or 0, best == 3 and shift.z or 0)
end

function kinds.plane(view, drag)
  return function(x, y, snaps, constrains)
    local _, _, back = camera.axes(view.camera)
    local from, to = on_plane(view, drag.point, back, drag.x, drag.y), on_plane(view, drag.point, back, x, y)
    local shift = to - from
    if constrains then shift = along_one_axis(shift) end
    shift = clench.vec3(snapped(shift.x, step, snaps), snapped(shift.y, step, snaps), snapped(shift.z, step, snaps))
    return clench.pose {xyz = shift} * drag.pose, function(reached) return ("%+.1f %+.1f %+.1f mm"):format(reached.x * 1000, reached.y * 1000, reached.z * 1000) end
  end
end

function kinds.ball(view, drag)
  return function(x, y, snaps, constrains)
    local right, up = camera.axes(view.camera)
    local yaw, pitch = (x - drag.x) * rotate_speed, (y - drag.y) * rotate_speed
    if constrains then
      if math.abs(yaw) >= math.abs(pitch) then pitch = 0 else yaw = 0 end
    end
    yaw, pitch = snapped(yaw, angle_step, snaps), snapped(pitch, angle_step, snaps)
    local center = drag.center
    return about(center, up, yaw) * about(center, right, pitch) * drag.pose, function(_, rotation) return ("turn %.1f°"):format(math.deg(rotation:angle())) end
  end
end

--- Begins a drag of a body or robot, or of the selection that contains it.
---@param target body|robot
---@param handle? table  handle of the manipulator; nil: moves freely, by the picked point
---@return table? drag  nil if the selection cannot be dragged, which the status bar says
function drags.begin(view, target, handle, point, x, y)
  local members, problem = together.members(view, target)
  if problem then
    view.status = problem
    return nil
  end
  local drag = {target = target, pose = target.pose, center = manipulator.center(target), point = point, x = x, y = y, handle = handle and handle.name}
  local kind = handle and handle.kind or view.current_tool == "Rotate" and "ball" or "plane"
  drag.pose_at = kinds[kind](view, drag, handle)
  drag.group = members and together.begin(view, members, drag.center)
  drag.gesture = view.session:begin_gesture(("%s %s%s"):format(view.current_tool, target.name, members and #members > 1 and (" and %d more"):format(#members - 1) or ""))
  return drag
end

-- a robot on an arm is moved by the arm, from its present posture
local function move_mounted(robot, pose)
  local arm = robot.parent
  local found = arm:ik(robot.base, pose, {starts = 1})
  local result = arm:move_dofs(found.dofs, {stop_at_contact = true})
  return result, not found.reached and ("%.1f mm and %.1f° out of reach"):format(found.distance * 1000, math.deg(found.angle)) or nil
end

local function touched(result)
  local pair = result.stopped_by and result.stopped_by[1]
  return pair and ("%s touches %s"):format(pair[1].name, pair[2].name) or nil
end
drags.touched = touched

--- Moves the target of a drag towards the pose requested by the mouse.
function drags.move(view, drag, x, y, snaps, constrains)
  local pose, describe = drag.pose_at(x, y, snaps, constrains)
  local target, result, miss = drag.target, nil, nil
  if drag.group then
    result = together.move(drag.group, pose * drag.pose:inverse())
  elseif clench.type(target) == "robot" and target.parent then
    result, miss = move_mounted(target, pose)
  else
    result = target:move_to(pose)
  end
  local contact = touched(result)
  local now = drag.group and drag.group.reached * drag.pose or target.pose
  local text = describe(now.position - drag.pose.position, now * drag.pose:inverse())
  view.status = text .. (miss and "; " .. miss or "") .. (contact and "; " .. contact or "")
  view.session:emit("changed", {gesture = true})
end

return drags
