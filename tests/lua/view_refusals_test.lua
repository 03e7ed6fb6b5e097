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
