--- Chooses grasps from different sides: a grasp from a new approach direction comes before a better one from a direction already chosen.

local apart = math.cos(math.rad(30))  -- approach directions whose cosine is smaller count as different

---@param hand robot
---@param grasps grasp[]  best first
---@param count integer  number of grasps to choose
---@return grasp[]  best first
return function(hand, grasps, count)
  if #grasps <= count then return grasps end
  local in_base = hand.pose:inverse():rotate(hand.approach.direction)
  local directions, chosen, left = {}, {}, {}
  for i, grasp in ipairs(grasps) do directions[i], left[i] = grasp.pose:rotate(in_base), i end
  -- each round takes the best remaining grasp of every direction
  while #chosen < count do
    local of_round, rest = {}, {}
    for _, i in ipairs(left) do
      local is_new = #chosen < count
      for _, other in ipairs(of_round) do is_new = is_new and directions[i]:dot(other) < apart end
      if is_new then
        of_round[#of_round + 1], chosen[#chosen + 1] = directions[i], i
      else
        rest[#rest + 1] = i
      end
    end
    left = rest
  end
  table.sort(chosen)
  for k, i in ipairs(chosen) do chosen[k] = grasps[i] end
  return chosen
end
