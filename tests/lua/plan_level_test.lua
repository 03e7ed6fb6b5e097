-- Starts of hands with several fingers around low objects, and the grasps that they lead to.
local test, clench = require "test", require "clench"
local starts, opposition = require "clench.plan.starts", require "clench.plan.opposition"

local data = (os.getenv "CLENCH_SHARED" or "../shared") .. "/data/hands-urdf/"

-- A hand above a body that lies on a table.
local function scene_of(t, path, shape)
  local file = io.open(path)
  if not file then t.skip("no third-party data at ../shared or CLENCH_SHARED") end
  file:close()
  local world = clench.world()
  local height = shape.size[3]
  local object = world:add_object(clench.shapes.box(shape.size), {mass = 0.1, material = "wood", pose = {xyz = {0, 0, height / 2 + 2e-5}}})
  world:add_obstacle(clench.shapes.box {2, 2, 0.04}, {name = "table", pose = {xyz = {0, 0, -0.02}}})
  local hand = world:add_robot(path, {pose = {xyz = {0, 0, 1.5}}})
  for _, body in ipairs(hand.bodies) do world:set_friction(body.material, object.material, {static = 0.6, kinetic = 0.6}) end
  return world, hand, object
end

local function lowest_of(link)
  local low = math.huge
  for _, vertex in ipairs(link.mesh.vertices) do low = math.min(low, (link.pose * vertex).z) end
  return low
end

local function lowest_tips(hand)
  local out = {}
  for i, finger in ipairs(opposition.fingers(hand)) do
    for _, link in ipairs(finger.links) do
      if link.mesh then out[i] = math.min(out[i] or math.huge, lowest_of(link)) end
    end
  end
  return out
end

local options = {standoff = 0.15, friction = 0.5, width = 0.2, kind = "antipodal"}

local function check_level(t, path, shape, at_least)
  local world, hand, object = scene_of(t, path, shape)
  local next_state = starts.random({hand = hand, object = object, world = world, seed = 1}, options)
  hand:set_dofs((starts.opened(hand)))
  local _, thumb = opposition.thumb(hand)
  local count = 0
  for number = 1, 12 do
    local state = next_state(number)
    if state and state.reach == options.standoff then
      count = count + 1
      hand:set_posture(object.pose * state.pose, state.dofs)
      local down = clench.pose {xyz = {0, 0, -options.standoff}}
      hand.pose = down * hand.pose
      t.ok(not world:collides(hand))
      local tips, others = lowest_tips(hand), math.huge
      for i, low in ipairs(tips) do
        if i ~= thumb then others = math.min(others, low) end
      end
      -- 1 to 3 mm above the table, plus the spacing of the points sampled on a tip
      for _, low in ipairs {tips[thumb], others} do t.ok(low > 0 and low < 0.0045, low) end
    end
  end
  t.ok(count >= at_least, count)
end

test("starts around a low object have the ends of thumb and fingers just above the table", function(t)
  check_level(t, "models/hands/barrett/barrett.cfg", {size = {0.03, 0.15, 0.025}}, 6)
  check_level(t, data .. "leap_hand/leap_hand_right.urdf", {size = {0.03, 0.15, 0.025}}, 6)
  check_level(t, data .. "allegro_hand/allegro_hand_right.urdf", {size = {0.03, 0.15, 0.025}}, 6)
end)

test("an object higher than a fingertip is approached from any side", function(t)
  local world, hand, object = scene_of(t, "models/hands/barrett/barrett.cfg", {size = {0.03, 0.15, 0.2}})
  local next_state = starts.random({hand = hand, object = object, world = world, seed = 1}, options)
  for number = 1, 12 do t.ok(next_state(number).reach ~= options.standoff) end
end)

test("a hand with four fingers holds a screwdriver that lies on a table", function(t)
  local world, hand, bar = scene_of(t, data .. "leap_hand/leap_hand_right.urdf", {size = {0.03, 0.15, 0.025}})
  world:remove(bar)
  local object = world:add_object(data .. "../ycb/043_phillips_screwdriver.obj", {mass = 0.1, material = "wood"})
  object.pose = {xyz = {0, 0, 2e-5 - object.mesh.bounds.low.z}}
  local run = clench.plan.sample {hand = hand, object = object, candidates = 128, count = 100}
  t.ok(#run.grasps >= 1, #run.grasps)
end)
