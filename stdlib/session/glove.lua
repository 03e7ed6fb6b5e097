--- Calibration of the glove of a session: recorded postures, with DOFs or with the distance of two fingertips, and the calibration that follows from them.
local raise = require "clench.raise"
local sensors = require "clench.session.sensors"
local glove = {}

local min_tip_postures = 6

-- postures that have a field
local function with(session, field)
  local list = {}
  for _, posture in ipairs(session.sensors.postures) do
    if posture[field] then list[#list + 1] = posture end
  end
  return list
end

--- Records the last reading with the DOFs of the hand, or with the distance of two fingertips instead.
---@param args table  {dofs, distance}
---@return integer count  of postures
function glove.record(session, args)
  if args.dofs and args.distance then raise "session: a posture has either dofs or a distance" end
  local postures = session.sensors.postures
  postures[#postures + 1] = {sensors = sensors.reading(session, "glove"), dofs = not args.distance and (args.dofs or session.hand.dofs) or nil, distance = args.distance}
  return #postures
end

--- Condition of commands: are there postures with DOFs for a calibration?
function glove.has_postures(session) return #with(session, "dofs") > 1, "fewer than two postures were recorded" end

--- Condition of commands: is there any posture?
function glove.has_any(session) return #session.sensors.postures > 0, "no posture was recorded" end

--- Condition of commands: are there a hand, a calibration and postures of fingertips?
function glove.has_tips(session)
  if not session.hand then return false, "no hand is current" end
  if not session.sensors.calibration then return false, "the glove is not calibrated" end
  return #with(session, "distance") >= min_tip_postures, ("fewer than %d postures with a distance of two fingertips were recorded"):format(min_tip_postures)
end

--- Fits the calibration to the postures with DOFs.
---@return table report  by DOF
function glove.calibrate(session, args)
  local calibration = clench.devices.calibrate {samples = with(session, "dofs"), sensors_of = args.sensors_of}
  session.sensors.calibration = calibration
  return calibration.report
end

--- Refines the calibration by the postures with a distance of two fingertips.
---@return table report
function glove.calibrate_tips(session, args)
  local state = session.sensors
  local found = clench.devices.calibrate_tips {hand = session.hand, calibration = state.calibration, dofs = state.dofs, samples = with(session, "distance"), tips = args.tips,
                                              refine = args.refine, shell = args.shell}
  state.calibration = found
  return found.tips
end

--- Reads postures from a file, which are added to those of the session.
---@return integer count  of postures
function glove.load_postures(session, path)
  local postures = session.sensors.postures
  local added = {}
  for i, pose in ipairs(clench.files.glove_poses(path)) do
    if not pose.sensors or #pose.sensors == 0 then raise(("session: %s: pose %d has no sensors"):format(path, i)) end
    added[i] = {sensors = pose.sensors, distance = pose.distance, dofs = not pose.distance and pose.joints or nil}
  end
  table.move(added, 1, #added, #postures + 1, postures)
  return #postures
end

return glove
