-- The viewer's gallery: grasps of jobs and files, and two of them side by side.
local test, clench = require "test", require "clench"

local function open()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {1070, 937}}
  view:frame()
  view:frame()  -- tabs are laid out in the second frame
  view:click_label "Gallery"
  return session, view
end

-- a file of two grasps, from two sides of the mug
local function file_of_grasps()
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  local hand, mug, list = world.robots[1], world.objects[1], clench.grasps()
  local start = hand.pose
  for _, angle in ipairs {0, 0.6} do
    hand:open()
    hand.pose = clench.pose {xyz = mug.pose.position} * clench.pose {rpy = {0, 0, angle}} * clench.pose {xyz = mug.pose.position}:inverse() * start
    hand:autograsp()
    local grasp = clench.grasp(hand, mug)
    grasp:quality "epsilon"
    list:add(grasp)
  end
  local path = os.tmpname() .. ".jsonl"
  list:save(path)
  return path, list
end

local function items_of(view, pattern)
  view:frame()
  local found = {}
  for _, item in ipairs(view:items()) do
    if item.label:find(pattern) then found[#found + 1] = item end
  end
  return found
end

test("grasps of a file are shown, applied by a click, and saved", function(t)
  local session, view = open()
  local path, list = file_of_grasps()
  session:run("grasp.load_grasps", {path = path})
  for _ = 1, 4 do view:frame() end
  local images = items_of(view, "^grasp %d$")
  t.equal(#images, 2)
  view:click(images[2].x + 20, images[2].y + 20)
  local expected = session.world:clone()
  list[2]:apply(expected)
  t.equal(session.world:hash(), expected:hash())
  local copy = os.tmpname() .. ".csv"
  view:click_label "Save…"
  view:frame()
  view:key "ctrl+a"
  view:type(copy)
  view:click_label "Save"
  t.equal(view.ask, nil)
  t.equal(#clench.grasps(copy), 2)
  os.remove(copy)
  os.remove(path)
  t.fails(function() session:run("grasp.save_grasps", {path = copy}) end, "no job was started")
  t.fails(function() session:run("grasp.save_grasps", {path = copy, grasps = {}}) end, "there are no grasps")
  view:close()
end)

test("two grasps are compared: their measures in one table, their pictures by one camera", function(t)
  local session, view = open()
  local path, list = file_of_grasps()
  session:run("grasp.load_grasps", {path = path})
  os.remove(path)
  for _ = 1, 4 do view:frame() end
  for _, box in ipairs(items_of(view, "^%d: 0%.%d+$")) do view:click(box.x + 8, box.y + 8) end
  local first, second = table.unpack(view.compared)
  t.close(first.values.epsilon, list[1].epsilon, 1e-9)
  t.close(second.values.epsilon, list[2].epsilon, 1e-9)
  -- each value is in the window, and so is the name of the better grasp
  local better = first.values.epsilon > second.values.epsilon and first or second
  for _, entry in ipairs {first, second} do t.ok(#items_of(view, ("^%.5g$"):format(entry.values.epsilon):gsub("%.", "%%.")) > 0) end
  t.ok(#items_of(view, "^" .. better.short .. "$") >= 2)
  -- a turn of the view turns both pictures
  local pictures = {first.picture, second.picture}
  view:orbit(40, 0)
  t.equal(first.picture == pictures[1], false)
  t.equal(second.picture == pictures[2], false)
  local shot = view:screenshot {}
  t.equal(shot.width, 1070)
  t.equal(shot.height, 937)
  local buttons = items_of(view, "^Apply$")
  view:click(buttons[2].x + 8, buttons[2].y + 8)
  local expected = session.world:clone()
  list[2]:apply(expected)
  t.equal(session.world:hash(), expected:hash())
  view:click(items_of(view, "^%d: 0%.%d+$")[1].x + 8, items_of(view, "^%d: 0%.%d+$")[1].y + 8)
  t.equal(#view.compared, 1)
  t.equal(#items_of(view, "^Apply$"), 0)
  view:close()
end)

test("a grasp of another hand says why it cannot be put here", function(t)
  local session, view = open()
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  world.robots[1]:autograsp()
  local list = clench.grasps()
  list:add(clench.grasp(world.robots[1], world.objects[1]))
  local path = os.tmpname() .. ".jsonl"
  list:save(path)
  session:run("grasp.load_grasps", {path = path})
  os.remove(path)
  view:frame()
  view:frame()
  local buttons = items_of(view, "^cannot be")
  view:click(buttons[1].x + 20, buttons[1].y + 20)
  t.ok(view.status:find "there is no such hand in this world", view.status)
  view:close()
end)

test("pictures are kept when a list grows or changes its order, and their places do not move", function(t)
  local session, view = open()
  local path, list = file_of_grasps()
  os.remove(path)
  local grasps = {list[1]}
  session.lists[1] = {name = "growing", grasps = grasps}
  for _ = 1, 3 do view:frame() end
  local first
  for _, kept in pairs(view.gallery.by_key) do first = kept.picture end
  local place = items_of(view, "^grasp 1$")[1]
  table.insert(grasps, 1, list[2])
  view:frame()
  local function check_kept()
    local count, is_kept = 0, false
    for _, kept in pairs(view.gallery.by_key) do count, is_kept = count + 1, is_kept or kept.picture == first end
    t.equal({count, is_kept}, {2, true})
  end
  check_kept()
  local now = items_of(view, "^grasp %d$")
  t.equal(#now, 2)
  t.equal({now[1].x, now[1].y}, {place.x, place.y})
  grasps[1], grasps[2] = grasps[2], grasps[1]
  view:frame()
  check_kept()
  view:close()
end)

test("pictures are renewed, one per frame, when an object has moved, but not while it moves or when the hand does", function(t)
  local session, view = open()
  local path, list = file_of_grasps()
  os.remove(path)
  session.lists[1] = {name = "two", grasps = {list[1], list[2]}}
  for _ = 1, 4 do view:frame() end
  local function pictures()
    local set, count = {}, 0
    for _, kept in pairs(view.gallery.by_key) do set[kept.picture], count = true, count + 1 end
    return set, count
  end
  local before, count = pictures()
  t.equal(count, 2)
  local function kept_after_frame()
    view:frame()
    local shared = 0
    for picture in pairs((pictures())) do shared = shared + (before[picture] and 1 or 0) end
    return shared
  end
  session:run "grasp.autograsp"
  t.equal(kept_after_frame(), 2)
  session:begin_gesture "Move"
  session.object.pose = session.object.pose * clench.pose {xyz = {0, 0, 0.01}}
  t.equal(kept_after_frame(), 2)
  session:end_gesture()
  t.equal(kept_after_frame(), 1)
  t.equal(kept_after_frame(), 0)
  local renewed = pictures()
  for _ = 1, 3 do view:frame() end
  t.equal((pictures()), renewed)
  view:close()
end)
