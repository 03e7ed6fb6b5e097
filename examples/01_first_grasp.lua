-- From a world file to a measured grasp and its picture.
--   clench run examples/01_first_grasp.lua [PICTURE]
local clench = require "clench"
local picture = arg and arg[1] or "build/demo.png"

-- a hand with four fingers around a flask
local world = clench.load("worlds/dlr_flask.wld", {root = "."})
local hand, flask = world.robots[1], world.objects[1]
print(("%s has %d DOFs; %s weighs %.3f kg"):format(hand.name, #hand.dofs, flask.name, flask.mass))

-- close every finger until a contact or its limit stops it
hand:autograsp()
assert(#world:colliding() == 0, "closing stops at the surface, never inside")

-- contacts of the hand on the flask: points [m], unit normals into the flask
local contacts = world:contacts(hand, flask)
print(("%d contacts"):format(#contacts))
for _, c in ipairs(contacts) do
  print(("  %-24s at (%7.4f, %7.4f, %7.4f) m, normal (%5.2f, %5.2f, %5.2f), mu %.2f"):format(c.link.name, c.point.x,
    c.point.y, c.point.z, c.normal.x, c.normal.y, c.normal.z, c.mu))
end

-- wrenches that these contacts can resist with normal forces that sum to one
local grasp = clench.grasp(hand, flask)
local space = grasp:wrench_space()
local worst = space:weakest()
print(("epsilon       %.4f   the weakest wrench that breaks the grasp"):format(grasp:quality "epsilon"))
print(("volume        %.4f   of all wrenches that it resists"):format(grasp:quality "volume"))
print(("force closure %s"):format(grasp:is_force_closure() and "yes" or "no"))
print(("weakest along force (%.2f, %.2f, %.2f), torque (%.2f, %.2f, %.2f)"):format(table.unpack(worst.direction)))

-- friction cones at the contacts; the flask is drawn transparent
clench.render(world, {
  size = {960, 720}, samples = 4, eye = {0.42, -0.42, 0.38}, target = {-0.02, 0, 0.1}, field_of_view = 0.45,
}):save(picture)
print("picture       " .. picture)

assert(#contacts >= 6 and grasp:is_force_closure() and grasp:quality "epsilon" > 0.02, "a firm grasp")
