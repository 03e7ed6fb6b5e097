--- Files to choose from below the path of a dialog: recent ones, those that come with Clench, and those of the folder that the text names.
local contains = require "clench.contains"
local error_text = require "clench.error_text"
local in_utf8 = require "clench.in_utf8"
local label = require "clench.view.label"
local printable = require "clench.printable"
local with_ending = require "clench.session.with_ending"
local paths = {}

local rows = 8            -- of the list that are visible
local max_choices = 300
local period = 1          -- a folder is read again after this time [s]
local longest = 0.02      -- time per frame for the kinds of files [s]
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

-- Is a file of a kind or with an ending that the command reads or writes? nil: its kind was not determined, as that takes long for many files.
local function is_listed(files, name, path, kinds, deadline)
  if files.endings then return contains(files.endings, (name:match "%.[^.]*$" or ""):lower()) end
  if not files.kinds then return true end
  if kinds[path] == nil then
    if clench.clock() > deadline then return nil end
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

-- Folder name for `clench.files.list`; writing never resolves to the installed models.
local function listed_name(files, folder)
  if folder == "" then return "./" end
  return files.writes and folder:sub(1, 1) ~= "/" and "./" .. folder or folder
end

-- Entries of a folder whose names contain a text. Returns the problem of one that cannot be read, and whether the kinds of some files are not known yet.
local function add_entries(add, files, folder, part, kinds)
  local ok, found = pcall(clench.files.list, listed_name(files, folder))
  if not ok then return error_text(found) end
  if folder == "./" then folder = "" end
  local deadline, is_incomplete = clench.clock() + longest, false
  local function matches(name) return (name:sub(1, 1) ~= "." or part:sub(1, 1) == ".") and name:lower():find(part, 1, true) end
  for _, name in ipairs(found.folders) do
    if matches(name) then add(folder .. name .. "/", name .. "/") end
  end
  for _, name in ipairs(found.files) do
    local listed = matches(name) and is_listed(files, name, folder .. name, kinds, deadline)
    is_incomplete = is_incomplete or listed == nil
    if listed and not add(folder .. name, name) then break end
  end
  return nil, is_incomplete
end

-- recent files, and those that come with Clench, whose paths contain a text
local function add_known(view, add, files, part)
  if files.writes then return end
  local function try(path)
    if path:lower():find(part, 1, true) then add(path, path) end
  end
  if contains(files.catalog or {}, "worlds") then
    for _, path in ipairs(view.recent) do try(path) end
  end
  for _, kind in ipairs(files.catalog or {}) do
    for _, path in ipairs(catalog_of(view)[kind] or {}) do try(path) end
  end
end

--- The choices for a text. With a slash it names a folder, whose entries come first; otherwise recent files and those that come with Clench do. For a file that is written they are
--- all entries of the folder.
---@param files table  `files` of the command's parameter
---@param kinds? table<string, string|false>  kinds of files that are known, and those that become known
---@return {path: string, label: string}[] choices
---@return string? problem  why the folder cannot be listed
---@return boolean? is_incomplete  another call finds more
function paths.choices(view, files, typed, kinds)
  kinds = kinds or {}
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
    local problem, is_incomplete = add_entries(add, files, folder, part:lower(), kinds)
    add_known(view, add, files, typed:lower())
    return list, problem, is_incomplete
  end
  if typed == "" then add("./", "./  (this folder)") end
  add_known(view, add, files, typed:lower())
  if typed == "" then return list end
  local _, is_incomplete = add_entries(add, files, "", typed:lower(), kinds)
  return list, nil, is_incomplete
end

-- the choices for the text of a list, computed again after a while
local function current_choices(view, files, state)
  local now = clench.clock()
  if state.listed ~= state.filter or now - state.at > period then
    state.kinds = state.kinds or {}
    local is_incomplete
    state.list, state.problem, is_incomplete = paths.choices(view, files, state.filter, state.kinds)
    state.listed, state.at = not is_incomplete and state.filter, now
    view.needs_frame = view.needs_frame or is_incomplete or false
  end
  return state.list, state.problem
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
  local list, problem = current_choices(view, files, state)
  local chosen, accepted = nil, false
  -- a further press at the same place would hit an entry of the folder that the first one has opened
  if ui.mouse.left.clicked then state.is_again = ui.mouse.left.again end
  local is_double = ui.mouse.left.double
  ui:child("files in " .. (state.filter:match "^.*/" or ""), {height = (rows - (lines or 0)) * (ui.line_height - 4), border = true}, function(ui)
    if problem then ui:text(printable(problem), {color = gray, wrap = true}) end
    if #list > max_choices then ui:text(("the first %d: type a part of the name for others"):format(max_choices), {color = gray}) end
    for i = 1, math.min(#list, max_choices) do
      local choice = list[i]
      if ui:selectable(label(choice.label, "file" .. i), choice.path == typed) and not state.is_again then chosen = choice.path end
      accepted = accepted or is_double and ui:hovered() and choice.path == typed
    end
  end)
  if chosen and chosen:sub(-1) ~= "/" then state.chosen = chosen end
  return chosen, accepted and typed:sub(-1) ~= "/"
end

-- true if the path exists, nil if that cannot be found out, as under --confine
local function exists(path)
  local ok, found = pcall(clench.files.exists, path)
  if ok then return found end
end

--- Question before a file is replaced or a folder is created; nil if neither happens.
---@return {path: string, text: string, button: string, prepare?: fun()}? question
function paths.question(files, path)
  if not files.writes or type(path) ~= "string" or path == "" or path:find "/$" then return nil end
  local file = files.ending and with_ending(path, files.ending) or path
  local folder = file:match "^(.+)/"
  if folder and exists(folder) == false then
    return {path = path, text = folder .. " does not exist. Create it?", button = "Create", prepare = function() clench.files.make_folder(folder) end}
  end
  local first = files.first and files.first(file) or file
  local found = exists(first)
  if found == nil then return {path = path, text = first .. " may exist. Write it?", button = "Write"} end
  return found and {path = path, text = first .. " exists. Replace it?", button = "Replace"} or nil
end

--- Draws a question, as long as the path is the same, and the button of a dialog.
---@param question? table
---@param path any  value of the field that the question is about
---@param button string  label of the button without a question
---@return table? question  nil: it is no longer open
---@return boolean pressed  the button, but not by a double click on what was there before the question
function paths.draw_button(ui, question, path, button, width)
  if question and question.path ~= path then question = nil end
  if question then ui:text(printable(in_utf8(question.text)), {color = {0.84, 0.37, 0}, wrap = true}) end
  if question and ui.mouse.left.clicked then question.is_again = ui.mouse.left.again end
  local pressed = ui:button(question and question.button or button, {width = width})
  return question, pressed and not (question and question.is_again)
end

return paths
