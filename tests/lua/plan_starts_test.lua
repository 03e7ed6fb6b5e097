-- Starts of planners: links that are fingers, opening of a hand, and hands that yield sideways.
local test, clench = require "test", require "clench"
local opposition, starts, closing = require "clench.plan.opposition", require "clench.plan.starts", require "clench.plan.closing"
local touch = require "clench.plan.touch"

local function hand_of_urdf(t, path)
  local whole = (os.getenv "CLENCH_SHARED" or "../shared") .. "/data/hands-urdf/" .. path
  local file = io.open(whole)
  if not file then t.skip("no third-party data at ../shared or CLENCH_SHARED") end
  file:close()
  return clench.world():add_robot(whole)
end

test("palms, wrists and frames are not fingers", function(t)
  for path, thumb in pairs {["shadow_hand/shadow_hand_right.urdf"] = "thtip", ["leap_hand/leap_hand_right.urdf"] = "thumb_tip_head",
                            ["allegro_hand/allegro_hand_left.urdf"] = "link_15.0_tip"} do
    local hand = hand_of_urdf(t, path)
    local fingers = opposition.fingers(hand)
    t.equal(#fingers, path:find "shadow" and 5 or 4)
    hand:set_dofs((starts.opened(hand)))
    local _, number = opposition.thumb(hand)
    local links = fingers[number].links
    t.ok(links[#links].name:find(thumb, 1, true), links[#links].name)
    local tips = {}
    local read = {raw = function(_, name) return name == "contacts" and "fingertip" or nil end}
    for _, name in ipairs(touch.read(read, hand).may) do tips[name] = true end
    for _, finger in ipairs(fingers) do
      local count = 0
      for _, link in ipairs(finger.links) do count = count + (tips[link.name] and 1 or 0) end
      t.equal(count, 1)
    end
  end
end)

test("a hand opens only as far as it is collision-free", function(t)
  local hand = hand_of_urdf(t, "leap_hand/leap_hand_right.urdf")
  local world = hand.world
  local before = world:hash()
  local open = starts.opened(hand)
  t.equal(world:hash(), before)
  hand:set_dofs(open)
  t.ok(not world:collides(hand))
  -- within its limits the thumb could enter the palm
  world:set_collision(false, hand)
  hand:open()
  local widest = hand.dofs
  world:set_collision(true, hand)
  t.ok(world:collides(hand))
  local moved = 0
  for i, value in ipairs(open) do moved = moved + (math.abs(value - widest[i]) > 1e-9 and 1 or 0) end
  t.ok(moved >= 1 and moved <= 4, moved)
end)

test("jaws that touch an off-center bar yield sideways, and hold it from their pregrasp", function(t)
  local world = clench.world()
  local hand = world:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
  local bar = world:add_object(clench.shapes.box {0.02, 0.04, 0.1}, {pose = {xyz = {0, 0, 1}}})
  local dofs = starts.opened(hand)
  -- the bar is narrow along x, where the jaws close; 8 mm off their middle
  local along = hand.chains[1].links[1].bounds_in_world
  local side = along.low.x > hand.base.bounds_in_world.low.x and 0.008 or -0.008
  local state = {pose = clench.pose {xyz = {side, 0, -0.2}}, dofs = dofs}
  local grasp = closing.close(hand, bar, state, {approach = 0.2})
  t.ok(grasp.epsilon > 0 and grasp.collision_free)
  t.close(grasp.pose.position.x, 0, 3e-4)
  t.close(grasp.pregrasp.pose.position.x, grasp.pose.position.x, 1e-12)
  t.close(grasp.pregrasp.pose.position.z, -0.2, 1e-12)
end)

test("sampling starts near successful grasps", function(t)
  local near, elsewhere = 0, 0
  for seed = 1, 6 do
    local world = clench.world()
    local hand, banana = world:add_robot "models/hands/barrett/barrett.cfg", world:add_object("models/objects/banana.iv", {pose = {xyz = {0, 0, 2}}})
    local run = clench.plan.sample {hand = hand, object = banana, candidates = 320, refine = 0, verify = false, count = 1000, distance = 0, seed = seed}
    -- from the second round on, starts 3 and 4 of each four begin near found grasps: they succeed more often
    for _, grasp in ipairs(run.grasps) do
      local number = grasp.info.number
      if number > 64 then
        if number % 4 >= 2 then near = near + 1 else elsewhere = elsewhere + 1 end
      end
    end
  end
  t.ok(near > 1.25 * elsewhere, near .. " " .. elsewhere)
end)
