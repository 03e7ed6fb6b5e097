--- The manipulator of the selection: with the Translate tool, arrows along the axes of the world; with the Rotate tool, rings about them.
local camera = require "clench.view.camera"
local handles = require "clench.view.handles"
local manipulator = {}

manipulator.length = 100  -- length of arrows, and radius of rings [pixels]
local length = manipulator.length
local gap = 16  -- gap between the center and an arrow [pixels]
local min_length = 14  -- minimum length of an arrow; shorter ones are seen end-on [pixels]

local axes = {{"x", 1, 0, 0}, {"y", 0, 1, 0}, {"z", 0, 0, 1}}

--- Size of a pixel at the depth of a point [m]; nil behind the camera.
function manipulator.pixel(view, point)
  local c = view.camera
  if c.orthographic then return c.orthographic / view.ui.size[2] end
  local _, _, back = camera.axes(c)
  local depth = (c.eye - point):dot(back)
  if depth <= 0 then return nil end
  return 2 * depth * math.tan(c.field_of_view / 2) / view.ui.size[2]
end

--- The body or robot that a drag moves: the robot of a base, otherwise the body itself; nil for a single link.
function manipulator.target(thing)
  if not thing then return nil end
  if clench.type(thing) == "robot" or not thing.robot then return thing end
  if thing == thing.robot.base then return thing.robot end
  return nil
end

--- The center that a drag moves, or about which it turns: the center of mass of a body, or of a robot's base.
function manipulator.center(target)
  local body = clench.type(target) == "robot" and target.base or target
  return body.pose * body.com
end

local function arrow(view, name, axis, center, pixel, color)
  local line = handles.project(view, {center + axis * (gap * pixel), center + axis * (length * pixel)})
  if not line then return nil end
  if (line[3] - line[1]) ^ 2 + (line[4] - line[2]) ^ 2 < min_length ^ 2 then return nil end
  return {name = name, kind = "arrow", axis = axis, center = center, line = line, color = color, head = true,
          x = 0.3 * line[1] + 0.7 * line[3], y = 0.3 * line[2] + 0.7 * line[4]}
end

-- the half of a ring that faces the camera
local function ring(view, name, axis, center, pixel, color)
  local towards = (view.camera.eye - center):unit()
  local near = towards - axis * towards:dot(axis)
  local u = near:norm() > 1e-3 and near:unit() or handles.plane_of(axis)
  local span = near:norm() < 0.2 and math.pi or math.pi / 2
  local points = handles.arc(center, u, axis:cross(u), length * pixel, -span, span)
  local line = handles.project(view, points)
  if not line then return nil end
  local middle = handles.project(view, {center + u * (length * pixel)})
  return {name = "turn " .. name, kind = "ring", axis = axis, center = center, line = line, color = color, x = middle[1], y = middle[2]}
end

--- Handles of the manipulator for the current tool.
---@return table[] handles
function manipulator.handles(view)
  local make = view.current_tool == "Translate" and arrow or view.current_tool == "Rotate" and ring
  local target = manipulator.target(view.session.selection[1])
  if not (make and target) then return {} end
  local center = manipulator.center(target)
  local pixel = manipulator.pixel(view, center)
  local list = {}
  if not pixel then return list end
  for i, axis in ipairs(axes) do
    local handle = make(view, axis[1], clench.vec3(axis[2], axis[3], axis[4]), center, pixel, handles.colors[i])
    if handle then
      handle.target = target
      list[#list + 1] = handle
    end
  end
  return list
end

return manipulator
