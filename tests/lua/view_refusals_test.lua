-- Wrong arguments of views, their methods and widgets: an error in a sentence, and the view goes on.
local test, clench = require "test", require "clench"

if not clench.ui then return test("the build has no viewer", function(t) t.skip "CLENCH_VIEWER=OFF" end) end

local session = clench.session(clench.load("worlds/barrett_mug.wld", {root = "."}))

test("options of views and panels are checked", function(t)
  local offscreen, panel = clench.view.offscreen, clench.view.panel
  t.fails(function() offscreen {} end, "clench.view.offscreen: session: expected a session, got nothing")
  t.fails(function() offscreen {session = session.world} end, "session: expected a session, got a world")
  t.fails(function() clench.view.open(5) end, "clench.view.open: session: expected a session, got 5")
  for _, scale in ipairs {1e9, 100, 0.01} do
    t.fails(function() offscreen {session = session, scale = scale} end, "scale must be 0.25 to 8, got ")
  end
  t.fails(function() offscreen {session = session, size = {1e18, 100}} end, "size of the view: expected 16 to 8192 pixels, got 1000000")
  t.fails(function() clench.ui {size = {64, 64}}:set_style {font_size = 2000} end, "font_size of the view, times its scale: expected 4 to 128 pixels, got 2000")
  t.fails(function() panel {name = "a", draw = print, palce = "left"} end, "clench.view.panel: unknown key 'palce'; did you mean 'place'?")
  t.fails(function() panel {name = "a", draw = print, place = "top"} end, "place: expected 'left', 'right' or 'bottom', got 'top'")
  t.fails(function() panel {name = "", draw = print} end, "name: expected a text in UTF-8, got ''")
end)

test("arguments of methods of a view are checked, and leave it as it was", function(t)
  local view = clench.view.offscreen {session = session, size = {200, 150}}
  for _ = 1, 3 do view:frame() end
  local before = view:hash()
  for _, case in ipairs {
    {"click", "view:click: x: expected a finite number, got nan", 0 / 0, 1}, {"click", "y: expected a finite number, got nothing", 1},
    {"drag", "to_y: expected a finite number, got nothing", 1, 2, 3}, {"drag", "steps: expected an integer from 1 to 10000, got 0", 1, 2, 3, 4, {steps = 0}},
    {"drag", "view:drag: unknown key 'step'; did you mean 'steps'?", 1, 2, 3, 4, {step = 1}}, {"drag", "button: expected an integer from 0 to 2, got 5", 1, 2, 3, 4, {button = 5}},
    {"key", "view:key: shortcut: expected a text in UTF-8, got 5", 5}, {"key", "shortcut: expected at most 100 bytes, got 'xxx", ("x"):rep(1e6)},
    {"type", "view:type: text: expected a text in UTF-8, got '", "\xFF"}, {"menu", "expected a menu and its entry, as in 'Grasp/Auto Grasp', got '/'", "/"},
    {"click_label", "view:click_label: label: expected a text in UTF-8, got nothing"}, {"orbit", "view:orbit: yaw: expected a finite number, got 'a'", "a", 1},
    {"project", "view:project: point: expected a point, got a table of 2", {1, 2}}, {"pick", "view:pick: x: expected a finite number, got nothing"},
    {"screenshot", "view:screenshot: unknown key 'pth'", {pth = "x.png"}}, {"screenshot", "camera: expected a table of options, got 5", {camera = 5}},
    {"screenshot", "eye and target must be two points", {camera = {eye = {0, 0, 0}, target = {0, 0, 0}}}},
  } do
    t.fails(function() view[case[1]](view, table.unpack(case, 3, 7)) end, case[2])
  end
  view:frame()
  t.equal(view:hash(), before)
  -- points of a camera may be lists
  local eye = view.camera.eye
  local camera = {eye = {eye.x, eye.y, eye.z}, target = view.camera.target, up = view.camera.up, field_of_view = view.camera.field_of_view}
  t.equal(view:screenshot {camera = camera} == view:screenshot(), true)
  view:close()
end)

test("widgets with empty labels and enormous numbers end neither a frame nor the program", function(t)
  local ui = clench.ui {size = {200, 150}}
  local function draw(f)
    for _ = 1, 2 do
      ui:frame(0.01, function() ui:window("w", {x = 0, y = 0, width = 200, height = 150}, function() f() end) end)
    end
  end
  draw(function()
    ui:button ""
    ui:checkbox("", true)
    ui:selectable("", false)
    ui:combo("", 1, {"", "a"})
    ui:slider("", 0.5)
    ui:text_input("", "")
    ui:tabs("", {"", "b"}, function() end)
    ui:table("", {"", ""}, {}, function() ui:next_column() end)
    ui:child("", {height = 20}, function() ui:button "" end)
  end)
  t.fails(function() draw(function() ui:slider("s", 0, {min = -1e308, max = 1e308}) end) end, "slider 's': expected a range within -1e300 to 1e300, got -1e+308 to 1e+308")
  draw(function()
    ui:slider("wide", 0.5, {format = "%500000000f"})
    ui:circle(1e308, -1e308, 1e308, {})
    ui:line({1e308, 1, 2, -1e308}, {width = 1e30})
    ui:plot("p", {1e308, -1e308}, {height = 1e30})
    ui:curves("c", {{1e308, -1e308}, {}, {1}}, {height = 1e30, min = -1e308})
  end)
  t.fails(function() ui:input {kind = "wheel", y = 1e308} end, "x and y: expected -1e6 to 1e6 pixels, got 0 and 1e+308")
  draw(function() ui:button "go" end)
  t.equal(ui.items[#ui.items].label, "go")
end)

-- a panel that calls a function, and removes itself
local function once(view, f)
  local done
  clench.view.panel {name = "Once", place = "left", draw = function(ui)
    if done then return end
    done = true
    f(ui)
  end}
  view:frame()
  return view
end

local function texts(view)
  local list = {}
  for _, item in ipairs(view.ui.items) do
    if item.kind == "text" then list[#list + 1] = item.label end
  end
  return table.concat(list, "\n")
end

test("errors of a panel with zero bytes, or with a million bytes, are shown in it", function(t)
  local view = clench.view.offscreen {session = session, size = {700, 500}}
  once(view, function() error("a\0b", 0) end)
  t.ok(texts(view):find("a?b", 1, true))
  once(view, function() error(("x"):rep(1e6), 0) end)
  t.ok(texts(view):find "x%.%.%. %(1000000 characters%)")
  view:print("c\0d")
  view:fail(setmetatable({}, {__tostring = function() return "e\0f" end}))
  view:frame()
  t.ok(texts(view):find("c?d", 1, true) and view.status == "e?f")
  view:close()
end)

test("texts of more characters than Dear ImGui draws at once do not end the program", function(t)
  local ui = clench.ui {size = {400, 300}}
  -- in a window of its own each: the text in lines that fit, the text in lines as they are, and a button of it
  local function draw(text, at_end)
    local widgets = {function(ui) ui:text(text, {wrap = true}) end, function(ui) ui:text(text) end, function(ui) ui:button(text) end}
    ui:frame(0.01, function(ui)
      for i, widget in ipairs(widgets) do
        ui:window("w" .. i, {x = 0, y = 100 * (i - 1), width = 400, height = 100}, function(ui)
          widget(ui)
          if at_end then ui:scroll_to_end() end
        end)
      end
    end)
  end
  local function labels()
    local list = {}
    for _, item in ipairs(ui.items) do
      if item.kind ~= "window" then list[#list + 1] = item.window .. " " .. item.kind .. " " .. item.label end
    end
    return list
  end
  for _, text in ipairs {("é"):rep(4990), ("é漢 x"):rep(200000), ("x"):rep(1e6), ("x\n"):rep(1e5)} do
    draw(text, false)
    draw(text, false)
    t.ok(table.concat(labels(), ";") == ("w1 text %s;w2 text %s;w3 button %s"):format(text, text, text), "each is seen from its beginning")
    for _ = 1, 3 do draw(text, true) end
    -- what is left out is counted at the end
    local count = table.concat(labels(), ";"):match "w1 text %.%.%. %((%d+) bytes%)"
    t.equal(count, #text > 10000 and tostring(#text) or nil)
    for _ = 1, 3 do draw("", false) end
  end
  ui:close()
end)

test("a panel may take a screenshot and close the view, but not draw frames", function(t)
  local view = clench.view.offscreen {session = session, size = {300, 200}}
  local picture
  once(view, function() picture = view:screenshot {panels = false} end)
  t.equal(picture == view:screenshot {panels = false}, true)
  once(view, function() picture = view:screenshot {size = {64, 48}} end)
  t.equal(picture.width, 64)
  clench.view.panel {name = "Once", place = "left", draw = function() view:screenshot() end}
  view:frame()
  t.ok(not view.is_closed)
  once(view, function() view:frame() end)
  t.ok(texts(view):find "a frame is open already")
  once(view, function() view:close() end)
  t.ok(view.is_closed)
  t.fails(function() view:frame() end, "view:frame: the view was closed")
end)

test("File/Save View… writes the picture", function(t)
  local view = clench.view.offscreen {session = session, size = {500, 400}}
  local path = os.tmpname()
  os.remove(path)
  view:menu "File/Save View…"
  view:frame()
  view:key "ctrl+a"
  view:type(path)
  view:click_label("Save", "button")
  view:frame()
  t.equal(view.ask, nil)
  local file <close> = assert(io.open(path .. ".png", "rb"))
  t.equal(file:read(4), "\137PNG")
  os.remove(path .. ".png")
  view:close()
end)

test("a camera that shows nothing is reported, and the last one stays", function(t)
  local view = clench.view.offscreen {session = session, size = {300, 200}}
  view:frame()
  local camera, origin = view.camera, clench.vec3(0, 0, 0)
  for _, bad in ipairs {{eye = origin, target = origin, up = clench.vec3(0, 0, 1), field_of_view = 0.5}, 5, {eye = "x"}} do
    view.status = "Ready"
    view.camera = bad
    view:frame()
    t.ok(view.status ~= "Ready")
    t.equal(view.camera, camera)
  end
  view:close()
end)
