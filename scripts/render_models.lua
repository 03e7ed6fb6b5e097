-- scripts/render_models.lua
--- Draws every shipped model and world, each into a separate picture.
--- build/release/clench run scripts/render_models.lua [FOLDER] [PATTERN]
--- writes FOLDER/hands_barrett.png and so on, by default in build/models; only models whose path matches PATTERN. Hands are shown three times: open
--- from the front and from behind, and closed.
local clench = require "clench"
local folder, pattern = ...
folder = folder or "build/models"

local function bounds(bodies)
  local low, high = {math.huge, math.huge, math.huge}, {-math.huge, -math.huge, -math.huge}
  for _, body in ipairs(bodies) do
    local pose = body.pose
    for _, vertex in ipairs(body.mesh.vertices) do
      local p = pose * vertex
      for k, x in ipairs {p.x, p.y, p.z} do low[k], high[k] = math.min(low[k], x), math.max(high[k], x) end
    end
  end
  return low, high
end

-- hands whose fingers lie along y are turned upright; those of the others already point up
local lying = {dlr = true, human16 = true, human20 = true, robonaut = true, shadow = true}
-- arms in a posture that shows their joints [rad]
local postures = {puma560 = {0.6, 0.7, -2.9, 0, 0.7, 0}, ur5 = {2.5, -2, -1.6, -1, 1.57, 0}}

local function name_of(path) return path:match "([^/]+)%.%w+$" end

--- the hand three times in a row, on z = 0, and the camera in front of it
local function three_hands(path)
  local up = clench.pose {rpy = {lying[name_of(path)] and math.pi / 2 or 0, 0, 0}}
  local world, place, tallest = clench.world(), {}, 0.2
  for i, angle in ipairs {0.35, math.pi - 0.6, 0.35} do
    local turn = clench.pose {rpy = {0, 0, angle}} * up
    local hand = world:add_robot(path, {name = "hand " .. i, pose = turn})
    local low, high = bounds {hand.base, table.unpack(hand.links)}
    place[i] = {hand, turn, low, high}
    tallest = math.max(tallest, high[1] - low[1], 0.7 * (high[3] - low[3]))
    -- moved aside before the next one is added
    hand.pose = clench.pose {xyz = {10 * i, 0, 0}} * turn
  end
  for i, one in ipairs(place) do
    local hand, turn, low, high = table.unpack(one)
    local shift = {(i - 2) * tallest - (low[1] + high[1]) / 2, -(low[2] + high[2]) / 2, -low[3]}
    hand.pose = clench.pose {xyz = shift} * turn
    if i == 3 then hand:autograsp() end
  end
  local middle = (place[1][4][3] - place[1][3][3]) / 2
  return world, {eye = {0, -5 * tallest, middle + 1.5 * tallest}, target = {0, 0, middle}, field_of_view = 0.34}
end

local function alone(add, path)
  local world = clench.world()
  world[add](world, path)
  return world
end

local scenes = {
  hands = three_hands,
  arms = function(path)
    local world = alone("add_robot", path)
    world.robots[1]:set_dofs(postures[name_of(path)] or world.robots[1].dofs)
    return world
  end,
  objects = function(path) return alone("add_object", path) end,
  obstacles = function(path) return alone("add_obstacle", path) end,
  worlds = function(path)
    local world = clench.load(path)
    -- an arm has no closing motion
    for _, robot in ipairs(world.robots) do
      if #world.objects > 0 and not robot.source:find "arms/" then robot:autograsp() end
    end
    return world, world.camera
  end,
}

os.execute(("mkdir -p '%s'"):format(folder))
local catalog = clench.catalog()
for _, shelf in ipairs {"hands", "arms", "objects", "obstacles", "worlds"} do
  for _, path in ipairs(catalog[shelf]) do
    if not pattern or path:find(pattern) then
      local world, view = scenes[shelf](path)
      view = view or {}
      view.size = shelf == "hands" and {960, 480} or {640, 480}
      view.transparent_objects = shelf == "worlds"
      local file = ("%s/%s_%s.png"):format(folder, shelf, name_of(path))
      clench.render(world, view):save(file)
      print(file)
    end
  end
end
