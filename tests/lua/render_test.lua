local test, clench = require "test", require "clench"

test("a size that is none and an up along the view are refused by name", function(t)
  local world = clench.world()
  world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "cube"})
  local function fails(options, message) t.fails(function() clench.render(world, options) end, message) end
  fails({size = {-1, 10}}, "size: expected whole numbers of pixels, 16 to 8192, got -1")
  fails({size = {16, 0}}, "size: expected whole numbers of pixels, 16 to 8192, got 0")
  fails({size = {100.5, 100}}, "size: expected whole numbers of pixels, 16 to 8192, got 100.5")
  fails({size = {100, 15}}, "size: expected whole numbers of pixels, 16 to 8192, got 15")
  fails({size = {1e9, 100}}, "size: expected whole numbers of pixels, 16 to 8192, got 1000000000")
  fails({size = {10}}, "size: expected 2 numbers, got 1")
  fails({eye = {0, 0, 1}, target = {0, 0, 0}, up = {0, 0, 1}}, "expected eye and target apart, and up not along the view")
  fails({eye = {0, 0, 1}, target = {0, 0, 0}, up = {0, 0, -3}}, "up not along the view")
  fails({up = {0, 0, 0}}, "up not along the view")
end)

test("options of figures are refused by name", function(t)
  local world = clench.world()
  local function fails(options, message) t.fails(function() clench.render(world, options) end, message) end
  fails({quality = "draft", samples = 8}, "samples: expected 1, 4, 9 or 16 of a draft, got 8")
  fails({ground = "low"}, "ground: expected true, false, or the height of the floor in metres, got 'low'")
  fails({outline = 40}, "outline: expected 0 to 32 pixels, got 40")
  fails({letters = -1}, "letters: expected 0 to 200 pixels, got -1")
  fails({orthographic = "yes"}, "orthographic: expected true, false, or a height > 0 in metres")
  fails({orthographic = -1}, "orthographic: expected true, false, or a height > 0 in metres")
  fails({background = "black"}, "background")
  fails({cones = "force"}, "cones: 'force' needs the option forces")
end)
