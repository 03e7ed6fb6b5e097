-- Hands whose files define no approach: random approaches from the guessed one are about as successful as from the best one.
local clench = require "clench"
local test = require "test"
local shared = "../shared/data/hands-urdf/"

-- hand, object and a function that returns the fraction of `trials` approaches along a frame in the base that end in force closure
local function stage(path)
  local world = clench.world {}
  local hand = world:add_robot(path)
  local objects = {}
  for i, shape in ipairs {clench.shapes.box {0.057, 0.057, 0.057}, clench.shapes.sphere {radius = 0.03},
                          clench.shapes.cylinder {radius = 0.03, height = 0.12}} do
    objects[i] = world:add_object(shape, {name = "object" .. i, pose = {xyz = {4 * i, 0, 0}}})
  end
  hand:open()
  local start = world:snapshot()
  return hand, function(frame, trials)
    local random, held = clench.random(1), 0
    for i = 1, trials do
      world:restore(start)
      local object = objects[i % #objects + 1]
      object.pose = random:rotation()
      hand.pose = clench.pose {xyz = {0, 0, -0.5}} * frame:inverse()
      if hand:move_to(clench.pose {xyz = {0, 0, 1}} * hand.pose).touched then
        hand:autograsp()
        local grasp = clench.grasp(hand, object)
        if #grasp.contacts > 1 and grasp:is_force_closure() then held = held + 1 end
      end
    end
    return held / trials
  end
end

for _, name in ipairs {"allegro_hand/allegro_hand_right", "leap_hand/leap_hand_right", "shadow_hand/shadow_hand_left",
                       "barrett_hand/bhand_model"} do
  test("random approaches of " .. name .. " succeed where it is guessed", function(t)
    local file = io.open(shared .. name .. ".urdf")
    if not file then t.skip("no " .. shared) end
    file:close()
    local hand, success = stage(shared .. name .. ".urdf")
    local own = hand.pose:inverse() * hand.approach.frame
    local places = {}
    for x = -0.06, 0.06, 0.03 do
      for y = -0.06, 0.06, 0.03 do places[#places + 1] = clench.pose {xyz = {x, y, 0}} end
    end
    for _, tilt in ipairs {{0.6, 0, 0}, {-0.6, 0, 0}, {0, 0.6, 0}, {0, -0.6, 0}} do
      places[#places + 1] = clench.pose {rpy = tilt}
    end
    local best = 0
    for _, place in ipairs(places) do best = math.max(best, success(own * place, 6)) end
    -- the best of 29 places with six trials each is partly best by chance
    local rate = success(own, 24)
    t.ok(best > 0.5 and rate >= 0.5 * best, ("%.2f of them, %.2f at best"):format(rate, best))
  end)
end
