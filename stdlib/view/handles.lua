--- Handles that are drawn over the picture and dragged: lines of pixels with a name, a color and the axis that they represent.
local camera = require "clench.view.camera"
local handles = {}

local reach = 9  -- distance within which the mouse is over a handle [pixels]
local highlight = {1, 0.85, 0.1, 1}

-- vermilion, green and blue: distinguishable by the color-blind
handles.colors = {{0.84, 0.37, 0, 0.95}, {0, 0.62, 0.45, 0.95}, {0, 0.45, 0.7, 0.95}}

--- Any two unit vectors that span the plane normal to an axis, counter-clockwise about it.
function handles.plane_of(axis)
  local other = math.abs(axis.x) < 0.9 and clench.vec3(1, 0, 0) or clench.vec3(0, 1, 0)
  local u = axis:cross(other):unit()
  return u, axis:cross(u)
end

--- Pixels of points of the world; nil if one of them is behind the camera.
function handles.project(view, points)
  local list = {}
  for i, point in ipairs(points) do
    local x, y = camera.project(view.camera, view.ui.size, point)
    if not x then return nil end
    list[2 * i - 1], list[2 * i] = x, y
  end
  return list
end

--- Points of an arc about a center from one angle to another, angle 0 at u, a right angle at v.
function handles.arc(center, u, v, radius, from, to)
  local points, count = {}, math.max(4, math.ceil(math.abs(to - from) / 0.13))
  for i = 0, count do
    local a = from + (to - from) * i / count
    points[#points + 1] = center + (u * math.cos(a) + v * math.sin(a)) * radius
  end
  return points
end

local function distance_to_segment(x, y, ax, ay, bx, by)
  local dx, dy = bx - ax, by - ay
  local square = dx * dx + dy * dy
  local t = square > 0 and math.max(0, math.min(1, ((x - ax) * dx + (y - ay) * dy) / square)) or 0
  return math.sqrt((x - ax - t * dx) ^ 2 + (y - ay - t * dy) ^ 2)
end

--- The handle under a pixel, the nearest one; nil if there is none.
function handles.at(list, x, y)
  local best, least = nil, reach
  for _, handle in ipairs(list) do
    local line = handle.line
    for i = 1, #line - 3, 2 do
      local distance = distance_to_segment(x, y, line[i], line[i + 1], line[i + 2], line[i + 3])
      if distance < least then best, least = handle, distance end
    end
  end
  return best
end

--- Draws a text on a light ground, legible over any picture.
---@param color? number[]
function handles.label(ui, x, y, text, color)
  local width, height = utf8.len(text) * 0.28 * ui.line_height + 4, 0.62 * ui.line_height
  ui:line({x - 4, y - 2, x + width, y - 2, x + width, y + height, x - 4, y + height}, {color = {1, 1, 1, 0.8}, filled = true})
  ui:label(x, y, text, {color = color or {0.1, 0.1, 0.1, 1}})
end

local function draw_head(ui, line, color)
  local n = #line
  local x, y = line[n - 1], line[n]
  local dx, dy = x - line[n - 3], y - line[n - 2]
  local length = math.sqrt(dx * dx + dy * dy)
  if length < 1 then return end
  dx, dy = dx / length * 12, dy / length * 12
  ui:line({x - dx - dy * 0.5, y - dy + dx * 0.5, x, y, x - dx + dy * 0.5, y - dy - dx * 0.5}, {color = color, width = 3})
end

--- Draws handles; the hovered or dragged one is highlighted, with its name and value.
---@param hovered? string  name of a handle
function handles.draw(ui, list, hovered)
  for _, handle in ipairs(list) do
    local is_hovered = handle.name == hovered
    local color = is_hovered and highlight or handle.color
    ui:line(handle.line, {color = {0, 0, 0, 0.35}, width = is_hovered and 7 or 5})
    ui:line(handle.line, {color = color, width = is_hovered and 4 or 2.5})
    if handle.head then draw_head(ui, handle.line, color) end
    for _, tick in ipairs(handle.ticks or {}) do ui:line(tick, {color = handle.color, width = 3}) end
    if handle.knob then ui:circle(handle.x, handle.y, is_hovered and 8 or 6, {color = color, filled = true}) end
    if is_hovered then handles.label(ui, handle.x + 14, handle.y - 24, handle.text or handle.name) end
  end
end

return handles
