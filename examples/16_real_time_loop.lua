-- The real-time loop of GraspIt!'s manual, section 1.1: a tracker moves the mug, a search in the background looks for grasps, and the Barrett hand
-- follows the best one. It closes once the mug rests and the grasp is verified. Devices are simulated unless their ports are given.
--   clench run examples/16_real_time_loop.lua [NAME=VALUE…]
--     tracker=/dev/ttyUSB0 hand=/dev/ttyUSB1   the lines of real devices
--     readings=5         records of the tracker of which the median is taken, for lines with noise
--     bad_bytes=0.05     fraction of the bytes of simulated devices that are damaged
--     unplug=1           time after which the simulated tracker is unplugged [s]
local clench = require "clench"
local loop, devices = clench.loop, clench.devices

local known = {tracker = tostring, hand = tostring, readings = math.tointeger, bad_bytes = tonumber, unplug = tonumber}
local given = {readings = 1, bad_bytes = 0, unplug = math.huge}
for _, word in ipairs(arg or {}) do
  local name, text = word:match "^([%w_]+)=(.+)$"
  given[name or 1] = known[name] and known[name](text) or error("expected NAME=VALUE with one of the names above, got " .. word, 0)
end

local noise = {flip_bytes = 0.8 * given.bad_bytes, lose_bytes = 0.2 * given.bad_bytes}
local bird = not given.tracker and devices.simulated.flock {poses = {clench.pose {xyz = {0.3, 0, 0.1}}}, flip_bytes = noise.flip_bytes, lose_bytes = noise.lose_bytes}
local flock <close> = devices.flock {port = given.tracker or bird.path, readings = given.readings, attempts = 200, timeout = given.tracker and 0.05 or 0.01}
local barrett <close> = devices.barrett {port = given.hand or devices.simulated.barrett(noise).path, timeout = given.hand and 0.2 or 0.02, move_timeout = given.hand and 20 or 0.05}
barrett:initialize()
local world = clench.load("worlds/barrett_mug.wld", {root = "."})
local hand, mug = world.robots[1], world.objects[1]
local to_pose = devices.tracker_map {mode = "relative", base = flock:read()[1], pose = mug.pose}
local mirror = devices.mirror {hand = hand, device = barrett, max_speed = 4}
local search = clench.plan.start("sample", {hand = hand, object = mug, count = 10, candidates = 2000, seconds = 5, seed = 1})

local latency, best, resting, last = {}, nil, 0, mug.pose
local function timed(stage, f, ...)
  local began = loop.time()
  local result = f(...)
  table.insert(latency, {stage, loop.time() - began})
  return result
end
local function track() mug.pose = to_pose(flock:read()[1]) end

-- grasps are in the frame of the mug: they stay valid while it moves
local function plan()
  for _, grasp in ipairs(search:events()) do
    if not best or grasp.epsilon > best.epsilon then best = grasp end
  end
end
local function follow() hand:set_posture(mug.pose * best.pregrasp.pose, best.pregrasp.dofs) end

-- the hand takes longer to reply than the tracker: it is served beside the loop
local closing, closed, problem = false, false, nil
local function send()
  repeat
    local is_last = closing
    local is_sent = best and timed("send", mirror.push, mirror)
    loop.sleep(0.02)
  until is_last and is_sent
  closed = true
end
loop.spawn(function()
  local ok, why = pcall(send)
  problem = not ok and why
end)

local began = loop.time()
repeat
  local t = loop.time() - began
  if bird then bird.poses[1] = clench.pose {xyz = {0.3, 0.1 * math.sin(math.min(t, 1.5)), 0.1}} end
  if bird and t > given.unplug then bird:unplug() end
  timed("track", track)
  timed("plan", plan)
  if best then timed("follow", follow) end
  resting = (mug.pose.position - last.position):norm() < 2e-4 and resting + 1 or 0
  last = mug.pose
until loop.wait(search, 0.02) and best and resting >= 5 or t > 20 or problem
assert(not problem, problem)
assert(best, "no grasp was found")
assert(resting >= 5, "the mug does not rest")

local grasp = timed("verify", best.apply, best, world, {hand = hand, object = mug})
assert(grasp:is_force_closure() and #world:colliding() == 0, "the grasp does not hold where the mug is now")
closing = true
repeat loop.sleep(0.02) until closed or problem
assert(not problem, problem)
print(("closed at epsilon %.3f, fingers at %s"):format(grasp.epsilon, clench.json.encode(barrett:read())))
for _, stage in ipairs {"track", "plan", "follow", "verify", "send"} do
  local count, sum, most = 0, 0, 0
  for _, one in ipairs(latency) do
    if one[1] == stage then count, sum, most = count + 1, sum + one[2], math.max(most, one[2]) end
  end
  print(("%-7s %4d times, mean %6.2f ms, longest %6.2f ms"):format(stage, count, 1000 * sum / count, 1000 * most))
end
