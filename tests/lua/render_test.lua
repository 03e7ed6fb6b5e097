local test, clench = require "test", require "clench"

test("a size that is none and an up along the view are refused by name", function(t)
  local world = clench.world()
  world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "cube"})
  local function fails(options, message) t.fails(function() clench.render(world, options) end, message) end
  fails({size = {-1, 10}}, "size: expected whole numbers of pixels, at least 1, got -1")
  fails({size = {10, 0}}, "size: expected whole numbers of pixels, at least 1, got 0")
  fails({size = {10.5, 10}}, "size: expected whole numbers of pixels, at least 1, got 10.5")
  fails({size = {10}}, "size: expected 2 numbers, got 1")
  fails({eye = {0, 0, 1}, target = {0, 0, 0}, up = {0, 0, 1}}, "expected eye and target apart, and up not along the view")
  fails({eye = {0, 0, 1}, target = {0, 0, 0}, up = {0, 0, -3}}, "up not along the view")
  fails({up = {0, 0, 0}}, "up not along the view")
end)
