local described = require "clench.described"
local least_squares = require "clench.devices.least_squares"
local new_options = require "clench.options"
local raise = require "clench.raise"

local subject = "devices.calibrate"
local max_rounds = 10  -- maximum number of rounds in which outliers are removed

local function is_number(x) return type(x) == "number" and x - x == 0 end

-- samples, all with the same number of sensors
local function check_samples(o)
  local samples = o:raw "samples"
  if type(samples) ~= "table" or #samples == 0 then o:expected("samples", "a list of {sensors, dofs}", samples) end
  local first = samples[1]
  local count = type(first) == "table" and type(first.sensors) == "table" and #first.sensors or 0
  for i, sample in ipairs(samples) do
    local fits = type(sample) == "table" and type(sample.sensors) == "table" and type(sample.dofs) == "table" and #sample.sensors == count and count > 0
    if not fits then o:expected(("samples[%d]"):format(i), ("{sensors, dofs} with %d sensors"):format(math.max(count, 1)), sample) end
    for s, value in ipairs(sample.sensors) do
      if not is_number(value) then o:expected(("samples[%d].sensors[%d]"):format(i, s), "a number", value) end
    end
    for d, value in pairs(sample.dofs) do
      if not is_number(value) then o:expected(("samples[%d].dofs[%s]"):format(i, tostring(d)), "a number", value) end
    end
  end
  return samples, count
end

local function check_sensors(o, count)
  local of_dof = o:raw "sensors_of"
  if type(of_dof) ~= "table" or next(of_dof) == nil then o:expected("sensors_of", "lists of sensors by the numbers of DOFs", of_dof) end
  local dofs = 0
  for d, list in pairs(of_dof) do
    if math.type(d) ~= "integer" or d < 1 or d > 1000 then raise(("%s: sensors_of: expected numbers of DOFs as keys, got %s"):format(subject, described(d))) end
    if type(list) ~= "table" or #list == 0 then o:expected(("sensors_of[%d]"):format(d), "a list of sensors", list) end
    for k, s in ipairs(list) do
      if math.type(s) ~= "integer" or s < 1 or s > count then o:expected(("sensors_of[%d][%d]"):format(d, k), ("a number from 1 to %d"):format(count), s) end
    end
    dofs = math.max(dofs, d)
  end
  return of_dof, dofs
end

-- Slopes and intercept of one DOF; sensors are centered on their means, so that the intercept is not penalized by the ridge.
local function fit(samples, used, d, sensors, ridge)
  local mean, mean_value = {}, 0
  for k, s in ipairs(sensors) do
    mean[k] = 0
    for _, i in ipairs(used) do mean[k] = mean[k] + samples[i].sensors[s] / #used end
  end
  for _, i in ipairs(used) do mean_value = mean_value + samples[i].dofs[d] / #used end
  local a, b = {}, {}
  for _, i in ipairs(used) do
    local row = {}
    for k, s in ipairs(sensors) do row[k] = samples[i].sensors[s] - mean[k] end
    a[#a + 1], b[#b + 1] = row, samples[i].dofs[d] - mean_value
  end
  for k in ipairs(ridge > 0 and sensors or {}) do
    local row = {}
    for other in ipairs(sensors) do row[other] = other == k and math.sqrt(ridge) or 0 end
    a[#a + 1], b[#b + 1] = row, 0
  end
  if #a < #sensors then return nil, nil, #sensors end
  local slopes, column = least_squares.solve(a, b)
  if not slopes then return nil, nil, column end
  local intercept = mean_value
  for k in ipairs(sensors) do intercept = intercept - slopes[k] * mean[k] end
  return slopes, intercept
end

local function residual(sample, d, sensors, slopes, intercept)
  local value = intercept
  for k, s in ipairs(sensors) do value = value + slopes[k] * sample.sensors[s] end
  return sample.dofs[d] - value
end

local function median(list)
  table.sort(list)
  return list[(#list + 1) // 2]
end

-- samples whose residuals are at most `limit` times the standard deviation, as estimated from the median
local function without_outliers(samples, all, limit, d, sensors, slopes, intercept)
  local sizes = {}
  for n, i in ipairs(all) do sizes[n] = math.abs(residual(samples[i], d, sensors, slopes, intercept)) end
  local bound = limit * 1.4826 * median {table.unpack(sizes)} + 1e-9
  local kept, dropped = {}, {}
  for n, i in ipairs(all) do table.insert(sizes[n] <= bound and kept or dropped, i) end
  return kept, dropped
end

local function report_of(samples, used, dropped, d, sensors, slopes, intercept)
  local sum, largest = 0, 0
  for _, i in ipairs(used) do
    local r = residual(samples[i], d, sensors, slopes, intercept)
    sum, largest = sum + r * r, math.max(largest, math.abs(r))
  end
  local free = #used - #sensors - 1
  return {samples = #used, outliers = dropped, rms = math.sqrt(sum / #used), max = largest, sigma = free > 0 and math.sqrt(sum / free) or nil}
end

local function calibrate_dof(samples, d, sensors, ridge, limit)
  local all = {}
  for i, sample in ipairs(samples) do
    if sample.dofs[d] ~= nil then all[#all + 1] = i end
  end
  local function fit_to(used)
    if ridge == 0 and #used < #sensors + 1 then
      raise(("%s: DOF %d: %d sensors need at least %d samples, got %d"):format(subject, d, #sensors, #sensors + 1, #used))
    end
    local slopes, intercept, column = fit(samples, used, d, sensors, ridge)
    if not slopes then raise(("%s: DOF %d: sensor %d does not vary independently of the others"):format(subject, d, sensors[column])) end
    return slopes, intercept
  end
  local used, dropped = all, {}
  local slopes, intercept = fit_to(used)
  for _ = 1, limit and max_rounds or 0 do
    local kept, out = without_outliers(samples, all, limit, d, sensors, slopes, intercept)
    if table.concat(kept, " ") == table.concat(used, " ") or #kept < #sensors + 2 then break end
    used, dropped = kept, out
    slopes, intercept = fit_to(used)
  end
  return slopes, intercept, report_of(samples, used, dropped, d, sensors, slopes, intercept)
end

--- Calibrates a glove: fits DOF = intercept + slopes * raw to recorded postures by least squares, each DOF to its own sensors. Two samples and
--- one sensor per DOF give the line through both (flat hand and fist, or two abductions); two sensors per DOF also fit the cross-talk of the
--- thumb.
---@param options table
---@option samples table[]  {sensors = raw values, dofs = values by the numbers of DOFs [rad]}; DOFs that a sample leaves out are fitted to the others
---@option sensors_of table  lists of sensors by the numbers of DOFs
---@option ridge? number [>= 0] = 0  penalty on squared slopes, where sensors vary little
---@option outliers? number [> 0]  samples are left out if their residual exceeds this number of standard deviations, as estimated from the median
---@return table calibration # `slopes`, `intercepts`, as of `clench.files.glove_calibration`; `report`, by DOF: `samples`, `outliers`, `rms`, `max`, `sigma` (standard deviation of the noise) [rad]
---@effect reads
--- > samples = {{sensors = {50, 9}, dofs = {0}}, {sensors = {150, 9}, dofs = {1.5}}}
--- > calibration = clench.devices.calibrate {samples = samples, sensors_of = {{1}}}
--- > math.abs(calibration.slopes[1][1] - 0.015) < 1e-15, calibration.slopes[1][2]  --> true, 0
--- > clench.devices.calibrate {samples = samples, sensors_of = {{1, 2}}}  --> error: DOF 1: 2 sensors need at least 3 samples, got 2
return function(options)
  local o = new_options(subject, options)
  local samples, count = check_samples(o)
  local of_dof, dofs = check_sensors(o, count)
  local ridge, limit = o:get "ridge", o:get "outliers"
  o:done()
  local calibration = {slopes = {}, intercepts = {}, report = {}}
  for d = 1, dofs do
    local row, intercept = {}, 0
    for s = 1, count do row[s] = 0 end
    local sensors = of_dof[d]
    if sensors then
      local slopes, at, report = calibrate_dof(samples, d, sensors, ridge, limit)
      for k, s in ipairs(sensors) do row[s] = slopes[k] end
      intercept, calibration.report[d] = at, report
    end
    calibration.slopes[d], calibration.intercepts[d] = row, intercept
  end
  return calibration
end
