-- Files that clench.csv opens.
local clench = require "clench"
local test = require "test"

-- runs with the path of a file made by `command`
local function with(command, run)
  local path = test.path()
  assert(os.execute(command:format(path)))
  run(path)
end

test("pipes and devices are never opened", function(t)
  with("mkfifo %s", function(path)
    t.fails(function() clench.csv.read(path) end, "csv.read: expected a file, got a special file: " .. path)
    t.fails(function() clench.files.read_text(path) end, "expected a file, got a special file: " .. path)
  end)
  for _, path in ipairs {"/dev/zero", "/dev/null"} do
    t.fails(function() clench.csv.read(path) end, "csv.read: expected a file, got a special file: " .. path)
  end
  with("ln -s /dev/zero %s", function(path)
    t.fails(function() clench.csv.read(path) end, "csv.read: expected a file, got a special file: " .. path)
  end)
  t.fails(function() clench.csv.read "tests" end, "csv.read: expected a file, got a folder: tests")
end)

test("a file is read completely, byte by byte", function(t)
  local path, text = test.path(), "a\0b\r\n\xFF"
  clench.files.save_text(path, text)
  t.equal(clench.files.read_text(path), text)
  os.remove(path)
  t.fails(function() clench.files.read_text(path) end, "no such file: " .. path)
end)

test("a file outside of the folder of confined reading is not read", function(t)
  clench.csv.write("build/csv_test.csv", {{a = 1}})
  t.equal(clench.csv.read("build/csv_test.csv", {confine = "build"})[1].a, 1)
  t.fails(function() clench.csv.read("build/csv_test.csv", {confine = "models"}) end, "csv.read: 'build/csv_test.csv' lies outside of models")
  t.fails(function() clench.csv.read("build/csv_test.csv", {confine = 3}) end, "confine")
end)
