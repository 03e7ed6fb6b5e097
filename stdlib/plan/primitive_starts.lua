--- Starts around boxes, spheres, cylinders and cones: positions, approach directions and thumb directions around each, by density, after GraspIt!'s primitive
--- planner. In the frame of the primitive, whose axis is y.
local standoff = 0.08  -- distance of the start from the surface [m]

-- limits of sizes that can be grasped: maximum span between thumb and fingers, minimum radius of ends of cylinders, maximum diameter and minimum height for
-- grasps across their sides [m]
local max_span, min_end, max_round, min_side = 0.2, 0.005, 0.18, 0.028

local v = clench.vec3
local y = v(0, 1, 0)

local function floor_div(x, step) return x // (step / 1000) end

local counts = {}

function counts.planes(m, height)
  if m == 1 then return 1 end
  if m == 2 then return 2 * floor_div(height, 100) + 1 end
  if m == 3 then return 2 * floor_div(height, 80) + 3 end
  return 2 * floor_div(height, 70) + 2 * m + 1
end

function counts.steps(m, r)
  if m == 1 then return 4 * floor_div(r, 100) + 4 end
  if m == 2 then return 8 * floor_div(r, 100) + 8 end
  if m == 3 then return 16 * floor_div(r, 50) + 16 end
  return 24 * floor_div(r, 50) + 4 * m
end

function counts.edge_planes(m, size)
  if m == 1 then return 1 end
  if m == 2 then return 2 * floor_div(size, 100) + 1 end
  return 2 * floor_div(size, 50) + (m == 3 and 1 or 2 * m + 1)
end

function counts.rotations(m) return m == 1 and 2 or m <= 3 and 4 or m + 4 end
function counts.both_thumbs(m) return m >= 3 end

-- a direction across z, turned about z by a fraction of a full turn
local function around(z, side, part) return clench.pose {axis = z, angle = 2 * math.pi * part}:rotate(side) end

local kinds = {}

-- starts at one end: on the axis, with the approach along it towards the primitive
local function add_end(add, m, height, way)
  local n = counts.rotations(m)
  for i = 0, n - 1 do
    add(y * (way * (height / 2 + standoff)), y * -way, around(y * way, v(1, 0, 0), i / n), "circle")
  end
end

local function add_side(add, m, point, direction, axis, across, along)
  if across then
    local thumb = direction:cross(axis)
    add(point, direction, thumb, "opposing")
    if counts.both_thumbs(m) then add(point, direction, -thumb, "opposing") end
  end
  if along then add(point, direction, -axis, "opposing") end
end

function kinds.cylinder(p, m, round, add)
  local r, h = p.radius, p.height
  if r >= min_end and round(r) <= max_round then
    add_end(add, m, h, 1)
    add_end(add, m, h, -1)
  end
  local planes, steps = counts.planes(m, h), counts.steps(m, r)
  for k = 1, planes do
    for i = 0, steps - 1 do
      local out = around(y, v(1, 0, 0), i / steps)
      local point = out * (r + standoff) + y * (-h / 2 + k * h / (planes + 1))
      add_side(add, m, point, -out, y, round(r) <= max_round and h >= min_side, h <= max_span)
    end
  end
end

function kinds.sphere(p, m, round, add)
  if round(p.radius) > max_round then return end
  local steps = counts.steps(m, p.radius)
  local n = counts.rotations(m)
  for i = 0, steps // 2 do
    local polar = math.pi * i / (steps / 2)
    local ring = math.floor(steps * math.sin(polar) + 1e-9) + 1
    for j = 0, ring - 1 do
      local turn = 2 * math.pi * j / ring
      local out = v(math.sin(polar) * math.cos(turn), math.cos(polar), math.sin(polar) * math.sin(turn))
      local side = out:cross(math.abs(out.y) < 0.9 and y or v(1, 0, 0))
      for k = 0, n - 1 do add(out * (p.radius + standoff), -out, around(out, side, k / n), "circle") end
    end
  end
end

function kinds.cone(p, m, round, add)
  local r, h = p.radius, p.height
  if r >= min_end then
    add_end(add, m, h, 1)
    if round(r) <= max_round then add_end(add, m, h, -1) end
  end
  local slant, rise = math.sqrt(r * r + h * h), math.atan(h, r)
  local planes, steps = counts.planes(m, slant), counts.steps(m, r)
  for i = 0, steps - 1 do
    local out = around(y, v(1, 0, 0), i / steps)
    local normal = out * math.sin(rise) + y * math.cos(rise)
    local up = y * math.sin(rise) - out * math.cos(rise)
    for k = 1, planes do
      local foot = out * r - y * (h / 2) + up * (slant * k / (planes + 1))
      add_side(add, m, foot + normal * standoff, -normal, up, true, slant <= max_span)
    end
    if round(r) <= max_round and h >= min_side then
      -- the edge of the bottom, approached along half of the slope
      local edge = out * math.cos(rise / 2) - y * math.sin(rise / 2)
      add_side(add, m, out * r - y * (h / 2) + edge * standoff, -edge, edge:cross(out:cross(y)), true, false)
    end
  end
end

function kinds.box(p, m, _, add, whole)
  local axes = {v(1, 0, 0), v(0, 1, 0), v(0, 0, 1)}
  local size = {p.size.x, p.size.y, p.size.z}
  for a = 1, 3 do
    local b, c = a % 3 + 1, (a + 1) % 3 + 1
    local nb, nc = counts.edge_planes(m, size[b]), counts.edge_planes(m, size[c])
    for _, way in ipairs {1, -1} do
      for i = 1, nb do
        for j = 1, nc do
          -- the original's rule starts at the full edge length from the center instead of half of it
          local point = axes[a] * (way * (size[a] * (whole and 1 or 0.5) + standoff)) +
                        axes[b] * (size[b] * (i / (nb + 1) - 0.5)) + axes[c] * (size[c] * (j / (nc + 1) - 0.5))
          for _, k in ipairs {b, c} do
            if size[k] <= max_span then
              add(point, axes[a] * -way, axes[k], "opposing")
              if counts.both_thumbs(m) then add(point, axes[a] * -way, -axes[k], "opposing") end
            end
          end
        end
      end
    end
  end
end

---@param primitives table[]  of clench.files.primitives
---@param density integer  1 and more
---@param rule string  "graspit" compares radii with limits of diameters, and starts too far from boxes
---@return {position: vec3, direction: vec3, thumb: vec3, preshape: string, primitive: integer}[] starts, number max_span  starts: in the object's frame; max_span: between thumb and fingers [m]
return function(primitives, density, rule)
  local of_graspit = rule == "graspit"
  local function round(r) return of_graspit and r or 2 * r end
  local out = {}
  for number, p in ipairs(primitives) do
    kinds[p.kind](p, density, round, function(point, direction, thumb, preshape)
      out[#out + 1] = {position = p.pose * point, direction = p.pose:rotate(direction), thumb = p.pose:rotate(thumb),
                       preshape = preshape, primitive = number}
    end, of_graspit)
  end
  return out, max_span
end
