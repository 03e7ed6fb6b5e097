-- A hand written as URDF and read again is the same hand: it closes the same way, and its grasps have the same measures.
local test, clench = require "test", require "clench"

local folder = test.folder()
clench.log.level "error"

local shared = (os.getenv "CLENCH_SHARED" or "../shared") .. "/data/"
local hands = {}
for _, path in ipairs(clench.catalog().hands) do hands[#hands + 1] = path end
for _, name in ipairs {"Barrett/Barrett", "DLR/DLR", "HumanHand/HumanHand20DOF", "HumanHand/HumanHand16DOF", "HumanHand/HumanHandAltAxes",
    "Robonaut/Robonaut", "Robonaut/Robonaut_13DOF", "harvardHand/harvardHand", "harvardHand/harvardHand_wr"} do
  hands[#hands + 1] = shared .. "graspit/models/robots/" .. name .. ".cfg"
end
for _, name in ipairs {"allegro_hand/allegro_hand_right", "leap_hand/leap_hand_right", "barrett_hand/bhand_model",
    "shadow_hand/shadow_hand_right"} do
  hands[#hands + 1] = shared .. "hands-urdf/" .. name .. ".urdf"
end

-- closed in free air, then on a ball in front of its palm
local function closed(path)
  local world = clench.world()
  local hand = world:add_robot(path, path:find "hands%-urdf" and {package = path:match "^(.*)/"} or nil)
  local out = {hand = hand, free = {}}
  hand:autograsp()
  for _, link in ipairs(hand.links) do
    if link.mesh then out.free[link.name] = link.bounds_in_world end
  end
  hand:open()
  -- as near to the approach point as the open hand allows
  local ball = world:add_object(clench.shapes.sphere {0.03}, {name = "the ball", mass = 0.1})
  for way = 0.03, 0.5, 0.01 do
    ball.pose = {xyz = hand.approach.point + hand.approach.direction * way}
    if #world:colliding(hand, ball) == 0 then break end
  end
  hand:autograsp()
  out.at, out.contacts = ball.pose.position, #world:contacts(hand, ball)
  if out.contacts > 0 then
    local grasp = clench.grasp(hand, ball)
    out.epsilon, out.volume = grasp:quality "epsilon", grasp:quality "volume"
  end
  return out
end

for number, path in ipairs(hands) do
  test(path:match "[^/]*$" .. " comes back from a URDF and closes as before", function(t)
    local file = io.open(path)
    if not file then t.skip("no " .. path) end
    file:close()
    local there = ("%s/hand%d.urdf"):format(folder, number)
    clench.convert(path, there, path:find "hands%-urdf" and {package = path:match "^(.*)/"} or nil)
    local before, after = closed(path), closed(there)
    t.equal(#after.hand.dofs, #before.hand.dofs)
    for i, name in ipairs(before.hand.dof_names) do
      -- one whose leading joint has another ratio has other values, and is distinguished
      local a, b = before.hand.dof_limits[i], after.hand.dof_limits[i]
      if math.abs(a[1] - b[1]) + math.abs(a[2] - b[2]) < 1e-12 then t.equal(after.hand.dof_names[i], name) end
    end
    for name, bounds in pairs(before.free) do
      local other = after.free[name]
      t.ok(other, name)
      for _, corner in ipairs {"low", "high"} do t.close((bounds[corner] - other[corner]):norm(), 0, 1e-5) end
    end
    t.close((after.hand.approach.point - before.hand.approach.point):norm(), 0, 1e-12)
    t.close((after.at - before.at):norm(), 0, 1e-12)
    t.equal(after.contacts, before.contacts)
    -- fingers stop anywhere within 0.1 mm of the ball
    if before.epsilon then
      t.close(after.epsilon, before.epsilon, 1e-2 * math.max(1e-3, before.epsilon))
      t.close(after.volume, before.volume, 1e-2 * math.max(1e-6, before.volume))
    end
    t.equal(after.hand.base.material, before.hand.base.material)
  end)
end

test("a grasp of a hand applies to the URDF that was written from the hand", function(t)
  local world = clench.load "worlds/dlr_flask.wld"
  local hand, flask = world.robots[1], world.objects[1]
  hand:autograsp()
  local grasp = clench.grasp(hand, flask)
  local there = folder .. "/dlr.urdf"
  clench.convert("models/hands/dlr/dlr.cfg", there)
  local other = clench.world()
  other:add_robot(there, {name = hand.name})
  other:add_object("models/objects/flask.iv", {name = flask.name, material = flask.material, pose = flask.pose})
  t.equal(#grasp:apply(other).contacts, #grasp.contacts)
end)
