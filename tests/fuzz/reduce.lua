-- Removes calls from a list that are not needed to cause the same failure.
-- FUZZ_CLENCH=PROGRAM lua5.4 tests/fuzz/reduce.lua REPEAT CALLS SIGNATURE OUT [LAST]
local repeat_script, from, signature, out, last = table.unpack(arg)
local crash = dofile((arg[0]:match "^(.*/)" or "") .. "crash.lua")

local lines = {}
for line in io.lines(from) do
  lines[#lines + 1] = line
  if #lines == tonumber(last) then break end
end

local function write(list)
  local file <close> = assert(io.open(out, "w"))
  file:write(table.concat(list, "\n"), "\n")
end

-- remaining runs; each takes at least the time of a start
local runs = 60
local function breaks(list)
  if runs == 0 then return false end
  runs = runs - 1
  write(list)
  local pipe = assert(io.popen(("timeout 600 %s -q run %s %s 2>&1; echo EXIT $?"):format(os.getenv "FUZZ_CLENCH", repeat_script, out)))
  local said = pipe:read "a"
  pipe:close()
  local code = tonumber(said:match "EXIT (%d+)\n$")
  if code == 3 then return said:find(signature, 1, true) ~= nil end
  return code ~= 0 and crash(said, code) == signature
end

-- the last call and the calls whose values it uses
local function needed(list)
  local expected, kept = {}, {}
  for i = #list, 1, -1 do
    local target = list[i]:match '^call%("v%[(%d+)%] ='
    local changed = not target and list[i]:match '^call%("v%[(%d+)%]'
    if i == #list or target and expected[target] or changed and expected[changed] then
      for n in list[i]:gmatch "v%[(%d+)%]" do expected[n] = true end
      table.insert(kept, 1, list[i])
    end
  end
  return kept
end

local best = lines
local slice = needed(lines)
if #slice < #lines and breaks(slice) then best = slice end
local size = (#best + 1) // 2
while size >= 1 and runs > 0 do
  local at = 1
  while at < #best do  -- the last call is kept
    local fewer = {}
    for i, line in ipairs(best) do
      if i < at or i >= at + size or i == #best then fewer[#fewer + 1] = line end
    end
    if #fewer < #best and breaks(fewer) then best = fewer else at = at + size end
  end
  size = size // 2
end
write(best)
