-- Completion in the console, tooltips, descriptions of DOFs, and fields of dialogs, driven by synthetic input.
local test, clench = require "test", require "clench"
local views = dofile "tests/lua/view_session.lua"
local open, texts_of, item, beside = views.open, views.texts_of, views.item, views.beside

test("Tab completes a name in the console, or its common beginning with a list of what can follow", function(t)
  local session, view = open()
  view.complete = require "clench.host.complete".words
  local field
  for _, line in ipairs(view:items()) do field = line.kind == "input" and line.window == "bottom" and line or field end
  view:click(field.x + 10, field.y + field.height / 2)
  local function completed(text)
    view:key "ctrl+a"
    view:type(text)
    view:key "tab"
    return view.console_text
  end
  local count = #view.lines
  t.equal(completed "object.friction_coef", "object.friction_coef")
  t.equal(completed "print(world:restor", "print(world:restore")
  t.equal(completed "sess", "session")
  t.equal(completed "session:und", "session:undo")
  view.globals.my_own_value = {deeper = {inner = 1}}
  t.equal(completed "my_own_value.deeper.in", "my_own_value.deeper.inner")
  t.equal(completed 'clench.load "worlds/barrett_m', 'clench.load "worlds/barrett_mug.wld')
  t.equal(#view.lines, count)
  -- several: the fields of a robot, by its description
  local expected = {}
  for _, class in ipairs(clench.entries().classes) do
    for _, field in ipairs((class.name == "dofs" or class.name == "robot_dynamics") and class.fields or {}) do
      if field.name:find "^dof" then expected[#expected + 1] = field.name end
    end
  end
  table.sort(expected)
  t.ok(#expected > 4)
  t.equal(completed "hand.do", "hand.dof")
  local listed = view.lines[#view.lines].text
  t.equal(listed, table.concat(expected, "  "))
  -- the rest of the line stays, and the keyboard stays in the field
  completed "hand.dof_nam)"
  t.equal(view.console_text, "hand.dof_nam)")
  for _ = 1, 1 do view:key "left" end
  view:key "tab"
  t.equal(view.console_text, "hand.dof_names)")
  view.complete = nil
  t.equal(completed "worl", "worl")
  view:close()
end)

test("Tab in a text field inserts what a function returns for the text before the cursor, and its errors are raised", function(t)
  local ui, text, asked = clench.ui {size = {320, 240}}, "", nil
  local function frame(complete)
    ui:frame(0.01, function(ui)
      ui:window("w", {width = 300, height = 200}, function() text = ui:text_input("t", text, {complete = complete, focus = asked == nil}) end)
    end)
    asked = asked or ""
  end
  local function tab(complete)
    local function noted(before)
      asked = before
      return complete(before)
    end
    for _, down in ipairs {false, true} do
      ui:input {kind = "key", code = 258, down = down}
      frame(noted)
    end
  end
  for _ = 1, 3 do frame() end
  ui:input {kind = "text", text = "grün"}
  frame()
  tab(function() return "er" end)
  t.equal({asked, text}, {"grün", "grüner"})
  tab(function() end)
  t.equal({asked, text}, {"grüner", "grüner"})
  t.fails(function() tab(function() error "no words" end) end, "no words")
  t.fails(function() tab(function() return {} end) end, "complete: expected a string, got an empty table")
  t.fails(function() frame(5) end, "complete: expected a function, got 5")
  ui:close()
end)

test("tooltips have lines of at most 40 em, and stay within the window", function(t)
  local words = ("several words "):rep(60)
  for _, width in ipairs {1600, 300} do
    local ui = clench.ui {size = {width, 600}}
    ui:input {kind = "move", x = width - 100, y = 515}
    local function shown(text)
      for _ = 1, 3 do
        ui:frame(0.01, function(ui)
          ui:window("w", {x = width - 120, y = 500, width = 120, height = 90, title = false}, function()
            ui:button "near the edge"
            ui:tooltip(text)
          end)
        end)
      end
      for _, found in ipairs(ui.items) do
        if found.kind == "tooltip" then return found end
      end
    end
    local short, long = shown "short", shown(words)
    t.equal(long.label, words)
    local em = short.height  -- of one line
    t.ok(long.width <= 40 * em and long.height > 5 * em, ("%g x %g"):format(long.width, long.height))
    t.ok(long.x >= 0 and long.x + long.width <= width and long.y >= 0 and long.y + long.height <= 600)
    ui:close()
  end
end)

test("a DOF is described by the joints that it moves, and by their names if the file gives any", function(t)
  local labels = require "clench.view.dof_labels"
  local session, view = open()
  local hand = session.hand
  local texts = {}
  for i, label in ipairs(labels.of(hand)) do texts[i] = label.text end
  t.equal(texts, {"dof1 (fingers 1, 2: joint 1)", "dof2 (finger 1: joints 2, 3)", "dof3 (finger 2: joints 2, 3)", "dof4 (finger 3: joints 1, 2)"})
  -- moving a DOF moves the joints of its description, and no others
  for i, label in ipairs(labels.of(hand)) do
    local before, goal = hand.chains, {table.unpack(hand.dofs)}
    goal[i] = goal[i] + 0.05
    hand.dofs = goal
    local moved = {}
    for c, chain in ipairs(hand.chains) do
      local places = {}
      for j, joint in ipairs(chain.joints) do
        if math.abs(joint.value - before[c].joints[j].value) > 1e-9 then places[#places + 1] = j end
      end
      if #places > 0 then moved[#moved + 1] = {c, table.concat(places, ", ")} end
    end
    local fingers = {}
    for k, entry in ipairs(moved) do fingers[k] = entry[1] end
    local expected = ("%s (finger%s %s: joint%s %s)"):format(label.name, #fingers > 1 and "s" or "", table.concat(fingers, ", "), moved[1][2]:find "," and "s" or "", moved[1][2])
    t.equal(label.text, expected)
  end
  view:select(hand.name)
  t.ok(texts_of(view):find "\nfingers 1, 2\ndof1 joint 1\n", texts_of(view))
  view:close()
  local path = test.path ".urdf"
  clench.files.save_text(path, [[<robot name="named"><link name="base"/><link name="a"/><link name="b"/>
    <joint name="thumb_swing" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
    <joint name="thumb_tip" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/><limit lower="0" upper="0.1" effort="1" velocity="1"/></joint></robot>]])
  local named = labels.of(clench.world():add_robot(path))
  t.ok(named[1].text:find("thumb_swing", 1, true) and named[2].text:find("thumb_tip", 1, true), named[1].text .. named[2].text)
  t.equal({named[1].unit, named[2].unit}, {"rad", "m"})
end)

test("parameters with few values are checkboxes and choices in dialogs, and scripts may give others", function(t)
  local session, view = open()
  view.picture_visible = false
  view:menu "Grasp/Sampling Planner…"
  local state = view.dialogs["planner.sample"]
  t.equal(state.verify, true)
  local box = beside(view, "verify")
  t.equal(box.kind, "checkbox")
  view:click(box.x + 8, box.y + 8)
  t.equal(state.verify, false)
  view.dialogs["planner.sample"] = nil
  view:menu "Grasp/EigenGrasp Planner…"
  t.equal(beside(view, "energy").kind, "combo")
  for _, parameter in ipairs(session.commands["planner.anneal"].parameters) do
    local values = parameter.suggested
    if type(values) == "function" then values = values(session) end
    if parameter.name == "schedule" or parameter.name == "energy" then
      t.ok(#values >= 5)
      -- each suggested value is accepted by the planner
      for _, value in ipairs(values) do
        local job = session:run("planner.anneal", {[parameter.name] = value, steps = 1})
        t.ok(job:wait(60))
        job:result()  -- raises what the planner has raised
        t.equal(job.state, "done")
      end
    end
  end
  local unknown = session:run("planner.anneal", {schedule = "x", steps = 1})
  t.ok(unknown:wait(60))
  t.fails(function() unknown:result() end, "no schedule 'x'")
  view.dialogs["planner.anneal"] = nil
  view:menu "Grasp/More Analyses/Quality…"
  t.equal(beside(view, "measure").kind, "combo")
  view.dialogs["grasp.quality"] = nil
  view:select "mug"
  view:menu "Element/Material…"
  local choices = 0
  for _, found in ipairs(view:items()) do choices = choices + (found.kind == "combo" and found.window == "Material" and 1 or 0) end
  t.equal(choices, 2)  -- of the body and of the material
  t.fails(function() session:command {name = "my.own", run = print, parameters = {{name = "a", type = "string", suggested = "x"}}} end,
          "suggested: expected a list or a function that returns one, got 'x'")
  view:close()
end)
