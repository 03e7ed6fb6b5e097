-- A user-defined planner compared with the built-in annealer, alternating in one run: examples/13_own_planner.lua, whose energy is composed of terms
-- of the engine, and clench.plan.anneal with the same energy, budget and list of best grasps.
--   clench run tests/bench/own_planner.lua [--check] [--csv FILE]
-- Aim: at least 0.8 of the built-in annealer's steps per second.
local clench = require "clench"
local aim, rounds, steps = 0.8, 5, 5000

local check, csv = false, nil
do
  local i = 1
  while arg[i] do
    if arg[i] == "--check" then check = true
    elseif arg[i] == "--csv" then i = i + 1; csv = arg[i]
    else error("usage: own_planner.lua [--check] [--csv FILE], got " .. arg[i]) end
    i = i + 1
  end
end

-- steps per second of each chain, as printed by the example
local function own_rates(seed)
  local rates, path = {}, nil
  local function heard(line)
    local rate = line:match "(%d+) steps a second"
    if rate then rates[#rates + 1] = tonumber(rate) end
    path = line:match "^written to (.*)$" or path
  end
  local env = setmetatable({print = heard, arg = {tostring(seed)}}, {__index = _G})
  assert(loadfile("examples/13_own_planner.lua", "t", env))()
  os.remove(path)
  assert(#rates == 4, "the example has 4 chains")
  return rates
end

local function built_in_rates(seed)
  local rates = {}
  for chain = 1, 4 do
    local world = clench.load("worlds/barrett_mug.wld", {root = "."})
    local hand, mug = world.robots[1], world.objects[1]
    local make = clench.energy
    local energy = make.contact {hand = hand, object = mug} + 50 * make.approach_cone {hand = hand, axis = {0, 0, -1}, angle = clench.rad(100)}
    local run = clench.plan.anneal {hand = hand, object = mug, energy = energy, steps = steps, seed = seed + chain, best = {size = 5, distance = 0.3}}
    rates[chain] = run.report.steps_per_second
  end
  return rates
end

local own, built_in = {}, {}
for round = 1, rounds do
  for _, rate in ipairs(own_rates(10 * round)) do own[#own + 1] = rate end
  for _, rate in ipairs(built_in_rates(10 * round)) do built_in[#built_in + 1] = rate end
end
local ours, theirs = clench.stats.quantile(own, 0.5), clench.stats.quantile(built_in, 0.5)
local ratio = ours / theirs
print(("own planner %.0f steps a second, plan.anneal %.0f (medians of %d chains): %.2f of it (asked %.1f)"):format(ours, theirs, #own, ratio, aim))
if csv then
  clench.csv.write(csv, {{planner = "own", steps_per_second = ours}, {planner = "anneal", steps_per_second = theirs}},
                   {columns = {"planner", "steps_per_second"}})
end
if check and ratio < aim then
  print(("FAILED: the own planner makes less than %.1f of the built-in one's steps"):format(aim))
  os.exit(1)
end
