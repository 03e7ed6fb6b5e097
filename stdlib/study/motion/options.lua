--- What all studies of moving grasps are given.
local bounds = require "clench.study.motion.bounds"
local read_vector = require "clench.study.motion.read_vector"
local suspect = require "clench.suspect"

local function check(read, name, kind)
  local value = read:raw(name)
  if clench.type(value) ~= kind then read:expected(name, "a " .. kind, value) end
  return value
end

--- Reads hand, object and world, how the hand grips, and when the object counts as lost.
---@param read table  of clench.options
---@param default {mass?: number, gravity?: vec3, grip_force?: number, surroundings?: boolean}  mass: the object's, unless given; gravity: the world's; grip_force: ten weights
---@return table job
return function(read, default)
  local job = {subject = read.subject, hand = check(read, "hand", "robot"), object = check(read, "object", "body")}
  job.world = read:raw "world" or job.hand.world
  if clench.type(job.world) ~= "world" then read:expected("world", "a world", job.world) end
  if job.hand.world ~= job.world or job.object.world ~= job.world then read:fail("hand and object must be in the same world") end
  if job.object.kind ~= "object" then read:fail("object: '%s' is no object but of kind '%s'", job.object.name, job.object.kind) end
  if job.object.welded_to then
    read:fail("object: '%s' is welded to '%s': unweld it first, for what is welded cannot be lost", job.object.name, job.object.welded_to.name)
  end
  if not job.object.mesh then read:fail("object: '%s' has no surface", job.object.name) end
  job.mass = read:positive("mass", default.mass or job.object.mass, bounds.mass)
  job.gravity = read_vector(read, "gravity", default.gravity or job.world.gravity, bounds.acceleration, " m/s^2")
  job.grip = read:choice("grip", {"forces", "close"})
  job.grip_force = read:positive("grip_force", default.grip_force or 10 * 9.81 * job.mass, bounds.force)
  job.grip_seconds = read:not_negative("grip_seconds", 0.5, bounds.seconds)
  job.settle = read:not_negative("settle", 1, bounds.seconds)
  job.friction_share = read:positive("friction_share", 0.75)
  job.max_distance = read:positive("max_distance", 0.05)
  job.max_angle = read:positive("max_angle", math.rad(15))
  suspect.millimetres(read.subject, "max_distance", job.max_distance)
  suspect.degrees(read.subject, "max_angle", job.max_angle)
  local surroundings = read:raw "surroundings"
  if surroundings ~= nil and type(surroundings) ~= "boolean" then read:expected("surroundings", "true or false", surroundings) end
  if surroundings == nil then surroundings = default.surroundings == true end
  job.surroundings = surroundings
  return job
end
