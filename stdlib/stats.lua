--- Statistics of lists of numbers.
local raise = require "clench.raise"
local described = require "clench.described"
local module_name = require "clench.module_name"
local read_options = require "clench.options"
local stats = {}

local function fail(name, format, ...) raise(("stats.%s: " .. format):format(name, ...)) end

-- a list of finite numbers, at least one
local function check_values(name, values)
  if type(values) ~= "table" or module_name(values) then fail(name, "expected a list of numbers, got %s", described(values)) end
  local count = 0
  for _ in pairs(values) do count = count + 1 end
  if count == 0 then fail(name, "expected at least one number, got none") end
  for i = 1, count do
    local x = values[i]
    if type(x) ~= "number" or x ~= x or x - x ~= 0 then
      fail(name, "values[%d]: expected a finite number, got %s", i, described(x))
    end
  end
end

local function sorted_copy(values)
  local sorted = table.move(values, 1, #values, 1, {})
  table.sort(sorted)
  return sorted
end

-- of a sorted list, by linear interpolation
local function quantile_of(sorted, part)
  local at = 1 + part * (#sorted - 1)
  local low = math.floor(at)
  local high = math.min(low + 1, #sorted)
  return sorted[low] + (at - low) * (sorted[high] - sorted[low])
end

local function mean_of(values)
  local mean = 0
  for i, value in ipairs(values) do mean = mean + (value - mean) / i end
  return mean
end

local function std_of(values)
  local mean, largest, squares = mean_of(values), 0, 0
  for _, value in ipairs(values) do largest = math.max(largest, math.abs(value - mean)) end
  if largest == 0 or #values == 1 then return 0 end
  -- scaled by the largest deviation, whose square may overflow
  for _, value in ipairs(values) do squares = squares + ((value - mean) / largest) ^ 2 end
  return largest * math.sqrt(squares / (#values - 1))
end

--- The arithmetic mean.
---@param values number[]  at least one
---@return number
---@effect reads
--- > clench.stats.mean {1, 2, 6}  --> 3.0
--- > clench.stats.mean {}  --> error: stats.mean: expected at least one number, got none
function stats.mean(values)
  check_values("mean", values)
  return mean_of(values)
end

--- The sample standard deviation, with denominator n - 1; 0 for a single number.
---@param values number[]  at least one
---@return number
---@effect reads
--- > clench.stats.std {1, 3}  --> 1.4142135623731
function stats.std(values)
  check_values("std", values)
  return std_of(values)
end

--- The quantile: the number below which a given fraction of the values lies, by linear interpolation.
---@param values number[]  at least one
---@param part number  fraction in [0, 1]; 0: minimum, 0.5: median, 1: maximum
---@return number
---@effect reads
--- > clench.stats.quantile({5, 1, 2, 4, 3}, 0.5)  --> 3.0
--- > clench.stats.quantile({1, 2}, 50)  --> error: stats.quantile: part: expected a number from 0 to 1, got 50
function stats.quantile(values, part)
  check_values("quantile", values)
  if type(part) ~= "number" or not (part >= 0 and part <= 1) then
    fail("quantile", "part: expected a number from 0 to 1, got %s", described(part))
  end
  return quantile_of(sorted_copy(values), part)
end

--- Summary statistics: count, mean, sample standard deviation, minimum, maximum, median, and 5th and 95th percentiles.
---@param values number[]  at least one
---@return {count: integer, mean: number, std: number, min: number, p05: number, median: number, p95: number, max: number}
---@effect reads
--- > s = clench.stats.summary {4, 1, 3, 2, 5}
--- > s.count, s.min, s.median, s.max  --> 5, 1, 3.0, 5
function stats.summary(values)
  check_values("summary", values)
  local sorted = sorted_copy(values)
  return {count = #values, mean = mean_of(values), std = std_of(values), min = sorted[1],
          p05 = quantile_of(sorted, 0.05), median = quantile_of(sorted, 0.5), p95 = quantile_of(sorted, 0.95),
          max = sorted[#sorted]}
end

--- Counts the numbers in intervals of equal width; each includes its lower edge, the last one both edges. The default number of bins is that of Sturges (1926),
--- 1 + log2 of the count, rounded up; numbers outside of `low` and `high` are counted separately.
---@param values number[]  at least one
---@param options? table  settings of the intervals
---@option bins? integer [1 to 100000]  number of intervals, by default by Sturges' rule
---@option low? number  lower edge of the first interval, by default the minimum
---@option high? number  upper edge of the last interval, by default the maximum
---@return {edges: number[], counts: integer[], below: integer, above: integer}  edges: one more than counts; below, above: numbers outside of the intervals
---@effect reads
--- > h = clench.stats.histogram({0, 1, 1, 2, 3, 4}, {bins = 2})
--- > h.edges  --> {0.0, 2.0, 4.0}
--- > h.counts  --> {3, 3}
--- > clench.stats.histogram({1, 2, 9}, {bins = 2, low = 0, high = 4}).above  --> 1
function stats.histogram(values, options)
  check_values("histogram", values)
  local read = read_options("stats.histogram", options or {})
  local least, largest = values[1], values[1]
  for _, value in ipairs(values) do least, largest = math.min(least, value), math.max(largest, value) end
  local bins = read:get("bins", math.max(1, math.ceil(1 + math.log(#values, 2))))
  local low, high = read:get("low", least), read:get("high", largest)
  read:done()
  -- equal numbers also need an interval with a width
  if low == high then low, high = low - 0.5, high + 0.5 end
  if low > high then fail("histogram", "expected low below high, got %s and %s", described(low), described(high)) end
  local out = {edges = {}, counts = {}, below = 0, above = 0}
  for i = 0, bins do out.edges[i + 1] = i == bins and high + 0.0 or low + (high - low) * i / bins end
  for i = 1, bins do out.counts[i] = 0 end
  for _, value in ipairs(values) do
    if value < low then
      out.below = out.below + 1
    elseif value > high then
      out.above = out.above + 1
    else
      local bin = math.min(bins, 1 + math.floor((value - low) / (high - low) * bins))
      -- corrects bins at edges for rounding errors
      while bin > 1 and value < out.edges[bin] do bin = bin - 1 end
      while bin < bins and value >= out.edges[bin + 1] do bin = bin + 1 end
      out.counts[bin] = out.counts[bin] + 1
    end
  end
  return out
end

--- The 95 % confidence interval of a probability, from the numbers of successes and trials. Source: Wilson (1927).
---@param successes integer [>= 0]  number of successes
---@param trials integer [>= 0]  number of trials
---@return {low: number, high: number}
---@effect reads
--- > i = clench.stats.interval(8, 10)
--- > i.low < 0.5 and i.high > 0.9  --> true
--- > clench.stats.interval(8)  --> error: stats.interval: trials: expected a whole number >= 0, got nothing
function stats.interval(successes, trials)
  local function check_count(name, n)
    if type(n) ~= "number" or not math.tointeger(n) or n < 0 then
      fail("interval", "%s: expected a whole number >= 0, got %s", name, described(n))
    end
  end
  check_count("successes", successes)
  check_count("trials", trials)
  if trials == 0 or successes > trials then
    fail("interval", "expected at least one trial, and at most as many successes as trials, got %d of %d", successes, trials)
  end
  local z = 1.959963984540054
  local p, n = successes / trials, trials
  local center = (p + z * z / (2 * n)) / (1 + z * z / n)
  local half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
  return {low = math.max(0, center - half), high = math.min(1, center + half)}
end

return require "clench.sealed"("clench.stats", stats)
