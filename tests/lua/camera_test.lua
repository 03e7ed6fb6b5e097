local test, clench = require "test", require "clench"

-- whether the camera shows the point, within a part of the picture's half width and height
local function is_in(camera, aspect, p, part)
  local back = (camera.eye - camera.target) / (camera.eye - camera.target):norm()
  local right = camera.up:cross(back)
  right = right / right:norm()
  local up = back:cross(right)
  local d = p - camera.eye
  local depth = -d:dot(back)
  local high = part * math.tan(camera.field_of_view / 2) * depth
  return depth > 0 and math.abs(d:dot(up)) <= high and math.abs(d:dot(right)) <= aspect * high
end

local function assert_shown(t, camera, aspect, body)
  local corners = 0
  for _, vertex in ipairs(body.mesh.vertices) do
    if not is_in(camera, aspect, body.pose * vertex, 0.9) then corners = corners + 1 end
  end
  t.equal(corners, 0, body.name .. " is cut")
end

test("palm and object are in the frame of every random world in which a hand touches its object", function(t)
  local random = clench.random(5)
  for _, name in ipairs {"barrett_mug", "parallel_jaw_cube", "three_finger_sphere", "tendon_cylinder", "dlr_flask"} do
    local world = clench.load("worlds/" .. name .. ".wld", {root = "."})
    local hand, object = world.robots[1], world.objects[1]
    hand:autograsp()
    t.ok(#world:contacts(hand, object) > 0, name)
    local hand_pose, object_pose = hand.pose, object.pose
    for _ = 1, 3 do
      local turn = clench.pose {xyz = {random:uniform(), random:uniform(), random:uniform()},
                                rpy = {6 * random:uniform(), 6 * random:uniform(), 6 * random:uniform()}}
      hand.pose, object.pose = turn * hand_pose, turn * object_pose
      for _, size in ipairs {{640, 480}, {336, 480}} do
        local camera = clench.camera(world, {size = size, contacts = false})
        assert_shown(t, camera, size[1] / size[2], object)
        assert_shown(t, camera, size[1] / size[2], hand.base)
      end
    end
  end
end)

test("a picture drawn with the camera that was read is byte-identical", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  world.robots[1]:autograsp()
  for _, options in ipairs {{size = {96, 64}, quality = "draft"}, {size = {64, 96}, quality = "draft", orthographic = true},
                            {size = {64, 48}, samples = 2, frame = "all"}} do
    local picture = clench.render(world, options)
    for key, value in pairs(picture.camera) do options[key] = value end
    t.ok(clench.render(world, options) == picture)
    local chosen = clench.camera(world, {size = options.size, frame = options.frame, orthographic = options.orthographic})
    t.ok(chosen.eye == picture.camera.eye and chosen.target == picture.camera.target)
  end
end)

test("forces do not change the direction of the view, which faces the contacts", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  hand:autograsp()
  local held = clench.grasp(hand, flask):contact_forces {load = {0, 0, -2, 0, 0, 0}}
  local plain, forces = clench.camera(world), clench.camera(world, {contacts = false, forces = held.forces})
  local function direction(c) return (c.eye - c.target) / (c.eye - c.target):norm() end
  t.ok(direction(plain):dot(direction(forces)) > 0.7)
end)

test("a film uses the camera of render, and shows hand and object in every frame", function(t)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  local hand, mug = world.robots[1], world.objects[1]
  hand:autograsp()
  local states, options = {}, {size = {320, 240}, contacts = false}
  t.ok(clench.camera({world}, options).eye == clench.camera(world, options).eye)
  for i = 1, 30 do
    states[i] = world:clone()
    local offset = clench.pose {xyz = {0, 0.02 * (i < 16 and i or 30 - i), 0}}
    states[i].robots[1].pose = offset * hand.pose
    states[i].objects[1].pose = offset * mug.pose
  end
  local camera = clench.camera(states, options)
  for _, state in ipairs(states) do
    assert_shown(t, camera, 320 / 240, state.objects[1])
    assert_shown(t, camera, 320 / 240, state.robots[1].base)
  end
end)

test("a list that contains other values than worlds is rejected", function(t)
  local world = clench.world()
  t.fails(function() clench.camera({world, 3}) end, "worlds[2]: expected a world, got 3")
  t.fails(function() clench.camera {} end, "worlds: expected at least one, got none")
  t.fails(function() clench.camera(world, {color = 1}) end, "unknown key 'color'")
end)
