--- Outlines of the selection, and of the links that a DOF moves while the mouse is on its slider: around each body, the convex outline of its surface on the screen.
local camera = require "clench.view.camera"
local contains = require "clench.contains"
local moved_links = require "clench.view.moved_links"
local replay = require "clench.view.replay"
local outline = {}

local direction_count = 96
local max_vertices = 50000  -- maximum number of vertices of a mesh that are searched; larger meshes are outlined by their boxes
local selected_color, moved_color = {0.95, 0.6, 0, 0.95}, {0, 0.45, 0.7, 0.95}

-- directions spread evenly over a sphere
local directions = {}
for i = 0, direction_count - 1 do
  local z = 1 - (2 * i + 1) / direction_count
  local radius, angle = math.sqrt(1 - z * z), i * math.pi * (3 - math.sqrt(5))
  directions[i + 1] = {radius * math.cos(angle), radius * math.sin(angle), z}
end

local function corners_of(bounds)
  local low, high, list = bounds.low, bounds.high, {}
  for i = 0, 7 do list[i + 1] = clench.vec3(i & 1 == 0 and low.x or high.x, i & 2 == 0 and low.y or high.y, i & 4 == 0 and low.z or high.z) end
  return list
end

-- the farthest vertices of a mesh in many directions
local function extreme_points(mesh)
  if mesh.vertex_count > max_vertices then return corners_of(mesh.bounds) end
  local vertices, list, seen = mesh.vertices, {}, {}
  for _, d in ipairs(directions) do
    local dx, dy, dz = d[1], d[2], d[3]
    local best, most = nil, -math.huge
    for i = 1, #vertices do
      local v = vertices[i]
      local along = v[1] * dx + v[2] * dy + v[3] * dz
      if along > most then best, most = i, along end
    end
    if best and not seen[best] then
      seen[best] = true
      local v = vertices[best]
      list[#list + 1] = clench.vec3(v[1], v[2], v[3])
    end
  end
  return list
end

local cache = {}  -- points by the fingerprint of their mesh

local function points_of(mesh)
  local key = mesh.fingerprint
  if not cache[key] then cache[key] = extreme_points(mesh) end
  return cache[key]
end

--- The convex hull of pixels, counter-clockwise, after Andrew (1979).
---@param points number[][]  {x, y}
---@return number[][]
function outline.hull(points)
  table.sort(points, function(a, b)
    if a[1] ~= b[1] then return a[1] < b[1] end
    return a[2] < b[2]
  end)
  local function half(first, last, by)
    local list = {}
    for i = first, last, by do
      local p = points[i]
      while #list > 1 do
        local a, b = list[#list - 1], list[#list]
        if (b[1] - a[1]) * (p[2] - a[2]) - (b[2] - a[2]) * (p[1] - a[1]) > 0 then break end
        list[#list] = nil
      end
      list[#list + 1] = p
    end
    list[#list] = nil
    return list
  end
  local lower = half(1, #points, 1)
  local upper = half(#points, 1, -1)
  table.move(upper, 1, #upper, #lower + 1, lower)
  return lower
end

local function draw_body(view, ui, body, color)
  local mesh, there = body.visual_mesh or body.mesh, replay.shown(view, body)
  if not (mesh and there) then return end
  local pose, pixels = there.pose, {}
  for _, point in ipairs(points_of(mesh)) do
    local x, y = camera.project(view.camera, ui.size, pose * point)
    if not x then return end
    pixels[#pixels + 1] = {x, y}
  end
  local line = {}
  for _, p in ipairs(outline.hull(pixels)) do line[#line + 1], line[#line + 2] = p[1], p[2] end
  if #line >= 6 then ui:line(line, {color = color, width = 2, closed = true}) end
end

--- Marks a DOF, whose links the next frame outlines, if the mouse is on the slider that was drawn last.
function outline.mark(view, ui, robot, dof)
  if ui:hovered() or ui:active() then view.marked = {robot = robot, dof = dof} end
end

--- At the start of a frame: the mark of the last one is drawn, and the panels set a new one.
function outline.begin(view) view.drawn_mark, view.marked = view.marked, nil end

--- At the end of a frame: requests another one if the mark has changed.
function outline.finish(view)
  local drawn, marked = view.drawn_mark or {}, view.marked or {}
  if drawn.robot ~= marked.robot or drawn.dof ~= marked.dof then view.needs_frame = true end
end

local function draw_moved(view, ui)
  local mark, world = view.drawn_mark, view.session.world
  if not mark or not world or not contains(world.robots, mark.robot) then return end
  for _, body in ipairs(moved_links(mark.robot, mark.dof)) do draw_body(view, ui, body, moved_color) end
end

--- Draws the outlines.
function outline.draw(view, ui)
  for _, thing in ipairs(view.session.selection) do
    for _, body in ipairs(clench.type(thing) == "robot" and thing.bodies or {thing}) do draw_body(view, ui, body, selected_color) end
  end
  draw_moved(view, ui)
end

return outline
