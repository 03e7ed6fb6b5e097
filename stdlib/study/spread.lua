-- stdlib/study/spread.lua
--- What a list of measured numbers says: mean, standard deviation, least, largest, and quantiles.
local spread = {}

--- the value below which a part of all lie, linear between neighbours
local function quantile(sorted, part)
  local at = 1 + part * (#sorted - 1)
  local low = math.floor(at)
  local high = math.min(low + 1, #sorted)
  return sorted[low] + (at - low) * (sorted[high] - sorted[low])
end

---@param values number[]  at least one
---@return {mean: number, std: number, min: number, p05: number, median: number, p95: number, max: number}  std of the sample; p05 and p95: 5 and 95 %
function spread.of(values)
  local sorted = table.move(values, 1, #values, 1, {})
  table.sort(sorted)
  local mean = 0
  for i, value in ipairs(values) do mean = mean + (value - mean) / i end
  local squares = 0
  for _, value in ipairs(values) do squares = squares + (value - mean) ^ 2 end
  return {mean = mean, std = #values > 1 and math.sqrt(squares / (#values - 1)) or 0,
          min = sorted[1], p05 = quantile(sorted, 0.05), median = quantile(sorted, 0.5),
          p95 = quantile(sorted, 0.95), max = sorted[#sorted]}
end

--- The interval that holds a probability with 95 % confidence, after so many of so many trials.
--- source  Wilson (1927)
function spread.interval(successes, trials)
  local z = 1.959963984540054
  local p, n = successes / trials, trials
  local centre = (p + z * z / (2 * n)) / (1 + z * z / n)
  local half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
  return {low = math.max(0, centre - half), high = math.min(1, centre + half)}
end

return spread
