-- Contact forces that hold a flask, the largest multiple of its weight that can be held, and the limit that is reached first.
--   clench run examples/10_contact_forces.lua [PICTURE]
local clench = require "clench"
local picture = arg and arg[1] or "build/forces.png"

local world = clench.load("worlds/dlr_flask.wld", {root = "."})
local hand, flask = world.robots[1], world.objects[1]
hand:autograsp()
local grasp = clench.grasp(hand, flask)
local weight = {0, 0, -9.81 * flask.mass, 0, 0, 0}

-- the smallest forces that balance the weight, within the friction cones and the limits of the motors
local held = grasp:contact_forces {load = weight, torque_limits = true}
print(("holding %.2f N takes normal forces of %.2f N in all"):format(-weight[3], held.objective))
for _, f in ipairs(held.forces) do
  if f.normal > 1e-6 then print(("  %-18s presses with %.3f N"):format(f.contact.link.name, f.normal)) end
end

-- the largest multiple of the weight that can be held, and the motor that limits it
local most = grasp:max_load {direction = weight, torque_limits = true}
print(("%.1f times the weight could be held; then DOF %d gives way"):format(most.load, most.certificate.dof))

-- normal forces of at most 0.2 N per contact do not suffice: the proof is a motion of the flask
local weak = grasp:contact_forces {load = weight, max_force = 0.2}
local proof = weak.certificate
print(("with 0.2 N a contact: %s, %.3f W against %.3f W, %s gives way"):format(weak.status, proof.power, proof.capacity,
  proof.contact.link.name))

-- forces well inside the cones, drawn as arrows
local firm = grasp:contact_forces {load = weight, objective = "max_margin", max_force = 5}
clench.render(world, {
  size = {960, 720}, samples = 4, eye = {0.42, -0.42, 0.38}, target = {-0.02, 0, 0.1}, field_of_view = 0.45,
  forces = firm.forces,
}):save(picture)
print("picture " .. picture)

assert(held.status == "optimal" and held.residual < 1e-9 and most.load > 1 and weak.status == "infeasible")
assert(firm.forces[1].margin > 0.1)
