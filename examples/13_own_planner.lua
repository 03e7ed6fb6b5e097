-- A custom planner: a mug on a table, grasped from above or from the side, never from below.
--   clench run examples/13_own_planner.lua [SEED]
local clench = require "clench"
local seed = math.tointeger(arg and arg[1] or 1)

local world = clench.load("worlds/barrett_mug.wld", {root = "."})
local hand, mug = world.robots[1], world.objects[1]

-- the energy of a state: fingers near the mug and facing it, the hand above the table, approaching from above or horizontally
local make = clench.energy
local energy = make.contact {hand = hand, object = mug}
             + 50 * make.approach_cone {hand = hand, axis = {0, 0, -1}, angle = clench.rad(100)}

-- chains of annealing, each from another start; later chains avoid the states that earlier ones have found
local chains, steps = 4, 5000
local starts = {}
for chain = 1, chains do
  local search = clench.annealing {hand = hand, object = mug, world = world:clone(), energy = energy, seed = seed + chain,
                                   best = {size = 5, distance = 0.3}}
  for _, state in ipairs(starts) do search:avoid(state) end
  local began = clench.clock()
  search:run(steps)
  print(("chain %d: energy %.1f, %.0f steps a second"):format(chain, search.best[1].energy, steps / (clench.clock() - began)))
  for _, state in ipairs(search.best) do starts[#starts + 1] = state end
end

-- tries each state: approach until contact, close, and, if the grasp fails, try again from slightly farther back
local found = clench.grasps()
for _, state in ipairs(starts) do
  for back = 0, 0.03, 0.01 do
    hand:set_posture(mug.pose * state.pose, state.dofs)
    hand:approach_object {reach = 0.1}
    hand.pose = clench.pose {xyz = hand.approach.direction * -back} * hand.pose
    if world:collides(hand) then break end
    hand:autograsp()
    local grasp = clench.grasp(hand, mug)
    if #grasp.points > 0 and grasp.epsilon > 0 then
      grasp.info, grasp.labels = {energy = state.energy, seed = seed}, {planner = "my own"}
      found:add(grasp)
      break
    end
  end
end
print(("%d grasps in force closure of %d states"):format(#found, #starts))
local path = os.tmpname() .. ".jsonl"
found:save(path)
print("written to " .. path)
