local described = require "clench.described"
local new_options = require "clench.options"
local of_glove = require "clench.devices.calibration"
local raise = require "clench.raise"

local subject = "devices.glove_map"

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
  local map = of_glove.read_map(o, #hand.dofs, #calibration.slopes)
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
