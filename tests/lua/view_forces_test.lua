-- The panel Forces, driven by synthetic input and compared with the functions that it calls.
local test, clench = require "test", require "clench"
local views = dofile "tests/lua/view_session.lua"
local texts_of = views.texts_of

local function open(world)
  local session = clench.session()
  session:open(("worlds/%s.wld"):format(world or "barrett_mug"), {root = "."})
  local view = clench.view.offscreen {session = session, size = {1070, 1400}}
  view:frame()
  return session, view
end

test("optimal forces are shown until something moves, and the yielding contact is named", function(t)
  local session, view = open()
  session:run "grasp.autograsp"
  view:click_label "Forces"
  view:click_label "Optimize"
  t.equal(view.forces.result.status, "optimal")
  t.equal(#view.shown_forces.forces, #session.world:contacts(session.hand, session.object))
  view.forces.max_force = 1e-3
  view:click_label "Optimize"
  view:frame()
  t.equal(view.forces.result.status, "infeasible")
  t.ok(texts_of(view):find "The contact of barrett_chain%d_link%d yields first", texts_of(view))
  view.forces.max_force = 0
  view:click_label "Stability"
  t.equal(view.forces.result.status, "stable")
  view:menu "Grasp/Auto Open"
  view:frame()
  t.equal(view.shown_forces, nil)
  t.ok(texts_of(view):find "Something has moved since")
  view:close()
end)

test("a wrench is typed, and its largest multiple is shown with what yields", function(t)
  local session, view = open()
  session:run "grasp.autograsp"
  view:click_label "Forces"
  view:click_label "wrench"
  t.equal(view.forces.wrench, {0, 0, 0, 0, 0, 0})
  local wrench = {0.5, 0, -1, 0, 0.01, 0}
  view.forces.wrench, view.forces.max_force = wrench, 2
  view:click_label "Maximum Wrench"
  local wanted = clench.grasp(session.hand, session.object):max_load {direction = wrench, max_force = 2}
  t.equal(view.forces.result.status, "optimal")
  t.close(view.forces.result.load, wanted.load, 1e-9)
  view:frame()
  t.ok(texts_of(view):find(("%.4g times the load"):format(wanted.load), 1, true), texts_of(view))
  t.ok(texts_of(view):find "yields first")
  view:click_label "weight"
  t.equal(view.forces.wrench, nil)
  view:close()
end)

test("an optimal preload becomes the constant torques, which hold the load", function(t)
  local session, view = open "tendon_cylinder"
  session:run "grasp.autograsp"
  view:click_label "Forces"
  view.forces = nil
  view:frame()
  view:click_label "wrench"
  view.forces.wrench = {0, 0, -0.2, 0, 0, 0}
  view:click_label "Optimal Preload"
  local grasp = clench.grasp(session.hand, session.object)
  local wanted = grasp:optimal_preload {loads = {{0, 0, 0, 0, 0, 0}, {0, 0, -0.2 * 1.5, 0, 0, 0}}}
  t.equal(view.forces.result.status, "optimal")
  t.close(view.forces.torques[1], wanted.torques[1], 1e-12)
  view:frame()
  t.ok(texts_of(view):find "of the limit of the motor that is loaded most")
  view:click_label "Stability"
  t.equal(view.forces.result.status, "stable")
  t.close(view.forces.result.joint_torques[1], wanted.torques[1], 1e-9)
  view:click_label "constant torques"
  t.equal(view.forces.torques, nil)
  view:close()
end)

test("resistible wrenches are plotted in the chosen plane", function(t)
  local session, view = open()
  session:run "grasp.autograsp"
  view:click_label "Forces"
  view.forces.max_force, view.forces.x, view.forces.y = 3, "fy", "tz"
  view:click_label "Resistible Wrenches"
  local wanted = clench.study.resistible_wrenches(clench.grasp(session.hand, session.object), {axes = {"fy", "tz"}, max_force = 3})
  t.close(view.forces.result.area, wanted.area, 1e-12)
  view:frame()
  t.ok(texts_of(view):find "resistible wrenches")
  t.ok(texts_of(view):find "yields first, at")
  view:close()
end)
