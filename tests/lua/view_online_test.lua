-- The panel of the on-line planner, driven by synthetic input and compared with the planner that it shows.
local test, clench = require "test", require "clench"
local views = dofile "tests/lua/view_session.lua"
local texts_of = views.texts_of
local loop = clench.loop

local function run_until(t, is_over)
  local last = loop.time() + 300
  while not is_over() and loop.time() < last do loop.run(0.02) end
  t.ok(is_over())
end

local function opened()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  session.hand:place_approach(session.object.pose.position, {0, 0, -1}, 0.1)
  local view = clench.view.offscreen {session = session, size = {1070, 1100}}
  view:frame()
  return session, view
end

-- starts it by the menu; the grasp of a short search, or else one that the hand closes at once, is the only solution
local function start(t, session, view)
  view:menu "Grasp/On-line Planner…"
  view:frame()
  view:click_label "OK"
  t.ok(session.online)
  t.equal(view.front.right, "On-line Planner")
  local hand, object = session.hand, session.object
  local copy = hand:in_world(hand.world:clone())
  local open = copy.dofs
  copy:approach_object {reach = 0.2}
  copy:autograsp()
  local grasp = clench.grasp(copy, object:in_world(copy.world))
  grasp:quality "epsilon"
  grasp.pregrasp = {pose = grasp.pose, dofs = open}
  session.online.planner.solutions = {{grasp = grasp, number = 1}}
  session.online.planner.finish = function() end
  run_until(t, function() return session.online.nearest and session.online.search end)
  return grasp
end

test("the menu starts the on-line planner, whose panel shows its status, distances and solutions", function(t)
  local session, view = opened()
  local grasp = start(t, session, view)
  local texts = texts_of(view)
  t.ok(texts:find "\nPLANNING\n")
  t.ok(texts:find("\n1 of 10\n", 1, true), texts)
  t.ok(texts:find(("\n%.4f m\n"):format(session.world:distance(session.hand, session.object)), 1, true), texts)
  local nearest = session.online.planner:nearest()
  t.ok(texts:find(("\n%.4f m, %.3f rad\n"):format(nearest.distance, nearest.angle), 1, true), texts)
  t.ok(texts:find(("\n%.4f\n"):format(grasp.epsilon), 1, true), texts)
  t.equal(texts:find "%.lua:%d+:", nil)
  view:click_label "auto"
  t.equal(session.online.auto, true)
  view:click_label "auto"
  view:click_label "shape the simulated hand"
  t.equal(session.online.shape_hand, false)
  view:click_label "shape the real hand"
  t.ok(view.status:find "the real hand is not connected", view.status)
  view:click_label("Grasp", "button")
  t.ok(texts_of(view):find "\nGRASPING\n")
  view:click_label("Open", "button")
  t.ok(texts_of(view):find "\nOPEN\n")
  view:click_label("Plan", "button")
  t.ok(texts_of(view):find "\nPLANNING\n")
  view:click_label "Go to Solution"
  t.close((session.hand.pose.position - (session.object.pose * grasp.pose).position):norm(), 0, 1e-9)
  for i, value in ipairs(session.hand.dofs) do t.close(value, grasp.dofs[i], 1e-9) end
  view:click_label("Stop", "button")
  t.equal(session.online, nil)
  t.ok(texts_of(view):find "\nnot running\n")
  view:close()
end)

test("ghosts show the search and the nearest solution, in the poses that the planner reports", function(t)
  local ghosts = require "clench.view.ghosts"
  local session, view = opened()
  local grasp = start(t, session, view)
  local function drawn() return ghosts.of(view) or {} end
  t.equal(#drawn(), 2)
  local search, solution = table.unpack(drawn())
  t.close((search.robot.pose.position - session.online.search.pose.position):norm(), 0, 1e-12)
  t.close((solution.robot.pose.position - (session.object.pose * grasp.pose).position):norm(), 0, 1e-12)
  for i, value in ipairs(solution.robot.dofs) do t.close(value, grasp.dofs[i], 1e-9) end
  view:frame()
  local both = view:hash()
  view:click_label "show the search"
  t.equal(#drawn(), 1)
  view:frame()
  t.ok(view:hash() ~= both)
  view:click_label "show the nearest solution"
  t.equal(#drawn(), 0)
  -- the picture is that of clench.render with the same ghosts
  view.panels_visible, view.shows_solution = false, true
  session.online.status = "open"
  view:frame()
  local options = {}
  for name, value in pairs(view.camera) do options[name] = value end
  options.size, options.quality, options.ghosts = {1070, 1100}, "draft", drawn()
  t.equal(view.ui:read() == clench.render(session.world, options), true)
  session:run "online.stop"
  t.equal(#drawn(), 0)
  view:close()
end)
