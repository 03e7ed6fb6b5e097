--- Conditions under which commands are available: each returns whether it holds, and the reason why not.
local conditions = {}

function conditions.world(session) return session.world ~= nil, "no world is open" end

function conditions.hand(session) return session.hand ~= nil, "no hand is current" end

function conditions.hand_and_object(session)
  if not session.hand then return false, "no hand is current" end
  return session.object ~= nil, "no object is current"
end

return conditions
