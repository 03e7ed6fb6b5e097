local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local crowd = require "clench.plan.crowd"
local starts = require "clench.plan.starts"
local verified = require "clench.plan.verified"

-- Start number n of a seed: before a point of the surface, along its normal or tilted, closed by a part of the way, and
-- DOFs that closing does not move (a spread) anywhere.
local function random_starts(job, standoff)
  local hand, object = job.hand, job.object
  local open, closes = starts.opened(hand)
  local limits, X_AH = hand.dof_limits, starts.base_in_approach(hand)
  return function(number)
    local random = clench.random(job.seed, 2 * number)
    local at = object.mesh:sample(random, 1)[1]
    local tilt = random:normal() * 0.4
    local axis = at.normal:cross(random:direction())
    local direction = -at.normal
    if axis:norm() > 1e-6 then direction = clench.pose {axis = axis, angle = tilt}:rotate(direction) end
    local X_OA = starts.looking(at.point - direction * standoff, direction, random:uniform(0, 2 * math.pi))
    local dofs, closed = {}, random:uniform(0, 0.35)
    for i, value in ipairs(open) do
      local low, high = limits[i][1], limits[i][2]
      if not (high - low < math.huge) then
        dofs[i] = value
      elseif closes[i] then
        local far = math.abs(value - low) > math.abs(value - high) and low or high
        dofs[i] = value + closed * (far - value)
      else
        dofs[i] = random:uniform(low, high)
      end
    end
    local set_back = math.max(0, random:uniform(-0.03, 0.03))
    return {pose = X_OA * X_AH, dofs = dofs, set_back = set_back}
  end
end

local function read_verify(read, grasp_options)
  local given = read:raw "verify"
  if given == false then return nil end
  if given ~= nil and given ~= true and type(given) ~= "table" then read:expected("verify", "a boolean or a table", given) end
  local own = require "clench.options"(read.subject .. ": verify", type(given) == "table" and given or {})
  local options = {grasp = grasp_options}
  for _, name in ipairs {"displacement", "force_ratio", "lift", "min_epsilon", "min_load"} do
    options[name] = own:not_negative(name, verified.defaults[name])
  end
  own:done()
  return options
end

--- Random approaches to the object's surface: the hand comes to the first touch and closes; what is in force closure is
--- improved by small random changes and verified. Fast, diverse, and any number of threads gives the same grasps.
---@param options {hand: robot, object: body, count?: integer, candidates?: integer, seconds?: number, seed?: integer, threads?: integer, refine?: integer, verify?: boolean|table, standoff?: number, distance?: number, on_grasp?: function, grasp?: table, world?: world}  count: of grasps before like ones are left out, 100; candidates: at most, 100000; refine: changes that are tried, 10; verify: {displacement: 0.001 [m], force_ratio: 10 weights of normal force, min_load: 2 weights, min_epsilon: 0.01, lift: 0.1 [m]}; standoff: of the approach point before the surface, 0.15 [m]; distance: grasps nearer than that part of the object's radius, of half a turn and of the DOFs' ranges are alike, 0.1; on_grasp(grasp): called as soon as one is found; grasp: options of clench.grasp
---@return {grasps: grasps, report: table} # the largest epsilon first, each with `info.load_margin` [weights] and `info.reclosed_epsilon`
--- > run = clench.plan.sample {hand = hand, object = flask, count = 3, refine = 2}
--- > run.grasps[1].epsilon > 0, run.report.candidates > 3  --> true, true
--- > clench.plan.sample {hand = hand, object = flask, verify = {lfit = 0}}  --> error: unknown key 'lfit'
return function(options)
  local own = {}
  local job = new_job("plan.sample", options, function(read, job)
    own.count = read:count("count", 100, 1, 1000000)
    own.limit = read:count("candidates", 100000, 1, 1e9)
    own.refine = read:count("refine", 10, 0, 10000)
    own.verify = read_verify(read, job.grasp_options)
    own.standoff = read:positive("standoff", 0.15)
    own.distance = read:not_negative("distance", 0.1)
    own.on_grasp = read:raw "on_grasp"
    if own.on_grasp and type(own.on_grasp) ~= "function" then read:expected("on_grasp", "a function", own.on_grasp) end
  end)
  own.planner, own.approach = "sample", 2 * own.standoff
  local told = {planner = "plan.sample"}
  local found = crowd.try(job, told, random_starts(job, own.standoff), own)
  job:finish()
  return new_run(job, crowd.sort(found), told, {distance = own.distance})
end
