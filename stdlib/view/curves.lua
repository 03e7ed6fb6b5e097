--- Curves of the current grasp over the last changes of the world: quality, contact forces, efforts of the motors.
local curves = {}

local max_points = 300  -- of a curve

--- The curves in the order of the panel: key and title.
curves.list = {{"epsilon", "epsilon"}, {"force", "sum of contact forces [N]"}, {"contacts", "contacts"}, {"effort", "motors, largest [N m or N]"}}

local function add(list, value)
  list[#list + 1] = value
  if #list > max_points then table.remove(list, 1) end
end

local function total_force(contacts)
  local total = 0
  for _, contact in ipairs(contacts) do total = total + (contact.force and contact.force:norm() or 0) end
  return total
end

local function largest(values)
  local largest = 0
  for _, value in ipairs(values) do largest = math.max(largest, math.abs(value)) end
  return largest
end

-- the effort of each motor of a hand; of another hand nothing is kept
local function add_efforts(all, hand)
  local efforts = hand.dof_efforts
  if all.hand ~= hand or #all.efforts ~= #efforts then
    all.hand, all.efforts = hand, {}
    for i = 1, #efforts do all.efforts[i] = {} end
  end
  for i, effort in ipairs(efforts) do add(all.efforts[i], effort) end
  add(all.effort, largest(efforts))
end

--- Adds the values of the present state, once after each change.
---@param view table  whose panel Grasp Quality has measured the grasp
function curves.sample(view)
  view.curves = view.curves or {epsilon = {}, force = {}, contacts = {}, effort = {}, efforts = {}}
  local quality, hand = view.quality, view.session.hand
  if not (quality and hand) or view.replay or view.plotted == view.stamp then return end
  view.plotted = view.stamp
  add(view.curves.epsilon, quality.measures.epsilon or 0)
  add(view.curves.force, total_force(quality.contacts))
  add(view.curves.contacts, #quality.contacts)
  add_efforts(view.curves, hand)
end

return curves
