--- Bounding volumes of the selection: wire boxes of the trees that collision queries descend.
local camera = require "clench.view.camera"
local replay = require "clench.view.replay"
local boxes = {}

boxes.max_depth = 3  -- in the panel: up to 512 boxes per body
local max_boxes = 3000  -- that are drawn
local color = {0.80, 0.47, 0.65, 0.9}
-- lines along all edges, by the numbers of the corners
local paths = {{1, 2, 4, 3, 1, 5, 6, 8, 7, 5}, {2, 6}, {4, 8}, {3, 7}}

local cache = {}  -- corners of boxes by the fingerprint of their mesh and the depth

local function corners_of(box)
  local half, list = box.size * 0.5, {}
  for i = 0, 7 do
    list[i + 1] = box.pose * clench.vec3(i & 1 == 0 and -half.x or half.x, i & 2 == 0 and -half.y or half.y, i & 4 == 0 and -half.z or half.z)
  end
  return list
end

local function boxes_of(mesh, depth)
  local key = mesh.fingerprint .. depth
  if not cache[key] then
    local list = {}
    for i, box in ipairs(mesh:bounding_boxes(depth)) do list[i] = corners_of(box) end
    cache[key] = list
  end
  return cache[key]
end

local function draw_box(view, ui, pose, corners)
  local xs, ys = {}, {}
  for i, corner in ipairs(corners) do
    xs[i], ys[i] = camera.project(view.camera, ui.size, pose * corner)
    if not xs[i] then return end
  end
  for _, path in ipairs(paths) do
    local line = {}
    for _, corner in ipairs(path) do line[#line + 1], line[#line + 2] = xs[corner], ys[corner] end
    ui:line(line, {color = color, width = 1})
  end
end

-- bodies of the selection that have a surface
local function bodies_of(view)
  local list = {}
  for _, thing in ipairs(view.session.selection) do
    for _, body in ipairs(clench.type(thing) == "robot" and thing.bodies or {thing}) do
      if body.mesh then list[#list + 1] = body end
    end
  end
  return list
end

--- Number of boxes that the selection has at a depth.
function boxes.count(view, depth)
  local count = 0
  for _, body in ipairs(bodies_of(view)) do count = count + #boxes_of(body.mesh, depth) end
  return count
end

--- Draws the boxes of the selection at the depth of the view, or at the largest smaller one that has at most 3000 boxes.
function boxes.draw(view, ui)
  local depth = view.box_depth
  if not depth then return end
  while depth > 0 and boxes.count(view, depth) > max_boxes do depth = depth - 1 end
  for _, body in ipairs(bodies_of(view)) do
    local there = replay.shown(view, body)
    for _, corners in ipairs(there and boxes_of(body.mesh, depth) or {}) do draw_box(view, ui, there.pose, corners) end
  end
end

return boxes
