-- Selection in the picture, the tree and the tool bar of the viewer.
local test, clench = require "test", require "clench"
local outline = require "clench.view.outline"

local function open()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session}
  view:frame()
  return session, view
end

local function shift(view, down) view.ui:input {kind = "key", code = 340, down = down} end

test("clicks select a link, then its robot, Shift adds and removes, and a click on the background selects nothing", function(t)
  local session, view = open()
  view:tool "Select"
  local link = session.world:robot("barrett").base
  local x, y = 560, 200
  view:click(x, y)
  t.equal(session.selection[1] == link, true)
  view:click(x, y)
  t.equal(session.selection[1] == link.robot, true)
  shift(view, true)
  view:click(585, 560)
  t.equal(#session.selection, 2)
  t.equal(session.selection[2] == session.world:body "mug", true)
  view:click(585, 560)
  t.equal(#session.selection, 1)
  view:click(800, 100)
  t.equal(#session.selection, 1)
  view:click_label "mug"
  t.equal(#session.selection, 2)
  shift(view, false)
  view:click(800, 100)
  t.equal(#session.selection, 0)
  view:close()
end)

test("Delete removes bodies but no links, and undo restores them", function(t)
  local session, view = open()
  local before = session.world:hash()
  view:select "mug"
  view:key "delete"
  t.equal(#session.world.objects, 0)
  view:frame()
  view:key "ctrl+z"
  t.equal(session.world:hash(), before)
  view:select "barrett/barrett_chain0_link1"
  view:key "delete"
  t.equal(session.world:hash(), before)
  t.ok(view.status:find "barrett", view.status)
  view:close()
end)

test("the switch of collisions and the material of the tool bar act on the selection", function(t)
  local session, view = open()
  local world = session.world
  local mug, hand = world:body "mug", world:robot "barrett"
  view:select "mug"
  view:click_label "Collisions"
  t.equal(world:may_collide(mug), false)
  t.equal(world:may_collide(hand), true)
  view:click_label "Collisions"
  t.equal(world:may_collide(mug), true)
  t.ok(session:script():find("set_collision(", 1, true))
  session:run("body.material", {body = "mug", material = world.materials[3]})
  t.equal(require("clench.view.selection").material(view), world.materials[3])
  session:run("world.select", {addresses = {"mug", "barrett"}})
  t.equal(require("clench.view.selection").material(view), nil)
  view:close()
end)

test("the outline is the convex hull of the visible part", function(t)
  local hull = outline.hull {{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 0}}
  t.equal(#hull, 4)
  t.equal(hull[1][1] + hull[1][2], 0)
end)

local function item(view, label, kind)
  for _, found in ipairs(view:items()) do
    if found.label == label and found.kind == kind then return found end
  end
end

test("what is selected in the picture is shown in the tree: its branch is opened and scrolled to", function(t)
  local session = clench.session()
  session:open("worlds/shadow_bottle.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {800, 600}}
  view.picture_visible = false
  view:frame()
  local robot = session.world.robots[1]
  local last = robot.bodies[#robot.bodies]
  local label = last.name:gsub("^" .. robot.name:gsub("%p", "%%%0") .. "_", "")
  t.equal(item(view, label, "tree"), nil)
  view:select(view:address(last))
  for _ = 1, 3 do view:frame() end
  local shown = item(view, label, "tree")
  t.ok(shown, label)
  t.ok(shown.y > 0 and shown.y + shown.height < 400)
  -- a click on another entry that is visible does not scroll
  local base = robot.bodies[#robot.bodies - 1].name:gsub("^" .. robot.name:gsub("%p", "%%%0") .. "_", "")
  local before = item(view, base, "tree")
  view:click(before.x + 60, before.y + 8)
  t.equal(session.selection[1] == robot.bodies[#robot.bodies - 1], true)
  for _ = 1, 3 do view:frame() end
  t.equal(item(view, label, "tree").y, shown.y)
  view:close()
end)

test("a click on a contact in the picture marks it in the list, and scrolls to it", function(t)
  local session, view = open()
  session:run "grasp.autograsp"
  view:tool "Select"
  view.sizes.bottom = 190
  for _ = 1, 2 do view:frame() end
  local contacts = view.quality.contacts
  local index = #contacts
  local x, y = view:project(contacts[index].point)
  view:click(x, y)
  t.ok(view.highlighted and (contacts[view.highlighted].point - contacts[index].point):norm() < 0.01)
  for _ = 1, 3 do view:frame() end
  local found
  for _, one in ipairs(view:items()) do found = found or one.label:find(("^%d "):format(view.highlighted)) and one end
  t.ok(found, "the row of the contact is visible")
  view:click(800, 100)
  t.equal(view.highlighted, nil)
  view:close()
end)
