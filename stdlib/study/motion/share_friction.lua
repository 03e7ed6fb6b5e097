--- Multiplies the friction between a hand's materials and an object's by a factor.
---@param hand robot
---@param object body
---@param share number  > 0
return function(hand, object, share)
  local world, done = hand.world, {}
  for _, body in ipairs(hand.bodies) do
    if not done[body.material] then
      local static, kinetic, restitution = world:friction(body.material, object.material)
      world:set_friction(body.material, object.material, {static = static * share, kinetic = kinetic * share, restitution = restitution})
      done[body.material] = true
    end
  end
end
