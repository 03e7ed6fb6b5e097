-- The panel Wrench Space and its windows, driven by synthetic input.
local test, clench = require "test", require "clench"

local function open()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  session:run "grasp.autograsp"
  local view = clench.view.offscreen {session = session, size = {1070, 937}}
  view:frame()
  view:click_label "Wrench Space"
  return session, view
end

local function item(view, label)
  view:frame()
  for _, found in ipairs(view:items()) do
    if found.label == label then return found end
  end
end

test("several windows show projections with coordinates of their own, and follow the grasp", function(t)
  local session, view = open()
  view:click_label "Open in a Window"
  view.projection.fixed = {fx = 0, fy = 0.1, fz = 0}
  view:click_label "Open in a Window"
  view:frame()
  t.equal(#view.projections, 2)
  local first, second = view.projections[1], view.projections[2]
  local space = clench.grasp(session.hand, session.object):wrench_space()
  t.close(first.projection.volume, space:project({fixed = {tx = 0, ty = 0, tz = 0}}).volume, 1e-12)
  t.close(second.projection.volume, space:project({fixed = {fx = 0, fy = 0.1, fz = 0}}).volume, 1e-12)
  second.norm = "Linf"
  view:frame()
  t.close(second.projection.volume, clench.grasp(session.hand, session.object):wrench_space({norm = "Linf"}):project({fixed = {fx = 0, fy = 0.1, fz = 0}}).volume, 1e-9)
  local before = first.projection.volume
  session:run "grasp.open"
  view:frame()
  t.equal(item(view, "wrench space" .. first.key), nil)
  session:undo()
  view:frame()
  t.close(first.projection.volume, before, 1e-12)
  view:close()
end)

test("a drag over a projection turns its picture, and the cross closes its window", function(t)
  local _, view = open()
  view:click_label "Open in a Window"
  local state = view.projections[1]
  local picture = item(view, "wrench space" .. state.key)
  local before = state.picture
  view:drag(picture.x + 60, picture.y + 100, picture.x + 160, picture.y + 110)
  view:frame()
  t.ok(state.camera ~= nil, "the drag did not turn it")
  t.ok(state.picture ~= before)
  local old, new = before.camera, state.camera
  t.close((new.eye - new.target):norm(), (old.eye - old.target):norm(), 1e-9)
  t.ok((new.eye - old.eye):norm() > 0.1 * (old.eye - old.target):norm())
  t.equal(#view.projections, 1)
  -- of a window 330 wide
  view:click(picture.x + 306, picture.y - 131)
  view:frame()
  t.equal(#view.projections, 0)
  view:close()
end)
