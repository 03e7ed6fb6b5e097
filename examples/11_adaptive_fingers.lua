-- Two fingers on springs, pulled by one tendon, wrap around an object; the forces with which the springs press.
--   clench run examples/11_adaptive_fingers.lua [PICTURE]
local clench = require "clench"
local picture = arg and arg[1] or "build/adaptive.png"

local world = clench.load("worlds/tendon_cylinder.wld", {root = "."})
local gripper, cylinder = world.robots[1], world.objects[1]

-- rods in front of the palm: the wider the rod, the earlier it stops the proximal links, and the farther the distal ones close
local proximal = {}
for i, radius in ipairs {0.03, 0.024, 0.018} do
  local trial = world:clone()
  local hand = trial.robots[1]
  trial:remove(trial.objects[1])
  local rod = trial:add_object(clench.shapes.cylinder {radius, height = 0.16}, {name = "rod", pose = {xyz = {radius - 0.04, 0, 0}}})
  hand:autograsp()
  local joints = hand.chains[1].joints
  proximal[i] = joints[1].value
  print(("rod of %2.0f mm: proximal %5.2f rad, distal %5.2f rad, %d contacts"):format(radius * 2000, joints[1].value,
    joints[2].value, #trial:contacts(hand, rod)))
end
assert(proximal[1] < proximal[2] and proximal[2] < proximal[3])

-- joints that contacts hold back deflect their springs, which press on the rod
gripper:autograsp()
for _, joint in ipairs(gripper.chains[1].joints) do
  print(("wound up by %.3f rad: %.2f N mm"):format(joint.spring_deflection, 1000 * joint.spring * joint.spring_deflection))
end
local held = clench.grasp(gripper, cylinder):equilibrium {torques = "springs"}
local pressed = 0
for _, force in ipairs(held.forces) do pressed = pressed + force.normal end
print(("%s: the fingers press with %.2f N in all"):format(held.status, pressed))

clench.render(world, {
  size = {960, 720}, samples = 4, eye = {0.05, -0.2, 0.34}, target = {-0.02, 0, 0.06}, field_of_view = 0.55, forces = held.forces, contacts = false,
}):save(picture)
print("picture " .. picture)
assert(held.status == "stable" and pressed > 0.1)
