local described = require "clench.described"
local new_options = require "clench.options"
local of_glove = require "clench.devices.calibration"
local raise = require "clench.raise"

local subject = "devices.glove_map"

-- pairs {DOF of the hand, row of the calibration}
local function read_pairs(o, count, rows)
  local given, out = o:raw "dofs", {}
  if given == nil then
    for d = 1, math.min(count, rows) do out[d] = {d, d} end
    return out
  end
  if type(given) ~= "table" or next(given) == nil then o:expected("dofs", "rows of the calibration by the numbers of DOFs", given) end
  for d, row in pairs(given) do
    if math.type(d) ~= "integer" or d < 1 or d > count then o:expected("dofs", ("numbers of DOFs from 1 to %d"):format(count), d) end
    if math.type(row) ~= "integer" or row < 1 or row > rows then o:expected(("dofs[%d]"):format(d), ("a row from 1 to %d"):format(rows), row) end
    out[#out + 1] = {d, row}
  end
  return out
end

--- A function from raw sensor values of a glove to DOFs of a hand, clamped to their limits. DOFs without a row keep their values.
---@param options table
---@option hand robot
---@option calibration? table  {slopes, intercepts}; that of the hand, `hand.glove`, by default
---@option dofs? table  rows of the calibration by the numbers of DOFs; by default each DOF has the row of its number
---@return fun(raw: number[]): number[]
---@effect reads
--- > calibration = {slopes = {{0.01}}, intercepts = {-0.5}}
--- > to_dofs = clench.devices.glove_map {hand = hand, calibration = calibration, dofs = {[2] = 1}}
--- > math.abs(to_dofs({60})[2] - 0.1) < 1e-12, to_dofs({60})[1] == hand.dofs[1]  --> true, true
return function(options)
  local o = new_options(subject, options)
  local hand = o:get "hand"
  local calibration = o:raw "calibration"
  if calibration == nil then calibration = hand.glove end
  of_glove.check(subject, calibration, ", or a hand with a glove")
  local map = read_pairs(o, #hand.dofs, #calibration.slopes)
  o:done()
  return function(raw)
    if type(raw) ~= "table" then raise(("%s: expected a list of raw sensors, got %s"):format(subject, described(raw))) end
    local out, limits = hand.dofs, hand.dof_limits
    for _, pair in ipairs(map) do
      local d, row = pair[1], pair[2]
      out[d] = math.max(limits[d][1], math.min(limits[d][2], of_glove.dof(subject, calibration, row, raw)))
    end
    return out
  end
end
