-- Heaps of round bodies in a bin: no overlaps, and no increase of energy.
local test, clench = require "test", require "clench"
local shapes = clench.shapes

local gravity = 9.81

local function add_bin(world, half)
  local thick, height = 0.02, 0.4
  world:add_obstacle(shapes.box {2 * half + 0.2, 2 * half + 0.2, 0.1}, {name = "floor", pose = {xyz = {0, 0, -0.05}}})
  for _, side in ipairs {{1, 0}, {-1, 0}, {0, 1}, {0, -1}} do
    local x, y, length = side[1], side[2], 2 * (half + thick)
    local out = half + thick / 2
    world:add_obstacle(shapes.box {x ~= 0 and thick or length, y ~= 0 and thick or length, height},
                       {pose = {xyz = {x * out, y * out, height / 2}}})
  end
end

-- Random numbers from 0 to 1, the same on all platforms.
local function random_numbers(seed)
  local state = seed * 7919
  return function()
    state = (state * 1103515245 + 12345) % 2 ^ 31
    return state / 2 ^ 31
  end
end

-- Eight bodies in two layers, in random orientations.
local function heap(shape, mass, half, pitch, seed)
  local world, random = clench.world(), random_numbers(seed)
  world.gravity = {0, 0, -gravity}
  add_bin(world, half)
  for i = 0, 7 do
    local function place(odd) return (odd and 0.5 or -0.5) * half + (random() - 0.5) * 0.006 end
    local x, y, z = place(i % 2 == 1), place(i // 2 % 2 == 1), pitch * (0.6 + i // 4)
    world:add_object(shape, {mass = mass, name = "o" .. i,
                             pose = {xyz = {x, y, z}, rpy = {6.28 * random(), 3 * random(), 6.28 * random()}}})
  end
  return world
end

local function energy(world)
  local parts = world:energy()
  return parts.kinetic + parts.potential
end

local function overlapping(world)
  local objects, count = world.objects, 0
  for i, a in ipairs(objects) do
    for j = i + 1, #objects do count = count + #world:colliding(a, objects[j]) end
    for _, wall in ipairs(world.obstacles) do count = count + #world:colliding(a, wall) end
  end
  return count
end

local coin, can = shapes.cylinder {0.012, 0.002}, shapes.cylinder {0.02, 0.06}
local capsule = shapes.capsule {0.015, 0.05}
local cases = {
  {"coins", coin, 0.005, 0.05, 0.028, {1, 3}},
  {"cans", can, 0.1, 0.12, 0.075, {1, 2}},
  {"capsules", capsule, 0.1, 0.12, 0.075, {1, 3}},
}
for _, case in ipairs(cases) do
  local name, shape, mass, half, pitch, seeds = table.unpack(case)
  test(name .. " that fall into a bin never overlap and gain no energy", function(t)
    for _, seed in ipairs(seeds) do
      local world = heap(shape, mass, half, pitch, seed)
      -- in free fall, steps of h gain m (g h)^2 / 2 each
      local h = world.time_step
      local gain = 8 * mass * (gravity * h) ^ 2 / 2
      local start = energy(world)
      local before = start
      for _ = 1, 150 do
        world:run(h)
        local now = energy(world)
        t.ok(now <= before + gain + 5e-4 * start)
        t.equal(overlapping(world), 0)
        before = now
      end
      t.equal(world.report.overlaps, 0)
      t.equal(world.report.failures, 0)
      t.ok(world.report.contacts > 0)
    end
  end)
end
