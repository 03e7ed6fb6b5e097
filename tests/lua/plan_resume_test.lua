-- A search that ends early and is continued from its journal finds bit-identical results to an uninterrupted one.
local test, clench = require "test", require "clench"
local journal = require "clench.plan.journal"
local recorded = require "clench.plan.recorded"

local count_wanted = 26  -- found in the second round

local function search(record, hand_file, count)
  local world = clench.world()
  local hand = world:add_robot(hand_file or "models/hands/barrett/barrett.cfg")
  local bar = world:add_object(clench.shapes.box {0.03, 0.05, 0.12}, {pose = {xyz = {0, 0, 1}}, name = "bar", mass = 0.1})
  local options = {hand = hand, object = bar, count = count or count_wanted, refine = 1, seed = 5, threads = 2, distance = 0.02, verify = false}
  recorded[options] = record
  return clench.plan.sample(options)
end

local function lines_of(run)
  local lines = {}
  for i, grasp in ipairs(run.grasps) do lines[i] = clench.json.encode(grasp) end
  return table.concat(lines, "\n")
end

local function check_same(t, run, other)
  t.equal(lines_of(run), lines_of(other))
  t.equal(run.report.candidates, other.report.candidates)
  t.equal(clench.json.encode(run.report.rejected), clench.json.encode(other.report.rejected))
  t.equal(run.report.complete, other.report.complete)
end

-- a search that records itself in a file and ends after the given number of pieces
local function record_in(path, pieces, hand_file, count_asked)
  local count = 0
  clench.files.save_text(path, journal.head({name = "bar"}, count_wanted))
  return search(journal.new {
    write = function(lines)
      count = count + 1
      clench.files.append_text(path, lines)
    end,
    is_ended = function() return count >= pieces end,
  }, hand_file, count_asked)
end

local function continued(known, more)
  local options = {known = known, write = function() end, is_ended = function() return false end}
  for key, value in pairs(more or {}) do options[key] = value end
  return search(journal.new(options))
end

local without_break = search()
local path = test.path ".search"
local complete = record_in(path, math.huge)
local text = clench.files.read_text(path)

test("a journal does not change a search", function(t)
  t.equal(#without_break.grasps, count_wanted)
  t.equal(without_break.report.candidates, 128)
  t.equal(without_break.report.complete, true)
  check_same(t, complete, without_break)
  t.equal(journal.head_of(path).search.name, "bar")
  t.equal(journal.head_of(path).count, count_wanted)
end)

test("a search with a complete journal tries nothing and finds the same grasps", function(t)
  local known, clean = journal.read(path)
  t.equal(journal.head({name = "bar"}, count_wanted) .. clean, text)
  local count = 0
  check_same(t, continued(known, {write = function() count = count + 1 end}), without_break)
  t.equal(count, 0)
end)

test("a search that ended after a round continues", function(t)
  local short = test.path ".search"
  local first = record_in(short, 1)
  t.equal(first.report.candidates, 64)
  t.equal(first.report.complete, false)
  check_same(t, continued((journal.read(short))), without_break)
end)

test("from a journal truncated anywhere, the search continues after the last complete piece", function(t)
  local random = clench.random(8)
  local cut = test.path ".search"
  local head = #journal.head({name = "bar"}, count_wanted)
  for i = 1, 2 do
    clench.files.save_text(cut, text:sub(1, i == 1 and head or random:integer(head, #text)))
    check_same(t, continued((journal.read(cut))), without_break)
  end
  local function pieces(known)
    local count = 0
    for _ in pairs(known) do count = count + 1 end
    return count
  end
  local all = pieces(journal.read(path))
  for _, size in ipairs {#text - 1, #text - 30, #text - 2000} do
    clench.files.save_text(cut, text:sub(1, size))
    t.ok(pieces(journal.read(cut)) < all)
  end
end)

test("starts that jaws have shifted are restored bit-exactly", function(t)
  local jaws, shifted = "models/hands/parallel_jaw/parallel_jaw.cfg", test.path ".search"
  -- 40 pieces include starts of the second round, which begin near found grasps
  record_in(shifted, 40, jaws, 1000)
  t.ok(clench.files.read_text(shifted):find('"moved":true', 1, true))
  local known, clean = journal.read(shifted)
  t.equal(journal.head({name = "bar"}, count_wanted) .. clean, clench.files.read_text(shifted))
  t.ok(known[1])
end)

test("missing pieces are computed at their positions", function(t)
  local known = journal.read(path)
  local random = clench.random(2)
  for first in pairs(journal.read(path)) do
    if random:uniform() < 0.3 then known[first] = nil end
  end
  check_same(t, continued(known), without_break)
end)

test("a damaged journal is read up to the damage, and other files are rejected", function(t)
  local damaged = test.path ".search"
  local at = text:find('{"search":{"best_load"', #text // 2, true) or text:find('{"search":', #text // 2, true)
  clench.files.save_text(damaged, text:sub(1, at) .. "x" .. text:sub(at + 1))
  check_same(t, continued((journal.read(damaged))), without_break)
  clench.files.save_text(damaged, "{}\n")
  t.equal(journal.head_of(damaged), nil)
  t.equal(journal.head_of "no.search", nil)
  t.equal(journal.read "no.search", nil)
end)

test("grasps that are listed but not recorded are kept", function(t)
  local listed = {without_break.grasps[count_wanted]}
  local run = search(journal.new {listed = listed, write = function() end, is_ended = function() return true end})
  t.equal(#run.grasps, 1)
  t.equal(run.report.candidates, 0)
  check_same(t, continued({}, {listed = listed}), without_break)
end)
