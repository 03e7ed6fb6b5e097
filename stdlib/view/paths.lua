--- Files to choose from below the path of a dialog: recent ones, those that come with Clench, and those of the folder that the text names.
local contains = require "clench.contains"
local error_text = require "clench.error_text"
local in_utf8 = require "clench.in_utf8"
local printable = require "clench.printable"
local with_ending = require "clench.session.with_ending"
local paths = {}

local rows = 8            -- of the list that are visible
local max_choices = 300
local period = 1          -- a folder is read again after this time [s]
local gray = {0.5, 0.5, 0.5}

-- the models and worlds that come with Clench; without their folder, the reason is shown once, and other files remain
local function catalog_of(view)
  if not view.catalog then
    local ok, found = pcall(clench.catalog)
    view.catalog = ok and found or {}
    if not ok then view:fail(found) end
  end
  return view.catalog
end

-- contents of a folder, with the problem if it cannot be read
local function listed(view, folder)
  local old, now = view.listed, clench.clock()
  if old and old.folder == folder and now - old.at < period then return old end
  local ok, found = pcall(clench.files.list, folder)
  view.listed = {folder = folder, at = now, folders = ok and found.folders or {}, files = ok and found.files or {}, problem = not ok and error_text(found) or nil,
                 kinds = old and old.folder == folder and old.kinds or {}}
  return view.listed
end

-- is a file of a kind or with an ending that the command reads or writes?
local function is_listed(files, name, path, kinds)
  if files.endings then return contains(files.endings, (name:match "%.[^.]*$" or ""):lower()) end
  if not files.kinds then return true end
  if kinds[path] == nil then
    local ok, kind = pcall(clench.file_kind, path)
    kinds[path] = ok and kind
  end
  return contains(files.kinds, kinds[path])
end

-- "../" for "./", "a/" for "a/b/"; nil for "/"
local function above(folder)
  if folder == "./" then return "../" end
  if folder:find "%.%./$" then return folder .. "../" end
  local up = folder:match "^(.-)[^/]+/+$"
  return up == "" and "./" or up
end

-- entries of a folder whose names contain a text
local function add_entries(view, add, files, folder, part)
  local found = listed(view, folder == "" and "./" or folder)
  if folder == "./" then folder = "" end
  local function matches(name) return (name:sub(1, 1) ~= "." or part:sub(1, 1) == ".") and name:lower():find(part, 1, true) end
  for _, name in ipairs(found.folders) do
    if matches(name) then add(folder .. name .. "/", name .. "/") end
  end
  for _, name in ipairs(found.files) do
    if matches(name) and is_listed(files, name, folder .. name, found.kinds) and not add(folder .. name, name) then return end
  end
end

-- recent files, and those that come with Clench, whose paths contain a text
local function add_known(view, add, files, part)
  if files.writes then return end
  local function try(path)
    if path:lower():find(part, 1, true) then add(path, path) end
  end
  if contains(files.kinds or {}, "world") then
    for _, path in ipairs(view.recent) do try(path) end
  end
  for _, kind in ipairs(files.catalog or {}) do
    for _, path in ipairs(catalog_of(view)[kind] or {}) do try(path) end
  end
end

--- The choices for a text. With a slash it names a folder, whose entries come first; otherwise recent files and those that come with Clench do. For a file that is written they are
--- all entries of the folder.
---@param files table  `files` of the command's parameter
---@return {path: string, label: string}[] choices
---@return string? problem  why the folder has none
function paths.choices(view, files, typed)
  local list, seen = {}, {}
  local function add(path, label)
    if #list > max_choices then return false end
    if not seen[path] then seen[path], list[#list + 1] = true, {path = path, label = label} end
    return true
  end
  local folder, part = typed:match "^(.*/)([^/]*)$"
  if files.writes then folder, part = folder or "./", "" end
  if folder then
    local up = part == "" and above(folder)
    if up then add(up, "../") end
    add_entries(view, add, files, folder, part:lower())
    local problem = view.listed.problem
    add_known(view, add, files, typed:lower())
    return list, problem
  end
  if typed == "" then add("./", "./  (this folder)") end
  add_known(view, add, files, typed:lower())
  if typed ~= "" then add_entries(view, add, files, "", typed:lower()) end
  return list
end

--- Draws the list.
---@param state table  kept by the dialog for this list
---@param typed string  text of the field
---@param lines? number  by which the list is shorter
---@return string? path  was chosen
---@return boolean accepted  by a double click
function paths.draw(view, ui, files, state, typed, lines)
  -- the list stays as it is when a file of it is chosen
  if typed ~= state.chosen then state.filter, state.chosen = typed, nil end
  local list, problem = paths.choices(view, files, state.filter)
  local chosen, accepted = nil, false
  ui:child("files", {height = (rows - (lines or 0)) * (ui.line_height - 4), border = true}, function(ui)
    if problem then ui:text(printable(problem), {color = gray, wrap = true}) end
    if #list > max_choices then ui:text(("the first %d: type a part of the name for others"):format(max_choices), {color = gray}) end
    for i = 1, math.min(#list, max_choices) do
      local choice = list[i]
      if ui:selectable(printable(in_utf8(("%s##file%d"):format(choice.label, i))), choice.path == typed) then chosen = choice.path end
      accepted = accepted or ui:hovered() and ui.mouse.left.double and choice.path == typed
    end
  end)
  if chosen and chosen:sub(-1) ~= "/" then state.chosen = chosen end
  return chosen, accepted and typed:sub(-1) ~= "/"
end

--- The file that would be replaced by writing to a path; nil if there is none.
---@return string? file
function paths.replaced(files, path)
  if not files.writes or type(path) ~= "string" then return nil end
  if files.ending then path = with_ending(path, files.ending) end
  local folder, name = path:match "^(.*/)([^/]*)$"
  local ok, found = pcall(clench.files.list, folder or "./")
  return ok and contains(found.files, name or path) and path or nil
end

--- Draws the question before a file is replaced, as long as the path is the same.
---@param question? {path: string, file: string}
---@return table? question  nil: it is no longer open
function paths.draw_question(ui, question, path)
  if not question or question.path ~= path then return nil end
  ui:text(printable(question.file) .. " exists. Replace it?", {color = {0.84, 0.37, 0}, wrap = true})
  return question
end

return paths
