-- Menus of right clicks, compared with the commands of their entries.
local test, clench = require "test", require "clench"
local input = require "clench.view.input"

local function open()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session}
  view:frame()
  return session, view
end

local function right_click(view, x, y) input.click(view, x, y, 1) end

test("a right click on a body opens its menu, whose entries act on it", function(t)
  local session, view = open()
  local mug = session.world:body "mug"
  right_click(view, 585, 560)
  view:click_label "Select This"
  t.equal(session.selection[1] == mug, true)
  t.equal(view.context, nil)
  right_click(view, 585, 560)
  view:click_label "Collisions ON/OFF"
  t.equal(session.world:may_collide(mug), false)
  session:undo()
  local point = view:pick(585, 560).point
  right_click(view, 585, 560)
  view:click_label "Seek This"
  t.close((view.camera.target - point):norm(), 0, 1e-9)
  view:home()
  right_click(view, 585, 560)
  view:click_label "Remove"
  t.equal(#session.world.objects, 0)
  view:close()
end)

test("a link has the entries of its hand, and cannot be removed separately", function(t)
  local session, view = open()
  right_click(view, 560, 200)
  t.equal(input.find(view, "Remove", "menu item").enabled, false)
  view:click_label "Select Robot"
  t.equal(session.selection[1] == session.world:robot "barrett", true)
  right_click(view, 560, 200)
  view:click_label "Auto Grasp"
  local other = clench.session()
  other:open("worlds/barrett_mug.wld", {root = "."})
  other:run "grasp.autograsp"
  t.equal(session.world:hash(), other.world:hash())
  view:close()
end)

test("a right click on the background opens the menu of the camera, and a drag with the right button opens none", function(t)
  local _, view = open()
  right_click(view, 800, 100)
  view:click_label "Orthographic"
  t.ok(view.camera.orthographic)
  view:drag(585, 560, 600, 660, {button = 1})
  t.equal(view.context, nil)
  view:close()
end)

test("the tree has the same menus", function(t)
  local session, view = open()
  local item = input.find(view, "mug", "tree")
  right_click(view, item.x + 40, item.y + item.height / 2)
  view:click_label "Select This"
  t.equal(session.selection[1] == session.world:body "mug", true)
  item = input.find(view, "barrett", "tree")
  right_click(view, item.x + 40, item.y + item.height / 2)
  view:click_label "Add to Selection"
  t.equal(session.selection[2] == session.world:robot "barrett", true)
  view:close()
end)
