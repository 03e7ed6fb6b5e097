--- Commands of the Edit menu: the history of the session.
-- creating the first world is not a step that a user would undo
local function undoable(session)
  local last = session.history.done[#session.history.done]
  return session.gesture ~= nil or last ~= nil and last.before ~= nil and last.before.world ~= nil, "there is nothing to undo"
end

return {
  {name = "edit.undo", label = "Undo", menu = "Edit", shortcut = "ctrl+z", reads = true, enabled = undoable, run = function(session) return session:undo() end},
  {name = "edit.redo", label = "Redo", menu = "Edit", shortcut = "ctrl+shift+z", reads = true,
   enabled = function(session) return #session.history.undone > 0, "there is nothing to redo" end, run = function(session) return session:redo() end},
}
