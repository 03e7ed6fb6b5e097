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
