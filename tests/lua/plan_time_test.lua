-- Planners whose time ends early: results and messages.
local test = require "test"

local function start(planner, options)
  local world = clench.world()
  local all = {hand = world:add_robot "models/hands/barrett/barrett.cfg", object = world:add_object "models/objects/flask.iv"}
  for key, value in pairs(options) do all[key] = value end
  return clench.plan[planner](all)
end

test("a search whose time ends before its first candidate says so", function(t)
  local run = start("sample", {seconds = 1e-9})
  t.equal(#run.grasps, 0)
  t.equal(run.report.candidates, 0)
  t.ok(not run.report.stopped)
  t.ok(run.report.causes[1]:find("the search ended before its first candidate: its start takes longer than the limit of 1e-09 s with this hand and object", 1, true))
  t.equal(#run.report.causes, 1)
end)

test("an error by a deadline has the kind timeout", function(t)
  local deadline, is_stopped, is_timeout = require "clench.deadline", require "clench.is_stopped", require "clench.is_timeout"
  local world = clench.world()
  local limit = deadline(0)
  local ok, problem = pcall(function() while true do world:collides() end end)
  t.ok(not ok and limit:close())
  t.equal(problem.kind, "timeout")
  t.equal(problem.sentence, "out of time")
  t.ok(is_stopped(problem) and is_timeout(problem))
  t.ok(is_stopped {kind = "stopped"} and not is_timeout {kind = "stopped"})
  for _, other in ipairs {"out of time", {kind = "input"}, setmetatable({}, {__index = {kind = "timeout"}})} do
    t.ok(not is_stopped(other) and not is_timeout(other))
  end
end)

test("a planner ends at its deadline, and restores the world", function(t)
  for _, planner in ipairs {"sample", "random", "anneal", "guided", "loop"} do
    local world = clench.world()
    local hand, object = world:add_robot "models/hands/barrett/barrett.cfg", world:add_object "models/objects/flask.iv"
    local before = world:hash()
    local run = clench.plan[planner] {hand = hand, object = object, seconds = 1e-6}
    t.equal(#run.grasps, 0)
    t.ok(not run.report.stopped, planner)
    t.equal(world:hash(), before)
  end
end)

test("work after a search whose time has ended is not interrupted", function(t)
  local run = start("anneal", {seconds = 0.1, steps = 1000000000})
  t.ok(run.report.steps < 1000000000)
  -- the hand has closed from the found states
  t.ok(#run.grasps > 0 or next(run.report.rejected) ~= nil)
  local world = clench.world()
  local a = world:add_object(clench.shapes.box {0.1, 0.1, 0.1})
  local b = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {pose = {xyz = {1, 0, 0}}})
  for _ = 1, 1000 do t.close(world:distance(a, b), 0.9, 1e-9) end
end)

test("all DOFs together make the open posture of a hand of many links collision-free", function(t)
  local starts = require "clench.plan.starts"
  local text = {'<robot name="r"><link name="l0"><collision><geometry><box size="0.05 0.05 0.05"/></geometry></collision></link>'}
  for i = 1, 70 do
    text[#text + 1] = ('<link name="l%d"><collision><origin xyz="0 0 0.01"/><geometry><box size="0.01 0.01 0.015"/></geometry></collision></link><joint name="j%d" type="revolute"><parent link="l%d"/><child link="l%d"/><origin xyz="%g 0 0.02"/><axis xyz="0 1 0"/><limit lower="-0.5" upper="0.5" effort="1" velocity="1"/></joint>'):format(
      i, i, i % 35 == 1 and 0 or i - 1, i, i % 35 == 1 and 0.02 * (i // 35) or 0)
  end
  text[#text + 1] = "</robot>"
  local path = test.path(".urdf", table.concat(text))
  local hand = clench.world():add_robot(path)
  t.equal(#hand.links, 70)
  local open = starts.opened(hand)
  hand:set_dofs(open)
  t.equal(#hand.world:colliding(hand), 0)
end)
