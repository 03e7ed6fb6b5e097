-- Tab in the console: names from live values.
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

test("nothing of the user's runs, and nothing fails", function(t)
  trap = setmetatable({}, {__index = function() error "ran" end, __pairs = function() error "ran" end,
                           __name = setmetatable({}, {__tostring = error})})
  for _, line in ipairs {"trap.", "trap.x.", "trap:", "nothing.at.all.", "f().x", "a..b", "...", "1.", "x = 'a.", "", "()",
                         "clench.nothing.", "value[", "a[1", "a[1].", ":", ".", "\0", "clench.shapes.nothing."} do
    t.equal(type((complete.words(line))), "string")
  end
  t.equal(#select(2, words "trap."), 0)
  trap = nil
end)
