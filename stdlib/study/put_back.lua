--- Restores a grasp in a copy of its world to the state in which it was measured; the world may have changed since.
local raise = require "clench.raise"
local on_behalf_of = require "clench.on_behalf_of"
local put_back = {}

--- Does a grasp belong to a world? Grasps of planners and files do not.
function put_back.stands(grasp) return (pcall(function() return grasp.hand end)) end

--- Rejects a grasp that belongs to no world.
---@param subject string  "study.compare: grasps[1]"
function put_back.check_stands(subject, grasp)
  if put_back.stands(grasp) then return end
  raise(subject .. ": the grasp belongs to no world, like those of planners and files; grasp:apply(world) gives one that does")
end

local same = 1e-6  -- meters and radians: the tolerance at which the engine compares a grasp with its world

local function stale(subject, what)
  raise(("%s: %s since the grasp was measured; measure it anew"):format(subject, what), "stale")
end

local function check_friction(subject, grasp)
  local world = grasp.hand.world
  for _, contact in ipairs(grasp.contacts) do
    if world:friction(contact.body.material, contact.other.material) ~= contact.mu then stale(subject, "friction has changed") end
  end
end

-- a hand on an arm cannot be moved to the grasp
local function check_held(subject, grasp, hand, object)
  local off = grasp.pose:inverse() * object.pose:inverse() * hand.pose
  if off.position:norm() > same or off:angle() > same then stale(subject, "hand and object have moved apart") end
end

local function copy(subject, grasp)
  check_friction(subject, grasp)
  local world = grasp.hand.world:clone()
  local hand, object = world:robot(grasp.hand.name), world:body(grasp.object.name)
  if hand.parent then check_held(subject, grasp, hand, object) end
  grasp:apply(world, {hand = hand, object = object})
  if object.com ~= grasp.com then object.com = grasp.com end
  return {world = world, hand = hand, object = object, pose = object.pose, start = world:snapshot()}
end

--- A copy of the world in which the hand grasps the object as measured, at the object's present pose, with the grasp's DOFs, joints and center of mass.
---@param subject string  "study.robustness"
---@param grasp grasp
---@return {world: world, hand: robot, object: body, pose: pose, start: snapshot}  pose: of the object
function put_back.copy(subject, grasp)
  put_back.check_stands(subject, grasp)
  return on_behalf_of(subject, copy, subject, grasp)
end

return put_back
