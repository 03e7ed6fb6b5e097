-- Files and calls of tests/data/found, which once crashed a reader or a call under the fuzzers, are handled.
local test = require "test"
local judge = dofile "tests/fuzz/judge.lua"
local report = require "clench.report"

local function list(folder)
  local names = {}
  local pipe <close> = io.popen("ls tests/data/found/" .. folder .. " 2>/dev/null")
  for name in pipe:lines() do names[#names + 1] = ("tests/data/found/%s/%s"):format(folder, name) end
  return names
end

for _, path in ipairs(list "files") do
  test(path .. " is understood, or refused by a sentence", function(t)
    local r = report.of(path, {root = "."})
    t.ok(r.error or r.parsed)
    t.equal(r.error and judge.message(r.error), nil)
    t.equal(r.parsed and judge.value(r.parsed, "found"), nil)
  end)
end

for _, path in ipairs(list "calls") do
  test(path .. " finds nothing", function(t)
    local before = clench.log.level "quiet"
    local call = dofile "tests/fuzz/call.lua"
    loadfile(path, "t", {call = call.run})()
    clench.log.level(before)
    t.ok(call.number > 0)
    t.equal(call.findings, 0)
  end)
end
