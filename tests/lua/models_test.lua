local test, clench = require "test", require "clench"

package.path = "scripts/?.lua;" .. package.path
local inventor, sets = require "models.inventor", require "models.sets"
local catalog = clench.catalog()

local function read(path)
  local file = assert(io.open(path, "rb"))
  local text = file:read "a"
  file:close()
  return text
end

for _, set in ipairs(sets) do
  test("the model files of '" .. set .. "' are what scripts/make_models.lua writes", function(t)
    for _, entry in ipairs(require("models." .. set)) do
      t.ok(read(entry[1]) == (entry.text or inventor.text(entry, entry[1])), entry[1] .. " is stale")
    end
  end)
end

for _, path in ipairs(catalog.hands) do
  test(path .. " is made of solids, stands free and closes without collision", function(t)
    local world = clench.world()
    local hand = world:add_robot(path)
    for _, body in ipairs(world.bodies) do t.ok(body.mesh:is_watertight(), body.name) end
    t.equal(#world:colliding(), 0)
    hand:autograsp()
    t.equal(#world:colliding(), 0)
    hand:open()
    t.equal(#world:colliding(), 0)
  end)
end

for _, entry in ipairs {{"dlr_flask", 6}, {"barrett_mug", 3}, {"barrett_glass_table", 3}} do
  local name, least = table.unpack(entry)
  test("closing the hand of " .. name .. " gives force closure", function(t)
    local world = clench.load("worlds/" .. name .. ".wld", {root = "."})
    local hand, object = world.robots[1], world.objects[1]
    t.equal(#world:colliding(), 0)
    hand:autograsp()
    t.equal(#world:colliding(), 0)
    t.ok(#world:contacts(hand, object) >= least, "contacts: " .. #world:contacts(hand, object))
    local grasp = clench.grasp(hand, object)
    t.ok(grasp:is_force_closure() and grasp:quality "epsilon" > 0.05, "epsilon " .. grasp:quality "epsilon")
  end)
end

test("the vessels weigh what such vessels weigh", function(t)
  -- [kg]: a flask of 1000 ml, a mug, a tumbler, each as its trade lists it, with a third to spare
  for _, entry in ipairs {{"flask", 0.2, 0.42}, {"mug", 0.25, 0.42}, {"glass", 0.15, 0.35}} do
    local object = clench.world():add_object("models/objects/" .. entry[1] .. ".iv")
    t.ok(entry[2] < object.mass and object.mass < entry[3], entry[1] .. " weighs [kg] " .. object.mass)
  end
end)
