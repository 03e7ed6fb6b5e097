-- Values as printed by the console.
local test, show = require "test", require "clench.show"

test("tables show their contents, lists first, names sorted", function(t)
  t.equal(show {3, 2, b = 1, a = {x = {}}}, "{3, 2, a = {x = {}}, b = 1}")
  t.equal(show {[1.5] = 1, ["a b"] = 2, [true] = 3, [-1] = 4}, '{[true] = 3, [-1] = 4, [1.5] = 1, ["a b"] = 2}')
  t.equal(show {"a\nb", 'q"'}, [[{"a\nb", "q\""}]])
  t.equal(show "plain", "plain")
  t.equal(show(nil), "nil")
  t.equal(show {clench.vec3(1, 2, 3)}, "{(1, 2, 3)}")
end)

test("long, deep or recursive values are abbreviated, with a mark", function(t)
  local long = {}
  for i = 1, 1000 do long[i] = i end
  t.ok(#show(long) < 500)
  t.ok(show(long):find "%.%.%. %d+ more}$")
  t.ok(#show(long, 40) < 80)
  local self = {}
  self.self = self
  t.equal(show(self), "{self = <itself>}")
  local deep = {}
  for _ = 1, 20 do deep = {deep} end
  t.equal(show(deep), "{{{{{{...}}}}}}")
end)

test("a table with its own __tostring shows that, even if it fails", function(t)
  t.equal(show(setmetatable({}, {__tostring = function() return "mine" end})), "mine")
  t.ok(show(setmetatable({}, {__tostring = function() error("no", 0) end})):find "whose text fails: no")
  t.equal(show(setmetatable({1}, {__index = function() error "ran" end, __len = function() return 9 end})), "{1}")
end)
