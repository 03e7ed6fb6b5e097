-- Hands and objects at rest on a table, for benchmarks.
local clench = require "clench"
local table_scene = {}

local data = (os.getenv "CLENCH_SHARED" or "../shared") .. "/data/"

local paths = {
  parallel_jaw = "models/hands/parallel_jaw/parallel_jaw.cfg",
  adaptive_gripper = "models/hands/adaptive_gripper/adaptive_gripper.cfg",
  barrett = "models/hands/barrett/barrett.cfg",
  leap = data .. "hands-urdf/leap_hand/leap_hand_right.urdf",
  allegro = data .. "hands-urdf/allegro_hand/allegro_hand_right.urdf",
  mug = "models/objects/mug.iv",
  phone = "models/objects/phone.iv",
  cracker_box = data .. "ycb/003_cracker_box.obj",
  soup_can = data .. "ycb/005_tomato_soup_can.obj",
  mustard = data .. "ycb/006_mustard_bottle.obj",
  banana = data .. "ycb/011_banana.obj",
  apple = data .. "ycb/013_apple.obj",
  screwdriver = data .. "ycb/043_phillips_screwdriver.obj",
  hammer = data .. "ycb/048_hammer.obj",
  baseball = data .. "ycb/055_baseball.obj",
  cup = data .. "ycb/065-c_cups.obj",
}

table_scene.hands = {"parallel_jaw", "adaptive_gripper", "barrett", "leap", "allegro"}
table_scene.objects = {"mug", "phone", "cracker_box", "soup_can", "mustard", "banana", "apple", "screwdriver", "hammer", "baseball", "cup"}

local mass = 0.1  -- of each object [kg]
local settling = 3  -- [s]

local function is_there(path)
  local file = io.open(path, "rb")
  if file then file:close() end
  return file ~= nil
end

-- an object that was dropped by a millimetre, and has come to rest
local function rest(world, object)
  object.pose = {xyz = {0, 0, 0.001 - object.mesh.bounds.low.z}}
  world:run(settling)
  object.velocity = {linear = {0, 0, 0}, angular = {0, 0, 0}}
end

--- A hand above an object at rest on a table.
---@return {world: world, hand: robot, object: body, table: body}?  nil: there is no shared data
function table_scene.load(hand_name, object_name)
  if not is_there(paths[hand_name]) or not is_there(paths[object_name]) then return nil end
  local world = clench.world()
  local object = world:add_object(paths[object_name], {mass = mass})
  local board = world:add_obstacle(clench.shapes.box {2, 2, 0.04}, {name = "table", pose = {xyz = {0, 0, -0.02}}})
  rest(world, object)
  local hand = world:add_robot(paths[hand_name], {pose = {xyz = {0, 0, 1.5}}})
  return {world = world, hand = hand, object = object, table = board}
end

--- Writes the grasps, and where the object rests.
function table_scene.save(scene, grasps, path)
  grasps:save(path .. ".jsonl", {notes = {pose = {xyz = {scene.object.pose.position.x, scene.object.pose.position.y, scene.object.pose.position.z}}}})
end

return table_scene
