--- Gestures: sequences of many small changes, such as a drag or a playback, that form one step of undo.
local history = require "clench.session.history"
local script = require "clench.session.script"
local gesture = {}

--- Begins a gesture, and ends the open one.
---@param label string  label of the undo step
---@param lines? fun(session: table, before: table): string  returns lines of Lua with the same effect, "" if nothing changed; by default the resulting poses and DOFs
---@param over? fun()  called when it ends or is cancelled
---@return table gesture
function gesture.begin(session, label, lines, over)
  gesture.finish(session)
  session.gesture = {label = label, lines = lines, over = over, before = history.state_of(session)}
  return session.gesture
end

-- closes the open gesture and returns it; nil if that is not the given one
local function take(session, given)
  local current = session.gesture
  if given and current ~= given then return nil end
  session.gesture = nil
  if current and current.over then current.over() end
  return current
end

--- Ends the open gesture, if there is one; without a change no undo step is added. If its result cannot be logged, the session is restored.
---@param given? table  nothing happens if another one is open
function gesture.finish(session, given)
  local current = take(session, given)
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
---@param given? table  nothing happens if another one is open
function gesture.cancel(session, given)
  local current = take(session, given)
  if not current then return end
  history.set_state(session, current.before)
  session:emit("changed", {cancelled = current.label})
end

return gesture
