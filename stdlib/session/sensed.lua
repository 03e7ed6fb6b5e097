--- The simulated hand of a session and its devices: a glove and a tracker move the hand; the real hand and the simulated one follow each other.
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local raise = require "clench.raise"
local sensors = require "clench.session.sensors"
local sensed = {}

local pause = 0.01  -- between two turns of following [s]

-- DOFs of the hand by the readings of the glove
local function glove_dofs(session)
  local raw = sensors.reading(session, "glove")
  local state = session.sensors
  return clench.devices.glove_map {hand = session.hand, calibration = state.calibration or session.hand.glove, dofs = state.dofs} (raw)
end

-- pose of the hand's base by the reading of the tracker
local function tracked_pose(session)
  local reading = sensors.reading(session, "tracker")
  local frame = session.sensors.frame or {}
  return clench.devices.tracker_map {mode = frame.mode, base = frame.base, pose = frame.pose, mount = session.hand.tracker} (reading)
end

--- Moves the current hand to the last readings: with a tracker and a glove as a fuzzy grasp, with one of them until contact.
---@return table result  of `clench.devices.fuzzy_grasp`, `hand:move_to` or `hand:move_dofs`
function sensed.apply(session)
  local hand = session.hand
  local has_glove, has_tracker = session.sensors.glove ~= nil, session.sensors.tracker ~= nil
  if has_glove and has_tracker then return clench.devices.fuzzy_grasp {hand = hand, pose = tracked_pose(session), dofs = glove_dofs(session)} end
  if has_tracker then return hand:move_to(tracked_pose(session)) end
  return hand:move_dofs(glove_dofs(session))
end

--- Condition of commands: is there a hand, and a glove or tracker with a reading?
function sensed.can_apply(session)
  if not session.hand then return false, "no hand is current" end
  local has_glove, has_tracker = sensors.has_reading "glove"(session), sensors.has_reading "tracker"(session)
  return has_glove or has_tracker, "neither a glove nor a tracker is connected"
end

-- number of readings so far
local function count(session)
  local glove, tracker = session.sensors.glove, session.sensors.tracker
  return (glove and glove.count or 0) + (tracker and tracker.count or 0)
end

-- one turn of `follow`; an error, such as a lost device, ends it, and becomes a diagnostic
local function turn(session, following)
  local now = count(session)
  if now == following.count and sensed.can_apply(session) then return end
  following.count = now
  local ok, problem = pcall(sensed.apply, session)
  if ok then return session:emit("changed", {following = true}) end
  session:end_gesture()
  if is_stopped(problem) then error(problem, 0) end
  session:emit("diagnostic", {severity = "error", text = error_text(problem), count = 1})
end

--- The current hand follows the readings while `clench.loop` runs, until the gesture ends; it is one step of undo.
function sensed.follow(session)
  local following = {}
  session:begin_gesture("Follow Sensors", nil, function() session.following = nil end)
  session.following = following
  clench.loop.spawn(function()
    while session.following == following do
      turn(session, following)
      clench.loop.sleep(pause)
    end
  end)
end

-- a mirror of the current hand; the device must have as many values as the hand has DOFs
local function mirror_of(session, device, max_speed)
  local given, expected = #sensors.reading(session, "hand"), #session.hand.dofs
  if given ~= expected then raise(("session: the real hand has %d DOFs, and %s has %d"):format(given, session.hand.name, expected)) end
  return clench.devices.mirror {hand = session.hand, device = device, max_speed = max_speed}
end

--- Moves the simulated hand to where the real one is, until contact.
function sensed.pull(session)
  local reading = sensors.reading(session, "hand")
  return mirror_of(session, {read = function() return reading end, move = function() end}):pull()
end

--- Raises an error if no real hand is connected.
function sensed.require_real_hand(session) sensors.reading(session, "hand") end

-- Has the simulated hand moved since the real one was there? Drags and playbacks count once they have ended, unless the on-line planner shapes both hands.
local function has_moved(session, hand, before)
  local shapes = session.online and session.online.shape_real
  if session.gesture and not shapes then return false end
  for d, value in ipairs(hand.dofs) do
    if value ~= before[d] then return true end
  end
  return false
end

--- Moves the real hand to where the simulated one is, while `clench.loop` runs.
---@param max_speed number [rad/s]
---@param continuous boolean  true: it follows until it is stopped
function sensed.push(session, max_speed, continuous)
  sensors.reading(session, "hand")
  local sensor, hand = session.sensors.hand, session.hand
  if sensor.task then raise "session: the real hand is already moving" end
  local mirror = mirror_of(session, sensor.device, max_speed)
  local arrived  -- DOFs at which the real hand is
  sensor.task = function()
    if arrived and not has_moved(session, hand, arrived) then return false end
    local goal = hand.dofs
    arrived = mirror:push() and goal or nil
    return arrived ~= nil and not continuous
  end
end

--- Stops the real hand.
function sensed.stop(session)
  sensors.reading(session, "hand")
  session.sensors.hand.task = function(device)
    device:stop()
    return true
  end
end

return sensed
