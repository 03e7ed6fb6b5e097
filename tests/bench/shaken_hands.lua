-- Many hands shaken in parallel: grasps judged by the six-direction test per second of processor time, on one thread and on two, with byte-identical
-- output.
-- clench run tests/bench/shaken_hands.lua [--check] [--csv FILE]
local clench = require "clench"
local check, csv
local words = {...}
for i, word in ipairs(words) do
  if word == "--check" then check = true end
  if word == "--csv" then csv = words[i + 1] end
end

local scenes = {"dlr_flask", "human_flask", "shadow_bottle", "barrett_mug", "robonaut_glass"}
local count = 8  -- of each scene

local function judge(grasp, shared)
  local placed = grasp:apply(shared.hand.world, {hand = shared.hand, object = shared.object})
  local verdict = require "clench".study.shake {hand = shared.hand, object = shared.object}
  local out = {("%d %d"):format(#placed.points, verdict.contacts)}
  for i, row in ipairs(verdict.directions) do out[i + 1] = ("%a %a"):format(row.moved, row.turned) end
  return out
end

local function measure(hand, object, grasps, threads)
  local wall, cpu = clench.clock(), os.clock()
  local results, failed = clench.parallel.map(judge, grasps, {threads = threads, shared = {hand = hand, object = object}})
  assert(failed == 0, results[1].error)
  return clench.clock() - wall, os.clock() - cpu, clench.json.encode(results)
end

local rows, all = {}, {scene = "all", grasps = 0, cpu_1 = 0, cpu_2 = 0, wall_1 = 0, wall_2 = 0}
local same = true
for _, scene in ipairs(scenes) do
  local world = clench.load("worlds/" .. scene .. ".wld", {root = "."})
  local hand, object = world.robots[1], world.objects[1]
  local grasps = {}
  for i, grasp in ipairs(clench.plan.random {hand = hand, object = object, count = count, candidates = 2000, seed = 5}.grasps) do grasps[i] = grasp end
  local row = {scene = scene, grasps = #grasps}
  local one, two
  row.wall_1, row.cpu_1, one = measure(hand, object, grasps, 1)
  row.wall_2, row.cpu_2, two = measure(hand, object, grasps, 2)
  same = same and one == two
  for _, name in ipairs {"grasps", "cpu_1", "cpu_2", "wall_1", "wall_2"} do all[name] = all[name] + row[name] end
  rows[#rows + 1] = row
end
rows[#rows + 1] = all

print "grasps judged by the six-direction test (13.5 s of simulated time each)"
print(("%-16s %7s %22s %30s"):format("", "grasps", "a second and core", "two threads: CPU time by that of one"))
for _, row in ipairs(rows) do
  row.per_second = row.grasps / row.cpu_1
  row.cpu_ratio = row.cpu_2 / row.cpu_1
  print(("%-16s %7d %22.2f %30.2f"):format(row.scene, row.grasps, row.per_second, row.cpu_ratio))
end
print(same and "one and two threads give the same bytes" or "MISSED: two threads give other bytes than one")
if csv then
  for _, row in ipairs(rows) do row.cpu_1, row.cpu_2, row.wall_1, row.wall_2 = nil, nil, nil, nil end
  clench.csv.write(csv, rows)
end
if check and not same then os.exit(1) end
