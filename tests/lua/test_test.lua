-- The test library's own claims, and what it says when a claim does not hold.
local test = require "test"

test("close compares numbers, vectors and lists", function(t)
  t.close(1, 1.05, 0.1)
  t.close(clench.vec3(1, 2, 3), {1, 2, 3.05}, 0.1)
  t.close({{1, 2}, {3, 4}}, {{1, 2}, {3, 4}}, 0)
  t.close(math.huge, math.huge, 0)
  t.fails(function() t.close(1, 2, 0.5) end, "expected 2 within 0.5, got 1, off by 1")
  t.fails(function() t.close({1, 2}, {1, 3}, 0.5) end, "off by 1")
  t.fails(function() t.close({1, 2}, {1}, 0.5) end, "lists of one length")
  t.fails(function() t.close(nil, 1, 0.5) end, "got nil")
  t.fails(function() t.close(0 / 0, 1, 0.5) end, "expected 1")
  t.fails(function() t.close({0, 0 / 0}, {0, 1}, 0.5) end, "expected {0, 1}")
  t.fails(function() t.close(1, 1) end, "expected a tolerance")
end)

test("equal compares tables by their contents", function(t)
  t.equal({1, {a = 2}}, {1, {a = 2}})
  t.equal(clench.vec3(1, 2, 3), clench.vec3(1, 2, 3))
  t.fails(function() t.equal({1}, {1, 2}) end, "expected {1, 2}, got {1}")
  t.fails(function() t.equal({1, 2}, {1}) end, "expected {1}")
  t.fails(function() t.equal("1", 1) end, "expected 1")
end)

test("fails wants an error with every text, and returns its message", function(t)
  t.equal(t.fails(function() error("a and b", 0) end, "a", "b"), "a and b")
  t.fails(function() t.fails(function() end) end, "expected an error, got none")
  t.fails(function() t.fails(function() error "x" end, "y") end, "expected an error with 'y'")
  -- plain text, not a pattern
  t.fails(function() error "100%" end, "100%")
end)

test("ok wants something true", function(t)
  t.ok(1)
  t.fails(function() t.ok(nil) end, "expected true, got nil")
  t.fails(function() t.ok(false, "mine") end, "mine")
end)

test("a test without a claim or a function is refused", function(t)
  t.fails(function() test(1, function() end) end, "expected a claim and a function")
  t.fails(function() test "alone" end, "expected a claim and a function")
end)
