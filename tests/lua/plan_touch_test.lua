-- Links with which a planned grasp may and must touch.
local test, clench = require "test", require "clench"

local function barrett_mug()
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  return world.robots[1], world.objects[1]
end

local function touching(grasp)
  local names = {}
  for _, name in ipairs(grasp.links) do names[name:gsub("^.-_chain", "chain")] = true end
  return names
end

local function plan(planner, options)
  options.hand, options.object = barrett_mug()
  return clench.plan[planner](options), options.hand
end

test("fingertip grasps touch only with the last links, and power grasps with the palm as well", function(t)
  local run, hand = plan("sample", {contacts = "fingertip", count = 5, refine = 4})
  t.ok(#run.grasps >= 4)
  local tips = {chain0_link2 = true, chain1_link2 = true, chain2_link1 = true}
  for _, grasp in ipairs(run.grasps) do
    for name in pairs(touching(grasp)) do t.ok(tips[name], name) end
  end
  run = plan("sample", {contacts = "power", count = 5, refine = 4})
  t.ok(#run.grasps >= 4)
  for _, grasp in ipairs(run.grasps) do t.ok(touching(grasp)[hand.base.name]) end
end)

test("links that may and must touch are selected by name", function(t)
  local run, hand = plan("random", {touch = {must = {"chain2_link1", {"chain0_link1", "base"}}}, count = 10})
  t.ok(#run.grasps >= 5)
  for _, grasp in ipairs(run.grasps) do
    local names = touching(grasp)
    t.ok(names.chain2_link1 and (names.chain0_link1 or names[hand.base.name]))
  end
  run = plan("random", {touch = {may = {"chain0_link2", "chain1_link2", "chain2_link1"}}, count = 10})
  t.ok(#run.grasps >= 5)
  for _, grasp in ipairs(run.grasps) do t.ok(not touching(grasp)[hand.base.name]) end
end)

test("annealing respects the links, too, and if no grasp is left the report explains why", function(t)
  local all = plan("anneal", {steps = 3000, seed = 2})
  t.ok(#all.grasps > 0)
  local none = plan("anneal", {steps = 3000, seed = 2, touch = {may = {}}})
  t.equal(#none.grasps, 0)
  t.equal(none.report.rejected["touched with links that may not touch"], #all.grasps)
  t.ok(tostring(none.report):find "why: %d+ grasps were rejected: touched with links that may not touch")
  local run = plan("random", {candidates = 64, touch = {may = {"base"}}})
  t.equal(#run.grasps, 0)
  t.ok(tostring(run.report):find "touched with links that may not touch", tostring(run.report))
end)

test("faults of contacts and touch are reported", function(t)
  local function fails(options, words) t.fails(function() plan("random", options) end, words) end
  fails({contacts = "finger"}, "contacts must be 'fingertip', 'power' or 'any', got 'finger'")
  fails({contacts = "power", touch = {}}, "expected contacts or touch, got both")
  fails({touch = "base"}, "touch must be a table {must =, may =} of names of links, got 'base'")
  fails({touch = {mst = {}}}, "unknown key 'mst'")
  fails({touch = {may = {"bse"}}}, "touch.may[1]")
  fails({touch = {must = {{"base", 3}}}}, "touch.must[1][2] must be the name of a link, got 3")
  fails({touch = {must = 3}}, "touch.must must be a list of names of links, got 3")
end)
