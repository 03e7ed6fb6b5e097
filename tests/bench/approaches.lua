-- Counts random approaches of a hand that end in force closure: clench run tests/bench/approaches.lua HAND TRIALS [OBJECT | DOF=VALUE | search]...
--
-- An object in a random orientation has its center of mass on the hand's line of approach; the opened hand moves along that line until it touches,
-- and closes. Objects are of wood unless their files name a material; without any, they are a cube, a ball and a can, 6 cm wide. Given DOFs have
-- their value from the start. With `search`, the same trials are repeated along lines that are displaced from the hand's own line or inclined to it.
-- The output ranks the lines by successes, and counts the objects that at least one line grasps in their orientation. The best lines and the hand's
-- own are then tested on four times as many new trials, because the best of many lines also had favorable trials.
local clench = require "clench"
local path, trials = arg[1], tonumber(arg[2] or 90)
clench.log.level "error"
local world = clench.world {}
local hand = world:add_robot(path)
local things, posture, search = {}, {}, false
for i = 3, #arg do
  local dof, value = arg[i]:match "^([^=]+)=(.+)$"
  if dof then posture[dof] = tonumber(value)
  elseif arg[i] == "search" then search = true
  else things[#things + 1] = arg[i] end
end
if #things == 0 then
  things = {clench.shapes.box {0.057, 0.057, 0.057}, clench.shapes.sphere {radius = 0.03}, clench.shapes.cylinder {radius = 0.03, height = 0.12}}
end
local objects = {}
for i, thing in ipairs(things) do
  local name = type(thing) == "string" and thing:match "([^/]*)%.%w+$" or ({"cube", "ball", "can"})[i]
  objects[i] = world:add_object(thing, {name = name, pose = {xyz = {6 * i, 0, 0}}})
end
hand:open()
if next(posture) then hand:set_dofs(posture) end
local start = world:snapshot()
local own = hand.pose:inverse() * hand.approach.frame

-- success of each trial along the z axis of a frame in the base, and the number of successes
local function try(frame, seed, trials)
  local random, held, total = clench.random(seed), {}, 0
  for trial = 1, trials do
    world:restore(start)
    local object = objects[trial % #objects + 1]
    object.pose = random:rotation() * clench.pose {xyz = -1 * object.com}
    hand.pose = clench.pose {xyz = {0, 0, -0.5}} * frame:inverse()
    held[trial] = false
    if hand:move_to(clench.pose {xyz = {0, 0, 1}} * hand.pose).touched then
      hand:autograsp()
      held[trial] = clench.grasp(hand, object):is_force_closure()
      if held[trial] then total = total + 1 end
    end
  end
  return held, total
end

local held, total = try(own, 11, trials)
for i, object in ipairs(objects) do
  local succeeded, tried = 0, 0
  for trial = 1, trials do
    if trial % #objects + 1 == i then
      tried = tried + 1
      if held[trial] then succeeded = succeeded + 1 end
    end
  end
  print(("%s %d of %d"):format(object.name, succeeded, tried))
end
print(("%s: %d of %d approaches end in force closure"):format(hand.name, total, trials))
if not search then return end

local lines = {}
for x = -30, 30, 15 do
  for y = -30, 30, 15 do
    lines[#lines + 1] = {frame = clench.pose {xyz = {x / 1000, y / 1000, 0}}, name = ("%g, %g mm beside it"):format(x, y)}
  end
end
for _, lean in ipairs {15, 30} do
  for about = 0, 315, 45 do
    local a = clench.rad(about)
    lines[#lines + 1] = {frame = clench.pose {axis = {math.cos(a), math.sin(a), 0}, angle = clench.rad(lean)},
                         name = ("leaning %d degrees about an axis at %d degrees"):format(lean, about)}
  end
end
local graspable, ranking = {}, {}
for i, line in ipairs(lines) do
  local also, count = try(own * line.frame, 11, trials)
  for trial = 1, trials do graspable[trial] = graspable[trial] or also[trial] end
  ranking[i] = {count = count, name = line.name, frame = line.frame}
end
table.sort(ranking, function(a, b) return a.count > b.count or a.count == b.count and a.name < b.name end)
for i = 1, 5 do print(("  %d succeed %s"):format(ranking[i].count, ranking[i].name)) end
local others = 4 * trials
print(("  of %d other trials %d succeed along the hand's own line"):format(others, (select(2, try(own, 12, others)))))
for i = 1, 5 do print(("  and %d %s"):format(select(2, try(own * ranking[i].frame, 12, others)), ranking[i].name)) end
local possible = 0
for trial = 1, trials do if graspable[trial] then possible = possible + 1 end end
print(("  %d of %d objects are grasped along one of these %d lines as they stand: %.0f %% of these along the hand's own"):format(
  possible, trials, #lines, 100 * total / math.max(1, possible)))
