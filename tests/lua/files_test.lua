-- Folders and paths: clench.files.list, exists and make_folder; readers and writers of single formats are tested with their formats.
local test, clench = require "test", require "clench"

test("a folder is listed, and names of models and worlds are found as those of files are", function(t)
  local here = clench.files.list ""
  t.ok(table.concat(here.folders, " "):find("models", 1, true))
  t.ok(table.concat(here.files, " "):find("README.md", 1, true))
  t.equal(clench.files.list ".", here)
  local folder = test.path()
  os.execute(("mkdir '%s' && ln -s /tmp '%s/link'"):format(folder, folder))
  t.equal(clench.files.list(folder), {folders = {"link"}, files = {}})
  t.fails(function() clench.files.list(folder .. "/link", {confine = folder}) end, "'" .. folder .. "/link' lies outside of " .. folder .. ", to which reading is confined")
  t.fails(function() clench.files.list("..", {confine = "."}) end, "'..' lies outside of ., to which reading is confined")
  t.equal(clench.files.list("models", {confine = "."}), clench.files.list "models")

  local script = test.path ".lua"
  clench.files.save_text(script, 'print(#clench.files.list("models/hands").folders, pcall(clench.files.list, "models/none"))')
  local pipe <close> = io.popen(("home=$(pwd -P); cd /tmp && CLENCH_MODELS=$home \"$(readlink /proc/$PPID/exe)\" -q run '%s' 2>&1"):format(script))
  local said = pipe:read "a"
  t.ok(said:find("^" .. #clench.files.list("models/hands").folders .. "\tfalse\t"), said)
  t.ok(said:find("no such folder", 1, true), said)
end)

test("folders are created with those above them, and paths are found", function(t)
  local folder = test.path()
  t.equal(clench.files.exists(folder), false)
  for _ = 1, 2 do clench.files.make_folder(folder .. "/a/b") end
  t.equal(clench.files.list(folder), {folders = {"a"}, files = {}})
  clench.files.save_text(folder .. "/a/c", "")
  os.execute(("ln -s none '%s/a/dangling'"):format(folder))
  t.equal({clench.files.exists(folder .. "/a/c"), clench.files.exists(folder .. "/a/b"), clench.files.exists(folder .. "/a/dangling")}, {true, true, false})
  t.fails(function() clench.files.make_folder(folder .. "/a/c") end, "/a/c: the folder cannot be created: Not a directory")
end)

test("a path that is not a folder is rejected by name", function(t)
  t.fails(function() clench.files.list "README.md" end, "README.md: expected a folder, got a file")
  t.fails(function() clench.files.list "no/such" end, "no such folder: no/such")
  t.fails(function() clench.files.list "models\0x" end, "expected a string without zero bytes")
  t.fails(function() clench.files.list(3) end, "expected a")
  t.fails(function() clench.files.list("models", {root = "."}) end, "unknown key 'root'")
end)
