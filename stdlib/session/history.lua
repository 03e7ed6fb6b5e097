--- Undo: the states of a session between its commands. A state has the world's handle and a clone of the world, so that handles in a script stay valid after
--- undo, including those of removed bodies.
local contains = require "clench.contains"
local history = {}

local max_states = 1000  -- maximum number of states that can be undone; clones share meshes and unchanged data

function history.new() return {done = {}, undone = {}} end

-- The first robot with fingers; an arm has a single chain. Otherwise the first robot.
local function first_hand(world)
  for _, robot in ipairs(world.robots) do
    if #robot.chains > 1 then return robot end
  end
  return world.robots[1]
end

--- The present state of the session, before a command changes it.
function history.state_of(session)
  return {world = session.world, clone = session.world and session.world:clone(), hand = session.hand, object = session.object, path = session.path,
          selection = {table.unpack(session.selection)}, stack = {table.unpack(session.stack)}}
end

function history.set_state(session, state)
  if state.world then state.world:become(state.clone) end
  session.world, session.hand, session.object, session.path = state.world, state.hand, state.object, state.path
  session.selection, session.stack = {table.unpack(state.selection)}, {table.unpack(state.stack)}
end

--- Opens a world; its first hand and object become the current ones.
function history.take(session, world)
  session.world, session.selection, session.stack = world, {}, {}
  session.hand, session.object = first_hand(world), world.objects[1]
end

--- Removes bodies and robots that are no longer in the world from hand, object and selection.
function history.refresh(session)
  local world = session.world
  if not world then return end
  local robots, objects = world.robots, world.objects
  if not contains(robots, session.hand) then session.hand = first_hand(world) end
  if not contains(objects, session.object) then session.object = objects[1] end
  if #session.selection == 0 then return end
  local bodies = world.bodies
  local kept = {}
  for _, item in ipairs(session.selection) do
    if contains(bodies, item) or contains(robots, item) then kept[#kept + 1] = item end
  end
  if #kept < #session.selection then session.selection = kept end
end

function history.add(session, entry)
  history.refresh(session)
  local done = session.history.done
  done[#done + 1] = entry
  if #done > max_states then done[#done - max_states].before = nil end
  session.history.undone = {}
end

function history.undo(session)
  local done, undone = session.history.done, session.history.undone
  local entry = done[#done]
  if not entry or not entry.before then return nil end
  done[#done] = nil
  entry.after = history.state_of(session)
  undone[#undone + 1] = entry
  history.set_state(session, entry.before)
  return entry.label
end

function history.redo(session)
  local done, undone = session.history.done, session.history.undone
  local entry = table.remove(undone)
  if not entry then return nil end
  history.set_state(session, entry.after)
  entry.after = nil
  done[#done + 1] = entry
  return entry.label
end

return history
