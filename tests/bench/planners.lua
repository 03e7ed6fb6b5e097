-- Grasps per second: every shipped hand on five shipped objects, found and verified by plan.sample in a few seconds of one core; then a comparison of
-- the planners on one problem, with the same time.
--   clench run tests/bench/planners.lua [--seconds S] [--check] [--csv FILE]
-- A grasp counts once per place, rotation and posture. Aim: 1 grasp per second on average; the goal is 10.
local clench = require "clench"

local seconds, check, csv = 3, false, nil
do
  local i = 1
  while arg[i] do
    if arg[i] == "--seconds" then i = i + 1; seconds = tonumber(arg[i])
    elseif arg[i] == "--check" then check = true
    elseif arg[i] == "--csv" then i = i + 1; csv = arg[i]
    else error("usage: planners.lua [--seconds S] [--check] [--csv FILE], got " .. arg[i]) end
    i = i + 1
  end
end

local objects = {"mug", "flask", "banana", "hammer", "tea_tin"}

local function load(hand_path, object_path)
  local world = clench.world()
  local hand = world:add_robot(hand_path)
  local object = world:add_object(object_path, {pose = {xyz = {0, 0, 2}}})
  return world, hand, object
end

local rows, sum, pairs_with = {}, 0, 0
local count = 0
print(("%-22s %-10s %10s %10s %8s %8s"):format("hand", "object", "closed", "verified", "a second", "epsilon"))
for _, model in ipairs(clench.catalog().hands) do
  for _, name in ipairs(objects) do
    local object_path = ("models/objects/%s.iv"):format(name)
    local world, hand, object = load(model, object_path)
    local began = os.clock()
    local run = clench.plan.sample {hand = hand, object = object, seconds = seconds, count = 100000, seed = 1, refine = 4, threads = 1}
    local took = os.clock() - began  -- processor time: other processes may use the machine as well
    local best = run.grasps[1] and run.grasps[1].epsilon or 0
    local rate = #run.grasps / took
    count, sum = count + 1, sum + rate
    if #run.grasps > 0 then pairs_with = pairs_with + 1 end
    rows[#rows + 1] = {hand = hand.name, object = object.name, candidates = run.report.candidates, verified = #run.grasps,
                       per_second = rate, best_epsilon = best}
    print(("%-22s %-10s %10d %10d %8.1f %8.3f"):format(hand.name, object.name, run.report.candidates, #run.grasps, rate, best))
  end
end
local mean = sum / count
print(("%d pairs, %d with a verified grasp; %.1f verified grasps a second and core on average (asked 1, wished for 10)"):format(count, pairs_with, mean))

print()
print(("%-10s %8s %10s %10s"):format("planner", "seconds", "grasps", "epsilon"))
for _, planner in ipairs {"anneal", "loop", "guided", "random", "sample"} do
  local world = clench.load "worlds/barrett_mug.wld"
  local hand, object = world.robots[1], world.objects[1]
  local options = {hand = hand, object = object, seconds = 3 * seconds, seed = 1}
  if planner == "random" or planner == "sample" then options.count = 1000000 else options.steps = 1000000000 end
  local began = clench.clock()
  local run = clench.plan[planner](options)
  local good, best = 0, 0
  for _, g in ipairs(run.grasps) do
    if g.epsilon > 0 and g.collision_free then good, best = good + 1, math.max(best, g.epsilon) end
  end
  print(("%-10s %8.1f %10d %10.3f"):format(planner, clench.clock() - began, good, best))
end

if csv then clench.csv.write(csv, rows, {columns = {"hand", "object", "candidates", "verified", "per_second", "best_epsilon"}}) end
if check and mean < 1 then
  print "FAILED: fewer than 1 verified grasp a second"
  os.exit(1)
end
