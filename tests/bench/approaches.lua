-- How many random approaches of a hand end in force closure: clench run tests/bench/approaches.lua HAND TRIALS [OBJECT | DOF=VALUE]...
--
-- An object in a random orientation stands with its centre of mass on the hand's line of approach; the opened hand comes along that line
-- until it touches, and closes. Objects are of wood unless their files say otherwise; without any, they are a cube, a ball and a can, 6 cm wide. DOFs
-- with a value stand there from the first on.
local clench = require "clench"
local path, trials = arg[1], tonumber(arg[2] or 90)
clench.log.level "error"
local world = clench.world {}
local hand = world:add_robot(path)
local things, posture = {}, {}
for i = 3, #arg do
  local dof, value = arg[i]:match "^([^=]+)=(.+)$"
  if dof then posture[dof] = tonumber(value) else things[#things + 1] = arg[i] end
end
if #things == 0 then
  things = {clench.shapes.box {0.057, 0.057, 0.057}, clench.shapes.sphere {radius = 0.03}, clench.shapes.cylinder {radius = 0.03, height = 0.12}}
end
local objects, counts = {}, {}
for i, thing in ipairs(things) do
  local name = type(thing) == "string" and thing:match "([^/]*)%.%w+$" or ({"cube", "ball", "can"})[i]
  objects[i], counts[i] = world:add_object(thing, {name = name, pose = {xyz = {6 * i, 0, 0}}}), {held = 0, tried = 0}
end
hand:open()
if next(posture) then hand:set_dofs(posture) end
local start, random = world:snapshot(), clench.random(11)
local approach = hand.pose:inverse() * hand.approach.frame
local total = 0
for trial = 1, trials do
  world:restore(start)
  local i = trial % #objects + 1
  local object = objects[i]
  object.pose = random:rotation() * clench.pose {xyz = -1 * object.com}
  hand.pose = clench.pose {xyz = {0, 0, -0.5}} * approach:inverse()
  counts[i].tried = counts[i].tried + 1
  if hand:move_to(clench.pose {xyz = {0, 0, 1}} * hand.pose).touched then
    hand:autograsp()
    if clench.grasp(hand, object):is_force_closure() then counts[i].held, total = counts[i].held + 1, total + 1 end
  end
end
for i, object in ipairs(objects) do print(("%s %d of %d"):format(object.name, counts[i].held, counts[i].tried)) end
print(("%s: %d of %d approaches end in force closure"):format(hand.name, total, trials))
