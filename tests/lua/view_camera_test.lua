-- The camera of the viewer and its measuring tool.
local test, clench = require "test", require "clench"
local camera = require "clench.view.camera"
local layout = require "clench.view.layout"
local measure = require "clench.view.measure"

local function open()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {640, 480}}
  view.panels_visible = false
  view:home()
  view:frame()
  return session, view
end

local function same(a, b) return a.eye == b.eye and a.target == b.target end

-- two clicks within a frame or two of each other, like a double click
local function double_click(view, x, y)
  view.ui:input {kind = "move", x = x, y = y}
  view:frame()
  for _ = 1, 2 do
    view.ui:input {kind = "button", code = 0, down = true}
    view:frame()
    view.ui:input {kind = "button", code = 0, down = false}
    view:frame()
  end
end

test("a double click, F and View/Seek make the point under the mouse the center of rotation", function(t)
  local _, view = open()
  local first = view.camera
  local point = view:pick(320, 160).point
  double_click(view, 320, 160)
  t.close((view.camera.target - point):norm(), 0, 1e-9)
  local x, y = view:project(point)
  t.close(x, 320, 1e-6)
  t.close(y, 240, 1e-6)
  view.camera = first
  view.ui:input {kind = "move", x = 320, y = 160}
  view:frame()
  view:key "f"
  t.close((view.camera.target - point):norm(), 0, 1e-9)
  view.camera = first
  view.panels_visible = true
  view:menu "View/Seek"
  view.panels_visible = false
  view:frame()
  view:click(320, 160)
  t.close((view.camera.target - point):norm(), 0, 1e-9)
  view:click(320, 160)
  t.equal(view.seeks, nil)
  view:close()
end)

test("presses are a double click by their own times, however long frames take", function(t)
  local ui = clench.ui {size = {64, 48}}
  -- numbers of the frames with a double click, of presses at these times
  local function doubles(times, frame_time)
    local list, count = {}, 0
    for _, time in ipairs(times) do
      for _, down in ipairs {true, false} do ui:input {kind = "button", code = 0, down = down, time = time} end
    end
    repeat
      ui:frame(frame_time, function(ui)
        if ui.mouse.left.clicked then count = count + 1 end
        if ui.mouse.left.double then list[#list + 1] = count end
      end)
    until not ui:poll()
    return list
  end
  t.equal(doubles({10, 10.2}, 0.5), {2})
  t.equal(doubles({20, 20.4}, 0.001), {})
  t.equal(doubles({30, 30.1, 30.2}, 0.5), {2})
  t.equal(doubles({40, 40.5, 40.6}, 0.5), {3})
  ui:close()
end)

test("what the camera points at is framed between the panels", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {1070, 937}}
  for _, visible in ipairs {true, false} do
    view.panels_visible = visible
    view:frame()
    view:home(true)
    local x, y, width, height = layout.uncovered(view)
    t.equal({x, y, width, height}, visible and {264, 60, 542, 659} or {0, 0, 1070, 937})
    local low, high = {math.huge, math.huge}, {-math.huge, -math.huge}
    for _, body in ipairs(session.world.bodies) do
      for _, vertex in ipairs(body.mesh.vertices) do
        local at = {view:project(body.pose * vertex)}
        for i = 1, 2 do low[i], high[i] = math.min(low[i], at[i]), math.max(high[i], at[i]) end
      end
    end
    t.ok(low[1] >= x and high[1] <= x + width and low[2] >= y and high[2] <= y + height, ("%.0f to %.0f, %.0f to %.0f"):format(low[1], high[1], low[2], high[2]))
    t.ok(high[1] - low[1] > 0.6 * width or high[2] - low[2] > 0.6 * height, "it fills the rectangle")
  end
  view:close()
end)

test("bookmarks and home restore the camera", function(t)
  local _, view = open()
  local first = view.camera
  view:key "shift+f2"
  view:orbit(40, 10)
  local second = view.camera
  view:key "f3"
  t.ok(view.status:find "Bookmark 3 is empty", view.status)
  t.equal(same(view.camera, second), true)
  view:key "f2"
  t.equal(same(view.camera, first), true)
  view:orbit(-20, 0)
  require("clench.view.navigation").set_home(view)
  local home = view.camera
  view:orbit(30, 0)
  view:key "home"
  t.equal(same(view.camera, home), true)
  view:close()
end)

test("the middle button pans in the original's manner and turns in Blender's, where Shift pans and Ctrl zooms", function(t)
  local _, view = open()
  local function drag(code)
    local before = view.camera
    if code then view.ui:input {kind = "key", code = code, down = true} end
    view:drag(300, 200, 330, 220, {button = 2})
    if code then view.ui:input {kind = "key", code = code, down = false} end
    local after = view.camera
    view.camera = before
    local function length(c) return (c.eye - c.target):norm() end
    if (after.target - before.target):norm() > 1e-9 then return "pan" end
    if math.abs(length(after) - length(before)) > 1e-9 then return "zoom" end
    return same(after, before) and "none" or "orbit"
  end
  t.equal(drag(), "pan")
  view.navigation = "Blender"
  t.equal(drag(), "orbit")
  t.equal(drag(340), "pan")
  t.equal(drag(341), "zoom")
  view:close()
end)

test("an orthographic camera projects and picks consistently", function(t)
  local _, view = open()
  view:toggle_orthographic()
  view:frame()
  local hit = view:pick(320, 160)
  local x, y = camera.project(view.camera, {640, 480}, hit.point)
  t.close(x, 320, 1e-6)
  t.close(y, 160, 1e-6)
  view:close()
end)

test("two clicks measure a distance, three an angle", function(t)
  local _, view = open()
  view:key "5"
  t.equal(view.current_tool, "Measure")
  local a, b, c = view:pick(300, 120).point, view:pick(330, 120).point, view:pick(320, 160).point
  view:click(300, 120)
  view:click(330, 120)
  t.close(measure.values(measure.points(view)), (a - b):norm(), 1e-9)
  t.ok(view.status:find "^Distance 0%.", view.status)
  view:click(320, 160)
  local _, angle = measure.values(measure.points(view))
  t.close(math.cos(angle), (a - b):unit():dot((c - b):unit()), 1e-6)
  t.ok(view.status:find "^Angle", view.status)
  view:click(300, 120)
  t.equal(#view.measured, 1)
  view:click(3, 3)
  t.equal(#view.measured, view:pick(3, 3) and 2 or 0)
  view:close()
end)

test("Escape and a click on nothing end a measurement, and each tool says how it is used", function(t)
  local _, view = open()
  view:key "5"
  t.equal(view.status, "Measure: click on a point")
  view:click(300, 120)
  view:click(330, 120)
  t.equal(#view.measured, 2)
  view:key "escape"
  t.equal(#view.measured, 0)
  t.equal(view.status, "Measure: click on a point")
  for _, name in ipairs(view.tools) do
    view:tool(name)
    t.equal(view.status:match "^(%a+): ", name)
  end
  view:close()
end)

-- a frame that takes so long that the mouse comes from elsewhere and is pressed within it
local function press_from_afar(view, x, y, code)
  view.ui:input {kind = "move", x = 20, y = 20}
  view:frame()
  view.ui:input {kind = "move", x = x, y = y}
  view.ui:input {kind = "button", code = code, down = true}
  view:frame()
  view.ui:input {kind = "button", code = code, down = false}
  view:frame()
end

test("the way of the mouse to the place of a press moves neither the camera nor a body", function(t)
  local session, view = open()
  local before, hash = view.camera, session.world:hash()
  for code = 0, 2 do press_from_afar(view, 320, 160, code) end
  t.ok(same(view.camera, before))
  view:tool "Translate"
  press_from_afar(view, 320, 160, 0)
  t.equal(session.selection[1] == session.world:robot "barrett" or session.selection[1].robot == session.world:robot "barrett", true)
  t.equal(session.world:hash(), hash)
  t.ok(same(view.camera, before))
  view:close()
end)

test("measured points move with their bodies, and vanish with them", function(t)
  local session, view = open()
  local mug, hand = session.object, session.hand
  local a, b = hand.base.pose.position, mug.pose.position
  view.measured = {{body = hand.base, point = clench.vec3(0, 0, 0)}, {body = mug, point = clench.vec3(0, 0, 0)}}
  t.close(measure.values(measure.points(view)), (a - b):norm(), 1e-12)
  session:run("body.move", {body = "mug", pose = {xyz = {a.x, a.y, a.z - 0.3}, rpy = {0.2, 0.3, 0.4}}})
  view:frame()
  t.close(measure.values(measure.points(view)), 0.3, 1e-12)
  session:run("body.remove", {body = "mug"})
  t.equal(measure.points(view), {})
  t.equal(view.measured, {})
  view:close()
end)
