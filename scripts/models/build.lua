-- scripts/models/build.lua
--- Building blocks of hands. Fingers lie along x, bend about z, and touch with their +y side [mm].
local shapes = require "clench.shapes"
local build = {}

--- A slender body along x through rounded rectangles {x, y = center, h = height in y, w = width in z,
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

--- A number between control sections: a cubic through their values with slopes from their neighbors.
--- source  Catmull & Rom (1974), over uneven steps
local function between(sections, name, default, i, t)
  local function value(k) return sections[k][name] or default end
  local function slope(k)
    local a, b = math.max(k - 1, 1), math.min(k + 1, #sections)
    return (value(b) - value(a)) / (sections[b].x - sections[a].x)
  end
  local step = sections[i + 1].x - sections[i].x
  local t2, t3 = t * t, t * t * t
  return (2 * t3 - 3 * t2 + 1) * value(i) + (t3 - 2 * t2 + t) * step * slope(i) + (3 * t2 - 2 * t3) * value(i + 1) +
         (t3 - t2) * step * slope(i + 1)
end

--- a superellipse of the section, scaled by `scale`, moved by `ahead` along its normal
local function superellipse(s, sides, scale, ahead)
  local lean, ring = math.rad(s.lean), {}
  local function power(x) return (x < 0 and -1 or 1) * math.abs(x) ^ (2 / s.n) end
  for k = 1, sides do
    local angle = 2 * math.pi * (k - 0.5) / sides
    local u, v = scale * s.w / 2 * power(math.cos(angle)), scale * s.h / 2 * power(math.sin(angle))
    ring[k] = {s.x - v * math.sin(lean) + ahead * math.cos(lean) + u * s.slope,
               s.y + v * math.cos(lean) + ahead * math.sin(lean), s.z + u}
  end
  return ring
end

--- A smooth body along x through superellipses {x, y, z = center, h = height in y, w = width in z, n = power,
--- lean = turn about z [degrees], slope = dx/dz of the section}, with ends rounded off over the lengths `first`
--- and `last`, or flat.
---@param sections table[]
---@param o {first?: number, last?: number, steps?: integer, sides?: integer}  steps between two sections
function build.limb(sections, o)
  local steps, sides, rounds = o.steps or 3, o.sides or 16, 3
  local rings = {}
  local function at(i, t)
    local s = {x = sections[i].x + t * (sections[i + 1].x - sections[i].x)}
    for name, default in pairs {y = 0, z = 0, h = 0, w = 0, n = 2.3, lean = 0, slope = 0} do
      s[name] = between(sections, name, default, i, t)
    end
    return s
  end
  local function dome(s, length, k)
    local angle = math.pi / 2 * k / rounds
    if k == rounds then
      local tip = superellipse(s, 2, 0, length)
      return {tip[1]}
    end
    return superellipse(s, sides, math.cos(angle), length * math.sin(angle))
  end
  if o.first then
    for k = rounds, 1, -1 do rings[#rings + 1] = dome(at(1, 0), -o.first, k) end
  end
  for i = 1, #sections - 1 do
    for k = 0, steps - 1 do rings[#rings + 1] = superellipse(at(i, k / steps), sides, 1, 0) end
  end
  local last = at(#sections - 1, 1)
  rings[#rings + 1] = superellipse(last, sides, 1, 0)
  if o.last then
    for k = 1, rounds do rings[#rings + 1] = dome(last, o.last, k) end
  end
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

--- A phalanx of a mechanical finger, from its joint at x = -length to the next one at x = 0: a drum at its own joint, a body, cheeks around the next
--- joint, a pad.
---@param o {length: number, drum: number, grip: number, wide: number[], high: number[], axle?: number, inner?: number,
---  pad?: number[], shell: number[], steel: number[], rubber: number[]}
---  drum: radius at its joint; grip: half its length; wide, high: sizes of the body at both ends; axle: radius of the
---  next joint's cheeks, none at a fingertip; inner: half their gap; pad: from, to, thickness; then three colors
---@return table[] parts
function build.segment(o)
  local l, w, h = o.length, o.wide, o.high
  local last = o.axle and -o.axle - 1.5 or 0
  local first = -l + 0.55 * o.drum
  local parts = {
    {build.drum(-l, 0, o.drum, -o.grip, o.grip, 24), color = o.steel},
    {build.limb({
      {x = first, h = 0.8 * h[1], w = 0.9 * w[1], n = 3.4}, {x = first + 3, h = h[1], w = w[1], n = 3.4},
      {x = last - 3, h = h[2], w = w[2], n = 3.4}, {x = last, h = 0.84 * h[2], w = 0.86 * w[2], n = 3.2},
    }, {steps = 2, last = not o.axle and 0.42 * h[2] or nil}), color = o.axle and o.shell or o.rubber},
  }
  if o.axle then
    parts[3] = {build.fork(build.belt({last - 4, 0}, 0.9 * o.axle, {0, 0}, o.axle, 5), o.inner, w[2] / 2 + 0.4, 0.6),
                color = o.shell}
    parts[4] = {build.drum(0, 0, 0.5 * o.axle, -w[2] / 2 - 1.2, w[2] / 2 + 1.2, 16), color = o.steel}
  end
  if o.pad then
    local from, to, thick = o.pad[1], o.pad[2], o.pad[3]
    local rise = (h[1] + h[2]) / 4
    local slope = math.deg(math.atan((h[2] - h[1]) / 2, l))
    parts[#parts + 1] = {build.spine {
      {x = from, y = rise - 1, h = thick, w = 0.62 * w[1], r = 0.8, lean = slope},
      {x = from + 2, y = rise - 0.4, h = thick + 1, w = 0.8 * w[1], r = 1.2, lean = slope},
      {x = to - 2, y = rise - 0.4, h = thick + 1, w = 0.8 * w[2], r = 1.2, lean = slope},
      {x = to, y = rise - 1, h = thick, w = 0.62 * w[2], r = 0.8, lean = slope},
    }, color = o.rubber}
  end
  return parts
end

--- The outline of a belt around two circles in the plane: centers {x, y}, radii r.
function build.belt(a, ra, b, rb, steps)
  local dx, dy = b[1] - a[1], b[2] - a[2]
  local length = math.sqrt(dx * dx + dy * dy)
  local heading, tilt = math.atan(dy, dx), math.asin((ra - rb) / length)
  steps = steps or 8
  local points = {}
  local function arc(center, radius, first, last)
    for k = 0, steps do
      local angle = first + (last - first) * k / steps
      points[#points + 1] = {center[1] + radius * math.cos(angle), center[2] + radius * math.sin(angle)}
    end
  end
  local quarter = math.pi / 2
  arc(b, rb, heading - quarter + tilt, heading + quarter - tilt)
  arc(a, ra, heading + quarter - tilt, heading + 3 * quarter + tilt)
  return points
end

--- Turns a mesh built along z so that it lies along x (z to x, x to y, y to z).
function build.z_to_x(mesh) return shapes.turn(mesh, {1, 1, 1}, 2 * math.pi / 3) end

--- Turns a mesh built along z so that it lies along y (z to y, y to x, x to z).
function build.z_to_y(mesh) return shapes.turn(mesh, {1, 1, 1}, -2 * math.pi / 3) end

return build
