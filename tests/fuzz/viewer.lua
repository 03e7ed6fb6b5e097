-- Random input of a view off-screen: clicks, drags, keys, typed text, menu entries, commands of the palette. The same seed gives the same events.
--   clench -q run tests/fuzz/viewer.lua [SEED [EVENTS]]
-- It runs in a folder that may be written into, with models and worlds to read. After each round undo must lead back to the first world, and redo to the
-- last one. The exit code is 3 where something broke; the last events before it are printed.
local clench = require "clench"

-- an error that would be shown in a panel is a fault
local panel_fault
package.loaded["clench.view.guarded"] = function(ui, draw, ...)
  local ok, message = xpcall(draw, function(problem) return debug.traceback(tostring(problem)) end, ui, ...)
  if not ok then panel_fault = panel_fault or message end
end

local keys = require "clench.view.keys"

local seed, events = tonumber(arg[1] or 1), tonumber(arg[2] or 300)
local round_length = 150  -- events between two returns to the first world
local longest_event = 60  -- longer, it counts as a hang [s]
local size = {800, 600}

print(("random input of a view, seed %d, %d events"):format(seed, events))
local random = clench.random(seed)
local function chance(p) return random:uniform() < p end
local function number(low, high) return math.floor(random:uniform(low, high + 1)) end
local function one_of(list) return list[number(1, #list)] end

local session = clench.session()
session:open "worlds/barrett_mug.wld"
session:save "soak.wld"
local view = clench.view.offscreen {session = session, size = size}
local first = session.world:hash()

-- --- what the user sees ---

-- an error of the viewer, not of its user: a message that names a line of it
local function fault_of(text) return text:match "stdlib/[%w_/]+%.lua:%d+:.*" end

local checked_lines = 0
local function find_fault()
  if panel_fault then return panel_fault end
  for i = math.min(checked_lines, #view.lines) + 1, #view.lines do
    local line = view.lines[i]
    if line.kind == "error" and fault_of(line.text) then return line.text end
  end
  checked_lines = #view.lines
  if fault_of(view.status) then return view.status end
  for _, item in ipairs(view.ui.items) do
    if item.kind == "text" and fault_of(item.label) and item.window ~= "lines" then return item.label end
  end
end

-- the world changes by steps of the history and by gestures only
local last_world, last_step, last_hash
local function check_history()
  local step = session.history.done[#session.history.done]
  if session.gesture then last_world = nil return end
  local hash = session.world:hash()
  if last_world == session.world and last_step == step and hash ~= last_hash then error("the world has changed without a step of the history", 0) end
  last_world, last_step, last_hash = session.world, step, hash
end

local function settle()
  local count = 0
  repeat
    view:frame()
    count = count + 1
  until not view.ui:poll() or count > 400
  local fault = find_fault()
  if fault then error(fault, 0) end
  check_history()
end

-- the last frame must equal the same one drawn without reuse
local compared = 0
local function compare_frames()
  local hash = view:hash()
  view.ui:redraw()
  if view:hash() ~= hash then error("a kept picture differs from the one that is drawn anew", 0) end
  compared = compared + 1
end

local function items_of(accepts)
  local list = {}
  for _, item in ipairs(view.ui.items) do
    if item.enabled and item.kind ~= "text" and item.kind ~= "separator" and (not accepts or accepts(item)) then list[#list + 1] = item end
  end
  return list
end

-- --- events ---

local function move(x, y) view.ui:input {kind = "move", x = x, y = y} end
local function button(down, code) view.ui:input {kind = "button", code = code, down = down} end

local function press_at(x, y, code, count)
  move(x, y)
  for _ = 1, count do
    button(true, code)
    button(false, code)
  end
  settle()
end

local function point_of(item) return item.x + random:uniform(0, item.width), item.y + item.height / 2 end

local texts = {"mug", "models/objects/flask.iv", "models/hands/parallel_jaw/parallel_jaw.cfg", "no/such.wld", "soak.wld", "x", "é", "0.5", "-", "nil", "1", "view:home()",
               "hand.dofs", "error {}", "return", "]]", "\"", "a.lua"}

local events_of = {}

function events_of.click()
  local x, y = random:uniform(0, size[1]), random:uniform(0, size[2])
  local code, count = chance(0.8) and 0 or number(1, 2), chance(0.1) and 2 or 1
  return ("click %.0f %.0f %d %d"):format(x, y, code, count), function() press_at(x, y, code, count) end
end

function events_of.widget()
  local list = items_of()
  if #list == 0 then return events_of.click() end
  -- those of the window drawn last more often: questions and dialogs come last
  local item = chance(0.5) and list[number(math.max(1, #list - 12), #list)] or one_of(list)
  local x, y = point_of(item)
  local code = chance(0.95) and 0 or 1
  return ("%s '%s' of %s"):format(item.kind, item.label, item.window), function() press_at(x, y, code, 1) end
end

local names_of_keys = {"f", "g", "s", "r", "c", "v", "1", "2", "3", "4", "5", "home", "escape", "delete", "space", "tab", "enter", "up", "down", "left", "right", "backspace", "f1",
                       "shift+f1", "f5", "f9", "ctrl+p", "ctrl+q", "ctrl+z", "ctrl+shift+z", "ctrl+a", "ctrl+x", "ctrl+v", "shift+/", "alt+f4", "pageup", "end", "-", "="}
for _, name in ipairs(session.order) do names_of_keys[#names_of_keys + 1] = session.commands[name].shortcut end

local function press_key(name)
  local codes = keys.codes(name)
  for _, code in ipairs(codes) do view.ui:input {kind = "key", code = code, down = true} end
  for i = #codes, 1, -1 do view.ui:input {kind = "key", code = codes[i], down = false} end
  settle()
end

function events_of.drag()
  local x, y = random:uniform(0, size[1]), random:uniform(0, size[2])
  local list = items_of(function(item) return item.kind == "drag" or item.kind == "slider" end)
  local tool
  if #list > 0 and chance(0.3) then
    x, y = point_of(one_of(list))
  elseif chance(0.5) and #session.world.bodies > 0 then
    local at_x, at_y = view:project(one_of(session.world.bodies).pose.position)
    x, y, tool = at_x or x, at_y or y, one_of {"Translate", "Rotate"}
  end
  local by_x, by_y, code = random:uniform(-120, 120), random:uniform(-120, 120), chance(0.7) and 0 or number(1, 2)
  local held = chance(0.2) and one_of {"ctrl", "shift", "alt"}
  local pressed = chance(0.2) and one_of(names_of_keys)  -- in the middle
  return ("drag %.0f %.0f by %.0f %.0f, button %d %s %s %s"):format(x, y, by_x, by_y, code, held or "", pressed or "", tool or ""), function()
    if tool then view:tool(tool) end
    local key = held and keys.modifiers[held]
    if key then view.ui:input {kind = "key", code = key, down = true} end
    move(x, y)
    button(true, code)
    settle()
    for i = 1, 3 do
      move(x + by_x * i / 3, y + by_y * i / 3)
      settle()
      if i == 2 and pressed then press_key(pressed) end
    end
    button(false, code)
    if key then view.ui:input {kind = "key", code = key, down = false} end
    settle()
  end
end

function events_of.key()
  local name = one_of(names_of_keys)
  return "key " .. name, function() press_key(name) end
end

function events_of.text()
  local text = one_of(texts)
  return "text " .. text, function()
    for _, code in utf8.codes(text) do view.ui:input {kind = "text", text = utf8.char(code)} end
    settle()
  end
end

local function click_item(item)
  press_at(item.x + 8, item.y + item.height / 2, 0, 1)
  settle()
end

function events_of.menu()
  local order, choice = random:uniform(), random:uniform()
  return ("menu %.4f %.4f"):format(order, choice), function()
    local menus = items_of(function(item) return item.kind == "menu" end)
    if #menus == 0 then return end
    click_item(menus[1 + math.floor(order * #menus)])
    local entries = items_of(function(item) return item.kind == "menu item" end)
    if #entries > 0 then click_item(entries[1 + math.floor(choice * #entries)]) end
  end
end

-- a right click on a body or on a row of the tree, then an entry of its menu, or a key while it is open
function events_of.context()
  local x, y = random:uniform(0, size[1]), random:uniform(0, size[2])
  local rows = items_of(function(item) return item.kind == "tree" end)
  if #rows > 0 and chance(0.5) then x, y = point_of(one_of(rows)) end
  local choice, key = random:uniform(), chance(0.2) and one_of(names_of_keys)
  return ("context %.0f %.0f %.4f %s"):format(x, y, choice, key or ""), function()
    press_at(x, y, 1, 1)
    settle()
    if key then return press_key(key) end
    local entries = items_of(function(item) return item.kind == "menu item" end)
    if #entries > 0 then click_item(entries[1 + math.floor(choice * #entries)]) end
  end
end

function events_of.palette()
  local name = one_of(session.order)
  return "palette " .. name, function()
    for _, down in ipairs {true, false} do
      for _, code in ipairs(keys.codes "ctrl+p") do view.ui:input {kind = "key", code = code, down = down} end
    end
    settle()
    for _, code in utf8.codes(name) do view.ui:input {kind = "text", text = utf8.char(code)} end
    for _, down in ipairs {true, false} do view.ui:input {kind = "key", code = keys.codes "enter"[1], down = down} end
    settle()
  end
end

function events_of.wheel()
  local x, y, steps = random:uniform(0, size[1]), random:uniform(0, size[2]), random:uniform(-3, 3)
  return ("wheel %.0f %.0f %.2f"):format(x, y, steps), function()
    move(x, y)
    view.ui:input {kind = "wheel", y = steps}
    settle()
  end
end

function events_of.drop()
  local path = one_of {"models/objects/cube.iv", "soak.wld", "nothing.iv", "soak.lua"}
  return "drop " .. path, function()
    view.ui:input {kind = "drop", text = path}
    settle()
  end
end

local kinds = {}
for name, weight in pairs {click = 4, widget = 12, drag = 4, key = 6, text = 3, menu = 5, context = 2, palette = 3, wheel = 1, drop = 0.2} do kinds[#kinds + 1] = {name = name, weight = weight} end
table.sort(kinds, function(a, b) return a.name < b.name end)

local function random_kind()
  local sum = 0
  for _, kind in ipairs(kinds) do sum = sum + kind.weight end
  local at = random:uniform(0, sum)
  for _, kind in ipairs(kinds) do
    at = at - kind.weight
    if at <= 0 then return kind.name end
  end
  return "click"
end

-- --- rounds ---

local recent, counts = {}, {}

-- ends what is open, as a user would who closes everything, and returns to the first world
local function unwind()
  for code = 0, 2 do button(false, code) end
  for _, code in pairs(keys.modifiers) do view.ui:input {kind = "key", code = code, down = false} end
  settle()
  for _, job in ipairs(session.jobs) do job:stop() end
  view.dialogs, view.ask, view.leaving, view.palette, view.press, view.context = {}, nil, nil, nil, nil, nil
  session:end_gesture()
  local last, steps = session.world:hash(), 0
  while #session.history.done > 1 do
    if not session:undo() then error("a step cannot be undone", 0) end
    steps = steps + 1
  end
  settle()
  if session.world:hash() ~= first then error(("%d steps of undo do not lead back to the first world"):format(steps), 0) end
  for _ = 1, steps do session:redo() end
  if session.world:hash() ~= last then error(("%d steps of redo do not lead to the last world"):format(steps), 0) end
  for _ = 1, steps do session:undo() end
  if session.world:hash() ~= first then error("a second undo does not lead back to the first world", 0) end
  view.panels_visible = true
  return steps
end

local function run_event(count)
  local kind = random_kind()
  local text, f = events_of[kind]()
  counts[kind] = (counts[kind] or 0) + 1
  recent[#recent + 1] = ("%d: %s"):format(count, text)
  if #recent > 25 then table.remove(recent, 1) end
  if os.getenv "SOAK_TRACE" then io.stderr:write(recent[#recent], "\n") end
  local began = clench.clock()
  view.picture_visible = chance(0.2)  -- it takes most of the time of a frame
  f()
  if view.picture_visible then compare_frames() end
  local took = clench.clock() - began
  if took > longest_event then error(("an event took %.0f s"):format(took), 0) end
end

local steps = 0
local ok, problem = xpcall(function()
  settle()
  for count = 1, events do
    run_event(count)
    if count % round_length == 0 or count == events then
      steps, last_world = steps + unwind(), nil
    end
  end
end, function(message) return fault_of(tostring(message)) and debug.traceback(message, 2) or tostring(message) end)
if not ok then
  print(("FOUND with seed %d: %s\nthe last events:\n  %s"):format(seed, problem, table.concat(recent, "\n  ")))
  os.exit(3)
end
view:close()
local names = {}
for name in pairs(counts) do names[#names + 1] = ("%s %d"):format(name, counts[name]) end
table.sort(names)
print(("nothing broke; %d steps were undone and repeated, %d frames compared; %s"):format(steps, compared, table.concat(names, ", ")))
