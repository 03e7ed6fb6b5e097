-- scripts/models/build.lua
--- Pieces that the hands are built from. Fingers lie along x, bend about z, and touch with their +y side [mm].
local shapes = require "clench.shapes"
local build = {}

--- A slender body along x through rounded rectangles {x, y = centre, h = height in y, w = width in z,
--- r = rounding, lean = turn of the section about z [degrees]}; `nose` is an apex {x, y} that closes the far end.
function build.spine(sections, nose)
  local rings = {}
  for i, s in ipairs(sections) do
    local h, w, r = s.h / 2, s.w / 2, s.r
    local outline = shapes.outline {{-w, -h}, {w, -h}, {w, h}, {-w, h}, rounding = r, segments = 3}
    local lean = math.rad(s.lean or 0)
    local ring = {}
    for k, p in ipairs(outline) do
      ring[k] = {s.x - p[2] * math.sin(lean), (s.y or 0) + p[2] * math.cos(lean), p[1]}
    end
    rings[i] = ring
  end
  if nose then rings[#rings + 1] = {{nose[1], nose[2], 0}} end
  return shapes.loft(rings)
end

--- A joint's drum about z at (x, y), from z = low to z = high.
function build.drum(x, y, radius, low, high, segments)
  return shapes.cylinder {radius, from = {x, y, low}, to = {x, y, high}, chamfer = 0.8, segments = segments or 36}
end

--- A prism with its outline in the plane of x and y, from z = low to z = high.
function build.plate(outline, low, high, rounding)
  return shapes.move(shapes.prism {outline, high - low, rounding = rounding or 0.8, segments = 2}, {0, 0, low})
end

--- Both cheeks of a fork about z: an outline in x and y, between |z| = inner and |z| = outer.
function build.fork(outline, inner, outer, rounding)
  local cheek = build.plate(outline, inner, outer, rounding)
  return shapes.union {cheek, shapes.mirror(cheek, "z")}
end

--- The outline of a belt around two circles in the plane: centres {x, y}, radii r.
function build.belt(a, ra, b, rb, steps)
  local dx, dy = b[1] - a[1], b[2] - a[2]
  local length = math.sqrt(dx * dx + dy * dy)
  local heading, tilt = math.atan(dy, dx), math.asin((ra - rb) / length)
  steps = steps or 8
  local points = {}
  local function arc(centre, radius, first, last)
    for k = 0, steps do
      local angle = first + (last - first) * k / steps
      points[#points + 1] = {centre[1] + radius * math.cos(angle), centre[2] + radius * math.sin(angle)}
    end
  end
  local quarter = math.pi / 2
  arc(b, rb, heading - quarter + tilt, heading + quarter - tilt)
  arc(a, ra, heading + quarter - tilt, heading + 3 * quarter + tilt)
  return points
end

--- Turns what was built along z so that it lies along x (z to x, x to y, y to z).
function build.z_to_x(mesh) return shapes.turn(mesh, {1, 1, 1}, 2 * math.pi / 3) end

--- Turns what was built along z so that it lies along y (z to y, y to x, x to z).
function build.z_to_y(mesh) return shapes.turn(mesh, {1, 1, 1}, -2 * math.pi / 3) end

return build
