--- The recording of a session's last run: states of the world at a rate in simulation time, as stored by world:record.
local recorded = {}

local rate = 30  -- states per second of simulation time [Hz]
local max_states = 10000  -- maximum number of states of one recording

--- Records the world until `recorded.stop`; the recording becomes `session.recording`.
---@param seconds? number  length of the run, if it is known: a long one is recorded at a lower rate
function recorded.start(session, seconds)
  recorded.stop(session)
  session.recording = session.world:record {rate = seconds and math.min(rate, max_states / math.max(seconds, 1)) or rate}
end

--- Ends the recording; its states are kept.
function recorded.stop(session)
  if session.recording then session.recording:remove() end
end

--- Ends a recording that has become too long.
function recorded.check(session)
  if #session.recording.times >= max_states then recorded.stop(session) end
end

return recorded
