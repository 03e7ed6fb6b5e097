-- The viewer's panel that authors grasps, and the commands behind it.
local test, clench = require "test", require "clench"

local function open()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {1070, 1400}}
  view:frame()
  view:click_label "Author"
  return session, view
end

local function close_to(t, pose, other, tolerance)
  t.close((pose.position - other.position):norm(), 0, tolerance)
  t.close(math.abs(pose.quat[1] * other.quat[1] + pose.quat[2] * other.quat[2] + pose.quat[3] * other.quat[3] + pose.quat[4] * other.quat[4]), 1, tolerance)
end

local function same_numbers(t, list, other, tolerance)
  t.equal(#list, #other)
  for i, x in ipairs(list) do t.close(x, other[i], tolerance) end
end

test("a grasp that was authored in the panel is found again in JSON lines and in isaac_grasp", function(t)
  local session, view = open()
  local hand, mug = session.hand, session.object
  hand.pose = clench.pose {xyz = -0.05 * hand.approach.direction:unit()} * hand.pose
  view:click_label "Set Pregrasp"
  local before = {pose = mug.pose:inverse() * hand.pose, dofs = hand.dofs}
  view:click_label "+ Approach"
  view:click_label "+ Close"
  view:click_label "Play Phases"
  t.ok(#session.world:contacts(hand, mug) > 0)
  local expected = clench.grasp(hand, mug)
  view:click_label "Pull"
  clench.loop.wait(session.jobs[1], 300)
  view:frame()
  local verdict = session.jobs[1]:result()
  local state = view.author
  state.notes, state.confidence = "by the rim,\nthumb inside", 0.75
  view:click_label "Add Grasp"
  t.equal(state.name, "grasp_2")
  for _, ending in ipairs {"jsonl", "yaml"} do
    local path = ("%s.%s"):format(os.tmpname(), ending)
    view:click_label "Save…"
    view:frame()
    view:key "ctrl+a"
    view:type(path)
    view:click_label "Save"
    t.equal(view.ask, nil)
    local again = clench.grasps(path)[1]
    os.remove(path)
    close_to(t, again.pose, expected.pose, 1e-12)
    same_numbers(t, again:dofs_for(hand), expected.dofs, 1e-12)
    same_numbers(t, select(2, again:dofs_for(hand)), before.dofs, 1e-12)
    t.equal(again.labels.name, "grasp_1")
    t.close(again.info.confidence, 0.75, 1e-12)
    if ending == "jsonl" then
      close_to(t, again.pregrasp.pose, before.pose, 1e-12)
      t.equal(again.labels.notes, "by the rim,\nthumb inside")
      t.equal(clench.json.decode(again.labels.phases), {{kind = "approach", reach = 0.1}, {kind = "close"}})
      t.equal(again.info.tug_held, verdict.held)
      t.equal(again.info.tug_force, 1)
      t.close(again.measures.epsilon, expected:quality "epsilon", 1e-12)
    end
  end
  -- played again from the open hand, the phases lead to the same grasp; the script does the same
  session:run "grasp.open"
  session:run("grasp.close_in_phases", {pregrasp = before, phases = state.phases})
  close_to(t, clench.grasp(hand, mug).pose, expected.pose, 1e-9)
  same_numbers(t, hand.dofs, expected.dofs, 1e-9)
  view:close()
end)

test("phases are one step of undo, and the script repeats them", function(t)
  local session, view = open()
  local first = session.world:hash()
  view:click_label "Set Pregrasp"
  view:click_label "+ Posture"
  view:click_label "+ Close"
  session:run "grasp.autograsp"
  view:click_label "Play Phases"
  t.equal(load(session:script() .. " return world")():hash(), session.world:hash())
  local steps = #session.history.done
  view:click_label "Show Pregrasp"
  t.equal(#session.history.done, steps + 1)
  t.equal(session.world:hash(), first)
  view:key "ctrl+z"
  t.ok(#session.world:contacts(session.hand, session.object) > 0)
  view:close()
end)

test("an authored grasp replaces one of its name, is shown again with its phases, and is forgotten", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  t.fails(function() session:run("grasp.author", {name = "a"}) end, "the hand does not touch the object")
  session:run "grasp.autograsp"
  session:run("grasp.author", {name = "a", notes = "one"})
  session:run("grasp.author", {name = "a", notes = "two", phases = {{kind = "close"}}})
  t.equal(#session.authored, 1)
  t.equal(session.lists[1].grasps, session.authored)
  local view = clench.view.offscreen {session = session, size = {1070, 1400}}
  session:run "grasp.open"
  view:frame()
  view:click_label "Author"
  for _, item in ipairs(view:items()) do
    if item.label:find "^a  0%." then view:click(item.x + 10, item.y + 5) break end
  end
  t.equal(view.author.notes, "two")
  t.equal(view.author.phases, {{kind = "close"}})
  t.ok(#session.world:contacts(session.hand, session.object) > 0)
  t.fails(function() session:run("grasp.forget", {name = "b"}) end, "there is no authored grasp 'b'")
  session:run("grasp.forget", {name = "a"})
  t.equal(#session.authored, 0)
  t.fails(function() session:run("grasp.forget", {name = "a"}) end, "no grasp was authored")
  view:close()
end)

test("bad phases are refused by name", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local function play(phases, pregrasp) return function() session:run("grasp.close_in_phases", {phases = phases, pregrasp = pregrasp}) end end
  t.fails(play {{kind = "squeeze"}}, "phases[1]: expected {kind = \"approach\", \"posture\" or \"close\"}, got 'squeeze'")
  t.fails(play {{kind = "close"}, {kind = "approach"}}, "phases[2].reach: expected a number, got nothing")
  t.fails(play {{kind = "close", speed = 2}}, "phases[1]: unknown key 'speed'")
  t.fails(play {kind = "close"}, "phases: expected a list, got a table with names")
  t.fails(play({}, {pose = 3}), "pregrasp: expected {pose = a pose, dofs = a list of numbers}")
end)

test("names and notes that no file can store are refused", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  session:run "grasp.autograsp"
  local function author(name, notes) return function() session:run("grasp.author", {name = name, notes = notes}) end end
  t.fails(author "", "grasp.author: name: expected a name, got ''")
  t.fails(author "a\0b", "grasp.author: name: expected UTF-8 without control characters, got ")
  t.fails(author "\xff", "grasp.author: name: expected UTF-8 without control characters, got ")
  t.fails(author("a", "\0"), "grasp.author: notes: expected UTF-8 without zero bytes, got ")
  t.equal(session.authored, nil)
  author("é ## '\"]]", "one\ntwo\t\"'")()
  session:run("grasp.save_grasps", {path = "build/odd_names.jsonl", grasps = session.authored})
  local labels = clench.grasps("build/odd_names.jsonl")[1].labels
  t.equal({labels.name, labels.notes}, {"é ## '\"]]", "one\ntwo\t\"'"})
end)

test("damaged phases of a grasp are reported, and the panel works on", function(t)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  session:run "grasp.autograsp"
  session:run("grasp.author", {name = "a"})
  local view = clench.view.offscreen {session = session, size = {1070, 1400}}
  view:frame()
  view:click_label "Author"
  for _, damaged in ipairs {"{", "7", "[1]", '[{"kind":"approach"}]', '[{"kind":"posture","dofs":7}]', '{"kind":"close"}', "[null]"} do
    session.authored[1].labels = {name = "a", phases = damaged}
    view.status = "Ready"
    for _, item in ipairs(view:items()) do
      if item.label:find "^a  0%." then view:click(item.x + 10, item.y + 5) break end
    end
    t.equal(view.author.phases, {})
    t.ok(view.status ~= "Ready")
    view:click_label "+ Close"
    t.equal(view.author.phases, {{kind = "close"}})
  end
  view:close()
end)
