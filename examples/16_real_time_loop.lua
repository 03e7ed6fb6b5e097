-- The real-time loop of GraspIt!'s manual, section 1.1: a tracker moves the mug, a search in the background looks for grasps, and the Barrett hand
-- follows the best one. It closes once the mug rests and the grasp is verified. Devices are simulated unless their ports are given.
--   clench run examples/16_real_time_loop.lua [TRACKER HAND]        for instance /dev/ttyUSB0 /dev/ttyUSB1
local clench = require "clench"
local loop, devices = clench.loop, clench.devices

local is_real = arg and arg[2]
local bird = not is_real and devices.simulated.flock {poses = {clench.pose {xyz = {0.3, 0, 0.1}}}}
local flock <close> = devices.flock {port = bird and bird.path or arg[1]}
local barrett <close> = devices.barrett {port = is_real and arg[2] or devices.simulated.barrett {}.path}
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

local began = loop.time()
repeat
  local t = loop.time() - began
  if bird then bird.poses[1] = clench.pose {xyz = {0.3, 0.1 * math.sin(math.min(t, 1.5)), 0.1}} end
  timed("track", track)
  timed("plan", plan)
  if best then
    timed("follow", follow)
    timed("send", mirror.push, mirror)
  end
  resting = (mug.pose.position - last.position):norm() < 2e-4 and resting + 1 or 0
  last = mug.pose
until loop.wait(search, 0.02) and best and resting >= 5 or t > 20
assert(best, "no grasp was found")

local grasp = timed("verify", best.apply, best, world, {hand = hand, object = mug})
assert(grasp:is_force_closure() and #world:colliding() == 0, "the grasp does not hold where the mug is now")
repeat loop.sleep(0.05) until timed("send", mirror.push, mirror)
print(("closed at epsilon %.3f, fingers at %s"):format(grasp.epsilon, clench.json.encode(barrett:read())))
for _, stage in ipairs {"track", "plan", "follow", "send", "verify"} do
  local count, sum, most = 0, 0, 0
  for _, one in ipairs(latency) do
    if one[1] == stage then count, sum, most = count + 1, sum + one[2], math.max(most, one[2]) end
  end
  print(("%-7s %4d times, mean %6.2f ms, longest %6.2f ms"):format(stage, count, 1000 * sum / count, 1000 * most))
end
