--- Warns once of a number that is probably in degrees, and once of one in millimeters, as the engine does for poses.
local script_line = require "clench.script_line"
local suspect = {}

local max_turn, max_distance = 2 * math.pi, 10
local warned = {}

local function warn_once(kind, format, ...)
  if warned[kind] then return end
  warned[kind] = true
  clench.log.warning(script_line() .. format:format(...))
end

-- subject: "study.shake"; name: of the option; angle [rad]
function suspect.degrees(subject, name, angle)
  if math.abs(angle) <= max_turn then return end
  warn_once("degrees", "%s: %s is %.6g: radians? clench.rad(%.6g) is %.4g", subject, name, angle, angle, math.rad(angle))
end

-- length [m]; size: size of the object that it refers to, 10 m by default [m]
function suspect.millimeters(subject, name, length, size)
  if length <= math.min(size or max_distance, max_distance) then return end
  local why = size and size <= max_distance and (", more than the object's size of %.3g m"):format(size) or ""
  warn_once("millimeters", "%s: %s is %.6g m%s: meters? clench.mm(%.6g) is %.4g", subject, name, length, why, length, length / 1000)
end

return suspect
