--- The load that a hand holds with a grasp, by the balance of its contact forces.
local held_load = {}

--- The six directions in which objects are pulled, in the world.
held_load.directions = {clench.vec3(1, 0, 0), clench.vec3(-1, 0, 0), clench.vec3(0, 1, 0), clench.vec3(0, -1, 0),
                        clench.vec3(0, 0, 1), clench.vec3(0, 0, -1)}

--- Default of the maximum sum of normal forces [weights of the object].
held_load.force_ratio = 10

--- The load that the hand holds in the worst of six directions [weights of the object], with a sum of normal forces of at most `force_ratio` weights, and
--- motors within their limits unless `torque_limits` is false.
function held_load.of(object, grasp, force_ratio, torque_limits)
  local weight = 9.81 * object.mass
  local least = math.huge
  for _, d in ipairs(held_load.directions) do
    local result = grasp:max_load {direction = {d.x * weight, d.y * weight, d.z * weight, 0, 0, 0},
                                   max_total_force = force_ratio * weight, torque_limits = torque_limits ~= false}
    local load = (result.status == "optimal" or result.status == "unlimited") and result.load or 0
    least = math.min(least, load)
    if least <= 0 then break end
  end
  return math.max(least, 0)
end

return held_load
