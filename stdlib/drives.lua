--- Messages about the motors of a hand: DOFs that no motor closes, and motors without an effort limit.
local name_list = require "clench.name_list"
local drives = {}

-- names of the DOFs for which `holds` is true
local function names_of(hand, holds)
  local names, ranges = {}, hand.effort_ranges
  for i, info in ipairs(hand.dof_info) do
    if holds(info, ranges[i]) then names[#names + 1] = hand.dof_names[i] end
  end
  return names
end

local function closes(info) return info.default_velocity ~= 0 end

-- Does a motor close any DOF?
function drives.close(hand)
  return #names_of(hand, function(info) return info.can_close end) > 0
end

-- Names the closing DOFs that no motor closes; nil if there are none. If no DOF is known to close the hand, all DOFs count.
--@return string?
function drives.missing(hand)
  local any_closes = #names_of(hand, closes) > 0
  local undriven = names_of(hand, function(info) return (closes(info) or not any_closes) and not info.driven end)
  local opening = names_of(hand, function(info) return closes(info) and info.driven and not info.can_close end)
  local parts = {}
  if #undriven > 0 then parts[1] = "no motor drives " .. name_list(undriven) end
  if #opening > 0 then parts[#parts + 1] = "motors that cannot pull in the closing direction drive " .. name_list(opening) end
  return #parts > 0 and table.concat(parts, "; ") or nil
end

-- The reason why a closed hand exerts no grip force; nil if a motor closes it, or if no DOF closes.
--@return string?
function drives.no_force(hand)
  local missing = drives.missing(hand)
  if not missing or drives.close(hand) then return nil end
  return ("no grasp of %s can be verified, as it exerts no force: %s"):format(hand.name, missing)
end

-- Does the hand have neither motors nor springs? Then its links exert no forces.
function drives.is_inert(hand)
  for _, info in ipairs(hand.dof_info) do
    if info.driven then return false end
  end
  for _, chain in ipairs(hand.chains) do
    for _, joint in ipairs(chain.joints) do
      if (joint.spring or 0) > 0 then return false end
    end
  end
  return true
end

-- Names of the DOFs whose motors have no limit; nil if all have limits.
--@return string[]?
function drives.unlimited(hand)
  local names = names_of(hand, function(_, range) return range[1] == -math.huge or range[2] == math.huge end)
  return #names > 0 and names or nil
end

-- States that these efforts have no limit.
--@param names string[]?  of drives.unlimited
--@return string?
function drives.unlimited_text(names)
  return names and ("effort of %s %s: unlimited (none given)"):format(#names == 1 and "joint" or "joints", name_list(names)) or nil
end

return drives
