local described = require "clench.described"
local new_options = require "clench.options"
local raise = require "clench.raise"

local subject = "devices.tracker_map"

local function pose_of(o, name)
  local value = o:raw(name)
  if value == nil then return clench.pose {} end
  if clench.type(value) ~= "pose" then o:expected(name, "a pose", value) end
  return value
end

--- A function from readings of a tracker to poses of the body that carries its sensor, as in GraspIt!. "absolute": the transmitter is at
--- the origin of the world. "relative": the body moves from its pose at the time of the base reading, as the sensor moves relative to that reading.
--- "camera": readings are relative to the base reading, at which the camera has the given pose.
---@param options table
---@option mode? "absolute"|"relative"|"camera" = "absolute"  reference of the readings
---@option mount? pose  of the sensor in the body, as in `hand.tracker` and `body.tracker`; the identity by default
---@option base? pose  reading of the base: of the sensor itself (relative), or of the camera's
---@option pose? pose  of the body (relative) or the camera at that time, in the world
---@return fun(reading: pose): pose
---@effect reads
--- > mount = clench.pose {xyz = {0, 0, 0.1}}
--- > to_body = clench.devices.tracker_map {mount = mount}
--- > to_body(clench.pose {xyz = {1, 0, 0.5}}).position  --> (1, 0, 0.4)
--- > to_body = clench.devices.tracker_map {mode = "relative", base = clench.pose {xyz = {1, 1, 1}}, pose = flask.pose}
--- > (to_body(clench.pose {xyz = {1, 1, 1.5}}).position - flask.pose.position):norm()  --> 0.5
return function(options)
  local o = new_options(subject, options)
  local mode = o:get "mode"
  local mount, base, pose = pose_of(o, "mount"), pose_of(o, "base"), pose_of(o, "pose")
  if mode == "absolute" and (o:raw "base" ~= nil or o:raw "pose" ~= nil) then o:fail "base and pose belong to the modes relative and camera" end
  o:done()
  -- of the reading: before * reading * after
  local after = mount:inverse()
  local before = mode == "absolute" and clench.pose {} or mode == "relative" and pose * mount * base:inverse() or pose * base:inverse()
  return function(reading)
    if clench.type(reading) ~= "pose" then raise(("%s: expected a pose as reading, got %s"):format(subject, described(reading))) end
    return before * reading * after
  end
end
