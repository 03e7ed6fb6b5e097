-- Panels of the viewer, driven by synthetic input and compared with the commands that they run.
local test, clench = require "test", require "clench"
local views = dofile "tests/lua/view_session.lua"
local open, texts_of, item, beside = views.open, views.texts_of, views.item, views.beside

local function console_of(view)
  local lines = {}
  for i, line in ipairs(view.lines) do lines[i] = line.text end
  return table.concat(lines, "\n")
end

test("every panel draws on the mug and on the flask without an error", function(t)
  for _, world in ipairs {"barrett_mug", "dlr_flask"} do
    local session, view = open(world)
    session:run "grasp.autograsp"
    view:select(session.hand.name)
    for _, panel in ipairs(view.panels) do
      if panel.tab or panel.place == "bottom" then view:click_label(panel.name) end
      t.equal(texts_of(view):find "%.lua:%d+:", nil)
    end
    view:close()
  end
end)

test("no menu has two entries of the same name", function(t)
  local _, view = open()
  for _, menu in ipairs {"File", "Edit", "Element", "Grasp", "Dynamics", "Jobs", "Misc.", "View", "Help"} do
    local bar = item(view, "^" .. menu:gsub("%.", "%%.") .. "$")
    view:click(bar.x + 4, bar.y + 8)
    view:frame()
    local seen, count = {}, 0
    for _, entry in ipairs(view:items()) do
      if entry.kind:find "menu" and entry.y > 24 then
        t.equal(seen[entry.label], nil, menu .. "/" .. entry.label)
        seen[entry.label], count = true, count + 1
      end
    end
    t.ok(count > 0, menu)
    view:click(bar.x + 4, bar.y + 8)
  end
  view:close()
end)

test("the console shows the Lua of each command, of undo, and results with names", function(t)
  local session, view = open()
  view:menu "Grasp/Auto Grasp"
  view:menu "Edit/Undo"
  view:run("grasp.quality", {measure = "volume"})
  local text = console_of(view)
  t.ok(text:find('world:robot("barrett"):autograsp()', 1, true), text)
  t.ok(text:find("stopped by: .*barrett_chain0_link2"), text)
  t.ok(text:find("session:undo()  -- Auto Grasp", 1, true), text)
  t.ok(text:find('session:run("grasp.quality", {measure = "volume"})', 1, true), text)
  view:close()
end)

test("units of the inspector can be chosen", function(t)
  local session, view = open()
  view:select "mug"
  t.ok(item(view, "^x %[m%]$"))
  view:menu "View/Millimeters"
  view:menu "View/Degrees"
  t.ok(item(view, "^x %[mm%]$"))
  local yaw = item(view, "^yaw %[°%]$")
  local before = session.object.pose
  view:drag(yaw.x + 60, yaw.y + yaw.height / 2, yaw.x + 100, yaw.y + yaw.height / 2)
  t.ok(session.object.pose ~= before)
  t.equal(#session.history.done, 2)
  view:key "ctrl+z"
  t.equal(session.object.pose == before, true)
  view:close()
end)

test("material, collisions and transparency act on the complete selection", function(t)
  local session, view = open()
  local link = session.hand.links[1]
  session:run("world.select", {addresses = {"mug", view:address(link)}})
  view:frame()
  view:click_label "material"
  view:click_label "rubber"
  t.equal(session.object.material, "rubber")
  t.equal(link.material, "rubber")
  view:click_label "collide with each other"
  t.equal(session.world:may_collide(session.object, link), false)
  local slider = item(view, "^transp")
  view:drag(slider.x + 12, slider.y + 8, slider.x + 70, slider.y + 8)
  t.ok(session.object.transparency > 0.1)
  t.equal(session.object.transparency, link.transparency)
  local other = load(session:script():gsub('"worlds/barrett_mug.wld"%)', '"worlds/barrett_mug.wld")') .. " return world")()
  t.equal(other:hash(), session.world:hash())
  view:close()
end)

test("any measure of the engine can be chosen, and measures follow the hand", function(t)
  local session, view = open()
  view:menu "Grasp/Auto Grasp"
  view:click_label "more"
  view:click_label "epsilon_force"
  t.equal(view.measures, {"epsilon", "volume", "epsilon_force"})
  t.close(view.quality.measures.epsilon_force, clench.grasp(session.hand, session.object):quality "epsilon_force", 1e-12)
  local drop = beside(view, "volume")
  view:click(drop.x + 6, drop.y + 6)
  t.equal(view.measures, {"epsilon", "epsilon_force"})
  view:menu "Grasp/Auto Open"
  view:frame()
  t.equal(#view.quality.contacts, 0)
  view:close()
end)

test("an edit of the friction table is one command", function(t)
  local session, view = open()
  view:click_label "Friction"
  local cell = beside(view, "frictionless")
  local before = session.world:friction("frictionless", "frictionless")
  view:drag(cell.x + 20, cell.y + 8, cell.x + 60, cell.y + 8)
  local after = session.world:friction("frictionless", "frictionless")
  t.ok(after > before)
  view:key "ctrl+z"
  t.close(session.world:friction("frictionless", "frictionless"), before, 1e-12)
  view:close()
end)

test("an eigengrasp slider moves the hand, a fixed one does not, and the posture can become the origin", function(t)
  local session, view = open "dlr_flask"
  view:click_label "EigenGrasps"
  local slider = item(view, "^EG 1")
  local before = session.hand.amplitudes[1]
  view:drag(slider.x + 10, slider.y + 8, slider.x + 60, slider.y + 8)
  local moved = session.hand.amplitudes[1]
  t.ok(moved ~= before)
  local fixed = item(view, "^fixed$")
  view:click(fixed.x + 8, fixed.y + 8)
  view:drag(slider.x + 60, slider.y + 8, slider.x + 20, slider.y + 8)
  t.equal(session.hand.amplitudes[1], moved)
  view:click_label "Set Origin"
  for _, amplitude in ipairs(session.hand.amplitudes) do t.close(amplitude, 0, 1e-9) end
  view:close()
end)

test("eigengrasps are saved, replaced by one per DOF, and loaded, each as one command", function(t)
  local session, view = open "dlr_flask"
  view:click_label "EigenGrasps"
  local hand = session.hand
  local old, path = hand.eigengrasps, test.path ".xml"
  session:run("grasp.save_eigengrasps", {path = path})
  view:click_label "Use Identity"
  t.equal(hand.eigengrasps.count, #hand.dofs)
  for i, value in ipairs(hand.dofs) do
    t.close(hand.amplitudes[i], value, 1e-12)
    t.equal(hand.eigengrasps.limits[i], hand.dof_limits[i])
  end
  session:run("grasp.load_eigengrasps", {path = path})
  t.equal(session.hand.eigengrasps.count, old.count)
  for i = 1, old.count do
    for j = 1, #hand.dofs do t.close(session.hand.eigengrasps.vectors[i][j], old.vectors[i][j], 1e-6) end
  end
  t.equal(assert(load(session:script() .. "\nreturn world", "=script", "t"))():hash(), session.world:hash())
  view:close()
end)

test("virtual contacts are found, marked, saved, loaded and cleared", function(t)
  local session, view = open()
  session:run "grasp.autograsp"
  view:click_label "Virtual Contacts"
  view:click_label "Clear"
  t.equal(#session.hand.virtual_contacts, 0)
  view:click_label "Mark Contacts"
  t.equal(#session.hand.virtual_contacts, #session.world:contacts(session.hand, session.object))
  local path = os.tmpname() .. ".vgr"
  session:run("grasp.save_virtual", {path = path})
  local count = #session.hand.virtual_contacts
  view:click_label "Find"
  t.ok(#session.hand.virtual_contacts ~= count)
  session:run("grasp.load_virtual", {path = path})
  t.equal(#session.hand.virtual_contacts, count)
  os.remove(path)
  session:run "grasp.open"
  t.fails(function() session:run "grasp.mark_virtual" end, "the hand does not touch the object")
  view:close()
end)

test("an arch is built from the menu, stands on its supports, and rejects bad radii", function(t)
  local session, view = open()
  view:run "world.new"
  view:menu "Misc./Arch Builder…"
  view:click_label "OK"
  t.equal(#session.world.objects, 9)
  t.equal(#session.world.obstacles, 2)
  local key = session.world:body "block5"
  local before = key.com.z
  session:run("dynamics.run", {seconds = 0.2})
  t.close((key.pose * key.com).z, before, 0.005)
  t.fails(function() clench.build_arch(clench.world(), {outer_radius = 0.5}) end, "outer_radius must exceed inner_radius, 0.9, got 0.5")
  t.fails(function() clench.build_arch(clench.world(), {blocks = 2.5}) end, "blocks must be a whole number from 3 to 200, got 2.5")
  t.fails(function() clench.build_arch(clench.world(), {block = 2}) end, "unknown key 'block'")
  t.fails(function() clench.build_arch(clench.world(), {thickness = "x"}) end, "thickness must be a number > 0, got 'x'")
  t.fails(function() clench.build_arch(clench.world(), {thickness = 0}) end, "thickness must be a number > 0, got 0")
  t.fails(function() clench.build_arch "x" end, "expected a world, got 'x'")
  view:close()
end)

test("a planner is started, its results are stepped through, and targets become its arguments", function(t)
  local session, view = open()
  view:menu "Grasp/EigenGrasp Planner…"
  local state = view.dialogs["planner.anneal"]
  view:click_label "Variables"
  local searched = item(view, "^Tz$")
  view:click(searched.x + 8, searched.y + 8)
  t.equal(state.fixed, {"Tz"})
  view:click(searched.x + 8, searched.y + 8)
  t.equal(state.fixed, nil)
  state.steps, state.seconds = 3000, nil
  view:click_label "Start"
  t.equal(state.error, nil)
  state.job:wait(60)
  view:frame()
  local grasps = session:grasps_of(state.job)
  t.ok(#grasps >= 2, #grasps)
  view:click_label "Best"
  local best = session.world:hash()
  view:click_label ">"
  t.equal(state.rank, 2)
  view:click_label "<"
  t.equal(session.world:hash(), best)
  view:close()
end)

test("the dialog of a planner that finds nothing shows why", function(t)
  local session, view = open()
  view.picture_visible = false
  view:menu "Grasp/Sampling Planner…"
  local state = view.dialogs["planner.sample"]
  state.candidates, state.seed, state.refine, state.verify = 2, 6, 0, false
  view:click_label "Start"
  t.equal(state.error, nil)
  state.job:wait(60)
  t.equal(#session:grasps_of(state.job), 0)
  view:frame()
  t.ok(state.report:find "nothing touched: 1" and state.report:find "friction", state.report)
  view:close()
end)

test("print writes into the console, also in functions that fail, and Up and Down recall lines", function(t)
  local _, view = open()
  local before = print
  local function enter(text)
    for _, line in ipairs(view:items()) do
      if line.kind == "input" and line.window == "bottom" then view:click(line.x + 10, line.y + line.height / 2) end
    end
    view:type(text)
    view:key "enter"
  end
  enter "print(hand.name, 1 + 1)"
  t.equal(view.lines[#view.lines].text, view.session.hand.name .. "\t2")
  enter "(function() print 'so far' error 'no further' end)()"
  local text = console_of(view)
  t.ok(text:find "\nso far\n.*no further", text)
  t.equal(print == before, true)
  view:key "up"  -- the input has the keys again
  t.ok(view.console_text:find "so far", view.console_text)
  view:key "up"
  t.equal(view.console_text, "print(hand.name, 1 + 1)")
  view:key "up"
  view:key "down"
  view:key "down"
  t.equal(view.console_text, "")
  view:key "up"
  view:key "up"
  local count = #view.lines
  view:key "enter"
  t.equal(#view.lines, count + 2)
  view:close()
end)

test("empty panels say what to do, and the inspector shows the facts of the world while nothing is selected", function(t)
  local session, view = open()
  view:frame()
  t.ok(texts_of(view):find "Ctrl%+P finds a command", "console")
  for _, text in ipairs {"1 robot, 4 DOFs", "1 object, 0 obstacles", "worlds/barrett_mug.wld", "0.000 s, in steps of"} do t.ok(texts_of(view):find(text, 1, true), text) end
  t.ok(texts_of(view):find(("%s, %.4g kg"):format(session.object.name, session.object.mass), 1, true))
  session:run "grasp.autograsp"
  view:frame()
  t.equal(texts_of(view):find "Ctrl%+P finds a command", nil)
  view:close()
end)

test("the status bar names what overlaps, counts contacts, and confirms what was saved; an error stays until the next action", function(t)
  local session, view = open()
  view:frame()
  t.ok(texts_of(view):find "no overlap", "nothing overlaps")
  session:run("body.move", {body = "mug", pose = session.hand.pose})
  view:frame()
  local pair = session.world:colliding()[1]
  t.ok(texts_of(view):find(("overlap: %s and %s"):format(pair[1].name, pair[2].name), 1, true), "the first pair")
  session:undo()
  session:run "grasp.autograsp"
  view:frame()
  local count = #session.world:contacts(session.hand, session.object)
  t.ok(texts_of(view):find(("touch: %d contacts"):format(count), 1, true), "contacts")
  local path = os.tmpname() .. ".wld"
  view:run("world.save_as", {path = path})
  t.equal(view.status, "Saved " .. path)
  os.remove(path)
  view:run("body.remove", {body = "mgu"})
  local problem = view.status
  t.ok(problem:find "mgu", problem)
  for _ = 1, 3 do view:frame() end
  t.equal(view.status, problem)
  view:run "grasp.open"
  t.equal(view.status, "Ready")
  view:run("world.import_object", {path = "models/objects/mug.iv", pose = session.object.pose})
  t.ok(view.status:find "'mug_2' overlaps 'mug'", view.status)
  view:close()
end)

test("the dialog of an import has fields for the pose, and places the body by itself without them", function(t)
  local session, view = open()
  local path = "models/objects/box.iv"
  view:menu "File/Import Object…"
  view:frame()
  view:type(path)
  view:key "enter"
  t.equal(#session.world.objects, 2)
  t.equal(#session.world:colliding(session.world.objects[2]), 0)
  t.ok(view.status:find "'box' is", view.status)
  view:menu "File/Import Object…"
  view:frame()
  view:type(path)
  view:frame()
  local field
  for _, found in ipairs(view:items()) do field = field or found.kind == "drag" and found.y > 150 and found.y < 420 and found.x > 330 and found.x < 760 and found end
  view:drag(field.x + 10, field.y + 8, field.x + 110, field.y + 8)
  local pose = view.dialogs["world.import_object"].pose
  t.ok(pose.position.x > 0.05, tostring(pose))
  view:click_label "OK"
  t.close(session.world.objects[3].pose.position, pose.position, 1e-12)
  view:select "box"
  view:menu "Element/Move…"
  view:frame()
  t.equal(view.dialogs["body.move"].body, "box")
  t.close(view.dialogs["body.move"].pose.position, session.world:body "box".pose.position, 1e-12)
  view:close()
end)

test("steps are redone in the panel History while dynamics play, which ends the list of undone steps", function(t)
  local session, view = open()
  for i = 1, 3 do session:run("body.move", {body = "mug", pose = {xyz = {0, 0, 0.01 * i}}}) end
  for _ = 1, 3 do session:undo() end
  view:click_label "History"
  session:run "dynamics.play"
  clench.loop.run(0.1)
  t.equal(#session.history.undone, 3)
  local next_step = item(view, "%(undone%)")
  view.ui:input {kind = "move", x = next_step.x + 5, y = next_step.y + next_step.height / 2}
  for _, down in ipairs {true, false} do view.ui:input {kind = "button", code = 0, down = down} end
  repeat t.equal(texts_of(view):find "history%.lua:%d+", nil) until not view.ui:poll()  -- an error is shown for one frame
  t.equal(#session.history.undone, 0)
  t.ok(not session.playing)
  view:close()
end)

test("the links that a DOF moves are outlined while the mouse is on its slider", function(t)
  local moved_links = require "clench.view.moved_links"
  local session, view = open("barrett_mug", {1100, 1300})
  local function names(dof)
    local list = {}
    for i, link in ipairs(moved_links(session.hand, dof)) do list[i] = link.name:gsub("barrett_", "") end
    return list
  end
  t.equal(names(1), {"chain0_link0", "chain0_link1", "chain0_link2", "chain1_link0", "chain1_link1", "chain1_link2"})
  t.equal(names(4), {"chain2_link0", "chain2_link1"})
  local before = session.world:hash()
  session.hand.dofs = {0, session.hand.dof_limits[2][2], 0.5, 0.5}
  t.equal(names(2), {"chain0_link1", "chain0_link2"})
  session.hand.dofs = {0, 0.5, 0.5, 0.5}
  t.equal(session.world:hash(), before)

  view:select "barrett"
  local function settle()
    repeat view:frame() until not view.needs_frame and not view.ui:poll()
  end
  local slider = item(view, "^dof2")
  view.ui:input {kind = "move", x = slider.x + 10, y = slider.y + 8}
  settle()
  t.equal(view.drawn_mark.dof, 2)
  local function blue_pixels()
    local picture, count = view:screenshot {panels = true}, 0
    for y = 100, 900, 2 do
      for x = 280, 820, 2 do
        local r, g, b = picture:pixel(x, y)
        if r < 40 and g > 80 and g < 140 and b > 140 then count = count + 1 end
      end
    end
    return count
  end
  local marked = blue_pixels()
  view.ui:input {kind = "move", x = 500, y = 950}
  settle()
  t.equal(view.drawn_mark, nil)
  t.ok(marked > blue_pixels() + 50, marked)
  view:close()
end)
