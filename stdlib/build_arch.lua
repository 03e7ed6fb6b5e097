--- An arch of stones.
local raise = require "clench.raise"
local described = require "clench.described"
local read_options = require "clench.options"

local stone = {0.72, 0.69, 0.64}  -- color

local function read(given)
  local options, o = read_options("clench.build_arch", given or {}), {}
  for _, name in ipairs {"inner_radius", "outer_radius", "thickness", "blocks", "supports", "density"} do o[name] = options:get(name) end
  options:done()
  if o.outer_radius <= o.inner_radius then
    options:fail("outer_radius must exceed inner_radius, %.6g, got %.6g", o.inner_radius, o.outer_radius)
  end
  return o
end

-- prism over four corners in the xz plane, from y = -thickness / 2 to thickness / 2
local function wedge(corners, thickness)
  local vertices = {}
  for _, y in ipairs {-thickness / 2, thickness / 2} do
    for _, p in ipairs(corners) do vertices[#vertices + 1] = {p[1], y, p[2]} end
  end
  local triangles = {{1, 2, 3}, {1, 3, 4}, {5, 7, 6}, {5, 8, 7}}
  for i = 1, 4 do
    local j = i % 4 + 1
    triangles[#triangles + 1] = {i, i + 4, j}
    triangles[#triangles + 1] = {j, i + 4, j + 4}
  end
  return {vertices = vertices, triangles = triangles}
end

-- block number i of n: a wedge of pi / n about the arch's center
local function block(o, i, height)
  local first, last = math.pi * (i - 1) / o.blocks, math.pi * i / o.blocks
  local function at(radius, angle) return {radius * math.cos(angle), radius * math.sin(angle) + height} end
  return wedge({at(o.inner_radius, first), at(o.outer_radius, first), at(o.outer_radius, last), at(o.inner_radius, last)}, o.thickness)
end

local support_height = 0.05  -- [m]

local function parts_of(o)
  local height = o.supports and support_height or 0
  local parts = {}
  for i = 1, o.blocks do parts[i] = {"block" .. i, block(o, i, height)} end
  for i, side in ipairs(o.supports and {1, -1} or {}) do
    local low, high = math.min(side * o.inner_radius, side * o.outer_radius), math.max(side * o.inner_radius, side * o.outer_radius)
    parts[#parts + 1] = {"support" .. i, wedge({{low, 0}, {high, 0}, {high, height}, {low, height}}, o.thickness), true}
  end
  return parts
end

--- Adds a round arch of stone wedges that stand on each other without mortar, in the xz plane above z = 0, and two supports below it, which are
--- obstacles: dynamics show whether the arch stands on them.
---@param world world  to which it is added
---@param options? table  sizes and material
---@option inner_radius? number [m, > 0] = 0.9  of the opening
---@option outer_radius? number [m, > 0] = 1.1  of the back of the stones
---@option thickness? number [m, > 0] = 0.2  along y
---@option blocks? integer [3 to 200] = 9  each spans pi / blocks
---@option supports? boolean = true  true: two supports, 0.05 m high
---@option density? number [kg/m^3, > 0] = 2000  of the blocks
---@return body[] parts  blocks from +x to -x, then the supports
---@effect edits
--- > #clench.build_arch(clench.world(), {blocks = 5})  --> 7
--- > clench.build_arch(clench.world(), {outer_radius = 0.5})  --> error: outer_radius must exceed inner_radius, 0.9, got 0.5
return function(world, options)
  if clench.type(world) ~= "world" then raise("clench.build_arch: world: expected a world, got " .. described(world)) end
  local o = read(options)
  local bodies = {}
  for i, part in ipairs(parts_of(o)) do
    local name, mesh, is_support = table.unpack(part)
    local add = is_support and world.add_obstacle or world.add_object
    bodies[i] = add(world, mesh, {name = name, material = "stone", density = not is_support and o.density or nil, color = stone})
  end
  return bodies
end
