-- Files changed at random, read like by `clench check`. The same seed makes the same files.
--   clench -q run tests/fuzz/files.lua SEED COUNT LIST      LIST: a file with the paths of the initial files, one per line
--   clench -q run tests/fuzz/files.lua read FILE...         files unchanged
-- A changed file is written next to its original, as fuzz-SEED.ENDING, so that the files that it names are found, and stays there if it crashes the
-- program. Faults without a crash (an unreadable message, a number that is not finite, a call that takes seconds) are kept as
-- found-SEED-NUMBER.ENDING in the current folder and printed as `FINDING <number> <signature>`; the exit code is then 3.
local here = arg[0]:match "^(.*/)" or ""
local judge = dofile(here .. "judge.lua")
local mutate = dofile(here .. "mutate.lua")
local report = require "clench.report"

-- a file that takes longer, even under sanitizers, is a finding [s]
local max_seconds = 20
-- a batch stops changing a file that takes this long; other batches begin with other files [s]
local long_seconds = 0.3

local function read_all(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read "a"
end

local function write_all(path, text)
  local file <close> = assert(io.open(path, "wb"))
  file:write(text)
end

-- folders to which the names in a file are relative
local function options_of(path)
  local root = path:match "^shared/data/[^/]+" or not path:find "^tests/" and "." or path:match "^(.*)/"
  return {root = root, folder = path:match "^(.*)/", package = path:match "^(.*)/"}
end

local told_of = {"inferred", "repaired", "ignored", "suspicious"}

local said, findings, parsed = {}, 0, 0
local function finding(number, what, text, path)
  local signature = judge.signature(what, text)
  if said[signature] then return end
  said[signature] = true
  findings = findings + 1
  print(("FINDING %d %s"):format(number, signature))
  if arg[1] ~= "read" then write_all(("found-%s-%d.%s"):format(arg[1], number, path:match "[^.]*$"), read_all(path)) end
end

local function try(number, path)
  local began = os.clock()
  local ok, r = pcall(report.of, path, options_of(path))
  local took = os.clock() - began
  if ok and r.parsed then parsed = parsed + 1 end
  local ending = path:match "[^.]*$"
  if took > max_seconds then finding(number, "slow", ending, path) end
  if not ok then return finding(number, "message", ending .. ": " .. tostring(r), path) end
  local bad = r.error and judge.message(r.error)
  for _, list in ipairs(told_of) do
    for _, text in ipairs(r[list]) do bad = bad or judge.text(text) end
  end
  if bad then finding(number, "message", ending .. ": " .. bad, path) end
  if r.parsed and judge.value(r.parsed, ending) then finding(number, "not finite", ending, path) end
  if arg[1] == "read" then print(path, r.error or r.kind) end
  return took
end

if arg[1] == "read" then
  for i = 2, #arg do try(i - 1, arg[i]) end
  os.exit(findings > 0 and 3 or 0, true)
end

local seed, count = tonumber(arg[1]), tonumber(arg[2])
math.randomseed(seed)
local random = math.random
local function one_of(values) return values[random(#values)] end
local by_ending, endings = {}, {}
for path in io.lines(arg[3]) do
  local ending = path:match "[^.]*$"
  if not by_ending[ending] then
    by_ending[ending] = {}
    endings[#endings + 1] = ending
  end
  table.insert(by_ending[ending], path)
end
table.sort(endings)

-- batches alternate between formats, and choose valid initial files more often than invalid ones
local number, stop = 0, os.clock() + 10
local list = by_ending[endings[seed % #endings + 1]]
local good, bad = {}, {}
for _, path in ipairs(list) do table.insert(path:find "/bad/" and bad or good, path) end
while number < count and os.clock() < stop and #good + #bad > 0 do
  local from = (#bad == 0 or random(6) > 1 and #good > 0) and good or bad
  local place = random(#from)
  local path = from[place]
  local text, other = read_all(path), read_all(one_of(list))
  local changed = ("%s/fuzz-%d.%s"):format(path:match "^(.*)/", seed, path:match "[^.]*$")
  local spent, tries = 0, 0
  while number < count and tries < 150 and spent < long_seconds do
    number, tries = number + 1, tries + 1
    write_all(changed, text == "" and "x" or mutate(text, other))
    spent = spent + (try(number, changed) or 1)
  end
  if tries < 5 then table.remove(from, place) end
  os.remove(changed)
end
print(("CALLS %d %s %d"):format(number, endings[seed % #endings + 1], parsed))
collectgarbage()
os.exit(findings > 0 and 3 or 0, true)
