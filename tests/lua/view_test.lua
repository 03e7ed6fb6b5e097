-- The viewer off-screen, driven by synthetic input, compared with the commands of its menus and tools.
local test, clench = require "test", require "clench"

local function open(options)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  options = options or {}
  options.session = session
  return session, clench.view.offscreen(options)
end

local function labels_of(view)
  local labels = {}
  for _, item in ipairs(view:items()) do labels[item.label] = item end
  return labels
end

test("a screenshot without panels is the draft of the same camera", function(t)
  local session, view = open {size = {320, 240}}
  view.panels_visible = false
  local shot = view:screenshot {}
  t.equal(shot == clench.render(session.world, {size = {320, 240}, camera = view.camera, quality = "draft"}), true)
  local large = view:screenshot {size = {400, 360}}
  t.equal({large.width, large.height, view.ui.size}, {400, 360, {320, 240}})
  t.equal(large == clench.render(session.world, {size = {400, 360}, camera = view.camera, quality = "draft"}), true)
  t.equal(view:screenshot {} == shot, true)
  -- without picture and panels nothing of the world is drawn
  view.picture_visible = false
  local nothing = view:screenshot {}
  session:run "grasp.autograsp"
  t.equal(view:screenshot {} == nothing and nothing ~= shot, true)
  view:close()
end)

test("every menu command without a dialog has the effect of the session's command", function(t)
  local session, view = open()
  view:menu "Grasp/Auto Grasp"
  local other = clench.session()
  other:open("worlds/barrett_mug.wld", {root = "."})
  other:run "grasp.autograsp"
  t.equal(session.world:hash(), other.world:hash())
  view:key "ctrl+z"
  other:undo()
  t.equal(session.world:hash(), other.world:hash())
  view:close()
end)

test("each dialog opens by its label and is closed by Cancel", function(t)
  local session, view = open()
  for _, menu in ipairs(session:menus()) do
    for _, command in ipairs(menu.commands) do
      local label = command.label or command.name
      local enabled = not command.enabled or command.enabled(session)
      if label:find "…" and enabled then
        view:menu(menu.name .. "/" .. label)
        local shown = labels_of(view)
        t.ok(shown.Cancel or shown.Start, label)
        if shown.Cancel then view:click_label "Cancel" else view.dialogs = {} end
      end
    end
  end
  t.equal(next(view.dialogs), nil)
  view:close()
end)

test("projection and picking agree", function(t)
  local session, view = open()
  view:frame()
  local mug = session.object
  local x, y = view:project(mug.pose * mug.com)
  local hit = view:pick(x, y)
  t.equal(hit ~= nil, true)
  local px, py = view:project(hit.point)
  t.close(px, x, 1e-6)
  t.close(py, y, 1e-6)
  view:close()
end)

test("typing does not trigger shortcuts", function(t)
  local session, view = open()
  local first = session.world:hash()
  view:key "ctrl+p"
  view:type "g"
  view:key "g"
  t.equal(session.world:hash(), first)
  view:key "escape"
  t.equal(view.palette, nil)
  view:close()
end)

test("a command that cannot run opens no dialog, and its reason is shown", function(t)
  local session = clench.session()
  session:run "world.new"
  local view = clench.view.offscreen {session = session, size = {640, 480}}
  view:key "ctrl+p"
  view:type "planner.random"
  view:key "enter"
  t.equal(next(view.dialogs), nil)
  t.equal(view.status, "Random Planner cannot run now: " .. select(2, session.commands["planner.random"].enabled(session)))
  view:close()
end)

test("undo reverts all changes by random input", function(t)
  local session, view = open {size = {640, 480}}
  local first = session.world:hash()
  local random = clench.random(3)
  for _ = 1, 60 do
    local x, y = random:uniform(0, 640), random:uniform(0, 480)
    view.ui:input {kind = "move", x = x, y = y}
    view.ui:input {kind = "button", code = 0, down = random:uniform() < 0.5}
    if random:uniform() < 0.2 then view.ui:input {kind = "wheel", y = random:uniform(-1, 1)} end
    view:frame()
  end
  view.ui:input {kind = "button", code = 0, down = false}
  view:frame()
  view:frame()
  view.dialogs, view.ask, view.palette = {}, nil, nil
  session:end_gesture()
  local opened = #session.history.done
  while #session.history.done > 1 and opened > 0 do session:undo() opened = opened - 1 end
  t.equal(session.world:hash(), first)
  view:close()
end)

test("errors name what is missing", function(t)
  local _, view = open()
  view:frame()
  t.fails(function() view:click_label "no such button" end, "there is no widget 'no such button' on screen")
  t.fails(function() view:tool "Hammer" end, "expected one of Camera, Select, Translate, Rotate")
  t.fails(function() view:key "ctrl+nokey" end, "unknown key 'nokey'")
  view:close()
  t.fails(function() view:frame() end, "the view was closed")
  t.fails(function() clench.view.offscreen {sesion = 1} end, "unknown key 'sesion'")
  t.fails(function() clench.view.panel {} end, "expected {name = string, draw = function}")
end)

test("the page of a world needs nothing else and keeps its size", function(t)
  local session = open()
  session:run "grasp.autograsp"
  local path = os.tmpname() .. ".html"
  local bytes = clench.export_html(session.world, path)
  local file <close> = assert(io.open(path))
  local text = file:read "a"
  os.remove(path)
  t.equal(#text, bytes)
  t.equal(text:find 'src="http', nil)
  t.fails(function() clench.export_html(session.world, path, {max_size = 1000}) end, "more than max_size = 1000")
end)
