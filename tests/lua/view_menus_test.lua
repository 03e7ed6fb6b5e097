-- Every entry of every menu, by its label on screen: commands are compared with the session's commands, entries of the view with their effect.
local test, clench = require "test", require "clench"

local error_text = require "clench.error_text"
local playback = require "clench.session.playback"
local files = {}

-- the mug's world in a new file, which Save writes
local function open_session()
  local path = os.tmpname() .. ".wld"
  clench.load("worlds/barrett_mug.wld", {root = "."}):save(path)
  files[#files + 1] = path
  local session = clench.session()
  session:open(path)
  session:run("world.select", {addresses = {"mug"}})
  return session
end

local function open()
  local session = open_session()
  local view = clench.view.offscreen {session = session, size = {900, 1500}}  -- all entries of a menu are visible
  view.picture_visible = false
  view:frame()
  return session, view
end

-- entries that the open menu shows, and the menus within it
local function shown(view, kind)
  local list = {}
  for _, item in ipairs(view:items()) do
    if item.kind == kind then list[#list + 1] = {label = item.label, enabled = item.enabled} end
  end
  return list
end

-- opens a menu of the bar, and one within it
local function open_menu(view, name, inner)
  view:click(880, 1490)  -- beside all menus, which closes them
  view:click_label(name, "menu")
  if inner then view:click_label(inner, "menu") end
  view:frame()
end

-- the entries of a menu, those of an inner one with the path through it
local function entries_below(view, name, bars, list)
  local outer = {}
  open_menu(view, name)
  local inners = shown(view, "menu")
  for _, item in ipairs(shown(view, "menu item")) do
    outer[item.label] = true
    list[#list + 1] = {path = name .. "/" .. item.label, label = item.label, enabled = item.enabled}
  end
  for _, inner in ipairs(inners) do
    if not bars[inner.label] and inner.enabled then
      open_menu(view, name, inner.label)
      for _, item in ipairs(shown(view, "menu item")) do
        if not outer[item.label] then list[#list + 1] = {path = ("%s/%s/%s"):format(name, inner.label, item.label), label = item.label, enabled = item.enabled} end
      end
    end
  end
end

-- all entries
local function entries_of(view)
  local bars, names, list = {}, {}, {}
  for _, item in ipairs(shown(view, "menu")) do bars[item.label], names[#names + 1] = true, item.label end
  for _, name in ipairs(names) do entries_below(view, name, bars, list) end
  view:click(880, 1490)
  return list
end

local function command_of(session, path)
  for _, menu in ipairs(session:menus()) do
    for _, command in ipairs(menu.commands) do
      if path == menu.name .. "/" .. (command.label or command.name) then return command end
    end
  end
end

local function asks(command)
  if (command.label or ""):find "…" then return true end
  for _, parameter in ipairs(command.parameters or {}) do
    if not parameter.optional and parameter.default == nil then return true end
  end
  return false
end

-- a copy of the camera, which Home and View All set
local function target(view) return view.camera.target end

-- entries of the view itself, and of what takes time, and what they do
local own = {
  ["Dynamics/Play/Pause"] = function(t, view)
    t.ok(playback.is_on(view.session))
    playback.stop(view.session)
    while #view.session.history.done > 1 do view.session:undo() end
  end,
  ["File/Save View…"] = function(t, view) t.equal(view.ask.title, "Save View") view.ask = nil end,
  ["File/Save Session as Script…"] = function(t, view) t.equal(view.ask.title, "Save Session as Script") view.ask = nil end,
  ["File/Exit"] = function(t, view) t.equal(view.wants_exit, true) view.wants_exit = false end,
  ["View/Home"] = function(t, view, before) t.ok(view.camera ~= before.camera) end,
  ["View/View All"] = function(t, view, before) t.ok((view.camera.eye - target(view)):norm() > (before.camera.eye - before.camera.target):norm()) end,
  ["View/Orthographic"] = function(t, view) t.ok(view.camera.orthographic) view:toggle_orthographic() end,
  ["View/Set Home"] = function(t, view) t.ok(view.home_camera == view.camera) end,
  ["View/Seek"] = function(t, view) t.equal(view.seeks, true) view.seeks = nil end,
  ["View/Panels"] = function(t, view) t.equal(view.panels_visible, false) view.panels_visible = true end,
  ["View/Dark Theme"] = function(t, view) t.equal(view.dark, true) view:set_theme(false) end,
  ["View/Navigation/Original"] = function(t, view) t.equal(view.navigation, "Original") end,
  ["View/Navigation/Blender"] = function(t, view) t.equal(view.navigation, "Blender") end,
  ["View/Stereo/Stereo Off"] = function(t, view) t.equal(view.stereo, nil) end,
  ["View/Stereo/Side by Side"] = function(t, view) t.equal(view.stereo.kind, "side by side") view.stereo = nil end,
  ["View/Stereo/Anaglyph"] = function(t, view) t.equal(view.stereo.kind, "anaglyph") view.stereo = nil end,
  ["View/Millimeters"] = function(t, view) t.equal(view.units.length, "mm") end,
  ["View/Degrees"] = function(t, view) t.equal(view.units.angle, "deg") end,
  ["Help/Command Palette…"] = function(t, view) t.equal(view.palette.text, "") view.palette = nil end,
  ["Help/Keys…"] = function(t, view) t.equal(view.shows_keys, true) view.shows_keys = nil end,
  ["Help/Manual…"] = function(t, view) t.equal(view.shows_manual, true) view.shows_manual = nil end,
  ["Help/About…"] = function(t, view) t.equal(view.shows_about, true) view.shows_about = nil end,
}
for _, name in ipairs {"Camera", "Select", "Translate", "Rotate", "Measure"} do
  own["Element/" .. name] = function(t, view) t.equal(view.current_tool, name) end
end
for i = 1, 4 do
  own["View/Bookmarks/Store Bookmark " .. i] = function(t, view) t.ok(view.bookmarks[i] == view.camera) end
  own["View/Bookmarks/Recall Bookmark " .. i] = function(t, view) t.ok(view.camera == view.bookmarks[i]) end
end

local function is_enabled(session, command) return not command.enabled or (command.enabled(session)) and true or false end

-- messages name the line of the script that has caused them
local function without_line(text) return (text:gsub("^tests/%S+:%d+: ", "")) end

local function check_command(t, session, view, other, entry, command)
  if not is_enabled(session, command) then return end
  local first, steps, lines = session.world:hash(), #session.history.done, #view.lines
  view:menu(entry.path)
  if view.leaving then view:click_label "Don't Save" end  -- New, undone, leaves a world that counts as changed
  if asks(command) then
    t.ok(view.dialogs[command.name], entry.path)
    view.dialogs = {}
    t.ok(session.world:hash() == first, entry.path)
    return
  end
  local errors = {}
  for i = lines + 1, #view.lines do
    if view.lines[i].kind == "error" then errors[#errors + 1] = view.lines[i].text end
  end
  local ok, problem = pcall(other.run, other, command.name)
  t.ok(#errors == (ok and 0 or 1) and (ok or without_line(view.status) == without_line(error_text(problem))), entry.path .. ": " .. view.status)
  t.ok(session.world:hash() == other.world:hash(), entry.path)
  t.ok(#session.history.done == #other.history.done, entry.path)
  while #session.history.done > steps do
    session:undo()
    other:undo()
  end
  session:cancel_gesture()
  other:cancel_gesture()
end

test("Escape closes a menu and the dialog of a command", function(t)
  local session, view = open()
  open_menu(view, "Grasp")
  t.ok(#shown(view, "menu item") >= 10)
  view:key "escape"
  view:frame()
  t.equal(#shown(view, "menu item"), 0)
  view:menu "Dynamics/Run…"
  t.ok(view.dialogs["dynamics.run"])
  view:key "escape"
  t.equal(view.dialogs["dynamics.run"], nil)
  view:menu "Grasp/Sampling Planner…"
  view:key "escape"
  t.ok(view.dialogs["planner.sample"], "that of a planner stays")
  view:close()
end)

test("the menu Grasp begins with the first things to do, no menu is long, and submenus of commands may be left out of a path", function(t)
  local session, view = open()
  open_menu(view, "Grasp")
  local places, entries, bars = {}, {}, {}
  for i, entry in ipairs(shown(view, "menu item")) do places[entry.label] = i end
  for i, label in ipairs {"Auto Grasp", "Auto Open", "Approach", "Approach and Grasp", "Planner…", "EigenGrasp Planner…"} do t.equal(places[label], i) end
  t.ok(places["Grasp Force Optimization…"] < places["Select Hand…"])
  view:click(880, 1490)
  for _, item in ipairs(shown(view, "menu")) do bars[item.label] = true end
  for name in pairs(bars) do
    open_menu(view, name)
    t.ok(#shown(view, "menu item") + #shown(view, "menu") - 10 <= 22, name)
  end
  view:click(880, 1490)
  for _, path in ipairs {"Grasp/Set DOFs…", "Grasp/Posture/Set DOFs…"} do
    view:menu(path)
    t.ok(view.dialogs["grasp.dofs"], path)
    view.dialogs = {}
  end
  t.fails(function() view:menu "Grasp/Set DOFz…" end, "there is no menu item 'Set DOFz…' on screen")
  -- commands of users have their place, too
  session:command {name = "mine.b", label = "Second", menu = "Mine/Inner", section = 2, run = function() end}
  session:command {name = "mine.c", label = "Third", menu = "Mine/Inner", run = function() end}
  session:command {name = "mine.a", label = "First", menu = "Mine/Inner", section = 1, run = function() session.ran = true end, script = function() return "" end}
  view:frame()
  open_menu(view, "Mine", "Inner")
  for i, entry in ipairs(shown(view, "menu item")) do entries[i] = entry.label end
  t.equal(entries, {"First", "Second", "Third"})
  view:click(880, 1490)
  view:menu "Mine/First"
  t.equal(session.ran, true)
  view:close()
end)

test("a path and the first field of a dialog are typed at once, Enter confirms, and keys run no commands behind a question", function(t)
  local session, view = open()
  local path, count = test.path ".lua", #session.history.done
  view:menu "File/Save Session as Script…"
  view:frame()
  view:key "ctrl+a"
  view:type(path)
  view:key "enter"
  t.equal(view.ask, nil)
  local file <close> = assert(io.open(path))
  t.equal(file:read "a", session:script() .. "\n")
  os.remove(path)
  view:menu "File/Save Session as Script…"
  view:key "escape"
  view:frame()
  t.equal(view.ask, nil)
  view:menu "Dynamics/Run…"
  view:frame()
  view:key "ctrl+a"
  view:type "0.01"
  view:key "enter"
  t.equal(view.dialogs["dynamics.run"], nil)
  t.equal(session.world.time, 0.01)
  view:key "ctrl+q"
  view:frame()
  t.ok(view.leaving or view.wants_exit)
  view.leaving = {purpose = "exit", go = function() end}
  view:frame()
  local before = session.world:hash()
  view:key "ctrl+g"
  t.equal(session.world:hash(), before)
  view:key "escape"
  t.equal(view.leaving, nil)
  t.equal(#session.history.done, count + 1)
  view:close()
end)

test("a menu that is too long for the window stays below its title and chooses nothing", function(t)
  local session = open_session()
  local view = clench.view.offscreen {session = session, size = {900, 400}}
  view:frame()
  local steps = #session.history.done
  for _, item in ipairs(shown(view, "menu")) do
    view:click_label(item.label, "menu")
    for _, entry in ipairs(view:items()) do
      if entry.kind == "menu item" then t.ok(entry.y >= 20, item.label) end
    end
    view:click(700, 390)
    t.equal(next(view.dialogs), nil)
    t.equal(#session.history.done, steps)
  end
  view:close()
end)

test("every entry of every menu does what its command or its name says", function(t)
  local session, view = open()
  local other = open_session()
  local entries, commands = entries_of(view), 0
  t.ok(#entries > 70, #entries)
  for _, entry in ipairs(entries) do
    local command = command_of(session, entry.path)
    if command then t.ok(entry.enabled == is_enabled(session, command), entry.path) end
  end
  for _, entry in ipairs(entries) do
    local command = command_of(session, entry.path)
    local check = own[entry.path]
    if command then commands = commands + 1 end
    if command and not check then
      check_command(t, session, view, other, entry, command)
    elseif entry.path:find "^View/Show Panel/" then
      view:menu(entry.path)
      t.ok(view.hidden[entry.label], entry.path)
      view.hidden = {}
    elseif check then
      view.camera = {eye = clench.vec3(0.5, 0, 0.2), target = clench.vec3(0, 0, 0.1), up = clench.vec3(0, 0, 1), field_of_view = 0.5}
      view:frame()
      local before = {camera = view.camera}
      if entry.path:find "Recall" then view.bookmarks[tonumber(entry.path:match "%d$")] = {eye = clench.vec3(1, 0, 0), target = clench.vec3(0, 0, 0), up = clench.vec3(0, 0, 1), field_of_view = 0.5} end
      view:menu(entry.path)
      check(t, view, before)
    else
      t.ok(false, "an entry without a check: " .. entry.path)
    end
    view:frame()
  end
  -- each command of a menu is an entry, unless another world or library adds it
  local registered = 0
  for _, menu in ipairs(session:menus()) do registered = registered + #menu.commands end
  t.equal(commands, registered)
  view:close()
  for _, path in ipairs(files) do os.remove(path) end
end)
