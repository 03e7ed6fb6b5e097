-- Tab in the console: names from existing values.
local test, complete = require "test", require "clench.host.complete"

local function words(line)
  local list = table.pack(complete.words(line))
  return table.remove(list, 1), list
end
local function has(list, word)
  for _, w in ipairs(list) do
    if w == word then return true end
  end
end

test("globals and keywords", function(t)
  some_global = 1
  local typed, list = words "x = some_"
  t.equal(typed, "some_")
  t.equal(list[1], "some_global")
  t.ok(has(select(2, words "whi"), "while"))
  some_global = nil
end)

test("fields of tables, of libraries and of modules that are not loaded yet", function(t)
  scene = {part = {inner = {alpha = 1}}, list = {{beta = 2}}}
  t.equal({words "scene.part.inner.al"}, {"al", {"alpha", n = 2}})
  t.ok(has(select(2, words "scene.list[1]."), "beta"))
  t.ok(has(select(2, words "clench.ver"), "version"))
  t.ok(has(select(2, words "clench.sha"), "shapes"))
  t.ok(has(select(2, words "clench.shapes."), "box"))
  t.ok(has(select(2, words "clench.json.en"), "encode"))
  scene = nil
end)

test("fields after a dot, methods after a colon", function(t)
  value = clench.pose {}
  t.ok(has(select(2, words "value."), "position"))
  t.ok(not has(select(2, words "value."), "inverse"))
  t.ok(has(select(2, words "print(value:in"), "inverse"))
  t.ok(has(select(2, words "value.position:"), "norm"))
  text = "x"
  t.ok(has(select(2, words "text:up"), "upper"))
  value, text = nil, nil
end)

test("names of measures, of objects in a world, and of files in strings, and keys of options in braces", function(t)
  world = clench.world()
  hand = world:add_robot("models/hands/dlr/dlr.cfg", {name = "dlr"})
  t.equal({words 'grasp:quality "epsilon_f'}, {"epsilon_f", {"epsilon_force", n = 2}})
  t.equal({words "world:robot('"}, {"", {"dlr", n = 2}})
  t.ok(has(select(2, words 'hand:link "dlr_chain0'), "dlr_chain0_link2"))
  t.equal({words 'hand.base.material = "woo'}, {"woo", {"wood", n = 2}})
  world:add_keyframe "closed"
  t.equal({words 'world:set_keyframe "clo'}, {"clo", {"closed", n = 2}})
  t.equal({words 'hand.controller = "vel'}, {"vel", {"velocity", n = 2}})
  t.equal({words 'clench.load("worlds/d'}, {"\1worlds/d", {n = 1}})
  t.equal({words 'world:body("\\"'}, {'\\"', {n = 1}})
  t.equal({words "hand:autograsp {sp"}, {"sp", {"speed", n = 2}})
  t.equal({words "hand:set_dofs {dof1"}, {"dof1", {"dof1", "dof10", "dof11", "dof12", n = 5}})
  t.ok(has(select(2, words "clench.study.fall_off {hand = hand, gri"), "grip_force"))
  t.equal({words "hand:autograsp({speed = 1, "}, {"", {"dofs", "dynamic", "speed", "stages", "stop_at_contact", n = 6}})
  t.equal({words "world:add_object('mug.iv', {pose = {xyz = {1, 2, 3}}, trans"}, {"trans", {"transparency", n = 2}})
  t.ok(has(select(2, words "clench.shapes.box {0.1, ro"), "rounding"))
  t.ok(has(select(2, words "x = {wor"), "world"))
  t.equal({words "print('x') -- 'hand:no"}, {"no", {n = 1}})
  world, hand = nil, nil
end)

test("completion runs no code of the user, and never fails", function(t)
  trap = setmetatable({}, {__index = function() error "ran" end, __pairs = function() error "ran" end,
                           __name = setmetatable({}, {__tostring = error})})
  for _, line in ipairs {"trap.", "trap.x.", "trap:", "nothing.at.all.", "f().x", "a..b", "...", "1.", "x = 'a.", "", "()",
                         "clench.nothing.", "value[", "a[1", "a[1].", ":", ".", "\0", "clench.shapes.nothing."} do
    t.equal(type((complete.words(line))), "string")
  end
  t.equal(#select(2, words "trap."), 0)
  trap = nil
end)
