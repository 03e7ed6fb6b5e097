-- Keys of the viewer, which the user may change, and sizes of its panels; both are kept.
local test, clench = require "test", require "clench"
local bindings, preferences = require "clench.view.bindings", require "clench.view.preferences"

local function open()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {900, 700}}
  view:frame()
  return session, view
end

-- opens the table of keys, and finds a command in it
local function find_key(view, text)
  view:key "shift+/"
  view.key_search = text
  view:frame()
  view:frame()
end

local function rows_of(view)
  view:frame()
  local rows = {}
  for _, item in ipairs(view:items()) do
    if item.kind == "button" then rows[#rows + 1] = item.label end
  end
  return table.concat(rows, " ")
end

test("each key belongs to one action, and has an effect of its own", function(t)
  local session, view = open()
  local users, count = {}, 0
  for _, action in ipairs(bindings.list(view)) do
    if action.shortcut then
      t.equal(users[action.shortcut], nil, action.shortcut)
      users[action.shortcut], count = action.name, count + 1
      t.equal(bindings.find(view, action.shortcut).name, action.name)
    end
  end
  t.ok(count > 25, count)
  -- those of the original, and of the commands
  for shortcut, name in pairs {space = "dynamics.play", delete = "body.remove", g = "grasp.approach_and_grasp", s = "grasp.save_posture", r = "grasp.restore_posture",
                               v = "body.distance", ["ctrl+g"] = "grasp.autograsp", ["ctrl+z"] = "edit.undo", escape = "cancel", ["3"] = "tool Translate"} do
    t.equal(users[shortcut], name)
  end
  view:key "3"
  t.equal(view.current_tool, "Translate")
  view:key "f9"
  t.equal(view.panels_visible, false)
  view:key "f9"
  view:key "ctrl+g"
  t.equal(session.history.done[#session.history.done].name, "grasp.autograsp")
  view:close()
end)

test("the table of keys changes a key by clicking and pressing, and the menu shows it", function(t)
  local session, view = open()
  find_key(view, "auto grasp")
  t.ok(rows_of(view):find("Ctrl+G", 1, true) and not rows_of(view):find("Ctrl+Z", 1, true))
  view:click_label "Ctrl+G"
  t.equal(view.binding, "grasp.autograsp")
  view:key "ctrl+k"
  t.equal(view.binding, nil)
  t.ok(rows_of(view):find("Ctrl+K", 1, true) and not rows_of(view):find("Ctrl+G", 1, true))
  view.shows_keys = nil
  local first = session.world:hash()
  view:key "ctrl+g"
  t.equal(session.world:hash(), first)
  view:key "ctrl+k"
  t.ok(session.world:hash() ~= first)
  t.equal(bindings.shown(view, "grasp.autograsp"), "Ctrl+K")
  t.equal(bindings.shown(view, "keys"), "?")
  view:close()
end)

test("a key that is taken leaves its action, Delete removes one, Escape keeps it, and all are reset", function(t)
  local _, view = open()
  find_key(view, "auto grasp")
  view:click_label "Ctrl+G"
  view:key "escape"
  t.equal(bindings.shown(view, "grasp.autograsp"), "Ctrl+G")
  view:click_label "Ctrl+G"
  view:key "ctrl+z"
  t.equal(bindings.find(view, "ctrl+z").name, "grasp.autograsp")
  t.equal(bindings.shown(view, "edit.undo"), "")
  t.equal(view.status, "Undo has no key now")
  find_key(view, "hide panels")
  view:click_label "F9"
  view:key "delete"
  t.equal(bindings.find(view, "f9"), nil)
  view:click_label "Reset All"
  t.equal(next(view.bindings), nil)
  t.equal(bindings.find(view, "ctrl+z").name, "edit.undo")
  view:close()
end)

test("no key is taken from a panel that is being typed in", function(t)
  local session, view = open()
  local first = session.world:hash()
  for _, item in ipairs(view:items()) do
    if item.kind == "input" and item.window:find "bottom" then view:click(item.x + 20, item.y + item.height / 2) end
  end
  view:frame()
  t.equal(view.ui.wants_text, true)
  for _, action in ipairs(bindings.list(view)) do
    if action.shortcut and action.shortcut ~= "escape" then view:key(action.shortcut) end
  end
  t.equal(session.world:hash(), first)
  t.equal(#session.history.done, 1)
  t.equal(view.current_tool, "Camera")
  t.ok(view.panels_visible and not view.wants_exit and not view.shows_keys)
  view:close()
end)

test("edges of the panels are dragged, within limits, and the picture is not", function(t)
  local _, view = open()
  local camera, before = view.camera, {}
  for name, size in pairs(view.sizes) do before[name] = size end
  local middle = view.edges.left
  view:drag(middle.at + 2, 300, middle.at + 42, 300)
  t.equal(view.sizes.left, before.left + 40)
  view:drag(view.edges.right.at - 2, 300, view.edges.right.at - 32, 300)
  t.equal(view.sizes.right, before.right + 30)
  view:drag(450, view.edges.bottom.at - 2, 450, view.edges.bottom.at + 18)
  t.equal(view.sizes.bottom, before.bottom - 20)
  t.ok(view.camera == camera)
  local tab
  for _, item in ipairs(view:items()) do
    if item.kind == "tab" and item.label == "Console" then tab = item end
  end
  t.ok(tab.y > view.edges.bottom.at and tab.y < view.edges.bottom.at + 20)
  view:drag(view.edges.left.at + 2, 300, 5, 300)
  t.equal(view.sizes.left, 120)
  view:drag(view.edges.left.at + 2, 300, 890, 300)
  t.equal(view.sizes.left, (900 - 160) / 2)
  -- a column without panels has no edge
  for _, panel in ipairs(view.panels) do view.hidden[panel.name] = panel.place == "left" or nil end
  view:frame()
  t.equal(view.edges.left, nil)
  view:close()
end)

test("the edge between two panels of a column is dragged, and kept", function(t)
  local session, view = open()
  local file = os.tmpname()
  local kept = preferences.keep(view, file)
  local camera = view.camera
  local function top_of(label)
    view:frame()
    for _, item in ipairs(view:items()) do
      if item.label == label and item.kind == "window" then return item.y end
    end
  end
  local before, edge = top_of "Grasp Quality", view.edges["within left"]
  view:drag(100, edge.at + 2, 100, edge.at + 62)
  t.close(top_of "Grasp Quality", before + 60, 1.01)
  view:drag(100, edge.at + 62, 100, 690)
  t.close(view.shares.left, 0.85, 1e-12)
  t.equal(view.shares.right, nil)
  t.ok(view.camera == camera)
  -- a tall panel keeps the user's share
  local right = view.edges["within right"]
  view:drag(800, right.at + 2, 800, right.at - 58)
  local share = view.shares.right
  view:click_label "Author"
  t.equal(view.shares.right, share)
  t.close(view.edges["within right"].at, right.at - 60, 1.01)
  kept.finish()
  view:close()
  local other = clench.view.offscreen {session = session, size = {900, 700}}
  preferences.keep(other, file)
  t.close(other.shares.right, share, 1e-12)
  clench.files.save_text(file, '{"shares": {"left": 0.99, "right": "half", "bottom": 0.5}}')
  preferences.keep(other, file)
  t.equal(other.shares, {})
  other:close()
  os.remove(file)
end)

test("on a monitor of twice the resolution bars and panels are twice as large, and do not cover each other", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local function windows(size, scale)
    local view = clench.view.offscreen {session = session, size = size, scale = scale}
    view.picture_visible = false
    view:frame()
    view:frame()
    local rects = {}
    for _, item in ipairs(view:items()) do
      if item.kind == "window" or item.label == "Camera" and item.window == "tool bar" then rects[item.label] = item end
    end
    view:close()
    return rects
  end
  local once, twice = windows({900, 700}, 1), windows({1800, 1400}, 2)
  t.ok(once.World and once.Inspector and once["Grasp Quality"])
  for name, rect in pairs(once) do
    for _, field in ipairs {"x", "y", "width", "height"} do t.close(twice[name][field], 2 * rect[field], 2) end
  end
  t.ok(twice.World.y > twice.Camera.y + twice.Camera.height)
end)

test("keys, navigation, sizes and the panel in front are kept, and damaged values are ignored", function(t)
  local session, view = open()
  local file = os.tmpname()
  local kept = preferences.keep(view, file)
  bindings.set(view, "grasp.autograsp", "ctrl+k")
  view:menu "View/Navigation/Blender"
  view.sizes.bottom = 250
  view:frame()
  view:click_label "Friction"
  kept.finish()
  view:close()
  local other = clench.view.offscreen {session = session, size = {900, 700}}
  preferences.keep(other, file)
  t.equal(bindings.find(other, "ctrl+k").name, "grasp.autograsp")
  t.equal(other.navigation, "Blender")
  t.equal(other.sizes, {left = 264, right = 264, bottom = 250})
  t.equal(other.front, {bottom = "Console", right = "Friction"})
  other:close()
  clench.files.save_text(file, '{"keys": {"exit": "ctrl+nokey", "home": 3, "panels": false}, "sizes": {"left": "wide", "right": -5, "bottom": 1e9}, "front": [1], "navigation": "Maya"}')
  other = clench.view.offscreen {session = session, size = {900, 700}}
  preferences.keep(other, file)
  t.equal(other.bindings, {panels = false})
  t.equal(other.sizes, {left = 264, right = 264, bottom = 190})
  t.equal(other.navigation, "Original")
  other:close()
  os.remove(file)
end)

test("the command palette is in front of the panels of a small window, and arrow keys choose in it", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {640, 480}}
  view:frame()
  view:key "ctrl+p"
  view:type "auto"
  local entries = {}
  for _, item in ipairs(view:items()) do
    if item.window == "Command Palette" and item.label:find "^Auto" then entries[#entries + 1] = item end
  end
  t.equal(entries[1].label:match "^Auto Grasp", "Auto Grasp")
  t.ok(entries[1].x < view.sizes.left - 20, entries[1].x)
  view:click(entries[1].x + 5, entries[1].y + entries[1].height / 2)
  t.equal(view.palette, nil)
  t.equal(session.history.done[#session.history.done].label, "Auto Grasp")
  view:key "ctrl+p"
  view:type "auto"
  view:key "down"
  view:key "down"
  view:key "up"
  view:key "enter"
  t.equal(session.history.done[#session.history.done].label, entries[2].label:match "^%u%l+ %u%l+")
  view:close()
end)

test("a narrow window has the choices of the tool bar, and commands in the menus only", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  for _, width in ipairs {800, 1070} do
    local view = clench.view.offscreen {session = session, size = {width, 600}}
    local right, has_undo = 0, false
    for _, item in ipairs(view:items()) do
      if item.window == "tool bar" then
        right, has_undo = math.max(right, item.x + item.width), has_undo or item.label == "Undo"
      end
    end
    t.ok(right < width, right)
    t.equal(has_undo, width > 1000)
    view:close()
  end
end)

test("shortcuts edited by hand replace defaults; those that cannot work are named", function(t)
  local _, view = open()
  local file = os.tmpname()
  local function apply(text)
    clench.files.save_text(file, text)
    view.lines = {}
    bindings.reset(view)
    preferences.keep(view, file)
    local lines = {}
    for i, line in ipairs(view.lines) do lines[i] = line.text end
    return table.concat(lines, "\n")
  end
  t.equal(apply '{"keys": {"seek": "ctrl+p", "home": "shift+ctrl+h"}}', "")
  t.equal(bindings.find(view, "ctrl+p").name, "seek")
  t.equal(bindings.find(view, "ctrl+shift+h").name, "home")
  t.equal(bindings.shown(view, "palette"), "")
  local said = apply '{"keys": {"home": "k", "seek": "k", "exit": "ctrl+nokey", "panels": 3}}'
  t.ok(said:find("keys: seek: 'k' belongs to 'home'", 1, true))
  t.ok(said:find("keys: exit: .*unknown key 'nokey'"))
  t.ok(said:find("keys: panels: expected a shortcut, or false, got 3", 1, true))
  t.equal(view.bindings, {home = "k"})
  view:close()
  os.remove(file)
end)
