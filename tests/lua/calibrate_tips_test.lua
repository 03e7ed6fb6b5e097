-- Calibration of a glove by postures in which two fingertips touch, with known answers.
local test, clench = require "test", require "clench"
local calibrate_tips = clench.devices.calibrate_tips

local thumb, index = "human20_chain4_link2", "human20_chain0_link2"
local tip_points = {{link = thumb, point = {0.02, 0.001, -0.002}}, {link = index, point = {0.015, 0, 0.001}}}
local shell = 0.008

local function human()
  local world = clench.world()
  return world:add_robot("models/hands/human/human20.cfg", {root = "."})
end

-- DOFs of the chain of a link
local function dofs_of(hand, link)
  for _, chain in ipairs(hand.chains) do
    for _, body in ipairs(chain.links) do
      if body.name == link then
        local dofs, seen = {}, {}
        for _, joint in ipairs(chain.joints) do
          if joint.dof and not seen[joint.dof] then dofs[#dofs + 1], seen[joint.dof] = joint.dof, true end
        end
        return dofs
      end
    end
  end
end

-- a glove whose sensor d drives DOF d across the middle of its range; the first joint of the thumb also follows the sensor of the second one
local function truth(hand, random)
  local slopes, intercepts = {}, {}
  local roll, abduction = table.unpack(dofs_of(hand, thumb))
  for d, range in ipairs(hand.dof_limits) do
    slopes[d] = {}
    for s = 1, #hand.dofs do slopes[d][s] = 0 end
    local width = range[2] - range[1]
    slopes[d][d] = width * random:uniform(0.3, 0.4) / 255
    intercepts[d] = range[1] + width * 0.25
  end
  slopes[roll][abduction] = 0.1 * slopes[roll][roll]
  return {slopes = slopes, intercepts = intercepts}
end

-- separation of the surfaces of the tips at raw values, by poses of the links
local function distance_at(hand, calibration, raw)
  hand:set_dofs(clench.devices.glove_map {hand = hand, calibration = calibration} (raw))
  local function tip(i) return hand:link(tip_points[i].link).pose * clench.vec3(table.unpack(tip_points[i].point)) end
  return (tip(1) - tip(2)):norm() - shell
end

local function samples_of(hand, calibration, random, count, sigma)
  local samples = {}
  while #samples < count do
    local raw = {}
    for s = 1, #hand.dofs do raw[s] = random:integer(1, 255) end
    local distance = distance_at(hand, calibration, raw) + sigma * random:normal()
    if distance >= 0 then samples[#samples + 1] = {sensors = raw, distance = distance} end
  end
  return samples
end

-- the thumb's rows, wrong by some tenths of a radian
local function disturbed(hand, calibration, random)
  local out = {slopes = {}, intercepts = {table.unpack(calibration.intercepts)}}
  for d, row in ipairs(calibration.slopes) do out.slopes[d] = {table.unpack(row)} end
  for _, d in ipairs(dofs_of(hand, thumb)) do
    out.intercepts[d] = out.intercepts[d] + random:uniform(-0.1, 0.1)
    for s, slope in ipairs(out.slopes[d]) do out.slopes[d][s] = slope * random:uniform(0.9, 1.1) end
  end
  return out
end

test("without noise the true coefficients of the thumb are found to 1e-9", function(t)
  local hand, random = human(), clench.random(1)
  local known = truth(hand, random)
  local samples = samples_of(hand, known, random, 40, 0)
  local start = disturbed(hand, known, random)
  local posture, refine = hand.dofs, dofs_of(hand, thumb)
  t.ok(#refine >= 4, #refine)
  local found = calibrate_tips {hand = hand, calibration = start, samples = samples, tips = tip_points, refine = refine, shell = shell}
  t.equal(hand.dofs, posture)
  local before = 0
  for d in ipairs(hand.dofs) do
    t.close(found.intercepts[d], known.intercepts[d], 1e-9)
    t.close(found.slopes[d], known.slopes[d], 1e-11)
    before = math.max(before, math.abs(start.intercepts[d] - known.intercepts[d]))
  end
  t.ok(before > 0.05)
  t.ok(found.tips.converged and found.tips.max < 1e-9, found.tips.max)
  t.equal({found.tips.samples, #found.tips.rejected}, {40, 0})
end)

test("with noise the residuals agree with its level", function(t)
  local hand, random = human(), clench.random(2)
  local known = truth(hand, random)
  local sigma, count = 1e-3, 200
  local samples = samples_of(hand, known, random, count, sigma)
  local refine = dofs_of(hand, thumb)
  local found = calibrate_tips {hand = hand, calibration = disturbed(hand, known, random), samples = samples, tips = tip_points, refine = refine}
  t.ok(found.tips.converged)
  t.close(found.tips.sigma, sigma, 4 * sigma / math.sqrt(2 * count))
  -- other postures: distances are within some tenths of the noise of a single one
  local sum = 0
  for _, sample in ipairs(samples_of(hand, known, random, 100, 0)) do sum = sum + (distance_at(hand, found, sample.sensors) - sample.distance) ^ 2 end
  t.ok(math.sqrt(sum / 100) < 0.5 * sigma, math.sqrt(sum / 100))
end)

test("coefficients that no posture determines keep their values, and tips that coincide are rejected", function(t)
  local hand, random = human(), clench.random(3)
  local known = truth(hand, random)
  local start = disturbed(hand, known, random)
  -- the sensors of the thumb do not vary: its slopes and intercepts cannot be told apart
  local samples = samples_of(hand, known, random, 12, 0)
  for _, sample in ipairs(samples) do
    for _, d in ipairs(dofs_of(hand, thumb)) do sample.sensors[d] = 100 end
    sample.distance = math.max(0, distance_at(hand, known, sample.sensors))
  end
  local refine = dofs_of(hand, thumb)
  local found = calibrate_tips {hand = hand, calibration = start, samples = samples, tips = tip_points, refine = refine}
  for _, d in ipairs(refine) do
    t.close(found.slopes[d], start.slopes[d], 1e-6)
    t.close(found.intercepts[d], start.intercepts[d], 0.5)
  end
  -- the DOFs that move only the other fingers are not those of the tips: nothing changes
  local little = dofs_of(hand, "human20_chain3_link2")
  found = calibrate_tips {hand = hand, calibration = start, samples = samples, tips = tip_points, refine = little}
  t.equal(found.slopes, start.slopes)
  t.equal(found.intercepts, start.intercepts)
  -- two points of one joint's axis are at the same place in every posture
  local outer, inner = hand:link "human20_chain0_link1", hand:link "human20_chain0_link0"
  local shared = outer.pose:inverse() * inner.pose.position
  t.fails(function()
    calibrate_tips {hand = hand, calibration = start, samples = samples, refine = refine, tips = {{link = outer.name, point = shared}, {link = inner.name, point = {0, 0, 0}}}}
  end, "the tips of all postures coincide in the model of the hand")
end)

test("what cannot be used is refused in one sentence", function(t)
  local hand, random = human(), clench.random(4)
  local known = truth(hand, random)
  local samples = samples_of(hand, known, random, 8, 0)
  local function fails(changes, message)
    local options = {hand = hand, calibration = known, samples = samples, tips = {thumb, index}, refine = dofs_of(hand, thumb)}
    for key, value in pairs(changes) do options[key] = value end
    t.fails(function() calibrate_tips(options) end, "devices.calibrate_tips: " .. message)
  end
  fails({samples = {}}, "samples must be a list of at least 6 {sensors, distance}, got an empty table")
  local function with(change)
    local list = {table.unpack(samples)}
    list[3] = {sensors = change.sensors or samples[3].sensors, distance = change.distance}
    return {samples = list}
  end
  fails(with {}, "samples[3].distance must be a number >= 0 in m, got nothing")
  fails(with {distance = -0.01}, "samples[3].distance must be a number >= 0 in m, got -0.01")
  fails(with {distance = 0 / 0}, "samples[3].distance must be a number >= 0 in m, got nan")
  fails(with {distance = 0, sensors = {1}}, "samples[3] must be {sensors, distance} with 20 sensors")
  fails({tips = {thumb}}, "tips must be two links, by their names or as {link, point}")
  fails({tips = {thumb, thumb}}, "tips must be two different links")
  fails({tips = {thumb, {link = index, point = "tip"}}}, "tips[2].point must be a point of the link [m], got 'tip'")
  fails({tips = {thumb, 5}}, "tips[2] must be the name of a link, or {link, point}, got 5")
  fails({refine = {}}, "refine must be a list of DOFs of the hand")
  fails({refine = {1, 1}}, "refine[2] must be the number of a DOF that the calibration sets, got 1")
  fails({refine = {21}}, "refine[1] must be the number of a DOF that the calibration sets, got 21")
  fails({shell = -1}, "shell must be a number >= 0")
  fails({calibration = {slopes = {{1}}, intercepts = {0 / 0}}}, "DOF 1: expected finite numbers, got nan")
  t.fails(function() calibrate_tips {hand = hand, calibration = known, samples = samples, tips = {"no_link", index}, refine = {1}} end, "no_link")
  -- names alone: the point farthest from the joint
  local found = calibrate_tips {hand = hand, calibration = known, samples = samples, tips = {thumb, index}, refine = dofs_of(hand, thumb)}
  t.ok(found.tips.rms >= 0 and found.tips.samples == 8)
end)
