-- A capsule inclined to a floor by less than the contact threshold: its far contact moves towards the near one, and the forces follow.
local test, clench = require "test", require "clench"
local shapes = clench.shapes

local radius, length, mass, gravity = 0.01, 0.06, 0.05, 9.81
local gap, threshold = 2.5e-5, 1e-4
local slack = threshold - gap

-- The capsule along y, its lower end `gap` above the floor, and its contacts after one step from rest.
local function leaning(angle)
  local world = clench.world()
  world.gravity = {0, 0, -gravity}
  local floor = world:add_obstacle(shapes.move(shapes.box {1, 1, 0.1}, {0, 0, -0.05}), {name = "floor"})
  world:set_friction("wood", "wood", {static = 0, kinetic = 0})
  local rod = world:add_object(shapes.capsule {radius, length}, {name = "rod", mass = mass})
  local height = radius + gap + length / 2 * math.sin(angle)
  rod.pose = clench.pose {xyz = {0, 0, height}, rpy = {math.pi / 2 + angle, 0, 0}}
  world:solve_velocities(world.time_step)
  local contacts = world:contacts(floor, rod)
  table.sort(contacts, function(a, b) return a.gap < b.gap end)
  return world, rod, contacts
end

-- The part of its length between its contacts.
local function share(angle)
  local x = slack / (length * math.sin(angle))
  return x >= 1 and 1 or math.max(0, (4 * x - 1) / 3)
end

test("forces of a capsule at rest follow from its contact points, at any tilt", function(t)
  local steps, before = 120
  for i = 0, steps do
    local angle = 1e-6 + 1.55 * slack / length * i / steps
    local _, rod, contacts = leaning(angle)
    t.equal(#contacts, 2)
    local low, high = contacts[1], contacts[2]
    local reach = math.abs(high.point.y - low.point.y)
    t.close(reach, length * share(angle), 2e-4)
    -- moments about the near contact, and the weight
    local weight, arm = mass * gravity, math.abs(low.point.y - rod.pose.position.y)
    t.close(high.force:norm(), weight * arm / reach, 1e-6 * weight)
    t.close(low.force:norm(), weight * (1 - arm / reach), 1e-6 * weight)
    t.ok(rod.velocity.linear:norm() < 1e-9 and rod.velocity.angular:norm() < 1e-7)
    -- the length changes by at most 4/3 length^2 / slack per radian, and forces by the same fraction of the weight
    if before then
      local change = 4 / 3 * length ^ 2 / slack * 1.55 * slack / length / steps
      t.ok(math.abs(high.force:norm() - before) <= weight * (change + 4e-4) * arm / reach ^ 2)
    end
    before = high.force:norm()
  end
end)

test("a capsule with a larger inclination tips about its far contact, like free bodies", function(t)
  for i = 0, 40 do
    local angle = slack / length * (1.75 + 3 * i / 40)
    local world, rod, contacts = leaning(angle)
    local pivot = contacts[#contacts]
    local arm = math.abs(pivot.point.y - rod.pose.position.y)
    local inertia = rod.inertia[1][1]
    local force = mass * gravity * inertia / (inertia + mass * arm ^ 2)
    t.close(pivot.force:norm(), force, 2e-3 * force)
    t.close(rod.velocity.angular:norm(), force * arm / inertia * world.time_step, 1e-2 * rod.velocity.angular:norm())
  end
end)
