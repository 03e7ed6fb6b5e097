-- Eigengrasps and virtual contacts of a hand in scripts.
local test, clench = require "test", require "clench"

local function human() return clench.world():add_robot "models/hands/human/human20.cfg" end

test("a set written as text and as XML is read back the same", function(t)
  local hand = human()
  for _, ending in ipairs {".egr", ".xml"} do
    local path = test.path(ending)
    hand.eigengrasps:save(path)
    local set = clench.files.eigengrasps(path)
    t.ok(#set == #hand.eigengrasps)
    -- the file keeps the given vectors bit-exactly, and both sets normalize them in the same way
    for i, vector in ipairs(set.vectors) do t.close(vector, hand.eigengrasps.vectors[i], 0) end
    hand.eigengrasps = set
    t.close(hand.eigengrasps.origin, human().eigengrasps.origin, 0)
  end
end)

test("setting amplitudes sets those of the hand, unless a limit prevents it", function(t)
  local hand = human()
  for i = 0, 4 do
    local expected = {0.05 * i, -0.02 * i, 0.01, 0, 0, 0}
    local clamped = hand:set_amplitudes(expected)
    -- sums of twenty products of numbers below two
    if #clamped == 0 then t.close(hand.amplitudes, expected, 1e-13) end
  end
  local clamped = hand:set_amplitudes {50, 0, 0, 0, 0, 0}
  t.ok(#clamped > 0)
  for _, d in ipairs(clamped) do
    local q, limits = hand.dofs[d], hand.dof_limits[d]
    t.ok(q == limits[1] or q == limits[2])
  end
end)

test("in keep mode a DOF that no eigengrasp moves stays, and otherwise it does not", function(t)
  local hand = human()
  local vector = {}
  for d = 1, 20 do vector[d] = d > 10 and 1 or 0 end
  hand.eigengrasps = clench.eigengrasps {vectors = {vector}}
  local q = {}
  for d, limits in ipairs(hand.dof_limits) do q[d] = (limits[1] + limits[2]) / 2 end
  q[2] = 0.2
  hand:set_dofs(q)
  t.equal(hand:set_amplitudes({0.3}, {keep = true}), {})
  t.close(hand.dofs[2], 0.2, 1e-15)
  t.close(hand.amplitudes[1], 0.3, 1e-14)
  hand:set_amplitudes {0.3}
  t.ok(math.abs(hand.dofs[2] - 0.2) > 0.01)
end)

test("a hand moves towards amplitudes until contact", function(t)
  local world = clench.load("worlds/human_flask.wld", {root = "."})
  local hand = world.robots[1]
  hand:open()
  local moved = hand:move_amplitudes({2, 0, 0, 0, 0, 0}, {stop_at_contact = true})
  t.ok(moved.moved and type(moved.clamped) == "table")
  t.ok(#world:colliding() == 0)
end)

test("eigengrasps and virtual contacts are part of clones, snapshots and the hash", function(t)
  local stage = clench.world()
  local hand = stage:add_robot "models/hands/human/human20.cfg"
  local before, moment, clone = stage:hash(), stage:snapshot(), stage:clone()
  hand.eigengrasps = nil
  t.ok(stage:hash() ~= before and #clone.robots[1].eigengrasps == 6)
  stage:restore(moment)
  t.ok(stage:hash() == before and #hand.eigengrasps == 6)
  hand:add_virtual_contact {link = hand.base, point = {0, 0, 0}, normal = {0, 0, 1}}
  t.ok(stage:hash() ~= before)
  stage:restore(moment)
  t.ok(stage:hash() == before)
end)

test("virtual contacts are read back from files, also for other hands of the same kind", function(t)
  local hand, other = human(), human()
  hand.virtual_contacts = hand:find_virtual_contacts {count_per_link = 2}
  for _, ending in ipairs {".vgr", ".xml"} do
    local path = test.path(ending)
    hand:save_virtual_contacts(path)
    other.virtual_contacts = clench.files.virtual_contacts(path)
    t.ok(#other.virtual_contacts == #hand.virtual_contacts)
    for i, c in ipairs(other.virtual_contacts) do
      local own = hand.virtual_contacts[i]
      -- millimeters cost a rounding
      t.ok((c.point - own.point):norm() < 1e-15 and (c.normal - own.normal):norm() < 1e-15)
      t.ok(c.mu == own.mu and c.link.name == own.link.name)
    end
  end
end)

test("invalid virtual contacts are rejected in one sentence", function(t)
  local hand, world = human(), clench.world()
  local box = world:add_object("models/objects/box.iv")
  t.fails(function() hand.virtual_contacts = 3 end, "virtual_contacts: expected a list of virtual contacts, got 3")
  t.fails(function() hand.virtual_contacts = {3} end, "virtual_contacts[1]: expected a virtual contact")
  t.fails(function() hand.virtual_contacts = {{link = box, point = {0, 0, 0}, normal = {0, 0, 1}}} end, "belongs to another world")
  t.fails(function() hand.virtual_contacts = {{link = 9, chain = 1, point = {0, 0, 0}, normal = {0, 0, 1}}} end, "there is no link 9 of chain 1")
  t.fails(function() hand.virtual_contacts = {{link = math.mininteger // 2^32, chain = 1, point = {0, 0, 0}, normal = {0, 0, 1}}} end, "there is no link 0 of chain 1")
  t.fails(function() hand.virtual_contacts = {{link = 1, point = {0, 0, 0}, normal = {0, 0, 1}}} end, "expected a link, its name, or its number with that of its chain, got 1")
  local other = hand.world:add_robot("models/hands/parallel_jaw/parallel_jaw.cfg", {name = "jaw", pose = {xyz = {1, 0, 0}}})
  t.fails(function() other.virtual_contacts = hand:find_virtual_contacts() end, "there is no link 2 of chain 1")
  local found = other:find_virtual_contacts()
  hand.world:remove(other)
  t.fails(function() hand.virtual_contacts = found end, "robot 'jaw' was removed from its world")
  t.fails(function() hand.virtual_contacts = {{link = hand.base, point = {0, 0, 0}, normal = {0, 0, 0}}} end, "normal: expected a direction")
  t.fails(function() hand.virtual_contacts = {{link = hand.base, point = {0, 0, 0}, normal = {0, 0, 1}, nu = 1}} end, "unknown key 'nu'")
  t.fails(function() hand.virtual_contacts = {{link = hand.base, point = {0, 0, 0}, normal = {0, 0, 1}, mu = -1}} end, "mu: expected a number from 0 to 1e+06, got -1")
  t.fails(function() hand.eigengrasps = {} end, "expected eigengrasps, got an empty table")
  t.fails(function() clench.eigengrasps {} end, "expected postures or vectors")
  t.fails(function() clench.eigengrasps {vectors = {{1, 0}, {2, 0}}} end, "eigengrasp 2: it is a sum of those before it")
  t.fails(function() clench.eigengrasps {postures = {{0}, {1}}, count = 0} end, "count must be >= 1, got 0")
  t.fails(function() hand:find_virtual_contacts {count_per_link = 0} end, "count_per_link must be 1 to 100, got 0")
  t.fails(function() hand:find_virtual_contacts {object_material = "wod"} end, "wood")
end)

test("every shipped hand has eigengrasps and virtual contacts, and found ones are near the pads", function(t)
  for _, path in ipairs(clench.catalog().hands) do
    local world = clench.world()
    local hand = world:add_robot(path)
    t.ok(hand.eigengrasps.is_custom and #hand.eigengrasps >= 1, path)
    local found = hand:find_virtual_contacts()
    t.ok(#found >= 3, path)
    -- the normal of a place points in the direction in which the closing hand moves it
    local before = {}
    hand:open()
    for i, c in ipairs(found) do before[i] = {c.point, c.normal} end
    local q, limits = hand.dofs, hand.dof_limits
    for d, info in ipairs(hand.dof_info) do
      q[d] = math.max(limits[d][1], math.min(limits[d][2], q[d] + 0.001 * info.default_velocity))
    end
    hand:set_dofs(q)
    for i, c in ipairs(found) do
      local way = c.point - before[i][1]
      if way:norm() > 1e-9 then t.ok(way:dot(before[i][2]) > 0, path .. ": " .. c.link.name) end
    end
  end
end)

test("a virtual contact is on a link of the hand, in its world", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  t.fails(function() hand:add_virtual_contact {link = flask, point = {0, 0, 0}, normal = {0, 0, 1}} end, "is no link of robot")
  hand:autograsp()
  local other = clench.load("worlds/dlr_flask.wld", {root = "."}).robots[1]
  t.fails(function() other:add_virtual_contact(world:contacts(hand, flask)[1]) end, "the contact is of another world")
  t.fails(function() hand:remove_virtual_contact(0) end, "number: expected one of")
  t.fails(function() clench.files.save_pregrasps("x", 3) end, "list: expected a list of tables, got 3")
end)

test("a fixed amplitude stays while others are set", function(t)
  local hand = human()
  hand:set_amplitudes {0.2, 0.1, 0, 0, 0, 0}
  t.equal(hand:set_amplitudes({0.1, 9, 0, 0.05, 0, 0}, {fixed = {2}}), {})
  -- sums of twenty products of numbers below two
  t.close(hand.amplitudes, {0.1, 0.1, 0, 0.05, 0, 0}, 1e-13)
  hand:move_amplitudes({0, 0, 0, 0, 0, 0}, {fixed = {1}})
  t.close(hand.amplitudes[1], 0.1, 1e-9)  -- final values of a drive are within its tolerance
  t.fails(function() hand:set_amplitudes({0, 0, 0, 0, 0, 0}, {fixed = {7}}) end, "fixed: expected one of 6 eigengrasps, got 7")
  t.fails(function() hand:set_amplitudes({0, 0, 0, 0, 0, 0}, {fixed = {1.5}}) end, "fixed: expected one of 6 eigengrasps, got 1.5")
end)

test("virtual contacts that were made for another hand are accepted with a warning", function(t)
  local said = {}
  local hand, other = human(), clench.world():add_robot "models/hands/human/human16.cfg"
  local function give(list)
    said = {}
    clench.log.sink(function(_, text, about) said[#said + 1] = about .. " " .. text end)
    local ok, message = pcall(function() hand.virtual_contacts = list end)
    clench.log.sink()
    if not ok then error(message, 0) end
  end
  local path = test.path ".vgr"
  other:save_virtual_contacts(path)
  local list = clench.files.virtual_contacts(path)
  local ok = pcall(give, list)
  t.equal(said, ok and {"suspicious hand.virtual_contacts: virtual contacts made for 'human16' are used for 'human20'"} or {})
  give {hand.virtual_contacts[1]}
  t.equal(said, {})
  give {other.virtual_contacts[1]}
  t.equal(said, {"suspicious hand.virtual_contacts: virtual contacts made for 'human16' are used for 'human20'"})
end)

test("a virtual contact has a frame, or a point and a normal", function(t)
  local hand = human()
  t.fails(function() hand:add_virtual_contact {link = hand.base, frame = {}, normal = {0, 0, 1}} end,
    "expected frame, or point and normal, got both")
end)
