-- The panel Display, and the kind of bodies in the inspector, driven by synthetic input.
local test, clench = require "test", require "clench"
local views = dofile "tests/lua/view_session.lua"
local opened, texts_of = views.open, views.texts_of

-- the view without panels is the picture of clench.render with these options
local function shows(t, session, view, options)
  view.panels_visible = false
  view:frame()
  for name, value in pairs(view.camera) do options[name] = value end
  options.size, options.quality = {1070, 937}, "draft"
  t.equal(view.ui:read() == clench.render(session.world, options), true)
  view.panels_visible = true
  view:frame()
end

test("bodies are drawn as faces, edges or points", function(t)
  local session, view = opened()
  view:click_label "Display"
  view:click_label "bodies as"
  view:click_label "wireframe"
  shows(t, session, view, {style = "wireframe"})
  view:click_label "bodies as"
  view:click_label "points"
  shows(t, session, view, {style = "points"})
  view:click_label "bodies as"
  view:click_label "faces"
  shows(t, session, view, {})
  view:close()
end)

test("the unbalanced wrench of the selection is an arrow at its center of mass", function(t)
  local session, view = opened()
  local mug = session.object
  view:click_label "Display"
  view:click_label "unbalanced wrenches"
  view:select "mug"
  local wrench = session:run("body.net_wrench", {body = "mug"})
  t.close(wrench.force.z, mug.mass * session.world.gravity.z, 1e-12)
  session:run("world.select", {addresses = {}})
  shows(t, session, view, {})
  session:run("world.select", {addresses = {"mug"}})
  local wrenches = require "clench.view.wrenches"
  t.equal(wrenches.of(view), {wrench})
  -- without the outline, which the view adds
  local drawn = view.picture_visible and wrenches.of(view)
  local with = clench.render(session.world, {size = {200, 150}, quality = "draft", wrenches = drawn})
  t.ok(with ~= clench.render(session.world, {size = {200, 150}, quality = "draft"}))
  view:close()
end)

test("bounding boxes of the selection are drawn at the chosen depth", function(t)
  local session, view = opened()
  view:click_label "Display"
  view:select "mug"
  view:frame()
  local plain = view:hash()
  view:click_label "bounding boxes"
  t.ok(texts_of(view):find "\n1 boxes\n")
  t.ok(view:hash() ~= plain)
  view.box_depth = 2
  t.ok(texts_of(view):find(("\n%d boxes\n"):format(#session.object.mesh:bounding_boxes(2)), 1, true))
  view:select "barrett"
  view.box_depth = 3
  view:frame()
  view:click_label "bounding boxes"
  t.equal(view.box_depth, nil)
  view:close()
end)

test("the inspector switches a body between dynamic and static, as one command", function(t)
  local session, view = opened()
  view:select "mug"
  view:frame()
  t.ok(texts_of(view):find "\nobject\n")
  view:click_label "dynamic"
  t.equal(session.world:body("mug").kind, "obstacle")
  t.equal(session.object, nil)
  t.ok(texts_of(view):find "\nobstacle\n")
  t.ok(session:script():find('world:body("mug").kind = "obstacle"', 1, true))
  view:click_label "dynamic"
  t.equal(session.world:body("mug").kind, "object")
  view:key "ctrl+z"
  view:key "ctrl+z"
  t.equal(session.object.name, "mug")
  view:select "barrett"
  view:frame()
  t.equal(texts_of(view):find "\ndynamic\n", nil)
  view:close()
end)

test("the panel Forces prescribes sums, and lets springs hold", function(t)
  local session, view = opened()
  session:run "grasp.autograsp"
  view:click_label "Forces"
  view:click_label "Prescribed Sums"
  view.forces.total_force = 12
  view:click_label "Optimize"
  local sum = 0
  for _, force in ipairs(view.forces.result.forces) do sum = sum + force.normal end
  t.close(sum, 12, 1e-6)
  local weight = {0, 0, session.object.mass * session.world.gravity.z, 0, 0, 0}
  local wanted = clench.grasp(session.hand, session.object):contact_forces {load = weight, total_force = 12}
  for i, force in ipairs(wanted.forces) do t.close(view.forces.result.forces[i].normal, force.normal, 1e-9) end
  view.forces.total_force, view.forces.max_force = 0, 1e-3
  view:click_label "nearest balance"
  view:click_label "Optimize"
  t.equal(view.forces.result.status, "optimal")
  t.ok(view.forces.result.residual > 0.1)
  t.ok(texts_of(view):find "unbalanced")
  view:close()
  session, view = opened "tendon_cylinder"
  session:run "grasp.autograsp"
  view:click_label "Forces"
  view:click_label "springs hold"
  view:click_label "Stability"
  local grasp = clench.grasp(session.hand, session.object)
  weight = {0, 0, session.object.mass * session.world.gravity.z, 0, 0, 0}
  local springs = grasp:equilibrium {load = weight, torques = "springs"}
  t.equal(view.forces.result.status, springs.status)
  t.close(view.forces.result.residual or 0, springs.residual or 0, 1e-9)
  view:close()
end)
