local test, clench = require "test", require "clench"

local function each_joint(hand, visit)
  for c, chain in ipairs(hand.chains) do
    for j, joint in ipairs(chain.joints) do visit(joint, c, j) end
  end
end

local function closed_on_cylinder()
  local world = clench.load("worlds/tendon_cylinder.wld", {root = "."})
  local hand, cylinder = world.robots[1], world.objects[1]
  return world, hand, cylinder, hand:autograsp()
end

test("a gripper with springs wraps around a cylinder, holds it by its springs, and opens again", function(t)
  local world, hand, cylinder, result = closed_on_cylinder()
  t.equal(result.stops[1], "contact")
  t.equal(#world:colliding(), 0)
  local touching = {}
  for _, contact in ipairs(world:contacts(hand, cylinder)) do touching[contact.link.name] = true end
  for _, link in ipairs(hand.links) do t.ok(touching[link.name], link.name .. " does not touch") end
  local deflection = 0
  each_joint(hand, function(joint)
    t.equal(joint.broken_away, false)
    t.close(joint.spring_deflection, joint.ratio * hand.dofs[1] - joint.value, 1e-15)
    deflection = math.max(deflection, joint.spring_deflection)
  end)
  t.ok(deflection > 0.05)
  local held = clench.grasp(hand, cylinder):equilibrium {torques = "springs"}
  t.equal(held.status, "stable")
  local pressed = 0
  for _, force in ipairs(held.forces) do pressed = pressed + force.normal end
  t.ok(pressed > 0.1)
  hand:open()
  each_joint(hand, function(joint) t.equal(joint.value, 0) end)
end)

test("deflected springs are kept in Lua worlds, and other formats report the loss", function(t)
  local world, hand = closed_on_cylinder()
  local path = test.path()
  world:save(path .. ".lua", {root = "."})
  local again = clench.load(path .. ".lua", {root = "."})
  each_joint(hand, function(joint, c, j)
    local kept = again.robots[1].chains[c].joints[j]
    t.equal(kept.value, joint.value)
    t.equal(kept.spring_deflection, joint.spring_deflection)
  end)
  for _, ending in ipairs {".wld", ".xml"} do
    local said = {}
    clench.log.sink(function(_, text) said[#said + 1] = text end)
    world:save(path .. ending, {root = ".", format = ending == ".xml" and "graspit" or nil})
    clench.log.sink()
    t.ok(table.concat(said, "\n"):find("the joints of 'tendon_gripper' that do not follow their DOFs", 1, true), ending)
  end
end)

test("the original's compliant hand moves in free air with its ratios, and wraps around a ball", function(t)
  local shared = os.getenv "CLENCH_SHARED" or "../shared"
  local path = shared .. "/data/graspit/models/robots/harvardHand/harvardHand.cfg"
  local file = io.open(path)
  if not file then t.skip("no third-party data at ../shared or CLENCH_SHARED") end
  file:close()
  clench.log.level "quiet"
  local world = clench.world()
  local hand = world:add_robot(path, {root = shared .. "/data/graspit"})
  clench.log.level "warning"
  each_joint(hand, function(joint, _, j) t.close(joint.ratio, j == 1 and 1 or 0.6, 1e-12) end)
  local at = hand.approach.point + hand.approach.direction * 0.06
  local ball = world:add_object(clench.shapes.sphere {0.035}, {name = "ball", pose = {xyz = at}})
  if #world:colliding() > 0 then hand:open() end
  hand:autograsp()
  t.equal(#world:colliding(), 0)
  t.ok(#world:contacts(hand, ball) > 0)
  -- contacts balance every joint, but push the ball, which closing treated as fixed, out of the hand
  t.equal(clench.grasp(hand, ball):equilibrium({torques = "springs"}).status, "unstable")
end)

test("springs at rest without friction balance their joints", function(t)
  local world, hand, cylinder = closed_on_cylinder()
  for i, height in ipairs {0, 0.004, -0.003} do
    hand:open()
    for _, material in ipairs {"frictionless", "plastic"} do
      cylinder.material = material
      cylinder.pose = {xyz = {0.002 * i, height, 0}}
      hand:open()
      hand:autograsp()
      local status = clench.grasp(hand, cylinder):equilibrium({torques = "springs"}).status
      t.ok(status == "stable" or status == "unstable", ("%s at %g: %s"):format(material, height, status))
    end
  end
  t.equal(#world:colliding(), 0)
end)
