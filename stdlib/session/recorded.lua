--- The recording of a session's last run: states of the world at a rate in simulation time, as stored by world:record.
local recorded = {}

local rate = 30  -- states per second of simulation time [Hz]
local max_states = 10000  -- maximum number of states of one recording

--- Records the world until `recorded.stop`; the recording becomes `session.recording`.
---@param seconds? number  length of the run, if it is known: a long one is recorded at a lower rate
function recorded.start(session, seconds)
  recorded.stop(session)
  session.recording = session.world:record {rate = seconds and math.min(rate, max_states / math.max(seconds, 1)) or rate}
  session.recorded_now = session.recording
end

-- adds the state in which the run ended, if it is between two states of the rate
local function add_last(session, recording)
  local world, times = session.world, recording.times
  if recording.world ~= world or not times[1] or world.time <= times[#times] then return end
  times[#times + 1] = world.time
  recording.moments[#recording.moments + 1] = world:snapshot()
end

--- Ends the recording; its states are kept, and the last one is that in which the run ended.
function recorded.stop(session)
  local recording = session.recording
  if not recording or recording ~= session.recorded_now then return end
  session.recorded_now = nil
  recording:remove()
  add_last(session, recording)
end

--- Ends a recording that has become too long.
function recorded.check(session)
  if #session.recording.times >= max_states then recorded.stop(session) end
end

return recorded
