-- Costs of a world's state on this build compared with the build before model and state were separated: alternating runs, the minimum of the rounds,
-- and ratios as aims.
--   lua5.4 tests/bench/state_ratios.lua BEFORE NOW [--check] [--brief]      two programs, from the project's root
local before, now = arg[1], arg[2]
local asked = {}
for i = 3, #arg do asked[arg[i]] = true end

-- required ratios of speed
local figures = {
  {"snapshot and restore", 10}, {"clone", 6}, {"kinematics", 2}, {"colliding verdict", 2}, {"legal verdict", 2},
  {"autograsp", 2}, {"load", 1.5},
}

local function exists(path)
  local file = io.open(path)
  return file and file:close()
end

-- models of the original if present, else the shipped ones
local shared = (os.getenv "CLENCH_SHARED" or "../shared") .. "/data/"
local files = {shared .. "graspit/worlds/dlr_flask.wld", shared .. "graspit-xml/models/robots/HumanHand/HumanHand20DOF.xml",
               shared .. "graspit-xml/models/objects/flask.xml"}
if not (exists(files[1]) and exists(files[2])) then
  print "../shared is absent: on our own models"
  files = {"worlds/dlr_flask.wld", "models/hands/human/human20.cfg", "models/objects/flask.iv"}
end

local function quoted(text) return "'" .. text:gsub("'", "'\\''") .. "'" end

-- keeps the minimum of each figure, and separately that of the other work: differences of values from different runs may be below the true cost
local function measure(program, least)
  local command = ("%s -q run tests/bench/state.lua"):format(quoted(program))
  for _, file in ipairs(files) do command = command .. " " .. quoted(file) end
  local pipe <close> = assert(io.popen(command))
  for line in pipe:lines() do
    local name, seconds, besides = line:match "^(.-)\t(.-)\t(.*)$"
    seconds, besides = tonumber(seconds), tonumber(besides)
    if seconds and besides then
      local known = least[name] or {math.huge, math.huge}
      least[name] = {math.min(known[1], seconds), math.min(known[2], besides)}
    end
  end
end

local old, new = {}, {}
for _ = 1, asked["--brief"] and 1 or 5 do
  measure(before, old)
  measure(now, new)
end

print(("%-22s %12s %12s %8s %8s"):format("", "before [us]", "now [us]", "times", "asked"))
local missed = 0
for _, figure in ipairs(figures) do
  local name, expected = table.unpack(figure)
  local a, b = old[name] and old[name][1] - old[name][2], new[name] and new[name][1] - new[name][2]
  local ratio = a and b and b > 0 and a / b
  if not (ratio and ratio >= expected) then missed = missed + 1 end
  print(("%-22s %12s %12s %8s %8g"):format(name, a and ("%.2f"):format(a * 1e6) or "none", b and ("%.2f"):format(b * 1e6) or "none",
    ratio and ("%.2f"):format(ratio) or "none", expected))
  if not ratio then asked["--check"] = true end  -- a figure without measurement fails
end
if asked["--check"] and missed > 0 then
  print(missed .. " of " .. #figures .. " are missed")
  os.exit(1)
end
