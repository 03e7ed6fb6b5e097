-- A hand that squeezes a ball until it slips out.
local test, clench = require "test", require "clench"

test("a ball that slips out of closing fingers gets no more energy than motors provide, and no step fails", function(t)
  local world = clench.load "worlds/three_finger_sphere.wld"
  local hand, ball = world.robots[1], world.objects[1]
  ball.mass = 0.1
  world.gravity = {0, 0, 0}
  hand:autograsp()
  hand:autograsp {dynamic = true}
  world:run(2.75)
  world.gravity = {0, 0, -9.81}
  local work, before = 0, world:energy()
  for _ = 1, 500 do
    world:run(0.001)
    local velocities, efforts = hand.dof_velocities, hand.dof_efforts
    for i = 1, #velocities do work = work + efforts[i] * velocities[i] * 0.001 end
  end
  local after = world:energy()
  local gained = after.kinetic + after.potential - before.kinetic - before.potential
  t.equal(world.report.failures, 0)
  t.ok(gained > 0.1, gained)
  t.ok(gained < work, gained - work)
end)

test("fingers that close on each other without a ball solve every step", function(t)
  local world = clench.load "worlds/three_finger_sphere.wld"
  local hand, ball = world.robots[1], world.objects[1]
  ball.mass = 0.1
  hand:autograsp()
  hand:autograsp {dynamic = true}
  world:run(1.8)
  t.equal(world.report.failures, 0)
end)
