-- From gloves and trackers to hands, and between real and simulated hands.
local test, clench = require "test", require "clench"

local function scene()
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  return world, world.robots[1]
end

local function barrett()
  local simulated = clench.devices.simulated.barrett {}
  local device = clench.devices.barrett {port = simulated.path}
  device:initialize()
  return device, simulated
end

test("a glove sets the mapped DOFs, within their limits", function(t)
  local _, hand = scene()
  local calibration = {slopes = {{0.01, 0}, {0, 0.1}}, intercepts = {-0.5, 0}}
  hand.dofs = {0.3, 0.4, 0.5, 0.6}
  local got = clench.devices.glove_map {hand = hand, calibration = calibration, dofs = {[4] = 1, [3] = 2}} {100, 200}
  t.close(got[4], 0.5, 1e-12)
  t.equal(got[3], hand.dof_limits[3][2])
  t.equal({got[1], got[2]}, {hand.dofs[1], hand.dofs[2]})
  t.close(clench.devices.glove_map {hand = hand, calibration = calibration} {60}[1], 0.1, 1e-12)
  t.fails(function() clench.devices.glove_map {hand = hand} end, "calibration: expected {slopes, intercepts}, or a hand with a glove, got nothing")
  t.fails(function() clench.devices.glove_map {hand = hand, calibration = calibration, dofs = {[5] = 1}} end, "dofs must be numbers of DOFs from 1 to 4, got 5")
  t.fails(function() clench.devices.glove_map {hand = hand, calibration = calibration, dofs = {[1] = 3}} end, "dofs[1] must be a row from 1 to 2, got 3")
  t.fails(function() clench.devices.glove_map {hand = hand, calibration = calibration} "x" end, "expected a list of raw sensors, got 'x'")
end)

test("a fuzzy grasp without collisions has the values of the readings", function(t)
  local _, hand = scene()
  local pose = clench.pose {xyz = {0, 0, 0.2}} * hand.pose
  local got = clench.devices.fuzzy_grasp {hand = hand, pose = pose, dofs = {0.1, 0.2, 0.3, 0.4}}
  t.equal(got, {ok = true, palm = "free", chains = {"free", "free", "free"}})
  t.close((hand.pose.position - pose.position):norm(), 0, 1e-12)
  t.close(hand.dofs[4], 0.4, 1e-12)
end)

test("fingers inside an object are opened until they touch it", function(t)
  local world, hand = scene()
  local got = clench.devices.fuzzy_grasp {hand = hand, pose = hand.pose, dofs = {0, 2, 2, 2}}
  t.equal(got.ok, true)
  t.equal(got.chains, {"contact", "contact", "contact"})
  t.equal(#world:colliding(), 0)
  local mug = world.objects[1]
  for i, chain in ipairs(hand.chains) do
    local least = math.huge
    for _, link in ipairs(chain.links) do least = math.min(least, (world:distance(link, mug))) end
    t.ok(least < 1e-6, ("chain %d: %g m from the mug"):format(i, least))
    t.ok(hand.dofs[i + 1] < 2)
  end
end)

test("a palm inside an object is backed off until it touches, or the hand keeps its pose", function(t)
  local world, hand = scene()
  world:remove(world.objects[1])
  local post = world:add_object(clench.shapes.box {0.03, 0.03, 0.1}, {pose = {xyz = {0, 0, 0.02}}})
  -- poses deeper than the one at which the palm touches
  local down = hand.approach.direction
  local start = hand.pose
  hand.dofs = {0, 0, 0, 0}
  local depth = world:distance(hand.base, post)
  local function deeper(d) return clench.pose {xyz = down * (depth + d)} * start end
  local got = clench.devices.fuzzy_grasp {hand = hand, pose = deeper(0.015)}
  t.equal({got.ok, got.palm}, {true, "contact"})
  t.equal(#world:colliding(), 0)
  t.ok(world:distance(hand.base, post) < 1e-6)
  local before = world:hash()
  got = clench.devices.fuzzy_grasp {hand = hand, pose = deeper(0.05), dofs = {0, 1, 1, 1}}
  t.equal(got, {ok = false, palm = "failed", chains = {}})
  t.equal(world:hash(), before)
  t.equal(clench.devices.fuzzy_grasp {hand = hand, pose = deeper(0.05), tries = 10}.palm, "contact")
  t.fails(function() clench.devices.fuzzy_grasp {hand = hand, pose = 5} end, "pose must be")
  t.fails(function() clench.devices.fuzzy_grasp {hand = hand, pose = hand.pose, dofs = {1}} end, "expected 4 DOF values, got 1")
  t.fails(function() clench.devices.fuzzy_grasp {hand = hand, pose = hand.pose, back_off = 0} end, "back_off must be a number > 0")
end)

test("a simulated hand follows a real one until contact", function(t)
  local world, hand = scene()
  local device, simulated = barrett()
  local mirror = clench.devices.mirror {hand = hand, device = device}
  device:move {0.2, 0.3, 0.3, 0.3}
  mirror:pull()
  for i, value in ipairs {0.2, 0.3, 0.3, 0.3} do t.close(hand.dofs[i], value, 2e-3) end
  device:move {0, 2.4, 2.4, 2.4}
  local result = mirror:pull()
  t.ok(result.moved and hand.dofs[2] < 2)
  t.equal(#world:colliding(), 0)
  simulated:unplug()
  t.fails(function() mirror:pull() end, "is unplugged")
end)

test("a real hand follows a simulated one, within limits and speed", function(t)
  local _, hand = scene()
  local device, simulated = barrett()
  hand.dofs = {0, 1, 1, 1}
  local mirror = clench.devices.mirror {hand = hand, device = device, max_speed = 2, interval = 0.1, limits = {{0, 1}, {0, 1}, {0, 0.15}, {0, 2}}}
  t.equal(mirror:push(), false)
  local first = device:read()
  t.close(first[2], 0.2, 1e-3)  -- 2 rad/s for 0.1 s
  t.close(first[3], 0.15, 1e-3)
  local count = 1
  repeat
    local before = device:read()[2]
    clench.loop.sleep(0.02)
    local done = mirror:push()
    t.ok(device:read()[2] - before < 0.2 + 1e-3)
    count = count + 1
  until done
  t.ok(count > 4)
  local got = device:read()
  t.close(got[2], 1, 1e-3)
  t.close(got[3], 0.15, 1e-3)
  simulated:close()
end)

test("signs and offsets of a mirror apply in both directions, and wrong options are errors", function(t)
  local _, hand = scene()
  local values = {0.5, 0.1}
  local device = {read_positions = function() return {table.unpack(values)} end, write_positions = function(_, sent) values = sent end}
  local options = {hand = hand, device = device, dofs = {2, 3}, signs = {-1, 1}, offsets = {0.7, 0}}
  local mirror = clench.devices.mirror(options)
  mirror:pull()
  t.close(hand.dofs[2], 0.2, 1e-9)
  t.close(hand.dofs[3], 0.1, 1e-9)
  hand.dofs = {0, 0.25, 0.15, 0}
  t.equal(mirror:push(), true)
  t.close(values[1], 0.45, 1e-9)
  t.close(values[2], 0.15, 1e-9)
  local function fails(name, value, message)
    local changed = {}
    for key, old in pairs(options) do changed[key] = old end
    changed[name] = value
    t.fails(function() clench.devices.mirror(changed) end, message)
  end
  fails("device", 5, "device: expected a driver")
  fails("signs", {1, 2}, "signs[2] must be 1 or -1, got 2")
  fails("offsets", {1}, "offsets must be a list of 2 numbers")
  fails("dofs", {2, 2}, "dofs[2] must be a number from 1 to 4, different from the others, got 2")
  fails("limits", {{0, 1}, {1, 0}}, "limits[2] must be a range {low, high}")
  fails("max_speed", 0, "max_speed must be a number > 0")
end)

test("a mirror refuses what a driver should not return, and sends nothing beyond its limits", function(t)
  local _, hand = scene()
  local values, sent = {}, nil
  local device = {read = function() return values end, move = function(_, given) sent = given end}
  local mirror = clench.devices.mirror {hand = hand, device = device, dofs = {2, 3}, limits = {{0, 1}, {0, 1}}, max_speed = 1, interval = 0.1}
  for _, case in ipairs {{{1}, "device: expected 2 numbers from read, got a table of 1"}, {{opening = 1}, "expected 2 numbers from read, got a table with names"},
                         {{1, 0 / 0}, "value 2 of read: expected a finite number, got nan"}, {{"1", 1}, "value 1 of read: expected a finite number, got '1'"}, {nil, "got nothing"}} do
    values = case[1]
    t.fails(function() mirror:pull() end, case[2])
    t.fails(function() mirror:push() end, case[2])
  end
  values = {0.5, 5}
  t.fails(function() mirror:push() end, "value 2 of the device, 5, is beyond its limits 0 to 1: bring it back first")
  t.equal(sent, nil)
  hand.dofs = {0, 0, 0, 0}
  values = {0.5, 1.05}
  mirror:push()
  t.close(sent, {0.4, 0.95}, 1e-9)
  hand.dofs = {0, 0.5, 1, 0}
  mirror = clench.devices.mirror {hand = hand, device = device, dofs = {2, 3}, limits = {{0, 1}, {0, 1}}, max_speed = 0.1, interval = 0.1}
  values = {0.5, 1.01}
  mirror:push()
  t.close(sent, {0.5, 1}, 1e-9)
end)
