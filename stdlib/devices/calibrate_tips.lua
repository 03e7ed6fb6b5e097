local least_squares = require "clench.devices.least_squares"
local new_options = require "clench.options"
local of_glove = require "clench.devices.calibration"
local raise = require "clench.raise"

local subject = "devices.calibrate_tips"
local min_samples = 6
local max_steps = 100
local coincident = 2e-4  -- separation of tips below which its direction is not used [m]
local max_damping, min_damping = 1e12, 1e-14

local function is_number(x) return type(x) == "number" and x - x == 0 end

local function check_samples(o, count)
  local samples = o:raw "samples"
  if type(samples) ~= "table" or #samples < min_samples then o:expected("samples", ("a list of at least %d {sensors, distance}"):format(min_samples), samples) end
  for i, sample in ipairs(samples) do
    local fits = type(sample) == "table" and type(sample.sensors) == "table" and #sample.sensors == count
    if not fits then o:expected(("samples[%d]"):format(i), ("{sensors, distance} with %d sensors"):format(count), sample) end
    for s, value in ipairs(sample.sensors) do
      if not is_number(value) then o:expected(("samples[%d].sensors[%d]"):format(i, s), "a number", value) end
    end
    if not (is_number(sample.distance) and sample.distance >= 0) then o:expected(("samples[%d].distance"):format(i), "a number >= 0 in m", sample.distance) end
  end
  return samples
end

-- the point of a link that is farthest from its origin, at which its joint is
local function far_point(link)
  local far, longest = clench.vec3(0, 0, 0), -1
  for _, v in ipairs(link.mesh.vertices) do
    local p = clench.vec3(v[1], v[2], v[3])
    if p:norm() > longest then far, longest = p, p:norm() end
  end
  return far
end

-- two points on links of the hand
local function read_tips(o, hand)
  local given, tips = o:raw "tips", {}
  if type(given) ~= "table" or #given ~= 2 then o:expected("tips", "two links, by their names or as {link, point}", given) end
  for i, tip in ipairs(given) do
    local name, point = tip, nil
    if type(tip) == "table" then name, point = tip.link, tip.point end
    if type(name) ~= "string" then o:expected(("tips[%d]"):format(i), "the name of a link, or {link, point}", tip) end
    local link = hand:link(name)
    if point ~= nil and not (type(point) == "table" and is_number(point[1]) and is_number(point[2]) and is_number(point[3]) or clench.type(point) == "vec3") then
      o:expected(("tips[%d].point"):format(i), "a point of the link [m]", point)
    end
    tips[i] = {link = name, point = point and clench.vec3(point[1] or point.x, point[2] or point.y, point[3] or point.z) or far_point(link)}
  end
  if tips[1].link == tips[2].link then o:expected("tips", "two different links", given) end
  return tips
end

-- the coefficients that are fitted: for each DOF the intercept, and the slopes that are not zero
local function read_refined(o, calibration, map)
  local given, list, row_of = o:raw "refine", {}, {}
  for _, pair in ipairs(map) do row_of[pair[1]] = pair[2] end
  if type(given) ~= "table" or #given == 0 then o:expected("refine", "a list of DOFs of the hand", given) end
  for i, d in ipairs(given) do
    local row = row_of[d]
    if not row then o:expected(("refine[%d]"):format(i), "the number of a DOF that the calibration sets", d) end
    row_of[d] = nil  -- each once
    list[#list + 1] = {dof = d, row = row}
    for s, slope in ipairs(calibration.slopes[row]) do
      if slope ~= 0 then list[#list + 1] = {dof = d, row = row, sensor = s} end
    end
  end
  return list
end

-- raw values, less their means for the sensors whose slopes are fitted: otherwise slopes and intercepts depend on each other
local function means_of(samples, coefficients)
  local means = {}
  for _, c in ipairs(coefficients) do
    if c.sensor then
      local sum = 0
      for _, sample in ipairs(samples) do sum = sum + sample.sensors[c.sensor] end
      means[c.sensor] = sum / #samples
    end
  end
  return means
end

-- The problem's residuals: separation of the tips, less the recorded distance and the shell; with their derivatives by the coefficients
local function residuals_of(problem, calibration)
  local hand, tips, list = problem.hand, problem.tips, {}
  for i, sample in ipairs(problem.samples) do
    local dofs, is_free = {table.unpack(problem.dofs)}, {}
    for _, pair in ipairs(problem.map) do
      local d, value = pair[1], of_glove.dof(subject, calibration, pair[2], sample.sensors)
      local low, high = problem.limits[d][1], problem.limits[d][2]
      dofs[d], is_free[d] = math.max(low, math.min(high, value)), value > low and value < high
    end
    hand:set_posture(hand.pose, dofs)
    local between = hand:link(tips[1].link).pose * tips[1].point - hand:link(tips[2].link).pose * tips[2].point
    local separation = between:norm()
    local one = {value = separation - sample.distance - problem.shell, row = {}, is_used = separation > coincident}
    local first, second = hand:jacobian(tips[1].link, tips[1].point), hand:jacobian(tips[2].link, tips[2].point)
    for k, c in ipairs(problem.coefficients) do
      local slope = 0
      for axis, part in ipairs {between.x, between.y, between.z} do slope = slope + part * (first[axis][c.dof] - second[axis][c.dof]) end
      local factor = c.sensor and sample.sensors[c.sensor] - problem.means[c.sensor] or 1
      one.row[k] = one.is_used and is_free[c.dof] and slope / separation * factor or 0
    end
    list[i] = one
  end
  return list
end

local function cost_of(list)
  local sum = 0
  for _, one in ipairs(list) do
    if one.is_used then sum = sum + one.value * one.value end
  end
  return sum
end

-- the calibration with changed coefficients
local function changed(problem, calibration, step)
  local out = {slopes = {}, intercepts = {table.unpack(calibration.intercepts)}}
  for d, row in ipairs(calibration.slopes) do out.slopes[d] = {table.unpack(row)} end
  for k, c in ipairs(problem.coefficients) do
    if c.sensor then
      out.slopes[c.row][c.sensor] = out.slopes[c.row][c.sensor] + step[k]
      out.intercepts[c.row] = out.intercepts[c.row] - step[k] * problem.means[c.sensor]
    else
      out.intercepts[c.row] = out.intercepts[c.row] + step[k]
    end
  end
  return out
end

-- the step of Levenberg and Marquardt: coefficients are scaled by the norms of their columns
local function damped_step(list, count, damping)
  local scale, largest = {}, 0
  for k = 1, count do
    local sum = 0
    for _, one in ipairs(list) do sum = sum + one.row[k] ^ 2 end
    scale[k] = math.sqrt(sum)
    largest = math.max(largest, scale[k])
  end
  if largest == 0 then return nil end
  local a, b = {}, {}
  for k = 1, count do scale[k] = math.max(scale[k], 1e-9 * largest) end
  for i, one in ipairs(list) do
    a[i], b[i] = {}, -one.value
    for k = 1, count do a[i][k] = one.row[k] / scale[k] end
    if not one.is_used then b[i] = 0 end
  end
  for k = 1, count do
    local row = {}
    for other = 1, count do row[other] = other == k and math.sqrt(damping) or 0 end
    a[#a + 1], b[#b + 1] = row, 0
  end
  local step = least_squares.solve(a, b)
  for k = 1, step and count or 0 do step[k] = step[k] / scale[k] end
  return step
end

-- minimizes the sum of squares; returns the calibration, its residuals, the number of steps, and has it converged?
local function minimize(problem, calibration)
  local list, damping, count = residuals_of(problem, calibration), 1e-3, #problem.coefficients
  for steps = 1, max_steps do
    local cost, is_better = cost_of(list), false
    repeat
      local step = damped_step(list, count, damping)
      local next_one = step and changed(problem, calibration, step)
      local next_list = step and residuals_of(problem, next_one)
      is_better = step and cost_of(next_list) < cost
      if is_better then
        calibration, list, damping = next_one, next_list, math.max(min_damping, damping / 10)
      else
        damping = damping * 10
      end
    until is_better or damping > max_damping or not step
    if not is_better then return calibration, list, steps, true end
  end
  return calibration, list, max_steps, false
end

local function report_of(list, count, steps, converged)
  local sum, largest, used, rejected = 0, 0, 0, {}
  for i, one in ipairs(list) do
    if one.is_used then
      sum, largest, used = sum + one.value ^ 2, math.max(largest, math.abs(one.value)), used + 1
    else
      rejected[#rejected + 1] = i
    end
  end
  return {samples = used, rejected = rejected, rms = used > 0 and math.sqrt(sum / used) or nil, max = largest, steps = steps, converged = converged,
          sigma = used > count and math.sqrt(sum / (used - count)) or nil}
end

--- Refines the calibration of a glove by postures in which two fingertips touch, or have a known distance: those of thumb and index finger, for the joints
--- of the thumb, which are hard to measure. Intercepts and those slopes of the given DOFs that are not zero are changed, so that the distances of the tips of
--- the model agree with the recorded ones. Coefficients that the postures do not determine keep the given values as far as possible.
---@param options table
---@option hand robot  that has the geometry of the wearer's hand
---@option calibration table  {slopes, intercepts}, as of `clench.devices.calibrate`
---@option samples table[]  {sensors = raw values, distance = of the surfaces of the tips, 0: they touch [m]}, at least six
---@option tips table  two links, by their names, or as {link = its name, point = of the tip in it [m]}; by default the point farthest from the link's joint
---@option refine index[]  DOFs of the hand whose coefficients are fitted
---@option dofs? table  rows of the calibration by the numbers of DOFs; by default each DOF has the row of its number
---@option shell? number [m, >= 0] = 0.008  separation of the points of two tips that touch
---@return table calibration # `slopes`, `intercepts`; `tips`: `samples`, `rejected` (tips closer than 0.2 mm), `rms`, `max`, `sigma` (standard deviation of the noise) [m], `steps`, `converged`
---@effect reads
--- > calibration = {slopes = {{0.01}}, intercepts = {0}}
--- > options = {hand = hand, calibration = calibration, samples = {}, tips = {"chain0_link2", "chain1_link2"}, refine = {1}}
--- > clench.devices.calibrate_tips(options)  --> error: samples must be a list of at least 6 {sensors, distance}
return function(options)
  local o = new_options(subject, options)
  local hand, calibration, shell = o:get "hand", o:raw "calibration", o:get "shell"
  local count = of_glove.check(subject, calibration)
  local map = of_glove.read_map(o, #hand.dofs, #calibration.slopes)
  local problem = {map = map, samples = check_samples(o, count), tips = read_tips(o, hand), coefficients = read_refined(o, calibration, map), shell = shell,
                   dofs = hand.dofs, limits = hand.dof_limits}
  o:done()
  problem.means = means_of(problem.samples, problem.coefficients)
  problem.hand = hand:in_world(hand.world:clone())
  local found, list, steps, converged = minimize(problem, calibration)
  found.tips = report_of(list, #problem.coefficients, steps, converged)
  if found.tips.samples == 0 then raise(("%s: the tips of all postures coincide in the model of the hand"):format(subject)) end
  return found
end
