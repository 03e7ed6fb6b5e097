-- Grasps of objects at rest on a table: five hands, eleven shipped and shared objects, verified grasps in 8 s of one core.
--   clench run tests/bench/tables.lua [--seconds S | --candidates N] [--hands NAME,...] [--objects NAME,...] [--check] [--csv FILE] [--scenes FOLDER]
--   --hands, --objects  a part of the table
--   --candidates        number of candidates per pair, instead of a time
--   --scenes            writes each pair and its grasps for bench_mujoco
-- Aim: five verified grasps on nine of ten pairs whose narrowest graspable width fits the hand.
package.path = "tests/bench/?.lua;" .. package.path
local clench = require "clench"
local table_scene = require "table_scene"
local facing, starts = require "clench.plan.facing", require "clench.plan.starts"
local aim, part_with = 5, 0.9

local usage = "usage: tables.lua [--seconds S | --candidates N] [--hands NAME,...] [--objects NAME,...] [--check] [--csv FILE] [--scenes FOLDER]"
local options = {seconds = 8}
do
  local i = 1
  while arg[i] do
    local name = arg[i]:match "^%-%-(%a+)$"
    if name == "check" then
      options.check = true
    elseif ({seconds = true, candidates = true, hands = true, objects = true, csv = true, scenes = true})[name] and arg[i + 1] then
      i = i + 1
      options[name] = (name == "seconds" or name == "candidates") and tonumber(arg[i]) or arg[i]
    else
      error(usage .. ", got " .. arg[i], 0)
    end
    i = i + 1
  end
end

-- The names of a list that an option selects.
local function chosen(all, text, what)
  if not text then return all end
  local known, out = {}, {}
  for _, name in ipairs(all) do known[name] = true end
  for name in text:gmatch "[^,]+" do
    if not known[name] then error(("%s: expected some of %s, got '%s'"):format(what, table.concat(all, ", "), name), 0) end
    out[#out + 1] = name
  end
  return out
end

local function most_frequent(rejected)
  local max, why = 0, "-"
  for reason, count in pairs(rejected) do
    if count > max or count == max and reason < why then max, why = count, reason end
  end
  return ("%s (%d)"):format(why, max)
end

local rows, fitting, with_enough = {}, 0, 0
local hands = chosen(table_scene.hands, options.hands, "--hands")
local objects = chosen(table_scene.objects, options.objects, "--objects")
print(("%-18s %-12s %6s %6s %10s %8s %8s  %s"):format("hand", "object", "width", "opens", "candidates", "ms each", "verified", "most rejected"))
for _, hand_name in ipairs(hands) do
  for _, object_name in ipairs(objects) do
    local scene = table_scene.load(hand_name, object_name)
    if not scene then
      print(("%-18s %-12s skipped: no shared data"):format(hand_name, object_name))
    else
      local opens = starts.aperture(scene.hand)
      local width = facing.narrowest(scene.world, scene.object, 400, 0.5)
      local fits = width and opens and width <= opens - starts.clearance or false
      local began = os.clock()
      local run = clench.plan.sample {hand = scene.hand, object = scene.object, seconds = not options.candidates and options.seconds or nil,
                                      candidates = options.candidates, count = 100000, seed = 1}
      local took = os.clock() - began
      local verified, report = #run.grasps, run.report
      if fits then
        fitting = fitting + 1
        if verified >= aim then with_enough = with_enough + 1 end
      end
      rows[#rows + 1] = {hand = hand_name, object = object_name, width = width or 0, opens = opens, candidates = report.candidates,
                         ms = 1000 * took / math.max(1, report.candidates), verified = verified}
      print(("%-18s %-12s %6.1f %6.1f %10d %8.1f %8d  %s"):format(hand_name, object_name, 1000 * (width or 0), 1000 * (opens or 0), report.candidates,
        rows[#rows].ms, verified, most_frequent(report.rejected)))
      if options.scenes and verified > 0 then
        table_scene.save(scene, run.grasps, ("%s/%s_%s.json"):format(options.scenes, hand_name, object_name))
      end
    end
  end
end
local part = fitting > 0 and with_enough / fitting or 0
print(("%d of %d pairs that fit have %d verified grasps or more (asked %.0f %%)"):format(with_enough, fitting, aim, 100 * part_with))

if options.csv then
  clench.csv.write(options.csv, rows, {columns = {"hand", "object", "width", "opens", "candidates", "ms", "verified"}})
end
if options.check and part < part_with then
  print(("FAILED: fewer than %.0f %% of the pairs that fit have %d verified grasps"):format(100 * part_with, aim))
  os.exit(1)
end
