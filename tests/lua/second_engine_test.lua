-- ODE as a second engine: hands that close free of contacts move as ours do.
local test, clench = require "test", require "clench"

local function closed(path, engine, seconds)
  local world = clench.world {dynamics = {engine = engine}}
  world.gravity = {0, 0, 0}
  local hand = world:add_robot(path)
  world:set_collision(false)
  hand:autograsp {dynamic = true}
  world:run(seconds)
  return hand.dofs, world.report
end

test("hands whose joints begin at their stops close as ours do, every step solved", function(t)
  for _, path in ipairs {"human/human20.cfg", "human/human16.cfg", "shadow/shadow.cfg", "barrett/barrett.cfg"} do
    local ours = closed("models/hands/" .. path, "clench", 0.2)
    local ode, report = closed("models/hands/" .. path, "ode", 0.2)
    t.equal(report.failures, 0)
    t.equal(report.fallbacks, 0)
    for i, value in ipairs(ours) do t.close(ode[i], value, 1e-8) end
  end
end)

test("a run names what ODE does not simulate, once", function(t)
  local path = test.path(".xml", [[<mujoco model="m"><worldbody><body name="base"><geom size="0.1"/>
    <body name="a" pos="0 0 1"><joint name="a" type="slide" range="0 1"/><geom size="0.1"/></body>
    <body name="b" pos="0 0 2"><joint name="b" type="slide" range="0 1"/><geom size="0.1"/></body></body></worldbody>
    <tendon><fixed name="t" damping="1"><joint joint="a" coef="1"/><joint joint="b" coef="1"/></fixed></tendon></mujoco>]])
  local world = clench.world {dynamics = {engine = "ode"}}
  local robot = world:add_robot(path)
  local function said() return table.concat(t.warnings(function() world:run(0.002) end), "\n") end
  t.ok(said():find(("the engine \"ode\" does not simulate the joint tendons of '%s'"):format(robot.name), 1, true))
  t.equal(said():find("does not simulate", 1, true), nil)
end)
