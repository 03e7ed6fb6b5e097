--- For a hand on an arm: selects the grasps that the arm reaches, both at the pregrasp and at the grasp.
local reach = {}

-- DOFs of the arm that place the hand there without collision; nil: none were found
local function reaches(arm, hand, X_WH)
  local result = arm:ik(hand.base, X_WH, {collision_free = true})
  return result.reached and result.dofs or nil
end

---@param job table  of clench.plan.job, with an arm
---@param grasps grasp[]
---@return grasp[] reached, integer others  others: number of the remaining grasps; each reached grasp has the arm's DOFs at the grasp as `info.arm_1` and so on
function reach.filter(job, grasps)
  local world = job.given_world:clone()
  local hand, object = world:robot(job.given_hand.name), world:body(job.given_object.name)
  local arm = hand.parent
  local reached, others = {}, 0
  for _, grasp in ipairs(grasps) do
    if not job:has_patience() then break end
    local before = grasp.pregrasp
    hand:set_dofs(before and before.dofs or grasp.dofs)
    local comes = not before or reaches(arm, hand, object.pose * before.pose)
    hand:set_dofs(grasp.dofs)
    local dofs = comes and reaches(arm, hand, object.pose * grasp.pose)
    if dofs then
      local info = grasp.info
      for i, value in ipairs(dofs) do info["arm_" .. i] = value end
      grasp.info = info
      reached[#reached + 1] = grasp
    else
      others = others + 1
    end
  end
  return reached, others
end

return reach
