-- Files to choose from in dialogs, and the question before one is replaced.
local test, clench = require "test", require "clench"
local paths = require "clench.view.paths"
local views = dofile "tests/lua/view_session.lua"
local open, item, texts_of = views.open, views.item, views.texts_of

-- paths to choose from in the dialog of a command
local function choices(view, name, text)
  local list = {}
  for i, choice in ipairs(paths.choices(view, view.session.commands[name].parameters[1].files, text)) do list[i] = choice.path end
  return list
end

test("the files of an import are chosen from a list, which follows the text, and a planner's dialog ends with its world", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {1070, 937}}
  view:menu "Grasp/Planner…"
  t.ok(view.dialogs["planner.primitive"])
  view:menu "File/New"
  view:frame()
  t.equal(view.dialogs, {})
  view:menu "File/Import Object…"
  t.equal(choices(view, "world.import_object", ""), {"./", table.unpack(clench.catalog().objects)})
  view:type "cyl"
  t.equal(choices(view, "world.import_object", "cyl"), {"models/objects/cylinder.iv"})
  view:click_label "models/objects/cylinder.iv"
  t.equal(view.dialogs["world.import_object"].path, "models/objects/cylinder.iv")
  view:click_label "OK"
  t.equal(session.world.objects[1].name, "cylinder")
  t.equal(choices(view, "world.import_robot", "arms"), clench.catalog().arms)
  view:close()
end)

test("without a folder of models the reason is shown once, and recent files can be chosen", function(t)
  local script = test.path ".lua"
  clench.files.save_text(script, [[
    local clench, paths = require "clench", require "clench.view.paths"
    local view = clench.view.offscreen {session = clench.session(), size = {64, 48}}
    view.recent = {"one.wld", "two.wld"}
    local files = view.session.commands["world.open"].parameters[1].files
    local function paths_of(text)
      local list = {}
      for i, choice in ipairs(paths.choices(view, files, text)) do list[i] = choice.path end
      return table.concat(list, " ")
    end
    print(paths_of "", paths_of "two")
    for _, line in ipairs(view.lines) do print(line.text) end
  ]])
  local program = test.path()
  local pipe <close> = io.popen(("cp \"$(readlink /proc/$PPID/exe)\" '%s' && env -u CLENCH_MODELS '%s' -q run '%s'"):format(program, program, script))
  local lines = {}
  for line in pipe:lines() do lines[#lines + 1] = line end
  t.equal(#lines, 2)
  t.equal(lines[1], "./ one.wld two.wld\ttwo.wld")
  t.ok(lines[2]:find("clench.catalog: no folder", 1, true), lines[2])
end)

-- a while, after which a click is not part of a double click
local function pass(view)
  for _ = 1, 30 do view:frame() end
end

-- a folder with folders, models and other files
local function make_folder()
  local folder = test.path()
  os.execute(("mkdir -p '%s/sub' '%s/.hidden' && cp models/objects/cube.iv '%s/one.iv' && cp models/hands/parallel_jaw/parallel_jaw.cfg worlds/barrett_mug.wld '%s'"):format(folder, folder, folder, folder))
  clench.files.save_text(folder .. "/note.txt", "")
  clench.files.save_text(folder .. "/.secret.iv", "")
  return folder
end

test("a path that names a folder lists its folders and the files that the command reads", function(t)
  local session, view = open()
  local folder = make_folder() .. "/"
  local up = folder:match "^(.*/)[^/]+/$"
  t.equal(choices(view, "world.import_object", folder), {up, folder .. "sub/", folder .. "one.iv"})
  t.equal(choices(view, "world.import_robot", folder), {up, folder .. "sub/", folder .. "parallel_jaw.cfg"})
  t.equal(choices(view, "world.open", folder), {up, folder .. "sub/", folder .. "barrett_mug.wld", folder .. "one.iv", folder .. "parallel_jaw.cfg"})
  t.equal(choices(view, "file.check", folder), {up, folder .. "sub/", folder .. "barrett_mug.wld", folder .. "note.txt", folder .. "one.iv", folder .. "parallel_jaw.cfg"})
  t.equal(choices(view, "world.import_object", folder .. "O"), {folder .. "one.iv"})
  t.equal(choices(view, "world.import_object", folder .. ".hid"), {folder .. ".hidden/"})
  clench.files.save_text(folder .. "scene.mjcf", "")
  t.equal(choices(view, "world.save_as", folder .. "new"), {up, folder .. "sub/", folder .. "barrett_mug.wld", folder .. "scene.mjcf"})
  local list, problem = paths.choices(view, session.commands["world.open"].parameters[1].files, "no/such/")
  t.equal(#list, 1)
  t.ok(problem:find("no such folder: no/such/", 1, true), problem)
  view:close()
end)

test("every path leads up to the root, or on through ../", function(t)
  local session, view = open()
  local files = session.commands["file.check"].parameters[1].files
  local function up(path) return paths.choices(view, files, path)[1].path end
  t.equal(up "./", "../")
  t.equal(up "../", "../../")
  t.equal(up "models/", "./")
  t.equal(up "models/objects/", "models/")
  t.equal(up "/tmp/", "/")
  t.ok(up "/" ~= "/" and up "/" ~= nil)
  view:close()
end)

test("a file is chosen by going down folders, and a double click on it is OK", function(t)
  local session, view = open()
  view:menu "File/Import Obstacle…"
  view:click_label "./  (this folder)"
  for _, label in ipairs {"models/", "obstacles/", "table.iv"} do
    pass(view)
    view:click_label(label)
  end
  pass(view)
  t.equal(view.dialogs["world.import_obstacle"].path, "models/obstacles/table.iv")
  t.ok(item(view, "^table%.iv$"), "the list stays")
  views.clicks(view, item(view, "^table%.iv$"), 2)
  view:frame()
  t.equal(view.dialogs["world.import_obstacle"], nil)
  t.equal(session.world.obstacles[1].name, "table")
  view:close()
end)

test("the list follows the field that was used last", function(t)
  local _, view = open()
  view:menu "File/Convert File…"
  view:type "models/objects/cu"
  t.ok(texts_of(view):find("\ncube.iv\n", 1, true))
  view:key "tab"
  view:type "models/hands/"
  local texts = texts_of(view)
  t.ok(texts:find("\nbarrett/\n", 1, true), texts)
  t.ok(not texts:find("\ncube.iv\n", 1, true))
  view:close()
end)

test("a file is replaced only after a question, in dialogs of commands and in those of the view", function(t)
  local session, view = open()
  local file = test.path ".wld"
  clench.files.save_text(file, "old")
  view:menu "File/Save As…"
  view:type(file:match "^(.*)%.wld$")
  view:key "enter"
  t.equal(clench.files.read_text(file), "old")
  t.ok(texts_of(view):find(file .. " exists. Replace it?", 1, true))
  local field = views.beside(view, "path")
  view:click(field.x + field.width - 10, field.y + 10)
  view:type "x"
  t.ok(not texts_of(view):find("exists. Replace it?", 1, true), "another path")
  view:key "backspace"
  view:click_label "OK"
  t.equal(clench.files.read_text(file), "old")
  views.clicks(view, item(view, "^Replace$"), 2)
  t.equal(clench.files.read_text(file), "old", "a double click on OK")
  pass(view)
  view:click_label "Replace"
  t.equal(clench.load(file):hash(), session.world:hash())
  t.equal(view.dialogs, {})

  local script = test.path ".lua"
  clench.files.save_text(script, "old")
  view:menu "File/Save Session as Script…"
  view:type(script)
  view:click_label "Save"
  t.equal(clench.files.read_text(script), "old")
  pass(view)
  view:click_label "Replace"
  t.equal(clench.files.read_text(script), session:script() .. "\n")
  t.equal(view.ask, nil)
  view:close()
end)

test("each of two files that exist is asked about, and the first picture of a film", function(t)
  local session, view = open()
  local base = test.path()
  for _, name in ipairs {"a", "b", "f0001.png"} do clench.files.save_text(base .. name, "old") end
  local ran = 0
  session:command {name = "mine.write", label = "Write…", menu = "Mine", reads = true, run = function() ran = ran + 1 end,
                   parameters = {{name = "one", type = "string", files = {writes = true}}, {name = "two", type = "string", files = {writes = true}}}}
  view:menu "Mine/Write…"
  view:type(base .. "a")
  view:key "tab"
  view:type(base .. "b")
  view:click_label "OK"
  for _, name in ipairs {"a", "b"} do
    t.ok(texts_of(view):find(base .. name .. " exists. Replace it?", 1, true), name)
    t.equal(ran, 0)
    pass(view)
    view:click_label "Replace"
  end
  t.equal(ran, 1)
  session:run("dynamics.run", {seconds = 0.1})
  view:menu "Dynamics/Save Film…"
  view:type(base .. "f.png")
  view:click_label "OK"
  t.ok(texts_of(view):find(base .. "f0001.png exists. Replace it?", 1, true))
  view:close()
end)

test("clicks on a folder that follow each other open one folder", function(t)
  local _, view = open()
  local folder = test.path()
  clench.files.make_folder(folder .. "/a/b/c")
  view:menu "File/Import Object…"
  view:type(folder .. "/")
  views.clicks(view, item(view, "^a/$"), 3)
  t.equal(view.dialogs["world.import_object"].path, folder .. "/a/")
  view:close()
end)

test("wrong `files` of a parameter are named", function(t)
  local session = clench.session()
  local function try(files, kind)
    session:command {name = "mine.bad", run = print, parameters = {{name = "path", type = kind or "string", files = files}}}
  end
  t.fails(function() try(5) end, "parameter path: files: expected a table, got 5")
  t.fails(function() try {kind = "body"} end, "parameter path: files: unknown key 'kind'")
  t.fails(function() try {kinds = "body"} end, "files: kinds: expected a list of strings, got 'body'")
  t.fails(function() try {endings = {5}} end, "files: endings: expected a list of strings")
  t.fails(function() try {ending = "wld"} end, "files: ending: expected an ending such as '.wld', got 'wld'")
  t.fails(function() try {writes = 1} end, "files: writes: expected a boolean, got 1")
  t.fails(function() try {first = 1} end, "files: first: expected a function, got 1")
  t.fails(function() try({}, "number") end, "files: expected a parameter of type string, got 'number'")
end)

test("a file that may not be looked at, as under --confine, is written after a question", function(t)
  local script = test.path ".lua"
  clench.files.save_text(script, [[
    local paths = require "clench.view.paths"
    print(paths.question({writes = true}, "/tmp/x.txt").text)
  ]])
  local pipe <close> = io.popen(("\"$(readlink /proc/$PPID/exe)\" -q run --confine models '%s' 2>&1"):format(script))
  t.equal(pipe:read "a", "/tmp/x.txt may exist. Write it?\n")
end)

test("a folder of thousands of files, and of names that are not text, can be listed", function(t)
  local session, view = open()
  local folder = test.path()
  os.execute(("mkdir -p '%s' && cd '%s' && touch $(seq -f 'n%%g.iv' 1 2000) && touch \"$(printf 'a\\377\\033.iv')\" 'b##c.iv'"):format(folder, folder))
  local files = session.commands["world.import_object"].parameters[1].files
  t.equal(#paths.choices(view, files, folder .. "/"), 301)
  view:menu "File/Import Object…"
  view:type(folder .. "/")
  local texts = texts_of(view)
  t.ok(texts:find("the first 300: type a part of the name for others", 1, true))
  t.ok(texts:find "\na[^\n]*%.iv\n", texts)
  view:click_label(item(view, "^a.*iv$").label)
  t.equal(view.dialogs["world.import_object"].path, folder .. "/a\xff\x1b.iv")
  view:frame()
  view:click_label "OK"
  t.ok(view.dialogs["world.import_object"].error, "it is empty")
  view:close()
end)
