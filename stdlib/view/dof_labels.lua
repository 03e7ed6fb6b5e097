--- Descriptions of DOFs by the joints that they move: by the names of these, if the file gives any, otherwise by fingers, counted from 1, and by the places of
--- the joints in them, counted from the base.
local dof_labels = {}

-- "joint 1", "joints 1, 2"
local function counted(noun, numbers)
  return #numbers > 0 and ("%s%s %s"):format(noun, #numbers > 1 and "s" or "", table.concat(numbers, ", ")) or ""
end

local function add_once(list, value)
  for _, known in ipairs(list) do
    if known == value then return end
  end
  list[#list + 1] = value
end

-- for each DOF its fingers, the places and the names of its joints, and the kind of the first one
local function moved_by(robot)
  local moved = {}
  for i = 1, #robot.dof_names do moved[i] = {fingers = {}, places = {}, names = {}} end
  for c, chain in ipairs(robot.chains) do
    for j, joint in ipairs(chain.joints) do
      local entry = moved[joint.dof]
      if entry then
        entry.kind = entry.kind or joint.kind
        add_once(entry.fingers, c)
        add_once(entry.places, j)
        if joint.name then add_once(entry.names, joint.name) end
      end
    end
  end
  for _, entry in ipairs(moved) do table.sort(entry.places) end
  return moved
end

--- Labels of the DOFs of a robot. `text`: the name and, if that says more, what moves, as in "dof1 (fingers 1, 2: joint 1)"; `finger`: the fingers that it
--- moves, "" of a single chain; `short`: the name and the joints; `unit`: "m" or "rad".
---@param robot robot
---@return {name: string, text: string, finger: string, short: string, unit: string}[]
function dof_labels.of(robot)
  local labels, names, count = {}, robot.dof_names, #robot.chains
  for i, entry in ipairs(moved_by(robot)) do
    local name = names[i]
    local finger = count > 1 and counted("finger", entry.fingers) or ""
    local joints = #entry.names > 0 and table.concat(entry.names, ", ") or counted("joint", entry.places)
    if joints == name then joints = "" end
    local moves = #entry.names > 0 and joints or finger ~= "" and ("%s: %s"):format(finger, joints) or joints
    labels[i] = {name = name, finger = finger, short = joints ~= "" and ("%s %s"):format(name, joints) or name,
                 text = moves ~= "" and ("%s (%s)"):format(name, moves) or name, unit = entry.kind == "prismatic" and "m" or "rad"}
  end
  return labels
end

return dof_labels
