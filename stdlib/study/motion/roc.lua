--- The ROC curve of a score that separates good from bad samples, and the area under it.
--- source  Hanley & McNeil (1982), The meaning and use of the area under a ROC curve, eqs. 1 and 2 for its error

---@param good number[]  larger is better
---@param bad number[]
---@return {auc?: number, low?: number, high?: number, curve: {false_positives: number[], true_positives: number[]}}  no area if there are no good or no bad samples
return function(good, bad)
  local all = {}
  for _, value in ipairs(good) do all[#all + 1] = {value, true} end
  for _, value in ipairs(bad) do all[#all + 1] = {value, false} end
  table.sort(all, function(a, b) return a[1] > b[1] end)
  local curve = {false_positives = {0}, true_positives = {0}}
  local g, b, area, i = 0, 0, 0, 1
  while i <= #all do
    -- equal numbers form one step, a straight line
    local value, g0, b0 = all[i][1], g, b
    while i <= #all and all[i][1] == value do
      if all[i][2] then g = g + 1 else b = b + 1 end
      i = i + 1
    end
    area = area + (b - b0) * (g + g0) / 2
    table.insert(curve.false_positives, #bad > 0 and b / #bad or 0)
    table.insert(curve.true_positives, #good > 0 and g / #good or 0)
  end
  if #good == 0 or #bad == 0 then return {curve = curve} end
  local auc = area / (#good * #bad)
  local q1, q2 = auc / (2 - auc), 2 * auc ^ 2 / (1 + auc)
  local error = math.sqrt(math.max(0, (auc * (1 - auc) + (#good - 1) * (q1 - auc ^ 2) + (#bad - 1) * (q2 - auc ^ 2)) / (#good * #bad)))
  return {auc = auc, low = math.max(0, auc - 1.96 * error), high = math.min(1, auc + 1.96 * error), curve = curve}
end
