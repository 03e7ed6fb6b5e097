--- Conditions of the availability of commands: each returns a boolean, and the reason if it is false.
local conditions = {}

function conditions.world(session) return session.world ~= nil, "no world is open" end

function conditions.hand(session) return session.hand ~= nil, "no hand is current" end

function conditions.hand_and_object(session)
  if not session.hand then return false, "no hand is current" end
  return session.object ~= nil, "no object is current"
end

return conditions
