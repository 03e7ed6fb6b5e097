-- The time line of the viewer: recorded runs and their replay, driven by synthetic input.
local test, clench = require "test", require "clench"
local loop = clench.loop

local function open()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  session:run "grasp.autograsp"
  local view = clench.view.offscreen {session = session, size = {1070, 700}}
  view:frame()
  view:frame()  -- tabs are laid out in the second frame
  view:click_label "Time Line"
  return session, view
end

-- runs a command and shows its result
local function run(session, view, name, args)
  session:run(name, args)
  view:frame()
end

local function item(view, label)
  view:frame()
  for _, found in ipairs(view:items()) do
    if found.label == label then return found end
  end
  error("no widget " .. label)
end

local function slider(view)
  for _, found in ipairs(view:items()) do
    if found.kind == "slider" and found.window == item(view, "Time Line").window then return found end
  end
end

test("dynamics that play are recorded: one step of undo, and the script leads to the same world", function(t)
  local session, view = open()
  local before, steps = session.world:hash(), #session.history.done
  view:click_label "Play Dynamics"
  local last = loop.time() + 60
  while not (session.recording and #session.recording.times >= 5) and loop.time() < last do loop.run(0.01) end
  view:click_label "Pause Dynamics"
  t.equal(session.playing, nil)
  t.equal(#session.history.done, steps + 1)
  local after = session.world:hash()
  local times = session.recording.times
  t.close(times[1], 0, 1e-12)
  for i = 2, #times - 1 do t.close(times[i] - times[i - 1], 1 / 30, session.world.time_step + 1e-9) end
  -- the last state is that at Pause
  t.equal(times[#times], session.world.time)
  t.ok(times[#times] > times[#times - 1])
  local last_state = session.world:clone()
  last_state:restore(session.recording.moments[#times])
  t.equal(last_state:hash(), after)
  t.equal(load(session:script() .. " return world")():hash(), after)
  view:key "ctrl+z"
  t.equal(session.world:hash(), before)
  -- what was recorded can be replayed after the undo, too
  view:click_label "Replay"
  t.ok(view.replay ~= nil)
  t.equal(session.world:hash(), before)
  view:close()
end)

-- states of the same run, stepped by a loop of the script
local function states_of(session, seconds, times)
  local world = session.world:clone()
  local film = world:record {rate = 30}
  world:run(seconds)
  local hashes = {}
  film:each(function(state, i, time)
    hashes[i] = state:hash()
    assert(math.abs(time - times[i]) < 1e-9)
  end)
  return hashes
end

test("the picture shows recorded states bit-exactly, and the world stays as it is", function(t)
  local session, view = open()
  session.object.velocity = {linear = {0, 0, 0.3}, angular = {0, 0, 0}}
  local start = session.world:clone()
  run(session, view, "dynamics.run", {seconds = 0.2})
  local times, live = session.recording.times, session.world:hash()
  t.equal(#times, 7)
  local hashes = states_of({world = start}, 0.2, times)
  view:click_label "|<"
  t.equal(view.replay.world:hash(), hashes[1])
  view:click_label ">"
  view:click_label ">"
  t.equal(view.replay.index, 3)
  t.equal(view.replay.world:hash(), hashes[3])
  view:click_label "<"
  t.equal(view.replay.world:hash(), hashes[2])
  view:click_label ">|"
  t.equal(view.replay.world:hash(), hashes[7])
  local bar = slider(view)
  view:click(bar.x + 3, bar.y + bar.height / 2)
  t.equal(view.replay.index, 1)
  t.equal(session.world:hash(), live)
  -- the picture is that of the state, and its panels follow it
  local shown = view:screenshot {panels = false}
  t.equal(shown == clench.render(view.replay.world, {size = {1070, 700}, camera = view.camera, quality = "draft"}), true)
  view:frame()
  t.equal(view.quality.contacts[1].body, view.replay.world.objects[1])
  view:click_label "Present"
  t.equal(view.replay, nil)
  view:frame()
  t.equal(#view.quality.contacts, #session.world:contacts(session.hand, session.object))
  view:close()
end)

test("a replay plays at its speed and ends at the last state; any change shows the world again", function(t)
  local session, view = open()
  run(session, view, "dynamics.run", {seconds = 0.3})
  view:click_label "Replay"
  local first = view.replay.index
  for _ = 1, 6 do view:frame() end
  t.ok(view.replay.index > first)
  for _ = 1, 30 do view:frame() end
  t.equal(view.replay.index, #session.recording.times)
  t.equal(view.replay.plays, false)
  -- recorded states are not dragged
  local mug, live = session.object, session.world:hash()
  view:tool "Translate"
  local x, y = view:project(mug.pose * mug.com)
  t.equal(view:pick(x, y).body, mug)
  view:drag(x, y, x + 60, y)
  t.equal(session.world:hash(), live)
  session:run "grasp.open"
  t.equal(view.replay, nil)
  session:run "world.new"
  view:frame()
  t.equal(item(view, "Replay").enabled, false)
  view:close()
end)

test("a recorded run is saved as a film; without one there is nothing to save", function(t)
  local session, view = open()
  t.fails(function() session:run("dynamics.save_film", {path = "run.html"}) end, "no run was recorded")
  t.equal(item(view, "Save Film…").enabled, false)
  run(session, view, "dynamics.run", {seconds = 0.1})
  local path = os.tmpname() .. ".html"
  view:click_label "Save Film…"
  view:frame()
  view:type(path)
  view:click_label "OK"
  local file <close> = assert(io.open(path))
  t.ok(#file:read "a" > 100000)
  os.remove(path)
  t.fails(function() session:run("dynamics.save_film", {path = "run.txt"}) end, "ends in .html, .gif, .mp4 or .png")
  -- the run of another world is not that of the open one
  session:run "world.new"
  t.fails(function() session:run("dynamics.save_film", {path = path}) end, "no run was recorded")
  session:undo()
  t.ok(session.commands["dynamics.save_film"].enabled(session))
  view:close()
end)

test("a run that is shorter than the interval of states can be replayed, and one that is slower than real time is described as such", function(t)
  local session, view = open()
  item(view, "Runs of the dynamics are recorded, and can be replayed here.")
  run(session, view, "dynamics.run", {seconds = 0.01})
  t.equal(#session.recording.times, 2)
  t.close(session.recording.times[2] - session.recording.times[1], 0.01, 1e-9)
  item(view, "Replay")
  t.equal(item(view, "|<").enabled, true)
  view:click_label "Play Dynamics"
  session.playing.began = loop.time() - 100
  loop.run(0.03)
  view:frame()
  local found = ""
  for _, widget in ipairs(view:items()) do found = widget.label:match "^recording, .*" or found end
  local share = tonumber(found:match "^recording, [%d.]+ s, at ([%d.e-]+) of real time$")
  t.ok(share and share > 0 and share < 0.02, found)
  view:click_label "Pause Dynamics"
  view:close()
end)

test("curves of quality, forces and motor efforts have a point per change, of another world none", function(t)
  local session, view = open()
  session:run "grasp.open"
  view:frame()
  session:run("dynamics.close_hand", {})
  for _ = 1, 3 do run(session, view, "dynamics.run", {seconds = 0.05}) end
  local hand, largest, force = session.hand, 0, 0
  for _, effort in ipairs(hand.dof_efforts) do largest = math.max(largest, math.abs(effort)) end
  for _, contact in ipairs(session.world:contacts(hand, session.object)) do force = force + contact.force:norm() end
  local count = #view.curves.effort
  t.ok(count >= 5, count)
  t.ok(largest > 0, largest)
  t.equal(view.curves.effort[count], largest)
  t.equal(view.curves.force[count], force)
  t.equal(view.curves.contacts[count], #view.quality.contacts)
  t.equal(view.curves.epsilon[count], view.quality.measures.epsilon or 0)
  view:frame()
  t.equal(#view.curves.effort, count)
  -- a curve per motor; the largest of them is that of the curve before
  t.equal(#view.curves.efforts, #hand.dof_efforts)
  for i, effort in ipairs(hand.dof_efforts) do
    t.equal(#view.curves.efforts[i], count)
    t.equal(view.curves.efforts[i][count], effort)
  end
  view:click_label "Plots"
  local plots = 0
  for _, widget in ipairs(view:items()) do plots = plots + (widget.kind == "plot" and 1 or 0) end
  t.equal(plots, 4)
  -- each curve has its own color, which its name in the legend has, too
  local all = view:screenshot {}
  local motor = item(view, ("%.3g  dof2 (finger 1: joints 2, 3)"):format(view.curves.efforts[2][count]))
  view:click(motor.x + 5, motor.y + motor.height / 2)
  t.equal(view.shown_motor, 2)
  view:frame()
  t.ok(view:screenshot {} ~= all)
  view:click(motor.x + 5, motor.y + motor.height / 2)
  t.equal(view.shown_motor, nil)
  session:open("worlds/parallel_jaw_cube.wld", {root = "."})
  view:frame()
  t.ok(#view.curves.effort <= 1, #view.curves.effort)
  view:close()
end)

test("what was added after the run is left out of recorded states, with its outline, axes, boxes and measures", function(t)
  local session, view = open()
  session:run("dynamics.run", {seconds = 0.1})
  local cube = session:run("world.import_object", {path = "models/objects/cube.iv", pose = {xyz = {0.3, 0, 0}}})
  t.ok(session.object == cube)
  view:select "cube"
  view.shows_axes, view.box_depth, view.shows_wrenches, view.front.right = true, 3, true, "Author"
  view:frame()
  view.picture_visible = true
  view:click_label "Time Line"
  view:click_label "|<"
  t.ok(view.replay)
  local texts = {}
  view:frame()
  for _, shown in ipairs(view:items()) do texts[#texts + 1] = shown.label end
  texts = table.concat(texts, "\n")
  t.ok(texts:find("The recorded state lacks the hand or the object.", 1, true))
  t.equal(texts:find "another world", nil)
  t.equal(view.status:find "another world", nil)
  view:click_label "Present"
  view:frame()
  t.ok(view.quality)
  view:close()
end)
