-- Calibration of gloves with known answers.
local test, clench = require "test", require "clench"
local calibrate = clench.devices.calibrate

-- a glove of 22 sensors and 16 DOFs: a true calibration, and samples of it
local function truth(random)
  local of_dof, slopes, intercepts = {}, {}, {}
  for d = 1, 16 do
    of_dof[d] = d % 4 == 1 and {d, d + 3, d + 6} or {d + 1}
    slopes[d], intercepts[d] = {}, random:uniform(-1, 1)
    for s = 1, 22 do slopes[d][s] = 0 end
    for _, s in ipairs(of_dof[d]) do slopes[d][s] = random:uniform(0.002, 0.02) end
  end
  return {slopes = slopes, intercepts = intercepts}, of_dof
end

local function sample(random, calibration, sigma)
  local sensors, dofs = {}, {}
  for s = 1, 22 do sensors[s] = random:integer(1, 255) end
  for d, row in ipairs(calibration.slopes) do
    dofs[d] = calibration.intercepts[d] + sigma * random:normal()
    for s, slope in ipairs(row) do dofs[d] = dofs[d] + slope * sensors[s] end
  end
  return {sensors = sensors, dofs = dofs}
end

local function samples_of(random, calibration, count, sigma)
  local list = {}
  for i = 1, count do list[i] = sample(random, calibration, sigma) end
  return list
end

test("without noise the true coefficients are found, and saved and read bit-exactly", function(t)
  local random = clench.random(1)
  local known, of_dof = truth(random)
  local found = calibrate {samples = samples_of(random, known, 30, 0), sensors_of = of_dof}
  for d = 1, 16 do
    t.close(found.slopes[d], known.slopes[d], 1e-13)
    t.close(found.intercepts[d], known.intercepts[d], 1e-11)
    t.ok(found.report[d].max < 1e-12)
  end
  local path = os.tmpname()
  clench.devices.save_calibration(path, found)
  local read = clench.files.glove_calibration(path)
  os.remove(path)
  t.equal(read.slopes, found.slopes)
  t.equal(read.intercepts, found.intercepts)
end)

test("with noise the residuals agree with the noise level", function(t)
  local random = clench.random(2)
  local known, of_dof = truth(random)
  local sigma, count = 0.02, 500
  local found = calibrate {samples = samples_of(random, known, count, sigma), sensors_of = of_dof}
  for d = 1, 16 do
    local report = found.report[d]
    -- the standard deviation of an estimate of sigma is sigma / sqrt(2 n)
    t.close(report.sigma, sigma, 4 * sigma / math.sqrt(2 * count))
    t.close(report.rms, report.sigma * math.sqrt((count - #of_dof[d] - 1) / count), 1e-12)
    -- that of a slope is about sigma / (sqrt(n) * spread), for values from 1 to 255
    for _, s in ipairs(of_dof[d]) do t.close(found.slopes[d][s], known.slopes[d][s], 5 * sigma / (math.sqrt(count) * 73)) end
  end
end)

test("gross errors are detected and excluded", function(t)
  local random = clench.random(3)
  local known, of_dof = truth(random)
  local samples = samples_of(random, known, 100, 0.001)
  for i = 10, 100, 10 do samples[i].dofs[2] = samples[i].dofs[2] + 1 end
  local bad = calibrate {samples = samples, sensors_of = {[2] = of_dof[2]}}
  local good = calibrate {samples = samples, sensors_of = {[2] = of_dof[2]}, outliers = 5}
  t.ok(bad.report[2].rms > 0.1 and #bad.report[2].outliers == 0)
  t.equal(good.report[2].outliers, {10, 20, 30, 40, 50, 60, 70, 80, 90, 100})
  t.close(good.slopes[2], known.slopes[2], 1e-5)
  t.equal({good.report[1], good.slopes[1][1], good.intercepts[1]}, {nil, 0, 0})
end)

test("two postures determine the lines through both, and samples may omit DOFs", function(t)
  local flat = {sensors = {60, 80, 100}, dofs = {[1] = -0.1, [3] = 0}}
  local fist = {sensors = {160, 200, 50}, dofs = {[1] = math.pi / 2, [3] = 1}}
  local found = calibrate {samples = {flat, fist, {sensors = {1, 2, 3}, dofs = {}}}, sensors_of = {[1] = {2}, [3] = {3}}}
  t.close(found.intercepts[1] + found.slopes[1][2] * 80, -0.1, 1e-14)
  t.close(found.intercepts[1] + found.slopes[1][2] * 200, math.pi / 2, 1e-14)
  t.close(found.slopes[3][3], -1 / 50, 1e-16)
  t.equal(#found.slopes, 3)
end)

test("DOFs that cannot be fitted are named, and a ridge makes the fit possible", function(t)
  local samples = {{sensors = {1, 2}, dofs = {0.1}}, {sensors = {2, 4}, dofs = {0.2}}, {sensors = {3, 6}, dofs = {0.3}}}
  t.fails(function() calibrate {samples = samples, sensors_of = {{1, 2}}} end, "devices.calibrate: DOF 1: sensor 2 does not vary independently")
  t.fails(function() calibrate {samples = {samples[1]}, sensors_of = {{1}}} end, "DOF 1: 1 sensors need at least 2 samples, got 1")
  local found = calibrate {samples = samples, sensors_of = {{1, 2}}, ridge = 1e-9}
  for _, one in ipairs(samples) do t.close(found.intercepts[1] + found.slopes[1][1] * one.sensors[1] + found.slopes[1][2] * one.sensors[2], one.dofs[1], 1e-8) end
  t.fails(function() calibrate {} end, "samples must be a list of {sensors, dofs}, got nothing")
  t.fails(function() calibrate {samples = {{sensors = {1}, dofs = {}}, {sensors = {1, 2}, dofs = {}}}, sensors_of = {{1}}} end, "samples[2] must be {sensors, dofs} with 1 sensors")
  t.fails(function() calibrate {samples = samples, sensors_of = {{3}}} end, "sensors_of[1][1] must be a number from 1 to 2, got 3")
  t.fails(function() calibrate {samples = {{sensors = {0 / 0}, dofs = {1}}}, sensors_of = {{1}}} end, "samples[1].sensors[1] must be a number, got nan")
  t.fails(function() clench.devices.save_calibration("x.txt", {slopes = {{1}, {1, 2}}, intercepts = {0, 0}}) end, "slopes[2]: expected 1 numbers")
end)

test("tracked bodies follow their sensors, in all three modes", function(t)
  local map, random = clench.devices.tracker_map, clench.random(4)
  local function any() return clench.pose {xyz = {random:uniform(-1, 1), random:uniform(-1, 1), random:uniform(-1, 1)}} * random:rotation() end
  local function same(a, b)
    t.close((a.position - b.position):norm(), 0, 1e-12)
    t.close((a:inverse() * b):angle(), 0, 1e-7)
  end
  for _ = 1, 20 do
    local mount, transmitter, body = any(), any(), any()
    -- a sensor on the body reads body * mount, in the frame of the transmitter
    local function reading(of, from) return from:inverse() * of * mount end
    same(map {mount = mount}(reading(body, clench.pose {})), body)
    -- relative: the same motion in the frame of the sensor, for any pose of the transmitter
    local start, now = any(), any()
    local relative = map {mode = "relative", mount = mount, base = reading(start, transmitter), pose = body}
    same(relative(reading(start, transmitter)), body)
    same(relative(reading(now, transmitter)), body * start:inverse() * now)
    -- camera: the sensors of a camera and of the body are read in the same frame
    local camera, stand = any(), any()
    local seen = map {mode = "camera", mount = mount, base = transmitter:inverse() * camera, pose = stand}
    same(seen(reading(body, transmitter)), stand * camera:inverse() * body)
  end
  t.fails(function() map {base = clench.pose {}} end, "base and pose belong to the modes relative and camera")
  t.fails(function() map {mode = "absolut"} end, "mode must be 'absolute', 'relative' or 'camera'")
  t.fails(function() map {}(5) end, "expected a pose as reading, got 5")
end)
