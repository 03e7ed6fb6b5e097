-- every request of a script ends soon, with a result or an error message
local test, clench = require "test", require "clench"

-- a hand that holds a flask
local function held()
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  hand:autograsp()
  return world, hand, flask
end

test("a patch of any radius is fitted or rejected", function(t)
  clench.log.sink(function() end)
  -- the corners of a cube on a plate share one patch, 5 mm across
  local world = clench.world()
  local plate = world:add_obstacle(clench.shapes.box {0.2, 0.2, 0.02}, {material = "wood", pose = {xyz = {0, 0, -0.01}}})
  local cube = world:add_object(clench.shapes.box {0.005, 0.005, 0.005}, {
    material = "rubber", elastic_modulus = 1.5e6, pose = {xyz = {0, 0, 0.00255}}})
  local corners = world:contacts(plate, cube)
  t.equal(#corners, 4)
  for power = -30, 20 do
    for _, fit in ipairs {"quadric", "jet"} do
      for _, flat in ipairs {10.0 ^ power, 0.02} do
        local ok, result = pcall(corners[1].fit_patch, corners[1], {radius = 10.0 ^ power, fit = fit, max_radius = flat})
        if ok then
          t.ok(result:ellipse {force = 5}.indentation >= 0)
        else
          t.ok(result:find "contact patch: " or result:find "without a fit", result)
        end
      end
    end
  end
  clench.log.sink()
end)

-- memory of the process [MB]
local function memory()
  for line in io.lines "/proc/self/status" do
    local kilobytes = line:match "VmRSS:%s*(%d+)"
    if kilobytes then return kilobytes / 1024 end
  end
end

test("memory owned by values is collected: memory use stays constant", function(t)
  local world, hand, flask = held()
  local set = {vectors = {}}
  for i = 1, 10 do
    set.vectors[i] = {}
    for k = 1, 300 do set.vectors[i][k] = i == k and 1 or 0 end
  end
  local makers = {
    function() return world:snapshot() end,
    function() return world:clone() end,
    function() return clench.chart {series = {{name = "x", values = {1, 2}}}} end,
    function() return clench.eigengrasps(set) end,
    function() return clench.grasp(hand, flask, {soft = false}):wrench_space {edges = 100} end,
  }
  collectgarbage()
  local before = memory()
  for _, make in ipairs(makers) do
    for _ = 1, 300 do make() end
  end
  t.ok(memory() - before < 200, ("%.0f MB more"):format(memory() - before))
end)

test("the number of points of shapes is limited", function(t)
  local shapes = clench.shapes
  t.fails(function() shapes.prism {outline = shapes.ring {1, segments = 2000}, height = 1} end,
    "shapes.prism: outline must have at most 1024 points, got 2000")
  t.fails(function() shapes.torus {1, 0.1, segments = 1000, sides = 1000} end,
    "shapes.torus: expected at most 300000 vertices, got 1000000")
  local points = {}
  for i = 1, 200000 do points[i] = {i, i * i} end
  t.fails(function() shapes.prism {outline = points, height = 1} end, "a list of at most 100000 points, got a table of 200000")
end)

test("messages of shapes are short, and integers are printed without a decimal point", function(t)
  local function message(radius) return select(2, pcall(clench.shapes.sphere, {radius})) end
  t.ok(#message(("x"):rep(1e6)) < 300)
  t.ok(message "a\0b\27":find("'a?b?'", 1, true))
  t.ok(message(-123456789012):find("got -123456789012", 1, true))
  t.ok(message(-3.0):find "got %-3$")
end)
