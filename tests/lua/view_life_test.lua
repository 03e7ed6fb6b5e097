-- The life of a view: the question about unsaved changes, and data kept from one run to the next.
local test, clench = require "test", require "clench"

-- a small world from a new file
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

-- first: other tests leave views open
test("threads that start while a view is open have a lower priority, unless the user has chosen one", function(t)
  local nice = clench.parallel.nice
  local before = nice(0)
  local session, first = open()
  local levels = {nice()}
  local second = clench.view.offscreen {session = session, size = {64, 48}}
  first:close()
  levels[2] = nice()
  second:close()
  levels[3] = nice()
  t.equal(levels, {10, 10, 0})
  nice(5)
  clench.view.offscreen({session = session, size = {64, 48}}):close()
  t.equal(nice(), 5)
  nice(0)
  local view = clench.view.offscreen {session = session, size = {64, 48}}
  nice(3)
  view:close()
  t.equal(nice(), 3)
  nice(before)
end)

test("New asks only about unsaved changes", function(t)
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

test("a file that cannot be written is named, and the world is kept", function(t)
  local session, view, path = open()
  local world = session.world
  move(session)
  local full = os.tmpname() .. ".wld"
  os.execute("ln -s /dev/full " .. full)
  for file, reason in pairs {["no/such/folder/a.wld"] = "no such folder: no/such/folder", [full] = "got a special file"} do
    session.path = file
    view:key "ctrl+n"
    view:click_label "Save"
    t.ok(is_shown(view, reason), file)
    t.ok(session.world == world and session:is_modified())
    view:click_label "Cancel"
  end
  os.remove(full)
  view:close()
  os.remove(path)
end)

test("a selection is not a change, and undo leads back to an unchanged world", function(t)
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

-- a folder that does not exist yet
local function new_folder()
  local name = os.tmpname()
  os.remove(name)
  return name
end

local function text_at(path)
  local file <close> = io.open(path)
  return file and file:read "a"
end

local autosave, preferences = require "clench.view.autosave", require "clench.view.preferences"

test("unsaved work is stored after five seconds without changes, and dropped when it is saved", function(t)
  local session, view, path = open()
  local folder = new_folder()
  local kept = autosave.keep(view, folder)
  kept.tick(0)
  move(session)
  kept.tick(1)
  kept.tick(5.9)
  t.equal(text_at(folder .. "/autosave-1.lua"), nil)
  kept.tick(6.1)
  t.ok(text_at(folder .. "/autosave-1.lua"):find("clench.load", 1, true))
  t.equal(#autosave.left(folder), 0)  -- its process is running
  session:save()
  kept.tick(7)
  t.equal(text_at(folder .. "/autosave-1.lua"), nil)
  -- during continuous changes work is stored once a minute
  for i = 10, 69 do
    move(session)
    kept.tick(i)
  end
  t.equal(text_at(folder .. "/autosave-1.lua"), nil)
  move(session)
  kept.tick(70)
  t.ok(text_at(folder .. "/autosave-1.lua"))
  kept.finish()
  t.equal(text_at(folder .. "/autosave-1.lua"), nil)
  view:close()
  os.remove(path)
  os.remove(folder)
end)

test("work left by an ended process is offered and restored", function(t)
  local session, view, path = open()
  local folder = new_folder()
  view.kept = {autosave.keep(view, folder)}
  move(session)
  view:flush()
  local hash = session.world:hash()
  local name = folder .. "/autosave-1.lua"
  local text = text_at(name)
  view:close()
  -- another start of the same number is another process
  clench.files.save_text(name, (text:gsub('"start":"%d+"', '"start":"1"')))
  local other = clench.session()
  other:run "world.new"
  local next_view = clench.view.offscreen {session = other, size = {640, 480}}
  next_view.kept = {autosave.keep(next_view, folder)}
  t.ok(is_shown(next_view, "The viewer ended before " .. path .. " was saved"))
  next_view:click_label "Restore"
  t.equal(other.world:hash(), hash)
  t.equal(other.path, path)
  t.ok(other:is_modified() and not is_shown(next_view, "Discard"))
  t.equal(text_at(name), nil)
  t.ok(text_at(folder .. "/autosave-2.lua"))
  local again = load(other:script() .. "\nreturn world")()
  t.equal(again:hash(), hash)
  next_view:close()
  os.remove(path)
  os.remove(folder)
end)

test("current hand and object are restored, too", function(t)
  local session, view, path = open()
  local folder = new_folder()
  view.kept = {autosave.keep(view, folder)}
  session:run("world.import_robot", {path = "models/hands/parallel_jaw/parallel_jaw.cfg", place = "free"})
  session:run("world.import_object", {path = "models/objects/box.iv", place = "free"})
  session:run("grasp.select_hand", {hand = session.world.robots[1].name})
  local first, second = session.world.robots[1].name, session.world.robots[2].name
  local names = {}
  for i, hand in ipairs {first, second} do
    session:run("grasp.select_hand", {hand = hand})
    session:run("grasp.select_object", {object = session.world.objects[3 - i].name})
    names[i] = {hand, session.object.name}
    view:flush()
    local name = folder .. "/autosave-1.lua"
    local text = text_at(name)
    clench.files.save_text(folder .. "/autosave-2.lua", (text:gsub('"start":"%d+"', '"start":"1"')))
    local other = clench.session()
    other:run "world.new"
    local next_view = clench.view.offscreen {session = other, size = {640, 480}}
    next_view.kept = {autosave.keep(next_view, folder)}
    is_shown(next_view, "Restore")
    next_view:click_label "Restore"
    t.equal(other.world:hash(), session.world:hash())
    t.equal({other.hand.name, other.object.name}, names[i])
    next_view:close()
  end
  t.ok(names[1][1] ~= names[2][1] and names[1][2] ~= names[2][2])
  view:close()
  os.remove(path)
  os.execute(("rm -r '%s'"):format(folder))
end)

test("work of a process that has ended is offered even while its parent has not noticed", function(t)
  local folder = new_folder()
  os.execute(("mkdir '%s'"):format(folder))
  local ended <close> = io.popen "echo $$"  -- until it is closed, it is a zombie
  local id = ended:read "l"
  local function stat() return text_at(("/proc/%s/stat"):format(id)) end
  local last = clench.clock() + 20
  while not stat():find "%) Z " and clench.clock() < last do end
  local start = stat():match("%)" .. (" %S+"):rep(19) .. " (%S+)")
  clench.files.save_text(folder .. "/autosave-1.lua", ('-- autosave {"id":"%s","start":"%s","time":"now"}\n\n\nlines\n'):format(id, start))
  t.equal(#autosave.left(folder), 1)
  os.execute(("rm -r '%s'"):format(folder))
end)

test("of several viewers that start to store at once, each has a name of its own", function(t)
  local folder = new_folder()
  local file = folder .. "/new/autosave-1.lua"
  local user_files = require "clench.view.user_files"
  t.ok(user_files.claim(file))
  t.ok(not user_files.claim(file))
  t.ok(not user_files.claim(folder))
  t.ok(user_files.claim "/dev/full/autosave-1.lua")
  t.ok(user_files.claim "/proc/autosave-1.lua")
  os.execute(("rm -r '%s'"):format(folder))
end)

test("Discard removes what was offered, and nothing that has its name since", function(t)
  local session, view, path = open()
  local folder = new_folder()
  local file = folder .. "/autosave-1.lua"
  os.execute(("mkdir '%s'"):format(folder))
  local ended = '-- autosave {"id":"999999999","start":"1","time":"now"}\n\n\n'
  for _, of_another in ipairs {false, true} do
    clench.files.save_text(file, ended)
    view.left = autosave.left(folder)
    if of_another then clench.files.save_text(file, "of another viewer") end
    view:frame()
    view:frame()
    view:click_label "Discard"
    t.equal(#view.left, 0)
    t.equal(text_at(file), of_another and "of another viewer" or nil)
  end
  view:close()
  os.remove(path)
  os.execute(("rm -r '%s'"):format(folder))
end)

test("a full disk is reported once in the console", function(t)
  local session, view, path = open()
  local kept = autosave.keep(view, "/dev/full")
  for _ = 1, 2 do
    move(session)
    kept.flush()
  end
  local told = 0
  for _, line in ipairs(view.lines) do
    if line.text:find("autosave: ", 1, true) then told = told + 1 end
  end
  t.equal(told, 1)
  view:close()
  os.remove(path)
end)

test("unsaved work is stored beside folders and damaged files that have its names", function(t)
  local folder = new_folder()
  os.execute(("mkdir -p '%s/autosave-1.lua'"):format(folder))
  local heads = {'{"id":"","start":"1","time":"x"}', '{"id":5,"start":"1","time":"x"}', '{"id":"999999999","start":"1","time":"x","path":[]}', '{"id":"999999999","start":"1","time":"x","hand":7}', '[1]', '5', '{'}
  for i, head in ipairs(heads) do
    clench.files.save_text(("%s/autosave-%d.lua"):format(folder, i + 1), "-- autosave " .. head .. "\n\n\nlines\n")
  end
  t.equal(#autosave.left(folder), 0)
  local session, view, path = open()
  local kept = autosave.keep(view, folder)
  move(session)
  kept.flush()
  t.ok(text_at(("%s/autosave-%d.lua"):format(folder, #heads + 2)))
  for _, line in ipairs(view.lines) do t.ok(not line.text:find("autosave", 1, true), line.text) end
  view:close()
  os.remove(path)
  os.execute(("rm -r '%s'"):format(folder))
end)

test("settings and recent files are kept", function(t)
  local session, view, path = open()
  local folder = new_folder()
  local file = folder .. "/viewer.json"
  local kept = preferences.keep(view, file)
  view:menu "View/Dark Theme"
  view:menu "View/Millimeters"
  view:menu "View/Degrees"
  view.hidden.Plots = true
  view:frame()
  view:click_label "History"
  view:click_label "Forces"
  kept.tick(0)
  view:close()
  local other = clench.view.offscreen {session = session, size = {640, 480}}
  local again = preferences.keep(other, file)
  t.equal(other.dark, true)
  t.equal(other.units, {length = "mm", angle = "deg"})
  t.equal(other.hidden.Plots, true)
  t.equal(other.front, {bottom = "History", right = "Forces"})
  for _ = 1, 2 do other:frame() end
  t.equal(other.front.bottom, "History")
  t.ok(is_shown(other, "1  Open…") or is_shown(other, "Open"), "the panel History is shown")
  other:screenshot {size = {700, 500}}  -- another screen does not choose another tab
  t.equal(other.front.bottom, "History")
  t.equal(other.recent, {path})
  session:run "world.new"
  other:frame()
  for _, label in ipairs {"File", "Open Recent", path} do other:click_label(label) end
  t.equal(session.path, path)
  os.remove(path)
  session:run "world.new"
  for _, label in ipairs {"File", "Open Recent", path} do other:click_label(label) end
  t.ok(is_shown(other, "no such file: " .. path))
  t.equal(#other.recent, 0)
  session:run("world.save_as", {path = folder .. "/saved.wld"})
  again.tick(1000)
  t.equal(other.recent, {folder .. "/saved.wld"})
  os.remove(folder .. "/saved.wld")
  other:close()
  os.remove(file)
  os.remove(folder)
end)

test("damaged settings are named, and the defaults apply", function(t)
  local _, view, path = open()
  local file = os.tmpname()
  clench.files.save_text(file, "{")
  local kept = preferences.keep(view, file)
  t.ok(view.lines[1].text:find(file, 1, true) and view.lines[1].text:find("starts with its defaults", 1, true))
  t.equal(view.dark, false)
  kept.finish()
  view:close()
  t.equal(text_at(file .. ".damaged"), "{")
  os.remove(file .. ".damaged")
  os.remove(file)
  os.remove(path)
end)

test("names of recent files with control characters are dropped, as no menu can show them", function(t)
  local _, view, path = open()
  local file = os.tmpname()
  clench.files.save_text(file, '{"recent": ["/a\\u0000b.wld", "/c.wld"]}')
  preferences.keep(view, file)
  t.equal(view.recent, {path, "/c.wld"})
  view:close()
  os.remove(file)
  os.remove(path)
end)

test("dropped files are opened or imported, and others are rejected", function(t)
  local session, view, path = open()
  local function drop(file)
    view.ui:input {kind = "drop", text = file}
    view:frame()
    view:frame()
  end
  drop "models/objects/flask.iv"
  t.equal(#session.world.objects, 2)
  session:undo()
  drop "README.md"
  t.ok(view.status:find("expected a model, a world", 1, true))
  drop "no_such.wld"
  t.ok(view.status:find("no such file: no_such.wld", 1, true))
  drop(path)
  t.equal(session.path, path)
  view:close()
  os.remove(path)
end)

test("the session's script is written completely, or not at all", function(t)
  local session, view, path = open()
  local file = os.tmpname()
  view:save_script(file)
  t.equal(text_at(file), session:script() .. "\n")
  t.fails(function() view:save_script "no/such/folder/a.lua" end, "no such folder: no/such/folder")
  view:close()
  os.remove(file)
  os.remove(path)
end)
