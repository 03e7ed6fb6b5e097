-- Which grasps survive when they are shaken? Grasps are planned, pushed along six directions in simulation, the best is lifted, and the lift is recorded.
--   clench run examples/15_shake.lua [FILM.html]
local clench = require "clench"
local film_file = arg and arg[1] or "build/lift.gif"

local world = clench.load("worlds/barrett_mug.wld", {root = "."})
local hand, mug = world.robots[1], world.objects[1]
mug.mass = 0.1
local run = clench.plan.sample {hand = hand, object = mug, count = 4, candidates = 100, refine = 0, verify = false}

-- which measure predicts survival?
local study = clench.study.predictors(run.grasps, {hand = hand, object = mug, measures = {"epsilon", "load_margin"},
                                                   shake = {force = 2, grip_force = 5, seconds = 0.5, settle = 0.5}})
print(study)

local best
for i, outcome in ipairs(study.grasps) do
  print(("grasp %d: epsilon %.3f, held along %d of 6 directions"):format(i, run.grasps[i].epsilon, outcome.held))
  if outcome.survived and not best then best = run.grasps[i] end
end
best = best or run.grasps[1]

best:apply(world)
local load = clench.study.fall_off {hand = hand, object = mug, rate = 10, max_force = 10, settle = 0.5}
print(("the best is lost at %.1f N in its worst direction"):format(load.min_force))
print(clench.study.lift {hand = hand, object = mug})

-- the same lift by hand, as a film: the motors close, and the base moves up
world.gravity = {0, 0, 0}
hand:autograsp {dynamic = true}
world:run(0.3)
local film = world:record {rate = 20}
hand.velocity = {linear = {0, 0, 0.1}}
world:run(0.5)
local ok, why = pcall(film.save, film, film_file, film_file:match "html$" and {title = "A mug is lifted"} or {size = {240, 180}})
print(ok and ("%s: %d frames"):format(film_file, #film.times) or tostring(why))
