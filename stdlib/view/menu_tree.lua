--- Commands of a session as a tree of menus and submenus, with the entries of each in sections.
local menu_tree = {}

local last = math.huge  -- section of entries without one

local function label_of(command) return command.label or command.name end

-- the node of a menu below another one; a new one if there is none
local function child(node, name)
  for _, item in ipairs(node.items) do
    if item.items and item.name == name then return item end
  end
  local new = {name = name, items = {}, section = last}
  node.items[#node.items + 1] = new
  return new
end

local function insert(root, path, command)
  local node, section = root, command.section or last
  for name in path:gmatch "[^/]+" do
    node = child(node, name)
    node.section = math.min(node.section, section)
  end
  node.items[#node.items + 1] = {command = command, section = section}
end

--- Sorts the entries of a menu by their sections; within a section they stay in order.
---@param items {section: number}[]
---@return table[] items
function menu_tree.sorted(items)
  local order, list = {}, {}
  for i, item in ipairs(items) do order[item], list[i] = i, item end
  table.sort(list, function(a, b)
    if a.section ~= b.section then return a.section < b.section end
    return order[a] < order[b]
  end)
  return list
end

--- The menus of the session's commands: nodes with a name and items, which are nodes or have a command, each with its section.
---@return {name: string, items: table[], section: number}[]
function menu_tree.of(session)
  local root = {items = {}}
  for _, menu in ipairs(session:menus()) do
    for _, command in ipairs(menu.commands) do insert(root, menu.name, command) end
  end
  return root.items
end

--- The path of a command's entry, given that of its menu and label without submenus: "Grasp/Posture/Save Posture" of "Grasp/Save Posture".
---@return string path  unchanged if no command, or more than one, has this label in submenus of the menu, or one has it in the menu itself
function menu_tree.complete(session, path)
  local found
  for _, menu in ipairs(session:menus()) do
    for _, command in ipairs(menu.commands) do
      local label = label_of(command)
      if menu.name .. "/" .. label == path then return path end
      if menu.name:match "^[^/]+" .. "/" .. label == path then
        if found then return path end
        found = menu.name .. "/" .. label
      end
    end
  end
  return found or path
end

return menu_tree
