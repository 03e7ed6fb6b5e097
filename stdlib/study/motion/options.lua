--- Options shared by all studies of moving grasps.
local bounds = require "clench.study.motion.bounds"
local read_vector = require "clench.study.motion.read_vector"
local suspect = require "clench.suspect"

--- Reads hand, object and world, the settings of the grip, and the displacement at which the object counts as lost.
---@param read table  of clench.options, of a function whose description has these options
---@param grip_force? number  default [N]; ten weights of the object if neither this nor the description has a default
---@return table job
return function(read, grip_force)
  local job = {subject = read.subject, hand = read:get "hand", object = read:get "object"}
  job.world = read:get("world", job.hand.world)
  if job.hand.world ~= job.world or job.object.world ~= job.world then read:fail("hand and object must be in the same world") end
  if job.object.kind ~= "object" then read:fail("object: '%s' is of kind '%s', expected an object", job.object.name, job.object.kind) end
  if job.object.welded_to then
    read:fail("object: '%s' is welded to '%s': unweld it first, as a welded object cannot be lost", job.object.name, job.object.welded_to.name)
  end
  if not job.object.mesh then read:fail("object: '%s' has no surface", job.object.name) end
  job.mass = read:get("mass", job.object.mass)
  job.gravity = read_vector(read, "gravity", job.world.gravity, bounds.acceleration, " m/s^2")
  job.grip = read:get "grip"
  job.grip_force = read:get("grip_force", grip_force or 10 * 9.81 * job.mass)
  for _, name in ipairs {"grip_seconds", "settle", "friction_share", "max_distance", "max_angle", "surroundings"} do job[name] = read:get(name) end
  suspect.millimeters(read.subject, "max_distance", job.max_distance)
  suspect.degrees(read.subject, "max_angle", job.max_angle)
  return job
end
