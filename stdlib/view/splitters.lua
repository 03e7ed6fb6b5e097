--- The edges between the picture and the panels around it, and within a column of panels, which are dragged to change the sizes of the panels.
local splitters = {}

splitters.default = {left = 264, right = 264, bottom = 190}  -- widths, and a height, at scale 1 [pixels]
splitters.min = 120  -- of each, at scale 1 [pixels]

splitters.gap = 5  -- between the two parts of a column [pixels]
splitters.min_share = 0.15  -- minimum fraction of the height of a column for each of its parts

local reach = 5  -- of an edge into the picture [pixels]
splitters.min_picture = 160  -- width and height that stay between the panels [pixels]

--- A size of the panels, limited by the size of the window.
---@param name "left"|"right"|"bottom"
---@return number size  [pixels]
function splitters.size(view, name)
  local width, height = view.ui.size[1], view.ui.size[2]
  local max = name == "bottom" and height - splitters.min_picture - 120 or (width - splitters.min_picture) / 2
  return math.max(splitters.min * view.scale, math.min(view.sizes[name] * view.scale, max))
end

-- the direction in which the mouse makes the panels larger: of each edge its axis and sign
local directions = {left = {"x", 1}, right = {"x", -1}, bottom = {"y", -1}, ["within left"] = {"y", 1}, ["within right"] = {"y", 1}}

-- the name of the edge under the mouse
local function edge_at(view, mouse)
  for name, edge in pairs(view.edges) do
    local axis, sign = directions[name][1], directions[name][2]
    local beside, along = sign * (mouse[axis] - edge.at), mouse[axis == "x" and "y" or "x"]
    if beside >= 0 and beside < reach and along >= edge.from and along < edge.to then return name end
  end
end

-- the edge follows the mouse: a size of the panels, or within a column the fraction of the upper part
local function move(view, held, mouse)
  local axis, sign = directions[held.name][1], directions[held.name][2]
  local column = held.name:match "^within (%l+)$"
  if column then
    local share = (held.at + mouse.y - held.start - held.top) / held.height
    view.shares[column] = math.max(splitters.min_share, math.min(1 - splitters.min_share, share))
  else
    view.sizes[held.name] = (held.size + sign * (mouse[axis] - held.start)) / view.scale
    view.sizes[held.name] = splitters.size(view, held.name) / view.scale
  end
end

--- Applies the mouse of this frame to the edges, which the layout has stored in view.edges.
---@return boolean taken  is an edge being dragged?
function splitters.update(view)
  local mouse = view.ui.mouse
  local held = view.splitting
  if held then
    move(view, held, mouse)
    if not mouse.left.down then view.splitting = nil end
    return true
  end
  view.edge = not (view.press or view.ui.wants_mouse) and view.panels_visible and edge_at(view, mouse) or nil
  if not (view.edge and mouse.left.clicked) then return false end
  local edge = view.edges[view.edge]
  view.splitting = {name = view.edge, size = view.sizes[view.edge] and splitters.size(view, view.edge), start = mouse[directions[view.edge][1]],
                    at = edge.at + splitters.gap, top = edge.top, height = edge.height}
  return true
end

-- the gaps within columns have the color of panels
local function fill_gaps(view, ui)
  for _, name in ipairs {"within left", "within right"} do
    local edge = view.edges[name]
    if edge then
      local top, bottom = edge.at - 2, edge.at + splitters.gap + 2  -- its smooth border is under the panels
      ui:line({edge.from, top, edge.to, top, edge.to, bottom, edge.from, bottom}, {color = view.dark and {0.2, 0.21, 0.23} or {0.85, 0.86, 0.88}, filled = true})
    end
  end
end

--- Marks the edge under the mouse.
function splitters.draw(view, ui)
  fill_gaps(view, ui)
  local name = view.splitting and view.splitting.name or view.edge
  local edge = name and view.edges[name]
  if not edge then return end
  local axis, sign = directions[name][1], directions[name][2]
  local at = edge.at + sign * 1.5
  local ends = axis == "x" and {at, edge.from, at, edge.to} or {edge.from, at, edge.to, at}
  ui:line(ends, {color = {0.2, 0.45, 0.8, 0.9}, width = 3})
end

return splitters
