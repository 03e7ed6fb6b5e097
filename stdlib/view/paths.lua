--- Files to choose from below the path of a dialog: models and worlds that come with Clench, and recent files.
local paths = {}

local rows = 6  -- of the list that are visible

-- kinds of the catalog that a command reads
local kinds = {["world.open"] = {"worlds"}, ["world.import_robot"] = {"hands", "arms"}, ["world.import_object"] = {"objects"}, ["world.import_obstacle"] = {"obstacles"}}

local function add(list, seen, path, typed)
  if seen[path] or not path:lower():find(typed, 1, true) then return end
  seen[path], list[#list + 1] = true, path
end

-- the models and worlds that come with Clench; without their folder, the reason is shown once, and recent files remain
local function catalog_of(view)
  if not view.catalog then
    local ok, found = pcall(clench.catalog)
    view.catalog = ok and found or {}
    if not ok then view:fail(found) end
  end
  return view.catalog
end

--- The files for a command whose paths contain a text; all files if the text is one of them.
---@param command table  of the session
---@param typed string
---@return string[] paths
function paths.choices(view, command, typed)
  local list, seen = {}, {}
  local catalog = catalog_of(view)
  for _, kind in ipairs(kinds[command.name] or {}) do
    for _, path in ipairs(catalog[kind] or {}) do
      if path == typed then typed = "" end
    end
  end
  for _, path in ipairs(command.name == "world.open" and view.recent or {}) do add(list, seen, path, typed:lower()) end
  for _, kind in ipairs(kinds[command.name] or {}) do
    for _, path in ipairs(catalog[kind] or {}) do add(list, seen, path, typed:lower()) end
  end
  return list
end

--- Draws the list; a click on a file puts its path into the field.
---@param state table  of the dialog, with the texts of its fields
function paths.draw(view, ui, command, state)
  if not kinds[command.name] then return end
  local list = paths.choices(view, command, state.texts.path or "")
  if #list == 0 then return end
  ui:child("files", {height = rows * (ui.line_height - 4)}, function(ui)
    for _, path in ipairs(list) do
      if ui:selectable(path, path == state.path) then state.texts.path, state.path = path, path end
    end
  end)
end

return paths
