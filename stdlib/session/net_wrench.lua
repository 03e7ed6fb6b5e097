--- The unbalanced wrench of a body: its weight and the contact forces of the last step.
local net_wrench = {}

-- force and torsion of a contact on the body, along the world's axes
local function of_contact(body, contact)
  local sign = contact.body == body and 1 or -1
  return contact.force * sign, contact.normal * (contact.torsion * sign)
end

--- Force and torque about its center of mass, along the world's axes.
---@param body body
---@return {point: vec3, force: vec3, torque: vec3} wrench  point: the center of mass [m]; force [N], torque [N m]
function net_wrench.of(body)
  local world, center = body.world, body.pose * body.com
  local force, torque = world.gravity * body.mass, clench.vec3(0, 0, 0)
  for _, contact in ipairs(world:contacts(body)) do
    local f, t = of_contact(body, contact)
    force, torque = force + f, torque + t + (contact.point - center):cross(f)
  end
  return {point = center, force = force, torque = torque}
end

return net_wrench
