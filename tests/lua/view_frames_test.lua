-- Frames of the viewer: pictures are kept as long as what they show, and no input is lost.
local test, clench = require "test", require "clench"
local keys = require "clench.view.keys"

local function open(size)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  return session, clench.view.offscreen {session = session, size = size or {900, 700}}
end

local function drawn(view) return view.ui.pictures_drawn end

local function settle(view)
  local count = 0
  repeat
    view:frame()
    count = count + 1
  until not view.ui:poll() or count > 400
end

local function send(view, events)
  for _, event in ipairs(events) do view.ui:input(event) end
end

-- events of a keyboard that types a text: keys with their characters, as GLFW reports them
local function typed(text)
  local list = {}
  for c in text:gmatch "." do
    local upper, lower = c:find "%u" ~= nil, c:lower()
    local code = c == "\n" and 257 or c == "\b" and 259 or c == "\t" and 258 or c:byte() < 33 and 32 or lower:upper():byte()
    if upper then list[#list + 1] = {kind = "key", code = 340, down = true} end
    list[#list + 1] = {kind = "key", code = code, down = true}
    if c:byte() >= 32 then list[#list + 1] = {kind = "text", text = c} end
    list[#list + 1] = {kind = "key", code = code}
    if upper then list[#list + 1] = {kind = "key", code = 340} end
  end
  return list
end

local function chord(shortcut)
  local list, codes = {}, keys.codes(shortcut)
  for _, code in ipairs(codes) do list[#list + 1] = {kind = "key", code = code, down = true} end
  for i = #codes, 1, -1 do list[#list + 1] = {kind = "key", code = codes[i]} end
  return list
end

local function find_item(view, accepts)
  for _, item in ipairs(view:items()) do
    if accepts(item) then return item end
  end
end

local function focus_console(view)
  view.front.bottom = "Console"
  settle(view)
  local item = find_item(view, function(item) return item.kind == "input" and item.window == "bottom" end)
  view:click(item.x + 20, item.y + item.height / 2)
end

local function printed(view)
  local texts = {}
  for _, line in ipairs(view.lines) do texts[#texts + 1] = line.text end
  return table.concat(texts, "\n")
end

test("typing, and moving the mouse over panels, draws no picture of the world", function(t)
  local _, view = open()
  focus_console(view)
  local before = drawn(view)
  t.ok(before > 0)
  view:type "x = 1"
  for _, item in ipairs(view:items()) do
    view.ui:input {kind = "move", x = item.x + 3, y = item.y + 3}
    view:frame()
  end
  t.equal(drawn(view), before)
  view:close()
end)

test("each change of what the picture shows draws it, once", function(t)
  local session, view = open()
  settle(view)
  local function draws(what, change, count)
    settle(view)
    local before = drawn(view)
    change()
    for _ = 1, 3 do settle(view) end
    t.equal({what, drawn(view) - before}, {what, count or 1})
  end
  draws("nothing", function() end, 0)
  draws("the camera", function() view.camera = {eye = view.camera.eye + clench.vec3(0.01, 0, 0), target = view.camera.target, up = view.camera.up, field_of_view = view.camera.field_of_view} end)
  draws("a field of the camera", function() view.camera.eye = view.camera.eye + clench.vec3(0.01, 0, 0) end)
  draws("a pose, without a command", function() session.object.pose = session.object.pose * clench.pose {xyz = {0, 0, 0.001}} end)
  draws("DOFs", function() session.hand.dofs = {0.1, 0.2, 0.2, 0.2} end)
  draws("autograsp", function() session:run "grasp.autograsp" end)
  draws("undo", function() session:undo() end)
  draws("a display setting", function() view.display.transparent_objects = false end)
  draws("the same display setting", function() view.display.transparent_objects = false end, 0)
  draws("an approach arrow", function() view.display.approach = true end)
  draws("stereo", function() view.stereo = {kind = "side by side"} end, 2)
  draws("the other stereo", function() view.stereo = {kind = "anaglyph"} end, 2)
  draws("stereo off", function() view.stereo = nil end)
  draws("a new obstacle", function() session.world:add_obstacle("models/objects/cube.iv", {name = "extra", pose = clench.pose {xyz = {0.4, 0, 0}}}) end)
  -- lines over the picture are drawn over the kept one
  local hash = view:hash()
  draws("the selection", function() session:run("world.select", {addresses = {session.object.name}}) end, 0)
  t.ok(view:hash() ~= hash)
  view:close()
end)

-- is the last frame equal to the same one drawn without reuse?
local function is_fresh(view)
  settle(view)
  local hash = view:hash()
  view.ui:redraw()
  return view:hash() == hash
end

-- actions of a user and of scripts, by a random generator
local function actions(session, view, random)
  local function number(low, high) return math.floor(random:uniform(low, high + 1)) end
  local function one_of(list) return list[number(1, #list)] end
  local size = view.ui.size
  local function at_widget(act)
    local list = {}
    for _, item in ipairs(view:items()) do
      if item.enabled and (item.kind == "button" or item.kind == "tab" or item.kind == "checkbox" or item.kind == "tree" or item.kind == "radio") then list[#list + 1] = item end
    end
    if #list > 0 then
      local item = one_of(list)
      act(item.x + math.min(item.width, 20) / 2, item.y + item.height / 2)
    end
  end
  return {
    function() view.ui:input {kind = "move", x = number(0, size[1]), y = number(0, size[2])} end,
    function() at_widget(function(x, y) view.ui:input {kind = "move", x = x, y = y} end) end,
    function() at_widget(function(x, y) view:click(x, y) end) end,
    function() view:click(number(0, size[1]), number(0, size[2])) end,
    function()
      local x, y = number(0, size[1]), number(0, size[2])
      view:drag(x, y, x + number(-80, 80), y + number(-80, 80), {steps = 2, button = number(0, 1)})
    end,
    function() view:key(one_of {"1", "2", "3", "4", "5", "f9", "home", "escape", "ctrl+g", "ctrl+z", "ctrl+shift+z", "ctrl+p", "shift+/", "+", "f1", "shift+f1"}) end,
    function() view:type(one_of {"a", "0.5", "hand"}) end,
    function() view:orbit(number(-40, 40), number(-20, 20)) end,
    function() view.display[one_of {"transparent_objects", "approach", "patches", "file_colors"}] = random:uniform() < 0.5 or nil end,
    function() view.stereo = one_of {{kind = "side by side"}, {kind = "anaglyph"}, false, false} or nil end,
    function() view.hidden[one_of {"World", "Grasp Quality", "Inspector", "Console", "Gallery", "Display"}] = random:uniform() < 0.5 or nil end,
    function() view.picture_visible = random:uniform() < 0.8 end,
    function() view:set_theme(random:uniform() < 0.5) end,
    function() view.front.right = one_of {"Wrench Space", "Display", "Author", "Friction"} end,
    function() view.sizes[one_of {"left", "right", "bottom"}] = number(60, 320) end,
    function() view:screenshot {size = {number(300, 700), number(300, 600)}, panels = random:uniform() < 0.5} end,
    function() if session.object then session.object.pose = session.object.pose * clench.pose {xyz = {0, 0, random:uniform(-0.003, 0.003)}} end end,
    function() if session.hand and session.object then session:run "grasp.autograsp" end end,
    function() session:run("world.select", {addresses = {one_of {"mug", "barrett"}}}) end,
  }
end

for seed = 1, 3 do
  test(("after random input, frames that keep pictures equal frames that draw everything, seed %d"):format(seed), function(t)
    local session, view = open {800, 600}
    local random = clench.random(seed)
    local list = actions(session, view, random)
    local fresh, kept = 0, 0
    for i = 1, 60 do
      local number = math.floor(random:uniform(1, #list + 1))
      pcall(list[number])  -- a command may be refused
      local before = drawn(view)
      settle(view)
      if drawn(view) == before then kept = kept + 1 end
      local same = is_fresh(view)
      if same == false then t.fail(("event %d, action %d"):format(i, number)) end
      if same then fresh = fresh + 1 end
      if not session.hand or view.is_closed then break end
    end
    t.ok(fresh >= 50, fresh)
    t.ok(kept >= 20, kept)
    view:close()
  end)
end

test("small pictures show the present state, also after pictures of another size", function(t)
  local session, view = open {1000, 800}
  session:run "grasp.autograsp"
  view.front.right = "Wrench Space"
  settle(view)
  local function shown_afresh()
    for _ = 1, 3 do view:frame() end
    local hash = view:hash()
    view.projection = nil  -- computed anew
    view.ui:redraw()
    for _ = 1, 3 do view:frame() end
    return view:hash() == hash
  end
  t.ok(shown_afresh())
  local before = view:hash()
  session.object.pose = clench.pose {xyz = {0.004, 0, 0}} * session.object.pose  -- without a command
  view:screenshot {size = {700, 600}}
  t.ok(shown_afresh())
  t.ok(view:hash() ~= before)
  view:close()
end)

-- --- input ---

test("text typed in one batch arrives completely and in order", function(t)
  local _, view = open()
  focus_console(view)
  local text = "y = 'Hello World' .. 12 * 3 .. 'tttooo'"
  send(view, typed(text))
  local frames = view.frames
  settle(view)
  t.equal(view.console_text, text)
  t.ok(view.frames - frames < 20, view.frames - frames)  -- characters do not wait for each other
  -- the console keeps the focus after Enter, and keys that edit stay between the characters
  send(view, typed "\nxx\b = 5\b7\n   x + 1\n")
  settle(view)
  t.ok(printed(view):find("> x = 7\n", 1, true), printed(view))
  t.equal(printed(view):match "[^\n]*$", "8")
  t.equal(view.globals.y, "Hello World36tttooo")
  view:close()
end)

test("text that follows a shortcut goes into the dialog that it opens", function(t)
  for _, console in ipairs {false, true} do
    local session, view = open()
    if console then focus_console(view) end
    local events = chord "ctrl+p"
    table.move(typed "auto grasp\n", 1, 100, #events + 1, events)
    local hash = session.world:hash()
    if console then send(view, chord "escape") end
    send(view, events)
    settle(view)
    t.ok(session.world:hash() ~= hash)
    t.equal(session.history.done[#session.history.done].name, "grasp.autograsp")
    t.equal(view.console_text, "")
    view:close()
  end
end)

test("bare text, without keys, waits until the dialog is open as well", function(t)
  local session, view = open()
  send(view, chord "ctrl+p")
  for c in ("auto grasp"):gmatch "." do view.ui:input {kind = "text", text = c} end
  settle(view)
  t.equal(view.palette and view.palette.text, "auto grasp")
  send(view, chord "enter")
  settle(view)
  t.equal(session.history.done[#session.history.done].name, "grasp.autograsp")
  view:close()
end)

test("the character of a key that runs a command is not typed into what the command opens", function(t)
  local session, view = open()
  local count = #session.order
  session:command {name = "own.typed", label = "Typed…", shortcut = "k", parameters = {{name = "text", type = "string"}}, run = function() end}
  t.equal(#session.order, count + 1)
  send(view, typed "kab")
  settle(view)
  local state = view.dialogs["own.typed"]
  t.equal(state and state.text, "ab")
  view:close()
end)

test("keys pressed and released between two frames are seen, each once and in order", function(t)
  local _, view = open()
  send(view, typed "3")
  send(view, typed "4")
  send(view, chord "f9")
  settle(view)
  t.equal({view.current_tool, view.panels_visible}, {"Rotate", false})
  send(view, chord "f9")
  send(view, chord "f9")
  send(view, chord "f9")
  settle(view)
  t.equal(view.panels_visible, true)
  view:close()
end)

test("a click, text and a click on another field, in one batch, fill both fields", function(t)
  local texts = {"", ""}
  local ui = clench.ui {size = {300, 200}}
  local function frame()
    ui:frame(1 / 60, function(ui)
      ui:window("w", {x = 0, y = 0, width = 300, height = 200, title = false}, function(ui)
        for i = 1, 2 do texts[i] = ui:text_input("##field" .. i, texts[i]) end
      end)
    end)
  end
  frame()
  frame()
  local items = ui.items
  for i = 1, 2 do
    ui:input {kind = "move", x = items[i].x + 10, y = items[i].y + items[i].height / 2}
    ui:input {kind = "button", down = true}
    ui:input {kind = "button", down = false}
    for _, event in ipairs(typed(i == 1 and "first" or "Second")) do ui:input(event) end
  end
  local count = 0
  repeat
    frame()
    count = count + 1
  until not ui:poll() or count > 100
  frame()
  t.equal(texts, {"first", "Second"})
  ui:close()
end)

test("input does not wait forever for a field that asks for the focus in each frame", function(t)
  local ui = clench.ui {size = {300, 200}}
  local seen, text = 0, ""
  ui:input {kind = "key", code = 65, down = true}
  ui:input {kind = "text", text = "a"}
  for _ = 1, 60 do
    ui:frame(1 / 60, function(ui)
      seen = seen + #ui.pressed
      ui:window("w", {x = 0, y = 0, width = 300, height = 200}, function(ui) text = ui:text_input("##field", text, {focus = true}) end)
    end)
  end
  t.equal({seen, ui:poll()}, {1, false})
  ui:close()
end)

test("windows, questions, tooltips and the focus come and go in any order", function(t)
  for seed = 1, 12 do
    local random, shown = clench.random(seed), {}
    local function chance(p) return random:uniform() < p end
    local ui = clench.ui {size = {400, 300}}
    local function draw_field(ui)
      ui:text_input("t", "x", {focus = chance(0.2)})
      ui:tooltip "a field"
    end
    for _ = 1, 400 do
      for _, name in ipairs {"D", "E", "M", "N"} do
        if chance(0.15) then shown[name] = not shown[name] end
      end
      if chance(0.5) then ui:input {kind = "move", x = random:uniform(0, 400), y = random:uniform(0, 300)} end
      if chance(0.4) then ui:input {kind = "button", code = 0, down = chance(0.5)} end
      ui:frame(0.02, function(ui)
        ui:window("A", {x = 0, y = 0, width = 400, height = 300}, function(ui)
          ui:button("b", {width = 380, height = 200})
          ui:tooltip "in A"
        end)
        for _, name in ipairs {"D", "E"} do
          if shown[name] then ui:window(name, {x = 40, y = 40, width = 200, height = 150, movable = true}, draw_field) end
        end
        for _, name in ipairs {"M", "N"} do
          if shown[name] then ui:window(name, {width = 0, modal = true}, draw_field) end
        end
      end)
    end
    t.ok(#ui.items > 0)
    ui:close()
  end
end)
