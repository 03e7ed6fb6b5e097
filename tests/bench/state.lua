-- Costs of a world's state, as seen by a script: snapshot, restore, clone, kinematics, collision queries, closing and loading. Prints one
-- tab-separated line each: name, seconds, seconds of the other work in the measured block.
--   clench -q run tests/bench/state.lua WORLD HAND OBJECT    files, from the project's root: the DLR hand and flask, the human hand of 20 DOFs, and its object
-- It runs on this build and on the build that it is compared with, so it uses only entries that both have.
local clench = require "clench"
local world_file, hand_file, object_file = table.unpack(arg)

-- the minimum of five rounds of some 50 ms each, or of CLENCH_BENCH_ROUND seconds
local round = tonumber(os.getenv "CLENCH_BENCH_ROUND" or 0.05)
local function seconds_of(action)
  local count, best = 1, math.huge
  repeat
    local began = os.clock()
    for _ = 1, count do action() end
    local took = os.clock() - began
    if took < round then count = count * 2 end
  until took >= round
  for _ = 1, 5 do
    local began = os.clock()
    for _ = 1, count do action() end
    best = math.min(best, (os.clock() - began) / count)
  end
  return best
end

local function told(name, seconds, besides) print(("%s\t%.9g\t%.9g"):format(name, seconds, besides or 0)) end

-- --- DLR hand and flask ---

local function load_world() return clench.load(world_file, {root = world_file:match "^(.*)/worlds/" or "."}) end
local world = load_world()
local hand = world.robots[1]
told("snapshot and restore", seconds_of(function() world:restore(world:snapshot()) end))
told("clone", seconds_of(function() world:clone() end))
local open = world:snapshot()
hand:autograsp()  -- warm
local function close()
  world:restore(open)
  hand:autograsp()
end
local restoring = seconds_of(function() world:restore(open) end)
told("autograsp", seconds_of(close), restoring)
told("load", seconds_of(load_world))

-- --- human hand of 20 DOFs and flask ---

local place = clench.world()
local object = place:add_object(object_file)
local human = place:add_robot(hand_file, {root = hand_file:match "^(.*)/models/" or "."})
assert(#human.dofs == 20, "expected a hand of 20 DOFs")
local random = clench.random(7)
local states = {}
for i = 1, 400 do
  local dofs = {}
  for d, limit in ipairs(human.dof_limits) do dofs[d] = random:uniform(limit[1], limit[2]) end
  local center = object.pose.position
  states[i] = {dofs = dofs, pose = clench.pose {
    xyz = center + random:direction() * random:uniform(0.02, 0.3),
    rpy = {random:uniform(-3, 3), random:uniform(-1.5, 1.5), random:uniform(-3, 3)}}}
end

-- unknown names are errors
local function colliding() return #place:colliding() > 0 end
local ends_early = pcall(function() return place.collides end)
local collides = ends_early and function() return place:collides() end or colliding
local function place_hand(state)
  human.pose = state.pose
  human:set_dofs(state.dofs)
end
local hits, misses = {}, {}
for _, state in ipairs(states) do
  place_hand(state)
  table.insert(collides() and hits or misses, state)
end
assert(#hits >= 50 and #misses >= 50, "expected states of both kinds")

local function each(list, action) return seconds_of(function() for _, state in ipairs(list) do action(state) end end) / #list end
told("kinematics", each(states, place_hand))
local function verdict(name, list)
  local placing = each(list, place_hand)
  told(name, each(list, function(state)
    place_hand(state)
    collides()
  end), placing)
end
verdict("colliding verdict", hits)
verdict("legal verdict", misses)
