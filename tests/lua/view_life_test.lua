-- The life of a view: the question about unsaved changes, and what is kept from one run to the next.
local test, clench = require "test", require "clench"

-- a small world of a file of its own
local function open()
  local path = os.tmpname() .. ".wld"
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  world:save(path)
  local session = clench.session()
  session:open(path)
  return session, clench.view.offscreen {session = session, size = {640, 480}}, path
end

local function change(session) session.object.pose = session.object.pose * clench.pose {xyz = {0, 0, 0.01}} end

local function move(session)
  session:begin_gesture "Move"
  change(session)
  session:end_gesture()
end

local function is_shown(view, label)
  view:frame()
  view:frame()
  for _, item in ipairs(view:items()) do
    if tostring(item.label):find(label, 1, true) then return true end
  end
  return false
end

test("New asks about unsaved changes only", function(t)
  local session, view, path = open()
  local world = session.world
  move(session)
  view:menu "File/New"
  t.ok(is_shown(view, "Don't Save"))
  t.ok(session.world == world)
  view:click_label "Cancel"
  t.ok(session.world == world and not is_shown(view, "Don't Save"))
  view:menu "File/New"
  view:click_label "Don't Save"
  t.ok(session.world ~= world)
  t.equal(#session.world.bodies, 0)
  view:menu "File/New"
  t.ok(not is_shown(view, "Don't Save"))
  view:close()
  os.remove(path)
end)

test("Save before New writes the file", function(t)
  local session, view, path = open()
  move(session)
  local pose = session.object.pose
  view:key "ctrl+n"
  view:click_label "Save"
  t.equal(#session.world.bodies, 0)
  t.close((clench.load(path).objects[1].pose.position - pose.position):norm(), 0, 1e-9)
  view:close()
  os.remove(path)
end)

test("a file that cannot be written is named, and the world stays", function(t)
  local session, view, path = open()
  local world = session.world
  move(session)
  session.path = "no/such/folder/a.wld"
  view:key "ctrl+n"
  view:click_label "Save"
  t.ok(is_shown(view, "no such folder: no/such/folder"))
  t.ok(session.world == world and session:is_modified())
  view:close()
  os.remove(path)
end)

test("a selection is no change, and undo leads back to an unchanged world", function(t)
  local session, view, path = open()
  session:run("world.select", {addresses = {session.object.name}})
  t.equal(session:is_modified(), false)
  move(session)
  t.equal(session:is_modified(), true)
  session:undo()
  t.equal(session:is_modified(), false)
  view:close()
  os.remove(path)
end)
