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

for _, path in ipairs(catalog.arms) do
  test(path .. " is made of solids and stands free", function(t)
    local world = clench.world()
    world:add_robot(path)
    for _, body in ipairs(world.bodies) do t.ok(body.mesh:is_watertight(), body.name) end
    t.equal(#world:colliding(), 0)
  end)
end

test("the catalog contains hands, arms, objects, obstacles and worlds", function(t)
  for shelf, least in pairs {hands = 9, arms = 2, objects = 17, obstacles = 5, worlds = 13} do
    t.ok(#catalog[shelf] >= least, shelf .. ": " .. #catalog[shelf])
  end
end)

for _, shelf in ipairs {"objects", "obstacles"} do
  test(shelf .. " are solids and stand on z = 0", function(t)
    for _, path in ipairs(catalog[shelf]) do
      local world = clench.world()
      local body = shelf == "objects" and world:add_object(path) or world:add_obstacle(path)
      t.ok(body.mesh:is_watertight(), path)
      local low, high = body.mesh.bounds.low, body.mesh.bounds.high
      -- files have four decimals of a millimeter; a banana rests on a ring of its tube, whose sides are flat: 1 mm
      local ground = path:find "floor" and high.z or low.z
      t.ok(math.abs(ground) < 1e-3, ("%s: %g"):format(path, ground))
    end
  end)
end

for _, entry in ipairs {
  {"dlr_flask", 6}, {"barrett_mug", 3}, {"barrett_glass_table", 3}, {"barrett_plane", 3}, {"human_flask", 6},
  {"shadow_bottle", 6}, {"robonaut_glass", 6}, {"three_finger_sphere", 3}, {"tendon_cylinder", 4},
  {"parallel_jaw_cube", 8}, {"puma_barrett_glass", 3},
} do
  local name, least = table.unpack(entry)
  test("closing the hand of " .. name .. " gives force closure", function(t)
    local world = clench.load("worlds/" .. name .. ".wld", {root = "."})
    local hand, object = world.robots[#world.robots], world.objects[1]
    t.equal(#world:colliding(), 0)
    hand:autograsp()
    t.equal(#world:colliding(), 0)
    t.ok(#world:contacts(hand, object) >= least, "contacts: " .. #world:contacts(hand, object))
    local grasp = clench.grasp(hand, object)
    t.ok(grasp:is_force_closure() and grasp:quality "epsilon" > 0.05, "epsilon " .. grasp:quality "epsilon")
  end)
end

for _, name in ipairs {"gallery", "ur5_jaw_shelf", "puma_barrett_glass"} do
  test("nothing collides in " .. name .. " and nothing is mounted askew", function(t)
    local warnings = {}
    clench.log.sink(function(level, text)
      -- the inertia of a link of the Puma was measured, and is impossible for a rigid body
      if level == "warning" and not text:find "increased to equal it$" then warnings[#warnings + 1] = text end
    end)
    local world = clench.load("worlds/" .. name .. ".wld", {root = "."})
    clench.log.sink()
    t.equal(table.concat(warnings, " "), "")
    t.equal(#world:colliding(), 0)
  end)
end

test("the gallery shows every hand", function(t)
  local world, shown = clench.load("worlds/gallery.wld", {root = "."}), {}
  for _, hand in ipairs(world.robots) do shown[hand.name] = true end
  for _, path in ipairs(catalog.hands) do t.ok(shown[path:match "([%w_]+)%.cfg$"], path) end
end)

test("at 0 the arms have the poses of their published tables", function(t)
  -- sums along the tables by hand [m]: Puma a2 + a3, -d3, base + d4; UR5 a2 + a3, -d4 - d6, d1 - d5
  for name, at in pairs {
    puma560 = {0.4318 + 0.0203, -0.15005, 0.67183 + 0.4318},
      ur5 = {-0.425 - 0.39225, -0.10915 - 0.0823, 0.089159 - 0.09465},
  } do
    local world = clench.world()
    local arm = world:add_robot(("models/arms/%s/%s.cfg"):format(name, name))
    local flange = arm.links[6].pose.position
    -- the tables are in degrees: rounding of pi/2 times a meter
    t.close(flange.x, at[1], 1e-9)
    t.close(flange.y, at[2], 1e-9)
    t.close(flange.z, at[3], 1e-9)
  end
end)

test("every hand names its eigengrasps and sites, and they fit its DOFs and links", function(t)
  for _, path in ipairs(catalog.hands) do
    local world = clench.world()
    local hand = world:add_robot(path)
    local motions, sites = read((path:gsub("cfg$", "egr"))), read((path:gsub("cfg$", "vgr")))
    t.equal(tonumber(motions:match "^DIMENSIONS (%d+)"), #hand.dofs)
    local count, seen = tonumber(sites:match "^[^\n]*\n(%d+)"), 0
    for finger, link in sites:gmatch "\n(%-?%d+) (%d+)\n8\n" do
      seen = seen + 1
      local chain = hand.chains[tonumber(finger) + 1]
      t.ok(finger == "-1" or chain and chain.links[tonumber(link) + 1], ("%s: %s %s"):format(path, finger, link))
    end
    t.equal(seen, count)
    local text = read(path)
    t.ok(text:find "EigenGrasps\n" and text:find "VirtualContacts\n", path)
  end
end)

--- the sites of a file: lists of finger, link, location [mm], quaternion, normal
local function sites_of(path)
  local words, list, at = {}, {}, 2
  for word in read(path):gmatch "%S+" do words[#words + 1] = tonumber(word) or word end
  for i = 1, words[2] do
    local finger, link, edges = words[at + 1], words[at + 2], words[at + 3]
    at = at + 3 + 6 * edges
    list[i] = {finger = finger, link = link, point = clench.vec3(table.unpack(words, at + 1, at + 3)) * 1e-3,
               quat = {table.unpack(words, at + 4, at + 7)},
                 normal = clench.vec3(table.unpack(words, at + 11, at + 13))}
    at = at + 14
  end
  return list
end

for _, path in ipairs(catalog.hands) do
  test("the sites of " .. path .. " lie on their links, and their frames look outward", function(t)
    local world = clench.world()
    local hand, meshes = world:add_robot(path), {}
    for i, site in ipairs(sites_of((path:gsub("cfg$", "vgr")))) do
      local body = site.finger < 0 and hand.base or hand.chains[site.finger + 1].links[site.link + 1]
      meshes[body.name] = meshes[body.name] or {body.mesh.vertices, body.mesh.triangles}
      local on, vertices, triangles = false, table.unpack(meshes[body.name])
      for _, corner in ipairs(triangles) do
        local a, b, c = vertices[corner[1]], vertices[corner[2]], vertices[corner[3]]
        local normal = (b - a):cross(c - a)
        -- files have four decimals of a millimeter; the normal of a small triangle has at most this error
        local size = normal:norm()
        if math.abs((site.point - a):dot(normal)) < 2e-7 * size and normal:dot(site.normal) > 0.999 * size then
          local function inside(p, q) return (q - p):cross(site.point - p):dot(normal) >= -1e-3 * size ^ 2 end
          on = on or (inside(a, b) and inside(b, c) and inside(c, a))
        end
      end
      t.ok(on, ("%s: site %d is not on %s"):format(path, i, body.name))
      local z = clench.pose {quat = site.quat} * clench.vec3(0, 0, 1)
      t.close((z - site.normal):norm(), 0, 1e-8)
      -- normals of pads point in their closing direction: out of the palm, or along +y of the link
      local pad = site.finger < 0 and site.normal.z or site.normal.y
      t.ok(pad > 0.5, ("%s: site %d looks elsewhere: %g"):format(path, i, pad))
    end
  end)
end

test("the human hands have six eigengrasps and 18 sites", function(t)
  for _, name in ipairs {"human20", "human16"} do
    local world = clench.world()
    local hand = world:add_robot("models/hands/human/" .. name .. ".cfg")
    t.equal(#hand.eigengrasps, 6)
    t.equal(#hand.virtual_contacts, 18)
  end
end)

test("the initial postures of eigengrasps lie in the ranges and are collision-free", function(t)
  for _, path in ipairs(catalog.hands) do
    local world = clench.world()
    local hand = world:add_robot(path)
    t.ok(hand.eigengrasps.is_custom, path)
    hand:set_dofs(hand.eigengrasps.origin)
    t.equal(#world:colliding(), 0)
  end
end)

test("primitives fill the bounds of their objects", function(t)
  for _, name in ipairs {"flask", "mug", "glass", "plane"} do
    local world = clench.world()
    local object = world:add_object("models/objects/" .. name .. ".iv")
    local stand_in = world:add_object("models/objects/primitives/" .. name .. ".iv", {name = "stand-in"})
    for _, corner in ipairs {"low", "high"} do
      local a, b = object.mesh.bounds[corner], stand_in.mesh.bounds[corner]
      -- rounded shapes, wheels and a propeller are left out: 2 cm
      t.ok((a - b):norm() < 0.02, ("%s: %g"):format(name, (a - b):norm()))
    end
  end
end)

test("the vessels have the masses of typical vessels", function(t)
  -- [kg]: a flask of 1000 ml, a mug, a tumbler, from catalogs, with a tolerance of a third
  for _, entry in ipairs {{"flask", 0.2, 0.42}, {"mug", 0.25, 0.42}, {"glass", 0.15, 0.35}} do
    local object = clench.world():add_object("models/objects/" .. entry[1] .. ".iv")
    t.ok(entry[2] < object.mass and object.mass < entry[3], entry[1] .. " weighs [kg] " .. object.mass)
  end
end)
