--- Transparent hands in the picture: states of the on-line planner's search, and its nearest grasp.
local ghosts = {}

ghosts.colors = {search = {0.90, 0.62, 0.0}, solution = {0, 0.55, 0.45}}

-- a copy of the hand in the posture; kept while the posture is the same
local function ghost(view, kind, hand, pose, dofs)
  local kept = view.ghosts[kind]
  if not kept or kept.hand ~= hand then
    local world = hand.world:clone()
    local copy = hand:in_world(world)
    if copy.parent then copy:dismount() end
    kept = {hand = hand, copy = copy}
    view.ghosts[kind] = kept
  end
  kept.copy:set_posture(pose, dofs)
  return {robot = kept.copy, color = ghosts.colors[kind]}
end

--- The ghosts to be drawn, as an option of `ui:show`; nil: not shown.
function ghosts.of(view)
  local online = view.session.online
  if not online or online.world ~= view.session.world or view.replay then
    view.ghosts = {}
    return nil
  end
  local list = {}
  if view.shows_search and online.search then list[#list + 1] = ghost(view, "search", online.hand, online.search.pose, online.search.dofs) end
  if view.shows_solution and online.nearest then
    local grasp = online.nearest.grasp
    list[#list + 1] = ghost(view, "solution", online.hand, online.object.pose * grasp.pose, grasp.dofs)
  end
  return #list > 0 and list or nil
end

return ghosts
