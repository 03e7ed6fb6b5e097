--- Tests as claims: `test("a ring of contacts balances", function(t) t.close(sum, 0, 1e-12) end)`. Each test runs immediately; `clench test` counts them per
--- file.
local described = require "clench.described"
local error_text = require "clench.error_text"
local printable = require "clench.printable"
local raise = require "clench.raise"
local show = require "clench.show"
local test = {passed = 0, failed = 0, skipped = 0}

local skip = {}  -- marks a test that stops because it cannot run here
local failure = {__tostring = function(self) return self.message end}

local function fail(format, ...) error(setmetatable({message = format:format(...)}, failure), 0) end

-- a text in quotes; other values as in the console
local function shown(x) return type(x) == "string" and "'" .. x .. "'" or show(x) end

local function equal(a, b)
  if a == b then return true end
  if type(a) ~= "table" or type(b) ~= "table" then return false end
  for key, value in pairs(a) do
    if not equal(value, b[key]) then return false end
  end
  for key in pairs(b) do
    if a[key] == nil then return false end
  end
  return true
end

-- of a list or a vector; nil for other values
local function length(x)
  if type(x) == "table" then return #x end
  if type(x) ~= "userdata" then return nil end
  local ok, count = pcall(function() return #x end)
  return ok and count or nil
end

-- the maximum difference of two numbers, or of two lists or vectors of them
local function difference(a, b)
  if type(a) == "number" and type(b) == "number" then
    if a == b then return 0 end
    return math.abs(a - b)
  end
  local count = length(a)
  if not count or count ~= length(b) then fail("expected numbers or lists of one length, got %s and %s", shown(a), shown(b)) end
  local worst = 0
  for i = 1, count do
    local d = difference(a[i], b[i])
    if d ~= d or d > worst then worst = d end
    if d ~= d then return d end
  end
  return worst
end

--- The argument of a test.
local t = {}

--- The value must be true, or at least not nil or false.
---@param ok any
---@param message? string
function t.ok(ok, message)
  if not ok then fail("%s", message or "expected true, got " .. show(ok)) end
end

--- The values must be equal; tables must have equal contents.
function t.equal(got, want)
  if not equal(got, want) then fail("expected %s, got %s", shown(want), shown(got)) end
end

--- Numbers, vectors or lists of numbers must agree within the tolerance.
function t.close(got, want, tolerance)
  if math.type(tolerance) == nil or not (tolerance >= 0 and tolerance < math.huge) then
    fail("close: expected a tolerance of at least 0, got %s", shown(tolerance))
  end
  local off = difference(got, want)
  if not (off <= tolerance) then
    fail("expected %s within %.3g, got %s, off by %.3g", show(want), tolerance, show(got), off)
  end
end

--- fn must raise an error whose message contains each of the texts; returns the message.
function t.fails(fn, ...)
  if type(fn) ~= "function" then fail("fails: expected a function, got %s", shown(fn)) end
  for i = 1, select("#", ...) do
    local text = select(i, ...)
    if type(text) ~= "string" then fail("fails: expected texts after the function, got %s", shown(text)) end
  end
  local ok, message = pcall(fn)
  if ok then fail("expected an error, got none") end
  message = tostring(message)
  for _, text in ipairs {...} do
    if not message:find(text, 1, true) then fail("expected an error with '%s', got '%s'", text, message) end
  end
  return message
end

--- Runs fn; returns the warnings that it logs, as a list of texts.
function t.warnings(fn)
  local said = {}
  clench.log.sink(function(level, text) if level == "warning" then said[#said + 1] = text end end)
  local ok, message = pcall(fn)
  clench.log.sink()
  if not ok then error(message, 0) end
  return said
end

--- Ends the test as skipped.
function t.skip(reason) error({mark = skip, reason = reason or "no reason given"}, 0) end

-- raised by Ctrl-C: no further test runs
local interrupted = setmetatable({}, {__tostring = function() return "interrupted" end})

local function explain(message)
  if message == interrupted or type(message) == "table" and rawget(message, "kind") == "stopped" then return interrupted end
  if type(message) == "table" and rawequal(rawget(message, "mark"), skip) then return message end
  if getmetatable(message) == failure then
    -- finds the line of the failed test
    for level = 3, 12 do
      local info = debug.getinfo(level, "Sl")
      if info and info.currentline > 0 and not info.source:find "^@stdlib/test%.lua" then
        return ("%s:%d: %s"):format(info.short_src, info.currentline, message.message)
      end
    end
    return message.message
  end
  return debug.traceback(error_text(message), 2)
end

-- t:ok(x) would pass t as the value
for name, claim in pairs(t) do
  t[name] = function(first, ...)
    if rawequal(first, t) then fail("expected t.%s(...), got t:%s(...)", name, name) end
    return claim(first, ...)
  end
end

-- folder of temporary files, which is removed when the Lua state closes, and number of paths
local folder, paths = nil, 0
local tmpname = os.tmpname

local function make_folder(path) assert(os.execute("mkdir " .. path), "the folder " .. path .. " could not be made") end

--- A new temporary path with this ending; with a text, the file is created with this content. It is removed at the end of `clench test`.
---@param ending? string  such as ".urdf"
---@param text? string  content of the file; without it no file is written
---@return string
---@effect files
function test.path(ending, text)
  if not folder then
    local name = tmpname()
    os.remove(name)
    make_folder(name)
    folder = setmetatable({name = name}, {__gc = function() os.execute("rm -rf " .. name) end})
  end
  paths = paths + 1
  local path = ("%s/%d%s"):format(folder.name, paths, ending or "")
  if text then clench.files.save_text(path, text) end
  return path
end

--- A new empty folder, which is removed with its content at the end of `clench test`.
---@return string
---@effect files
function test.folder()
  local path = test.path()
  make_folder(path)
  return path
end

---@param claim string  the claim that is tested
---@param fn fun(t: table)
local function run(_, claim, fn)
  if type(claim) ~= "string" or type(fn) ~= "function" then error("test: expected a claim and a function", 2) end
  local ok, message = xpcall(fn, explain, t)
  if ok then
    test.passed = test.passed + 1
  elseif type(message) == "table" and message ~= interrupted then
    test.skipped = test.skipped + 1
    print(("  skipped  %s: %s"):format(claim, message.reason))
  else
    test.failed = test.failed + 1
    print(("  FAILED   %s\n           %s"):format(claim, (printable(tostring(message), "\n\t"):gsub("\n", "\n           "))))
    if message == interrupted then error(interrupted, 0) end
  end
end

--- Runs a file of tests, for `clench test`; returns the numbers of passed, failed and skipped tests.
---@effect files
function test.run_file(path)
  if type(path) ~= "string" then raise("test.run_file: path: expected a name, got " .. described(path)) end
  package.loaded.test = test
  -- a file that ends the program would hide the tests of the files after it
  local exit <close> = setmetatable({exit = os.exit}, {__close = function(saved) os.exit = saved.exit end})
  os.exit = function() error("os.exit: a file of tests cannot end the run", 2) end
  local chunk, message = loadfile(path, "t")
  local ok = chunk ~= nil
  if chunk then ok, message = xpcall(chunk, explain) end
  if ok and test.passed + test.failed + test.skipped == 0 then ok, message = false, "expected a test in it, got none" end
  if not ok and message ~= interrupted then
    test.failed = test.failed + 1
    print(("  FAILED   %s: the file itself\n           %s"):format(path, (printable(tostring(message), "\n\t"):gsub("\n", "\n           "))))
  end
  return test.passed, test.failed, test.skipped
end

return setmetatable(test, {__call = run})
