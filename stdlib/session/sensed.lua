--- The simulated hand of a session and its devices: a glove and a tracker move the hand; the real hand and the simulated one follow each other.
local birds = require "clench.session.birds"
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local raise = require "clench.raise"
local real_hands = require "clench.session.real_hands"
local sensors = require "clench.session.sensors"
local sensed = {}

local pause = 0.01  -- between two turns of following [s]

-- DOFs of the hand by the readings of the glove
local function glove_dofs(session)
  local raw = sensors.reading(session, "glove")
  local state = session.sensors
  return clench.devices.glove_map {hand = session.hand, calibration = state.calibration or session.hand.glove, dofs = state.dofs} (raw)
end

-- moves the current hand; nil if no device does
local function apply_to_hand(session)
  local hand = session.hand
  local bird = session.sensors.tracker and birds.of_hand(session)
  if session.sensors.glove and bird then return clench.devices.fuzzy_grasp {hand = hand, pose = birds.pose(session, bird), dofs = glove_dofs(session)} end
  if bird then return hand:move_to(birds.pose(session, bird)) end
  if session.sensors.glove then return hand:move_dofs(glove_dofs(session)) end
end

--- Moves what the devices move to the last readings: the current hand, with a tracker and a glove as a fuzzy grasp, with one of them until contact; and
--- the bodies, robots and the camera that further birds move.
---@return table result  of `clench.devices.fuzzy_grasp`, `hand:move_to` or `hand:move_dofs`; `birds`: those of other bodies and robots, by bird
function sensed.apply(session)
  local others = session.sensors.tracker and birds.of_others(session) or {}
  local moved = {}
  for _, bird in ipairs(others) do moved[bird] = birds.move(session, bird) end
  local result = apply_to_hand(session) or {}
  if next(moved) ~= nil then result.birds = moved end
  return result
end

--- Condition of commands: is there a device with a reading, and something that it moves?
function sensed.can_apply(session)
  local has_glove, has_tracker = sensors.has_reading "glove"(session), sensors.has_reading "tracker"(session)
  if has_tracker and #birds.of_others(session) > 0 then return true end
  if not session.hand then return false, "no hand is current" end
  if has_tracker and not has_glove and not birds.of_hand(session) then return false, "no bird of the tracker moves anything" end
  return has_glove or has_tracker, "neither a glove nor a tracker is connected"
end

-- number of readings so far
local function count(session)
  local glove, tracker = session.sensors.glove, session.sensors.tracker
  return (glove and glove.count or 0) + (tracker and tracker.count or 0)
end

local function report(session, problem)
  if is_stopped(problem) then error(problem, 0) end
  session:emit("diagnostic", {severity = "error", text = error_text(problem), count = 1})
end

-- one turn of `follow`; an error, such as a lost device, ends it, and becomes a diagnostic
local function turn(session, following)
  local now = count(session)
  if now == following.count and sensed.can_apply(session) then return end
  following.count = now
  local ok, problem = pcall(sensed.apply, session)
  if ok then return session:emit("changed", {following = true}) end
  report(session, problem)
  local ended, why = pcall(session.end_gesture, session)
  if not ended then report(session, why) end
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

-- DOFs of the hand that correspond to the values of the real one
local function dofs_of(session, sensor)
  local given, expected = #sensors.reading(session, "hand"), #session.hand.dofs
  local dofs = sensor.options.dofs
  if dofs and #dofs ~= given then raise(("session: the real hand has %d values, and was connected with %d dofs"):format(given, #dofs)) end
  if not dofs and given ~= expected then
    raise(("session: the real hand has %d DOFs, and %s has %d: connect it with dofs"):format(given, session.hand.name, expected))
  end
  if dofs then return dofs end
  dofs = {}
  for d = 1, expected do dofs[d] = d end
  return dofs
end

-- a mirror of the current hand
local function mirror_of(session, device, max_speed)
  local sensor, hand = session.sensors.hand, session.hand
  local dofs = dofs_of(session, sensor)
  local options = {hand = hand, device = device, max_speed = max_speed, dofs = dofs, signs = sensor.options.signs, offsets = sensor.options.offsets}
  -- numbers of DOFs are checked before their ranges are used
  local mirror = clench.devices.mirror(options)
  if not real_hands.drivers[sensor.options.driver].fractions then return mirror end
  options.device = real_hands.scaled(device, hand, dofs)
  return clench.devices.mirror(options)
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

--- Stops the real hand; a Barrett hand also while it replies to nothing else, because it moves.
function sensed.stop(session)
  sensors.reading(session, "hand")
  local sensor = session.sensors.hand
  sensor.task = function(device)
    device:stop()
    return true
  end
  if not sensor.device.is_waiting then return end
  clench.loop.spawn(function()
    local ok, problem = pcall(sensor.device.stop, sensor.device)
    if not ok and is_stopped(problem) then error(problem, 0) end
  end)
end

return sensed
