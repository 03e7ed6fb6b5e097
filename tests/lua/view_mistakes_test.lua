-- A view survives errors of scripts, commands and keys, and its history and script remain correct.
local test, clench = require "test", require "clench"
local views = dofile "tests/lua/view_session.lua"
local open, item, texts_of, move, button = views.open, views.item, views.texts_of, views.move, views.button

-- the session's script gives its world
local function check_script(t, session)
  local world = assert(load(session:script() .. "\nreturn world", "=script", "t"))()
  t.equal(world:hash(), session.world:hash())
end

local function panel_errors(view) return texts_of(view):match "[^\n]*%.lua:%d+[^\n]*" end

test("removed bodies are no longer the current hand, object or selection", function(t)
  local removals = {
    function(session) session.world:remove(session.object) end,
    function(session) session.world:remove(session.hand) end,
    function(session) session.object.kind = "obstacle" end,
    function(session)
      -- the world is as it was at the last frame
      local cube = session:run("world.import_object", {path = "models/objects/cube.iv"})
      session:run("world.select", {addresses = {"cube"}})
      session.world:remove(cube)
    end,
  }
  for i, remove in ipairs(removals) do
    local session, view = open()
    session:run("world.select", {addresses = {"mug"}})
    view:tool "Translate"
    remove(session)
    for _ = 1, 2 do t.equal(panel_errors(view), nil, i) end
    t.ok(not session.object or session.object.kind == "object")
    view:close()
  end
  local session, view = open()
  view:click(view.ui.size[1] / 2, 885)  -- the input line of the console
  view:type "world:remove(object)"
  view:key "enter"
  t.equal(#session.world.objects, 0)
  t.equal(panel_errors(view), nil)
  view:close()
end)

test("the menu of a body that a key removes closes", function(t)
  local session, view = open()
  session:run("world.select", {addresses = {"mug"}})
  view:frame()
  local x, y = view:project(session.object.pose.position)
  move(view, x, y)
  button(view, true, 1)
  button(view, false, 1)
  t.ok(view.context.thing)
  view:key "delete"
  t.equal(view.context, nil)
  view:key "ctrl+z"
  t.equal(#session.world.objects, 1)
  view:close()
end)

test("the menu of a robot in the tree has all commands", function(t)
  local _, view = open()
  local row
  for _, found in ipairs(view:items()) do
    if found.kind == "tree" and found.label == "barrett" then row = found end
  end
  move(view, row.x + 30, row.y + 5)
  button(view, true, 1)
  button(view, false, 1)
  local texts = texts_of(view)
  for _, label in ipairs {"Current Hand", "Restore Posture", "Material…", "Mass…", "Remove"} do t.ok(texts:find("\n" .. label .. "\n", 1, true), label) end
  t.equal(panel_errors(view), nil)
  view:close()
end)

test("an error of a command's `enabled` or `suggested` is the reason why it cannot run, and stops nothing else", function(t)
  local session, view = open()
  session:command {name = "mine.broken", label = "Broken…", menu = "Mine", reads = true, run = print, enabled = function() error("boom", 0) end}
  session:command {name = "mine.asks", label = "Asks…", menu = "Mine", reads = true, run = print,
                   parameters = {{name = "a", type = "string", suggested = function() error("bang", 0) end}}}
  t.equal({session:can_run "mine.broken"}, {false, "boom"})
  t.equal({session:can_run "grasp.autograsp"}, {true})
  t.fails(function() session:can_run "mine.none" end, "there is no command 'mine.none'")
  t.fails(function() session:run "mine.broken" end, "the command cannot run now: boom")
  t.fails(function() view:menu "Mine/Broken…" end, "'Broken…' is disabled")
  view:key "escape"
  view:menu "Mine/Asks…"
  t.equal(view.status, "bang")
  view:key "ctrl+p"
  view:frame()
  view:close()
end)

test("a key during a drag ends it: what follows changes nothing, and the script gives the world", function(t)
  for _, key in ipairs {"ctrl+z", "delete", "c", "g", "space"} do
    local session, view = open()
    session:run("world.select", {addresses = {"mug"}})
    view:tool "Translate"
    local x, y = view:project(session.object.pose.position)
    move(view, x + 25, y)
    button(view, true)
    for i = 1, 3 do move(view, x + 25 + 4 * i, y) end
    t.ok(session.gesture, key)
    view:key(key)
    t.equal(view.press and view.press.kind, nil, key)
    session:end_gesture()  -- of a playback
    local hash = session.world:hash()
    for i = 4, 6 do move(view, x + 25 + 4 * i, y) end
    button(view, false)
    t.equal(session.world:hash(), hash, key)
    check_script(t, session)
    view:close()
  end
end)

test("Escape during a drag reverts it, but not a playback that has begun meanwhile", function(t)
  local session, view = open()
  local before = session.world:hash()
  view:tool "Translate"
  local x, y = view:project(session.object.pose.position)
  move(view, x + 25, y)
  button(view, true)
  move(view, x + 40, y)
  view:key "escape"
  t.equal(session.world:hash(), before)
  button(view, false)
  session:run "dynamics.play"
  view:tool "Camera"
  move(view, 600, 700)
  button(view, true)
  move(view, 620, 700)
  view:key "escape"
  t.ok(session.playing, "a drag of the camera was cancelled")
  button(view, false)
  session:run "dynamics.pause"
  view:close()
end)

-- presses the mouse on a widget
local function press_on(view, pattern)
  local widget = item(view, pattern)
  move(view, widget.x + widget.width / 4, widget.y + 8)
  button(view, true)
  return widget
end

test("a slider during a playback ends it, and both are steps of the history and lines of the script", function(t)
  for _, pattern in ipairs {"^dof2", "^transp"} do
    local session, view = open("barrett_mug", {1100, 1900})
    view:select(pattern == "^dof2" and "barrett" or "mug")
    session:run "dynamics.play"
    for _ = 1, 3 do clench.loop.run(0.02) end
    press_on(view, pattern)
    t.equal(session.playing, nil)
    button(view, false)
    t.equal(session.gesture, nil)
    local done = session.history.done
    t.equal(done[#done - 1].label, "Play")
    check_script(t, session)
    view:close()
  end
end)

test("bodies that are moved while the transparency is dragged are in the script, too", function(t)
  local session, view = open("barrett_mug", {1100, 1900})
  view:select "mug"
  press_on(view, "^transp")
  session.hand.dofs = {0, 0.3, 0.3, 0.3}
  button(view, false)
  t.ok(session.object.transparency > 0)
  check_script(t, session)
  session:undo()
  t.equal(session.object.transparency, 0)
  view:close()
end)

test("the gesture of a slider that vanishes while it is dragged ends with the release", function(t)
  local session, view = open("barrett_mug", {1100, 1900})
  view:select "barrett"
  press_on(view, "^dof2")
  t.ok(session.gesture)
  session:run("world.select", {addresses = {"mug"}})
  button(view, false)
  t.equal(session.gesture, nil)
  check_script(t, session)
  view:close()
end)

test("a body that a script removes during a drag returns at the release, with the reason", function(t)
  local session, view = open("barrett_mug", {1100, 1900})
  view:select "mug"
  local field = press_on(view, "^x %[m%]")
  move(view, field.x + field.width / 2, field.y + 8)
  t.ok(session.gesture)
  session.world:remove(session.object)
  button(view, false)
  t.equal(session.gesture, nil)
  t.equal(#session.world.objects, 1)
  t.ok(view.status:find "adds or removes bodies", view.status)
  view:close()
end)

test("a slider that is hidden by F9 ends its gesture at the release", function(t)
  local session, view = open("barrett_mug", {1100, 1900})
  view:select "barrett"
  press_on(view, "^dof2")
  view:key "f9"
  button(view, false)
  t.equal(session.gesture, nil)
  view:key "f9"
  check_script(t, session)
  view:close()
end)

test("end_gesture and cancel_gesture of one gesture leave another one open, and take nothing else", function(t)
  local session = clench.session(clench.load("worlds/barrett_mug.wld", {root = "."}))
  local first = session:begin_gesture "First"
  local second = session:begin_gesture "Second"
  session:end_gesture(first)
  session:cancel_gesture(first)
  t.equal(session.gesture, second)
  session:cancel_gesture(second)
  t.equal(session.gesture, nil)
  t.fails(function() session:end_gesture(3) end, "session:end_gesture: expected the result of session:begin_gesture, got 3")
  t.fails(function() session:cancel_gesture {} end, "session:cancel_gesture: expected the result of session:begin_gesture, got an empty table")
end)

test("a message stays until the next action, which may have the same one", function(t)
  local session, view = open()
  session:command {name = "mine.notes", run = function() clench.log.info "seen" end, script = function() return "" end}
  for _ = 1, 3 do
    view:run "mine.notes"
    t.equal(view.status, "seen")
  end
  view:run "grasp.open"
  t.equal(view.status, "Ready")
  view:close()
end)

test("the status bar names the file of a note", function(t)
  local _, view = open()
  local file = test.path ".wrl"
  clench.files.save_text(file, "#VRML V2.0 utf8\nShape { geometry Box { size 1 1 1 } }\nSound {}\n")
  view:run("world.import_object", {path = file})
  t.ok(view.status:find("^" .. file:match "[^/]+$" .. ":%d*:? "), view.status)
  view:close()
end)

test("a click on a step of the history leads to it, also while dynamics play", function(t)
  local session, view = open()
  for i = 1, 4 do session:run("grasp.dofs", {dofs = {0, i / 10, i / 10, i / 10}}) end
  view:click_label "History"
  session:run "dynamics.play"
  for _ = 1, 3 do clench.loop.run(0.02) end
  view:click_label(item(view, "^3  ").label)
  t.equal(#session.history.done, 3)
  t.close(session.hand.dofs[2], 0.2, 1e-12)
  local next_step = item(view, "%(undone%)")
  view:click(next_step.x + 5, next_step.y + 5)
  t.close(session.hand.dofs[2], 0.3, 1e-12)
  view:close()
end)

test("a world without a file is saved under a new name, in a folder that is created after a question", function(t)
  local session = clench.session(clench.load("worlds/barrett_mug.wld", {root = "."}))
  local view = clench.view.offscreen {session = session, size = {1070, 937}}
  view:menu "File/Save"
  local folder = test.path()
  view:type(folder .. "/new/a")
  view:key "enter"
  t.ok(texts_of(view):find(folder .. "/new does not exist. Create it?", 1, true))
  t.equal(clench.files.exists(folder), false)
  for _ = 1, 30 do view:frame() end
  view:click_label "Create"
  t.equal(session.path, folder .. "/new/a.wld")
  t.equal(clench.load(session.path):hash(), session.world:hash())
  t.equal(view.status, "Saved " .. session.path)
  session:run "grasp.open"
  t.equal(view.status, "Ready")
  view:close()
end)

test("Enter is OK, also when the path was chosen with the mouse", function(t)
  local session, view = open()
  view:menu "File/Import Object…"
  view:click_label "models/objects/cube.iv"
  view:key "enter"
  t.equal(session.world:body "cube".name, "cube")
  t.equal(view.dialogs, {})
  view:close()
end)

test("an arm does not replace the current hand, and carries the only other robot by default", function(t)
  local session, view = open()
  session:run("world.import_robot", {path = "models/arms/puma560/puma560.cfg"})
  t.equal(session.hand.name, "barrett")
  view:menu "Element/Mount on…"
  t.equal(view.dialogs["body.mount"].on, "puma560")
  view:key "escape"
  session:run("world.import_robot", {path = "models/hands/parallel_jaw/parallel_jaw.cfg"})
  t.equal(session.hand.name, "parallel_jaw")
  view:close()
end)

test("the status bar says that collisions are off, instead of that nothing overlaps", function(t)
  local session, view = open()
  t.ok(texts_of(view):find "no overlap")
  session:run("world.select", {addresses = {}})
  session:run "body.collisions"
  t.ok(texts_of(view):find "collisions are off")
  view:close()
end)
