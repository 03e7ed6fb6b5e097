local test, clench = require "test", require "clench"

local function pinch(options)
  options = options or {}
  options.contacts = {
    {point = {-0.02, 0, 0}, normal = {1, 0, 0}, mu = 0.5, torsion_radius = options.torsion_radius},
    {point = {0.02, 0, 0}, normal = {-1, 0, 0}, mu = 0.5, torsion_radius = options.torsion_radius},
  }
  options.torsion_radius = nil
  options.rho = options.rho or 0.02
  return options
end

test("a soft pinch resists torsion, and a hard one does not", function(t)
  t.ok(not clench.wrench_space(pinch()):is_force_closure())
  for _, edges in ipairs {3, 8, 20, "exact"} do
    t.ok(clench.wrench_space(pinch {torsion_radius = 0.002, edges = edges}):is_force_closure())
  end
end)

test("brackets contain epsilon, and tell whether at_least is reached", function(t)
  local exact = pinch {torsion_radius = 0.005, edges = "exact", norm = "Linf"}
  local epsilon = clench.wrench_space(exact):epsilon()
  local wide = clench.wrench_space(exact):epsilon_bounds {tolerance = 0.01}
  t.ok(wide.lower <= epsilon and epsilon <= wide.upper and wide.upper - wide.lower <= 0.01)
  t.equal(wide.reached, nil)
  t.equal(clench.wrench_space(exact):epsilon_bounds {at_least = epsilon / 2}.reached, true)
  t.equal(clench.wrench_space(exact):epsilon_bounds {at_least = epsilon * 2}.reached, false)
end)

test("a space has its norm and coordinates, and a projection the treatment of each coordinate", function(t)
  local space = clench.wrench_space(pinch {norm = "Linf", coordinates = {"fx", "fy", "fz", "tx"}})
  t.equal(tostring(space), "Linf wrench space of 2 contacts, rank 3, epsilon 0")
  t.equal(space.norm, "Linf")
  t.equal(#space.coordinates, 4)
  local projection = space:project {projected = {"tx"}}
  t.equal(table.concat(projection.free, " "), "fx fy fz")
  t.equal(projection.projected[1], "tx")
  t.close(projection.volume, projection.mesh.volume, 1e-12)
  t.equal(space:project {fixed = {fz = 0}}.mesh, nil)  -- no torque about the line: flat
  t.equal(space:project {fixed = {fz = 0}}.fixed.fz, 0)
end)

test("invalid arguments are rejected by name", function(t)
  local function fails(options, text)
    t.fails(function() clench.wrench_space(pinch(options)) end, text)
  end
  fails({edges = 2}, "clench.wrench_space: edges must be 3 to 1000, got 2")
  fails({edges = 0}, "edges must be 3 to 1000, got 0")
  fails({edges = "round"}, "edges must be 3 to 1000 or 'exact', got 'round'")
  fails({edges = true}, "edges: expected")
  fails({norm = "L2"}, "L2")
  fails({torsion_radius = -1}, "torsion_radius must be >= 0, got -1")
  fails({coordinates = {"fx", "fu"}}, "coordinates: unknown coordinate 'fu', expected fx, fy, fz, tx, ty or tz")
  fails({coordinates = "fx"}, "coordinates: expected a list of coordinates, got 'fx'")
  fails({coordinates = {"fx"}}, "expected 2 to 6 coordinates, got 1")
  local space = clench.wrench_space(pinch {torsion_radius = 0.01, edges = "exact"})
  t.fails(function() space:volume_bounds {edges = 3} end, "space:volume_bounds: edges must be 4 to 1000, got 3")
  t.fails(function() space:volume_bounds {edges = 1001} end, "space:volume_bounds: edges must be 4 to 1000, got 1001")
  t.fails(function() space:volume_bounds {tolerance = 1} end, "unknown key 'tolerance'")
  t.fails(function() space:wrenches() end, "round cones have no edges to list, give a number")
  t.fails(function() space:epsilon_bounds {tolerance = -1} end, "tolerance must be >= 0, got -1")
  t.fails(function() space:project {fixed = {fu = 1}} end, "unknown key 'fu'")
  t.fails(function() space:project {fixed = 1} end, "fixed: expected a table of coordinates and values, got 1")
  t.fails(function() space:project {fixed = {fx = 9, fy = 0, fz = 0}} end, "no wrench of it has fx = 9, fy = 0, fz = 0")
end)

test("a grasp keeps its spaces, one for each set of options", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  hand:autograsp()
  local grasp = clench.grasp(hand, flask, {rho = "gyration"})
  t.ok(grasp.rho < clench.grasp(hand, flask).rho)
  t.equal(grasp:wrench_space {rho = grasp.rho}:epsilon(), grasp:quality "epsilon")
  t.equal(clench.grasp(hand, flask):wrench_space {rho = "gyration"}:epsilon(), grasp:quality "epsilon")
  t.equal(clench.grasp(hand, flask, {edges = "exact"}).edges, "exact")
  t.fails(function() clench.grasp(hand, flask, {rho = "radius"}) end, "rho must be a number or 'gyration', got 'radius'")
  t.fails(function() grasp:wrench_space {rho = -1} end, "rho")
  -- the contacts of the weakest direction exist
  local worst = grasp:wrench_space():weakest()
  for _, i in ipairs(worst.contacts) do t.ok(grasp.contacts[i]) end
end)

test("faulty contacts are reported by their number", function(t)
  local good = {point = {1, 0, 0}, normal = {-1, 0, 0}, mu = 0.5}
  local function refused(given, sentence) t.fails(function() clench.wrench_space(given) end, sentence) end
  refused({contacts = {good, {point = {0, 1, 0}, normal = {0, -1, 0}, mu = -1}}}, "contacts[2]: mu must be 0 to 1000000, got -1")
  refused({contacts = {good, {point = {0, 1, 0}, mu = 1}}}, "contacts[2]: normal: expected a vec3 or {x, y, z}, got nil")
  refused({contacts = {a = good}}, "contacts: expected a list of contacts, got a table with the key 'a'")
  refused({contacts = {good}, coordinates = {"fx", "fx"}}, "coordinates: fx is given twice")
  refused({contacts = {good}, coordinates = {1, k = 2}}, "coordinates: expected a list of coordinates")
end)

test("rings of equal round cones end in time, and their brackets are valid", function(t)
  local function ring(count, mu, edges)
    local contacts = {}
    for i = 1, count do
      local a = 2 * math.pi * i / count
      contacts[i] = {point = {math.cos(a), math.sin(a), 0}, normal = {-math.cos(a), -math.sin(a), 0}, mu = mu}
    end
    return clench.wrench_space {contacts = contacts, edges = edges}
  end
  for _, case in ipairs {{12, 0.5}, {3, 1e6}} do
    local space = ring(case[1], case[2], "exact")
    local bounds = space:epsilon_bounds {}
    t.ok(bounds.lower > 0 and bounds.lower <= bounds.upper)
    -- a pyramid of 64 edges is inside the cone, and has more than cos(pi / 64) of its extent
    local inner = ring(case[1], case[2], 64):epsilon()
    t.ok(bounds.upper >= inner * (1 - 1e-9))
    local epsilon = space:epsilon()
    t.ok(epsilon >= bounds.lower * (1 - 1e-9) and epsilon <= bounds.upper * (1 + 1e-9))
    -- independently of earlier queries
    t.equal(ring(case[1], case[2], "exact"):epsilon(), epsilon)
  end
end)

test("the weakest direction is a load on the object, which the contacts balance with the opposite wrench", function(t)
  local world = clench.load "worlds/dlr_flask.wld"
  local hand, flask = world.robots[1], world.objects[1]
  -- along the object's axes, for any pose of the object
  flask.pose = clench.pose {xyz = {0.1, 0.2, 0.3}, rpy = {0.4, 0.5, 0.6}} * flask.pose
  hand.pose = clench.pose {xyz = {0.1, 0.2, 0.3}, rpy = {0.4, 0.5, 0.6}} * hand.pose
  hand:autograsp()
  local grasp = clench.grasp(hand, flask)
  local space = grasp:wrench_space()
  local weakest, most = space:weakest(), -math.huge
  for _, contact in ipairs(space:wrenches()) do
    for _, wrench in ipairs(contact) do
      local against = 0
      for i = 1, 6 do against = against - wrench[i] * weakest.direction[i] end
      most = math.max(most, against)
    end
  end
  t.close(most, weakest.resistance, 1e-12)
  t.close(weakest.resistance, grasp:quality "epsilon", 1e-12)
end)
