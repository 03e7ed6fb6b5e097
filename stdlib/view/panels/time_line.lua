--- The time line: plays and records dynamics, and replays the recording.
local dialog = require "clench.view.dialog"
local replay = require "clench.view.replay"

local gray = {0.5, 0.5, 0.5}

local function command(view, ui, label, name, text)
  dialog.button(view, ui, label, name, {text = text})
  ui:same_line()
end

local function button(ui, label, text, enabled, f)
  ui:disabled(not enabled, function(ui)
    if ui:button(label .. "##replay") then f() end
  end)
  ui:tooltip(text)
  ui:same_line()
end

local function draw_speed(view, ui)
  local names, index = {}, 1
  for i, speed in ipairs(replay.speeds) do
    names[i] = ("speed %g"):format(speed)
    if speed == (view.replay_speed or 1) then index = i end
  end
  ui:width(100 * view.scale)
  local chosen, changed = ui:combo("##replay speed", index, names)
  if changed then view.replay_speed = replay.speeds[chosen] end
  ui:same_line()
end

local function draw_replay(view, ui, count)
  local state = view.replay
  local index = state and state.index or count + 1
  button(ui, "|<", "First state", count > 0, function() replay.show(view, 1) end)
  button(ui, "<", "State before", count > 0 and index > 1, function() replay.show(view, index - 1) end)
  button(ui, replay.is_playing(view) and "Stop" or "Replay", "Plays the recorded states; the world stays as it is", count > 0, function() replay.play(view) end)
  button(ui, ">", "Next state", index < count, function() replay.show(view, index + 1) end)
  button(ui, ">|", "Last state", count > 0, function() replay.show(view, count) end)
  draw_speed(view, ui)
  button(ui, "Present", "Shows the world as it is", state ~= nil, function() replay.leave(view) end)
end

local function draw_slider(view, ui, recording)
  local times = recording.times
  ui:width(-8)
  local shown = view.replay and times[view.replay.index] or times[#times]
  local time, changed = ui:slider("##time line", shown, {min = times[1], max = times[#times], format = "%.3f s"})
  if not changed then return end
  if view.replay then view.replay.plays = false end
  replay.show_time(view, time)
end

-- simulated seconds per second of the clock; nil in the first second
local function speed_of(playing)
  local passed = clench.loop.time() - playing.began
  return passed > 1 and playing.steps * playing.step / passed or nil
end

-- the text without recorded states
local function empty_text(session)
  local playing = session.playing
  if playing then
    local speed = speed_of(playing)
    return ("recording, %.3f s%s"):format(session.world.time, speed and speed < 0.9 * playing.speed and (", at %.2g of real time"):format(speed) or "")
  end
  return "Runs of the dynamics are recorded, and can be replayed here."
end

local function draw(ui, view)
  local session = view.session
  if not session.world then return ui:text("No world is open.", {color = gray}) end
  local recording = not session.playing and replay.recording(view) or nil
  local count = recording and #recording.times or 0
  command(view, ui, session.playing and "Pause Dynamics" or "Play Dynamics", "dynamics.play", "Plays the dynamics in real time; they are recorded")
  command(view, ui, "Step", "dynamics.step", "One step of dynamics")
  ui:text "  "
  ui:same_line()
  draw_replay(view, ui, count)
  command(view, ui, "Save Film…", "dynamics.save_film", "Saves the recorded run as a page, an image sequence or a film")
  ui:spacing()
  local present = ("%.3f s"):format(session.world.time)
  if count == 0 then return ui:text(empty_text(session), {color = gray}) end
  draw_slider(view, ui, recording)
  local state = view.replay
  ui:text(("%s   %d states from %.3f to %.3f s   present: %s"):format(state and ("state %d of %d, at %.3f s"):format(state.index, count, recording.times[state.index]) or "present",
          count, recording.times[1], recording.times[count], present), {color = gray})
end

return {name = "Time Line", place = "bottom", draw = draw}
