--- Birds of a tracker: each moves a body, a robot, or the camera of the view.
local arguments = require "clench.session.arguments"
local raise = require "clench.raise"
local sensors = require "clench.session.sensors"
local birds = {}

-- the sensor on a camera, as in GraspIt!: its x points along the view, its y to the right, its z down
local camera_mount = clench.pose {x_axis = {0, 0, -1}, z_axis = {0, -1, 0}}

local function number_of(thing)
  local tracker = thing.tracker
  return tracker and tracker.number
end

-- what a bird moves if nothing was chosen: the body or robot whose file names the bird; bird 1 moves the current hand
local function target_of_file(session, bird)
  if not session.world then return nil end
  local hand = session.hand
  if hand and (number_of(hand) or 1) == bird then return "hand" end
  for _, list in ipairs {session.world.robots, session.world.objects} do
    for _, thing in ipairs(list) do
      if thing ~= hand and number_of(thing) == bird then return (thing.name:gsub("/", "\\/")) end
    end
  end
end

--- Target and mode of a bird: {target, mode, base, pose}; nil: it moves nothing.
function birds.of(session, bird)
  local chosen = session.sensors.birds[bird]
  if chosen then return chosen.target ~= "none" and chosen or nil end
  local target = target_of_file(session, bird)
  if not target then return nil end
  for _, other in pairs(session.sensors.birds) do
    if other.target == target then return nil end  -- another bird moves it by choice
  end
  return {target = target, mode = "absolute"}
end

local function camera_of(session)
  return session.sensors.camera or raise "session: no view is open, whose camera a tracker could move"
end

-- the body or robot that a bird moves
local function thing_of(session, target)
  if target == "hand" then return session.hand or raise "session: no hand is current" end
  return arguments.find(session, target)
end

-- position of the sensor in what it moves
local function mount_of(session, target)
  if target == "camera" then return camera_mount end
  local tracker = thing_of(session, target).tracker
  return tracker and tracker.pose
end

local function pose_of(session, target)
  if target == "camera" then return camera_of(session).get() end
  return thing_of(session, target).pose
end

--- The last reading of a bird.
function birds.reading(session, bird)
  local readings = sensors.reading(session, "tracker")
  return readings[bird] or raise(("session: the tracker has %d bird%s, and bird %d is asked for"):format(#readings, #readings == 1 and "" or "s", bird))
end

-- what the bird of the camera moves it by
local function camera_bird(session)
  for _, one in pairs(session.sensors.birds) do
    if one.target == "camera" then return one end
  end
  raise "session: mode 'camera' needs a bird that moves the camera; choose that bird first"
end

-- a function from readings to poses
local function map_of(session, one)
  local mount = mount_of(session, one.target)
  if one.mode ~= "camera" then return clench.devices.tracker_map {mode = one.mode, base = one.base, pose = one.pose, mount = mount} end
  local camera = camera_bird(session)
  if camera.mode == "absolute" then return clench.devices.tracker_map {mount = mount} end
  return clench.devices.tracker_map {mode = "camera", base = camera.base, pose = camera.pose * camera_mount, mount = mount}
end

--- Chooses what a bird moves, and how, from now on.
---@param bird integer
---@param target string  "hand", "camera", "none", or the address of a body or robot
---@param mode "absolute"|"relative"|"camera"
function birds.choose(session, bird, target, mode)
  if target == "none" then
    session.sensors.birds[bird] = {target = "none"}
    return
  end
  local reading = birds.reading(session, bird)
  for other, one in pairs(session.sensors.birds) do
    if other ~= bird and one.target == target then raise(("session: bird %d moves '%s'; choose another target for it first"):format(other, target)) end
  end
  if target == "camera" and mode == "camera" then mode = "relative" end
  local is_relative = mode == "relative"
  local one = {target = target, mode = mode, base = is_relative and reading or nil, pose = is_relative and pose_of(session, target) or nil}
  if not is_relative then pose_of(session, target) end  -- an unknown target is an error now
  map_of(session, one)
  session.sensors.birds[bird] = one
end

--- The pose that a bird's last reading gives to its target.
function birds.pose(session, bird)
  return map_of(session, birds.of(session, bird))(birds.reading(session, bird))
end

--- Number of the bird that moves the current hand; nil: no bird.
function birds.of_hand(session)
  for bird in ipairs(sensors.reading(session, "tracker")) do
    local one = birds.of(session, bird)
    if one and session.hand and (one.target == "hand" or one.target ~= "camera" and thing_of(session, one.target) == session.hand) then return bird end
  end
end

--- Numbers of the birds that move something else than the current hand.
function birds.of_others(session)
  local list, own = {}, birds.of_hand(session)
  for bird in ipairs(sensors.reading(session, "tracker")) do
    if bird ~= own and birds.of(session, bird) then list[#list + 1] = bird end
  end
  return list
end

--- Moves a bird's target, other than the current hand, to its pose: bodies and robots until contact.
---@return table? result  as of `body:move_to`
function birds.move(session, bird)
  local target, pose = birds.of(session, bird).target, birds.pose(session, bird)
  if target == "camera" then return camera_of(session).set(pose) end
  return thing_of(session, target):move_to(pose)
end

return birds
