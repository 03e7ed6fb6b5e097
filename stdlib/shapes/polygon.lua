-- stdlib/shapes/polygon.lua
--- Simple polygons in the plane: orientation, crossings, inset, ear clipping.
local raise = require "clench.raise"
local polygon = {}

-- limited, as every edge is compared with every other edge
local max_points = 1024

local function check_count(points, subject)
  if #points > max_points then raise(("%s must have at most %d points, got %d"):format(subject, max_points, #points)) end
end

local function cross(o, a, b) return (a[1] - o[1]) * (b[2] - o[2]) - (a[2] - o[2]) * (b[1] - o[1]) end

--- Signed area, > 0 if counter-clockwise.
function polygon.area(points)
  local sum, o = 0, points[1]
  for i = 2, #points - 1 do sum = sum + cross(o, points[i], points[i + 1]) end
  return 0.5 * sum
end

local function between(x, a, b) return math.min(a, b) <= x and x <= math.max(a, b) end

local function on_segment(p, a, b)
  return cross(a, b, p) == 0 and between(p[1], a[1], b[1]) and between(p[2], a[2], b[2])
end

local function meet(a, b, c, d)
  local ca, cb, ac, ad = cross(c, d, a), cross(c, d, b), cross(a, b, c), cross(a, b, d)
  if ca * cb < 0 and ac * ad < 0 then return true end
  return on_segment(a, c, d) or on_segment(b, c, d) or on_segment(c, a, b) or on_segment(d, a, b)
end

--- Indices of the first two edges that touch without being neighbors, or of an edge without length.
function polygon.crossing(points)
  local n = #points
  local function corner(i) return points[(i - 1) % n + 1] end
  for i = 1, n do
    local a, b = corner(i), corner(i + 1)
    if a[1] == b[1] and a[2] == b[2] then return i, i end
    -- neighbors touch at their common corner; they must not fold back onto each other
    if on_segment(corner(i + 2), a, b) or (n > 3 and on_segment(a, b, corner(i + 2))) then return i, i % n + 1 end
    for j = i + 2, n do
      if not (i == 1 and j == n) and meet(a, b, corner(j), corner(j + 1)) then return i, j end
    end
  end
end

--- The points in counter-clockwise order; raises an error if they do not bound a simple area.
function polygon.simple(points, subject)
  check_count(points, subject)
  local i, j = polygon.crossing(points)
  if i then
    local what = i == j and ("edge %d has no length"):format(i) or ("edges %d and %d meet"):format(i, j)
    raise(subject .. " must not cross or touch itself, got a polygon whose " .. what)
  end
  local ordered = {}
  local turned = polygon.area(points) < 0
  for k, p in ipairs(points) do ordered[turned and #points + 1 - k or k] = p end
  return ordered
end

--- Moves every edge of a counter-clockwise polygon inward by `distance`; corners keep their indices.
function polygon.inset(points, distance)
  local n, moved = #points, {}
  for i, p in ipairs(points) do
    local before, after = points[(i - 2) % n + 1], points[i % n + 1]
    local ux, uy = p[1] - before[1], p[2] - before[2]
    local vx, vy = after[1] - p[1], after[2] - p[2]
    local lu, lv = math.sqrt(ux * ux + uy * uy), math.sqrt(vx * vx + vy * vy)
    ux, uy, vx, vy = ux / lu, uy / lu, vx / lv, vy / lv
    -- the corner moves along the bisector until both edges have moved by the distance
    local bisector = 1 + ux * vx + uy * vy
    moved[i] = {p[1] - distance * (uy + vy) / bisector, p[2] + distance * (ux + vx) / bisector}
  end
  return moved
end

local function inside(p, a, b, c)
  return cross(a, b, p) >= 0 and cross(b, c, p) >= 0 and cross(c, a, p) >= 0
end

--- Quality of the ear at corner i (smallest height over longest side); nil if it is not an ear.
local function ear(points, ring, i)
  local n = #ring
  local a, b, c = points[ring[(i - 2) % n + 1]], points[ring[i]], points[ring[i % n + 1]]
  local area = cross(a, b, c)
  if not (area > 0) then return nil end
  for _, k in ipairs(ring) do
    local p = points[k]
    if p ~= a and p ~= b and p ~= c and inside(p, a, b, c) then return nil end
  end
  local function squared(u, v) return (u[1] - v[1]) ^ 2 + (u[2] - v[2]) ^ 2 end
  return area / math.max(squared(a, b), squared(b, c), squared(c, a))
end

--- Triangles {i, j, k} that fill a simple counter-clockwise polygon, by ear clipping, best ear first.
--- source  Meisters (1975), polygons have ears; Eberly (2008), triangulation by ear clipping
function polygon.triangulate(points, subject)
  check_count(points, subject)
  local ring, quality, triangles = {}, {}, {}
  for i = 1, #points do ring[i] = i end
  for i = 1, #points do quality[i] = ear(points, ring, i) or -1 end
  while #ring > 3 do
    local best = 1
    for i = 2, #ring do
      if quality[i] > quality[best] then best = i end
    end
    if quality[best] < 0 then
      -- a clipped corner may have created an ear elsewhere
      for i = 1, #ring do
        quality[i] = ear(points, ring, i) or -1
        if quality[i] > quality[best] then best = i end
      end
      if quality[best] < 0 then raise(subject .. " must be a simple polygon, got one that folds onto itself") end
    end
    local n = #ring
    triangles[#triangles + 1] = {ring[(best - 2) % n + 1], ring[best], ring[best % n + 1]}
    table.remove(ring, best)
    table.remove(quality, best)
    for i = best - 2, best - 1 do
      local neighbor = i % (n - 1) + 1
      quality[neighbor] = ear(points, ring, neighbor) or -1
    end
  end
  triangles[#triangles + 1] = {ring[1], ring[2], ring[3]}
  return triangles
end

return polygon
