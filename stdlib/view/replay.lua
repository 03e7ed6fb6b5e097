--- Replay of the session's recorded run: the picture shows a recorded state, on a copy of the world. The session's world stays as it is, and is shown again
--- when the replay is left, or when something changes it.
local handles = require "clench.view.handles"
local replay = {}

replay.speeds = {0.1, 0.25, 0.5, 1, 2, 4}

--- The recording of the open world; nil if there is none with two states or more.
function replay.recording(view)
  local recording = view.session.recording
  if recording and recording.world == view.session.world and #recording.times > 1 then return recording end
end

--- The world that the picture shows: a recorded state, or the session's world.
function replay.world(view) return view.replay and view.replay.world or view.session.world end

--- The counterpart of a body or robot of the session's world in the world that the picture shows; nil if it was added after the recorded run.
function replay.shown(view, thing)
  if not view.replay then return thing end
  local ok, there = pcall(thing.in_world, thing, view.replay.world)
  return ok and there or nil
end

--- The hit of a ray in the shown world, with the body of the session's world; nil if that body has been removed since.
function replay.to_live(view, hit)
  if not view.replay then return hit end
  local ok, body = pcall(hit.body.in_world, hit.body, view.session.world)
  if not ok then return nil end
  hit.body = body
  return hit
end

--- Shows a recorded state.
---@param index integer  the nearest one is shown if it does not exist
function replay.show(view, index)
  local recording = replay.recording(view)
  if not recording then return end
  local state = view.replay
  if not state or state.recording ~= recording then state = {recording = recording, world = recording.world:clone()} end
  state.index = math.max(1, math.min(#recording.times, index))
  state.time = recording.times[state.index]
  state.world:restore(recording.moments[state.index])
  view.replay = state
  view:changed()
end

--- Shows the recorded state nearest to a time [s].
function replay.show_time(view, time)
  local recording = replay.recording(view)
  local best = 1
  for i, t in ipairs(recording.times) do
    if math.abs(t - time) < math.abs(recording.times[best] - time) then best = i end
  end
  replay.show(view, best)
end

--- Shows the session's world again.
function replay.leave(view)
  if not view.replay then return end
  view.replay = nil
  view:changed()
end

--- Is the replay running?
function replay.is_playing(view) return view.replay ~= nil and view.replay.plays == true end

--- Starts and stops the replay; from the last state it starts at the first.
function replay.play(view)
  if replay.is_playing(view) then
    view.replay.plays = false
    return
  end
  local state, recording = view.replay, replay.recording(view)
  if not state or state.index == #recording.times then replay.show(view, 1) end
  view.replay.plays = true
  view.needs_frame = true
end

--- Shows the state for the present time of the replay, while it is running.
---@param dt number  time since the last frame [s]
function replay.advance(view, dt)
  if not replay.is_playing(view) then return end
  local state = view.replay
  local times = state.recording.times
  local time, index = state.time + dt * (view.replay_speed or 1), state.index
  while index < #times and times[index + 1] <= time + 1e-9 do index = index + 1 end
  if index ~= state.index then replay.show(view, index) end
  state.time = time
  if index == #times then state.plays = false end
  view.needs_frame = true
end

--- Marks the picture as that of a recorded state.
function replay.draw(view, ui)
  if not view.replay then return end
  handles.label(ui, view.ui.size[1] / 2 - 90, 72, ("recorded state, %.3f s"):format(view.replay.recording.times[view.replay.index]))
end

return replay
