-- Hands and objects at rest on a table, for benchmarks.
local clench = require "clench"
local describe = require "verdicts.describe"
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

local mass, mu = 0.1, 0.6  -- mass of each object [kg], and friction between objects and hands
local weights = 10         -- normal force of hands [weights of the object]
local settling = 3         -- time until an object is at rest [s]

local function is_there(path)
  local file = io.open(path, "rb")
  if file then file:close() end
  return file ~= nil
end

-- Drops the object from a millimeter above the table, and waits until it is at rest.
local function rest(world, object)
  object.pose = {xyz = {0, 0, 0.001 - object.mesh.bounds.low.z}}
  world:run(settling)
  object.velocity = {linear = {0, 0, 0}, angular = {0, 0, 0}}
end

--- A hand above an object at rest on a table.
---@return {world: world, hand: robot, object: body, table: body}?  nil without shared data
function table_scene.load(hand_name, object_name)
  if not is_there(paths[hand_name]) or not is_there(paths[object_name]) then return nil end
  local world = clench.world()
  local object = world:add_object(paths[object_name], {mass = mass})
  local board = world:add_obstacle(clench.shapes.box {2, 2, 0.04}, {name = "table", pose = {xyz = {0, 0, -0.02}}})
  rest(world, object)
  local hand = world:add_robot(paths[hand_name], {pose = {xyz = {0, 0, 1.5}}})
  for _, body in ipairs(hand.bodies) do world:set_friction(body.material, object.material, {static = mu, kinetic = mu}) end
  return {world = world, hand = hand, object = object, table = board, hand_name = hand_name, object_name = object_name}
end

-- The hand as numbers, with every DOF at the value nearest to 0 within its limits.
local function describe_hand(hand_name)
  local hand = clench.world():add_robot(paths[hand_name])
  local values = {}
  for i, limits in ipairs(hand.dof_limits) do values[i] = math.max(limits[1], math.min(limits[2], 0)) end
  hand:set_dofs(values)
  return describe.hand(hand)
end

-- The mean torsion radius of the contacts of each link, 0 for links that do not touch the object [m].
local function torsion_radii(grasp, links)
  local out = {}
  for i, link in ipairs(links) do
    local sum, count = 0, 0
    for k, name in ipairs(grasp.links) do
      if name == link.name then sum, count = sum + grasp.points[k].torsion_radius, count + 1 end
    end
    out[i] = count > 0 and sum / count or 0.0
  end
  return out
end

-- One grasp, with the torques with which the hand presses; joints of one DOF share its torque.
local function row_of(scene, grasp, description)
  local hand, object = scene.hand, scene.object
  local placed = grasp:apply(scene.world, {hand = hand, object = object})
  local weight = 9.81 * object.mass
  local torques = placed:contact_forces({objective = "max_margin", total_force = weights * weight}).joint_torques
  for i, dof in ipairs(torques and description.dofs or {}) do torques[i] = torques[i] / dof.joints end
  return {pose = describe.pose(grasp.pose), dofs = hand.dofs, torques = torques, torsion_radii = torsion_radii(placed, description.links),
          epsilon = grasp.epsilon, load = grasp.info.load_margin or 0, held = grasp.info.directions_held or 0,
          survived = grasp.info.survived == 1, verified = true}
end

--- Writes the scene and its grasps for bench_mujoco.
function table_scene.save(scene, grasps, path)
  local X_OW = scene.object.pose:inverse()
  local point, up = X_OW * clench.vec3(0, 0, 0), X_OW:rotate(clench.vec3(0, 0, 1))
  local out = {hand_name = scene.hand_name, object_name = scene.object_name, mu = mu, force = 9.81 * mass, hand = describe_hand(scene.hand_name),
               object = describe.body(scene.object), table = {point = {point.x, point.y, point.z}, up = {up.x, up.y, up.z}}, grasps = {}}
  local here <close> = scene.world:snapshot()
  for i, grasp in ipairs(grasps) do out.grasps[i] = row_of(scene, grasp, out.hand) end
  scene.world:restore(here)
  clench.files.save_text(path, clench.json.encode(out))
end

return table_scene
