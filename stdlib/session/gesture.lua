--- Gestures: sequences of many small changes, such as a drag or a playback, that form one step of undo.
local history = require "clench.session.history"
local script = require "clench.session.script"
local gesture = {}

--- Begins a gesture, and ends the open one.
---@param label string  label of the undo step
---@param lines? fun(): string  returns lines of Lua with the same effect, "" if nothing changed; by default the resulting poses and DOFs
---@param over? fun()  called when it ends or is cancelled
function gesture.begin(session, label, lines, over)
  gesture.finish(session)
  session.gesture = {label = label, lines = lines, over = over, before = history.state_of(session)}
end

-- closes the open gesture and returns it
local function take(session)
  local current = session.gesture
  session.gesture = nil
  if current and current.over then current.over() end
  return current
end

--- Ends the open gesture, if there is one; without a change no undo step is added. If its result cannot be logged, the session is restored.
function gesture.finish(session)
  local current = take(session)
  if not current then return end
  local ok, lines = pcall(current.lines or script.of_change, session, current.before)
  if not ok then
    history.set_state(session, current.before)
    error(lines, 0)
  end
  if lines == "" then return end
  history.add(session, {label = current.label, name = "gesture", before = current.before, lines = lines})
  session:emit("changed", {gesture = current.label})
end

--- Ends the open gesture and reverts its changes.
function gesture.cancel(session)
  local current = take(session)
  if not current then return end
  history.set_state(session, current.before)
  session:emit("changed", {cancelled = current.label})
end

return gesture
