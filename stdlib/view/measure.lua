--- The measuring tool: two clicks measure the distance of two points, a third one the angle at the second. Points move with the bodies they are on.
local camera = require "clench.view.camera"
local handles = require "clench.view.handles"
local replay = require "clench.view.replay"
local measure = {}

local color = {0.45, 0.1, 0.5, 1}

--- Distance of the last two points, and angle at the second of three; nil if there are too few.
---@return number? distance [m]
---@return number? angle [rad]
function measure.values(points)
  local n = #points
  if n < 2 then return nil end
  local distance = (points[n] - points[n - 1]):norm()
  if n < 3 then return distance end
  local a, b = points[1] - points[2], points[3] - points[2]
  return distance, math.atan(a:cross(b):norm(), a:dot(b))
end

--- The measured points, where their bodies are now; none once one of these has been removed.
---@return vec3[] points  [m]
function measure.points(view)
  local points = {}
  for i, anchor in ipairs(view.measured) do
    local ok, pose = pcall(function() return replay.shown(view, anchor.body).pose end)
    if not ok then
      view.measured = {}
      return {}
    end
    points[i] = pose * anchor.point
  end
  return points
end

local function shown(view, distance)
  return view.units.length == "mm" and ("%.2f mm"):format(distance * 1000) or ("%.5f m"):format(distance)
end

--- Adds the point under a pixel; a fourth point begins a new measurement, and a click on nothing ends it.
function measure.click(view, x, y)
  local hit = view:pick(x, y)
  if not hit or #view.measured == 3 then view.measured = {} end
  if hit then
    local pose = replay.shown(view, hit.body).pose
    view.measured[#view.measured + 1] = {body = hit.body, point = pose:inverse() * hit.point}
  end
  local distance, angle = measure.values(measure.points(view))
  if angle then
    view.status = ("Angle %.2f°, distance %s"):format(math.deg(angle), shown(view, distance))
  elseif distance then
    view.status = "Distance " .. shown(view, distance)
  else
    view.status = hit and "Measure: click on a second point" or "Measure: click on a point"
  end
end

--- Removes the measurement.
---@return boolean removed
function measure.clear(view)
  local had = #view.measured > 0
  if had then view.measured, view.status = {}, "Measure: click on a point" end
  return had
end

--- Draws the points, the lines between them and their values.
function measure.draw(view, ui)
  local points, pixels = measure.points(view), {}
  for i, point in ipairs(points) do
    local x, y = camera.project(view.camera, ui.size, point)
    if not x then return end
    pixels[i] = {x, y}
    ui:circle(x, y, 5, {color = color, filled = true})
  end
  for i = 2, #points do
    local a, b = pixels[i - 1], pixels[i]
    ui:line({a[1], a[2], b[1], b[2]}, {color = color, width = 2})
    handles.label(ui, (a[1] + b[1]) / 2 + 10, (a[2] + b[2]) / 2 - 8, shown(view, (points[i] - points[i - 1]):norm()), color)
  end
  local _, angle = measure.values(points)
  if angle then handles.label(ui, pixels[2][1] + 12, pixels[2][2] - 24, ("%.2f°"):format(math.deg(angle)), color) end
end

return measure
