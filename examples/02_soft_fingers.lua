-- Torsional friction of rubber fingertips of several radii on a plate, on a ball and inside a ring.
--   clench run examples/02_soft_fingers.lua [PICTURE]
local clench = require "clench"
local picture = arg and arg[1] or "build/soft_fingers.png"
local force, modulus, gap = 5, 1.5e6, 5e-5  -- N, Pa, m

-- a ball of rubber just above a body whose surface passes through the origin
local function press(tip, place)
  local world = clench.world()
  local body = world:add_object(place, {material = "wood"})
  local finger = world:add_obstacle(clench.shapes.sphere {tip, subdivisions = 4}, {
    name = "finger", material = "rubber", elastic_modulus = modulus, pose = {xyz = {0, 0, tip + gap}},
  })
  local contact = world:contacts(finger, body)[1]
  assert(contact.kind == "soft")
  return contact.patch, world
end

-- a plate, a ball of radius 30 mm, and the inside of a ring with a tube radius of 10 mm, which is concave in one direction and
-- convex in the other
local shapes = clench.shapes
local ring = shapes.turn(shapes.torus {0.06, 0.01, segments = 200, sides = 48}, {1, 0, 0}, math.pi / 2)
local places = {
  {"plate", shapes.move(shapes.box {0.1, 0.1, 0.01}, {0, 0, -0.005}), 0, 0},
  {"ball", shapes.move(shapes.sphere {0.03, subdivisions = 5}, {0, 0, -0.03}), 1 / 0.03, 1 / 0.03},
  {"ring", shapes.move(ring, {0, 0, 0.05}), 1 / 0.01, -1 / 0.05},
}
print "tip [mm]  place   relative radii [mm]   ellipse [mm]   torsion [N mm]"
local worst, least, most = 0, math.huge, 0
for _, tip in ipairs {0.005, 0.01, 0.02, 0.03} do
  for _, place in ipairs(places) do
    local patch = press(tip, place[2])
    local radii, axes = patch.relative_radii, patch:ellipse {force = force}.semi_axes
    local torsion = patch:torsion_limit {force = force}
    print(("%8.0f  %-6s  %8.2f %8.2f   %6.2f %6.2f   %8.2f"):format(1000 * tip, place[1], 1000 * radii[1], 1000 * radii[2],
      1000 * axes[1], 1000 * axes[2], 1000 * torsion))
    -- curvatures add up: 1/R = 1/tip + 1/place
    for k = 1, 2 do worst = math.max(worst, math.abs(radii[k] * (1 / tip + place[2 + k]) - 1)) end
    least, most = math.min(least, torsion), math.max(most, torsion)
  end
end
print(("relative radii are within %.2f %% of 1 / (1/tip + 1/place)"):format(100 * worst))
print(("torsion from %.1f to %.1f N mm: it grows with the fourth root of the radii only"):format(1000 * least, 1000 * most))

-- the fitted patch inside the transparent body, with the boundary of the contact ellipse
local _, world = press(0.02, places[2][2])
clench.render(world, {size = {640, 480}, patches = true, eye = {0.02, -0.06, -0.05}, target = {0, 0, 0}}):save(picture)
print("picture " .. picture)
assert(worst < 0.02 and most / least < 2.5, "closed formulas")
