local test, shapes = require "test", require "clench.shapes"

local tau = 2 * math.pi

--- a zigzag through space, with bends up to a right angle
local path = {{0, 0, 0}, {0.1, 0, 0}, {0.15, 0.05, 0}, {0.15, 0.1, 0.05}, {0.15, 0.1, 0.15}}
local function arch(count)
  local points = {}
  for i = 0, count do points[i + 1] = {math.cos(math.pi * i / count), 0, math.sin(math.pi * i / count)} end
  return points
end
local function loop(count)
  local points = {}
  for i = 1, count do
    local a = tau * i / count
    points[i] = {math.cos(a), math.sin(a), 0.3 * math.sin(2 * a)}
  end
  return points
end
local letter_u = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}

-- one or more of every shape, in the order of their names
local samples = {
  {"box", shapes.box {0.1, 0.2, 0.3}},
  {"box with chamfer", shapes.box {0.1, 0.2, 0.3, chamfer = 0.01}},
  {"box with rounding", shapes.box {0.1, 0.2, 0.3, rounding = 0.01}},
  {"box rounded to a ball", shapes.box {0.1, 0.1, 0.1, rounding = 0.05}},
  {"box rounded to a rod", shapes.box {0.1, 0.1, 0.3, rounding = 0.05}},
  {"box rounded to a pad", shapes.box {0.3, 0.2, 0.1, rounding = 0.05}},
  {"capsule", shapes.capsule {0.01, 0.05}},
  {"tapered capsule", shapes.capsule {0.02, top = 0.01, from = {1, 0, 0}, to = {0, 1, 0}}},
  {"cone", shapes.cone {0.1, height = 0.2}},
  {"cone on its apex", shapes.cone {0, 0.1, 0.2}},
  {"frustum", shapes.cone {0.1, 0.05, 0.2}},
  {"cylinder", shapes.cylinder {0.1, 0.2}},
  {"cylinder with chamfer", shapes.cylinder {0.1, 0.2, chamfer = 0.02}},
  {"cylinder rounded to a ball", shapes.cylinder {0.1, 0.2, rounding = 0.1}},
  {"cylinder between points", shapes.cylinder {0.1, from = {0, 0, 0}, to = {1, 2, 3}}},
  {"lathe of a cup", shapes.lathe {{{0, 0}, {3, 0}, {3, 5}, {2.5, 5}, {2.5, 0.5}, {0, 0.5}}}},
  {"lathe of a ring, clockwise", shapes.lathe {{{2, 0}, {2, 1}, {3, 1}, {3, 0}}}},
  {"loft to an apex", shapes.loft {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0.5, 0.5, 2}}}},
  {"prism", shapes.prism {letter_u, 1}},
  {"prism with chamfer", shapes.prism {letter_u, 1, chamfer = 0.1}},
  {"prism with rounding", shapes.prism {letter_u, 1, rounding = 0.2}},
  {"sphere", shapes.sphere {0.02}},
  {"torus", shapes.torus {0.1, 0.02}},
  {"tube", shapes.tube {path, radius = 0.01}},
  {"tube with round ends", shapes.tube {path, radius = {0.01, 0.02, 0.01, 0.02, 0.01}, ends = "round"}},
  {"tube of a profile", shapes.tube {arch(20), profile = {{-0.1, -0.2}, {0.1, -0.2}, {0, 0.2}}, up = {0, 1, 0}}},
  {"closed tube", shapes.tube {loop(40), radius = 0.1, closed = true}},
  {"union", shapes.union {shapes.box {1, 1, 1}, shapes.sphere {1}}},
}

test("every shape is closed: each edge occurs once in each direction", function(t)
  for _, sample in ipairs(samples) do
    local closed, why = shapes.closed(sample[2])
    t.ok(closed, sample[1] .. ": " .. tostring(why))
  end
end)

test("every shape faces outward: its volume is positive", function(t)
  for _, sample in ipairs(samples) do t.ok(shapes.volume(sample[2]) > 0, sample[1]) end
end)

test("no shape has an unused vertex, or one vertex twice", function(t)
  for _, sample in ipairs(samples) do
    local used, seen = {}, {}
    for _, triangle in ipairs(sample[2].triangles) do
      for _, i in ipairs(triangle) do used[i] = true end
    end
    for i, p in ipairs(sample[2].vertices) do
      local key = table.concat(p, " ")
      -- the two parts of the union may share a point
      t.ok(used[i] and (not seen[key] or sample[1] == "union"), sample[1] .. ": vertex " .. i)
      seen[key] = true
    end
  end
end)

test("flat-sided shapes have the volume of their formulas", function(t)
  -- sums of a few dozen products of numbers near 1: rounding stays below 1e-12 of the result
  t.close(shapes.volume(shapes.box {0.1, 0.2, 0.3}), 0.006, 1e-15)
  t.close(shapes.volume(shapes.prism {letter_u, 2}), 14, 1e-12)
  t.close(shapes.volume(shapes.loft {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0.5, 0.5, 3}}}), 1, 1e-12)
  -- a box minus its twelve cut edges, w^2/2 times their length, plus their overlaps at the eight corners, where the three cuts together take the cube
  -- w^3 except for its inner pyramid, w^3/6
  local x, y, z, w = 0.1, 0.2, 0.3, 0.01
  local edges = 4 * (x + y + z - 6 * w) * w * w / 2
  t.close(shapes.volume(shapes.box {x, y, z, chamfer = w}), x * y * z - edges - 8 * w ^ 3 * 5 / 6, 1e-15)
end)

test("a straight-edged chamfer removes the prismoid's volume", function(t)
  -- a square of side s, inset by c over the height c: the prismoidal formula at both rims
  local s, h, c = 2, 1, 0.2
  local function area(inset) return (s - 2 * inset) ^ 2 end
  local rim = c / 6 * (area(0) + 4 * area(c / 2) + area(c))
  local square = {{0, 0}, {s, 0}, {s, s}, {0, s}}
  t.close(shapes.volume(shapes.prism {square, h, chamfer = c}), (h - 2 * c) * area(0) + 2 * rim, 1e-12)
end)

test("turned shapes approach the volume of their formulas from below, with the square of the segments", function(t)
  local function polygon_area(n) return 0.5 * n * math.sin(tau / n) end  -- of the unit circle's n-gon
  -- compared with the flat-sided formula they are exact
  t.close(shapes.volume(shapes.cylinder {0.1, 0.2, segments = 12}), polygon_area(12) * 0.01 * 0.2, 1e-15)
  t.close(shapes.volume(shapes.cone {0.3, 0.1, 0.6, segments = 9}), polygon_area(9) * 0.2 * (0.09 + 0.03 + 0.01), 1e-15)
  t.close(shapes.volume(shapes.lathe {{{2, 0}, {3, 0}, {3, 1}, {2, 1}}, segments = 7}), polygon_area(7) * 5, 1e-12)
  for _, case in ipairs {
    {function(n) return shapes.torus {0.1, 0.02, segments = n, sides = n} end, math.pi * tau * 0.1 * 0.0004},
    {function(n) return shapes.capsule {0.1, 0.3, segments = n} end, math.pi * 0.01 * (0.3 + 4 / 3 * 0.1)},
  } do
    local coarse, fine = case[2] - shapes.volume(case[1](32)), case[2] - shapes.volume(case[1](64))
    t.ok(fine > 0, "below the formula")
    t.close(coarse / fine, 4, 0.1)  -- second order, up to fourth-order terms of about (tau / 32)^2
  end
end)

test("a sphere's vertices lie on it, and the error of its volume falls by four per subdivision", function(t)
  local last
  for n = 1, 4 do
    local sphere = shapes.sphere {0.02, subdivisions = n}
    t.equal(#sphere.triangles, 20 * 4 ^ n // 1)
    for _, p in ipairs(sphere.vertices) do t.close(math.sqrt(p[1] ^ 2 + p[2] ^ 2 + p[3] ^ 2), 0.02, 1e-16) end
    local miss = 4 / 3 * math.pi * 0.02 ^ 3 - shapes.volume(sphere)
    if last then t.close(last / miss, 4, 0.4) end  -- the first subdivisions are coarse
    last = miss
  end
end)

test("a tapered capsule is the hull of its two spheres", function(t)
  local a, b, r, q = {0, 0, 0}, {0, 0, 0.05}, 0.02, 0.01
  for _, p in ipairs(shapes.capsule {r, top = q, from = a, to = b}.vertices) do
    -- distance to the nearest sphere of the family, by a scan
    local least = math.huge
    for k = 0, 2000 do
      local s = k / 2000
      local radius = r + (q - r) * s
      least = math.min(least, math.sqrt(p[1] ^ 2 + p[2] ^ 2 + (p[3] - 0.05 * s) ^ 2) - radius)
    end
    t.close(least, 0, 1e-7)  -- the scan's step of 2.5e-5 m misses the minimum by its square over the radius
  end
end)

test("a tube has the volume of its section times its length", function(t)
  local length = 0
  for i = 2, #path do
    length = length + math.sqrt((path[i][1] - path[i - 1][1]) ^ 2 + (path[i][2] - path[i - 1][2]) ^ 2
                                + (path[i][3] - path[i - 1][3]) ^ 2)
  end
  -- miters add outside what they remove inside, for a section with its centroid on the path
  local section = 0.5 * 24 * math.sin(tau / 24) * 0.01 ^ 2
  t.close(shapes.volume(shapes.tube {path, radius = 0.01}), section * length, 1e-12)
end)

test("an outline rounds convex and concave corners by arcs that touch both edges", function(t)
  local corner = {{0, 0}, {2, 0}, {2, 2}, {0, 2}}
  local function area(points) return shapes.volume(shapes.prism {points, 1}) end
  -- each corner loses r^2 minus a quarter circle; 64 chords differ from the arc by its (angle / 64)^2
  t.close(area(shapes.outline {corner[1], corner[2], corner[3], corner[4], rounding = 0.5, segments = 64}),
          4 - 0.25 * (4 - math.pi), 1e-4)
  local plain = shapes.outline {table.unpack(letter_u)}
  t.equal(#plain, #letter_u)
  -- the U has six convex corners and two concave ones
  local rounded = {rounding = 0.2, segments = 64, table.unpack(letter_u)}
  t.close(area(shapes.outline(rounded)), 7 - 4 * 0.04 * (1 - math.pi / 4), 1e-4)
  local one = shapes.outline {{0, 0}, {2, 0, 0.5}, {2, 2}, {0, 2}, segments = 64}
  t.close(area(one), 4 - 0.25 * (1 - math.pi / 4), 1e-4)
end)

test("moving, turning and mirroring keep the volume and the orientation, and scaling multiplies the volume", function(t)
  local solid = shapes.prism {letter_u, 1}
  local moved = shapes.move(solid, {10, -20, 30})
  local turned = shapes.turn(moved, {1, 2, 3}, 0.7, {1, 1, 1})
  local mirrored = shapes.mirror(turned, "y")
  t.close(shapes.volume(mirrored), 7, 1e-10)  -- coordinates near 40 cost two digits
  t.ok(shapes.closed(mirrored), "mirrored")
  t.close(shapes.volume(shapes.scale(solid, {2, 3, 4})), 7 * 24, 1e-10)
  t.close(shapes.volume(shapes.scale(solid, 0.5)), 7 / 8, 1e-12)
  t.equal(solid.vertices[1][1], 0)
  local quarter = shapes.turn(shapes.box {1, 2, 3}, {0, 0, 5}, tau / 4)
  local low, high = shapes.bounds(quarter)
  t.close(high[1], 1, 1e-12)
  t.close(low[2], -0.5, 1e-12)
end)

test("mass properties of a box equal the formulas, at any position", function(t)
  local x, y, z = 0.1, 0.2, 0.3
  local mass = shapes.mass(shapes.move(shapes.box {x, y, z}, {1, 2, 3}))
  t.close(mass.volume, 0.006, 1e-15)
  for k = 1, 3 do t.close(mass.centroid[k], k, 1e-12) end
  t.close(mass.inertia[1][1], (y * y + z * z) / 12, 1e-12)
  t.close(mass.inertia[2][2], (x * x + z * z) / 12, 1e-12)
  t.close(mass.inertia[3][3], (x * x + y * y) / 12, 1e-12)
  t.close(mass.inertia[1][2], 0, 1e-12)
end)

test("area of a box", function(t) t.close(shapes.area(shapes.box {1, 2, 3}), 22, 1e-12) end)

test("an open or inside-out mesh is distinguished from a solid", function(t)
  local box = shapes.box {1, 1, 1}
  box.triangles[#box.triangles] = nil
  local closed, why = shapes.closed(box)
  t.equal(closed, false)
  t.ok(why:find "open edge", why)
  local twisted = shapes.box {1, 1, 1}
  local first = twisted.triangles[1]
  first[1], first[2] = first[2], first[1]
  closed, why = shapes.closed(twisted)
  t.equal(closed, false)
  t.ok(why:find "same direction", why)
end)

test("sizes may be given by position or by name", function(t)
  t.equal(#shapes.sphere {radius = 0.1}.vertices, #shapes.sphere {0.1}.vertices)
  t.close(shapes.volume(shapes.box {x = 1, y = 2, z = 3}), 6, 1e-12)
end)

test("an unknown key is reported with the known ones", function(t)
  t.fails(function() shapes.box {1, 2, 3, roundign = 1} end, "shapes.box: unknown key 'roundign'", "rounding")
  t.fails(function() shapes.sphere {1, 2} end, "shapes.sphere: unknown key '2'")
  t.fails(function() shapes.bxo {1, 2, 3} end, "there is no 'bxo'", "; did you mean 'box'?")
end)

test("bad numbers are rejected with expected and got values", function(t)
  local nan = 0 / 0
  t.fails(function() shapes.box {1, 2, -3} end, "shapes.box: z must be a number > 0, got -3")
  t.fails(function() shapes.box {("x"):rep(5000), 1, 1} end, "got '" .. ("x"):rep(117) .. "...'")
  t.fails(function() shapes.box {"\27[2J", 1, 1} end, "got '?[2J'")
  t.fails(function() shapes.torus {1, 0.1, sides = 12345678901} end, "got 12345678901")
  t.fails(function() shapes.box {1, 2} end, "z must be a number > 0, got nothing")
  t.fails(function() shapes.box {1, nan, 3} end, "y must be a number > 0, got")
  t.fails(function() shapes.box {1, 2, 3, x = 1} end, "x is given twice")
  t.fails(function() shapes.box {1, 1, 1, rounding = 0.6} end, "at most half of the smallest size, 0.5, got 0.6")
  t.fails(function() shapes.box {1, 1, 1, rounding = 0.1, chamfer = 0.1} end, "chamfer or rounding, got both")
  t.fails(function() shapes.sphere "big" end, "one table of options", "got 'big'")
  t.fails(function() shapes.sphere {math.huge} end, "radius must be a number > 0")
  t.fails(function() shapes.sphere {1, subdivisions = 2.5} end, "a whole number from 0 to 7, got 2.5")
  t.fails(function() shapes.cone {0, 0, 1} end, "bottom or top must be > 0")
  t.fails(function() shapes.cylinder {1} end, "either height or both from and to, got neither")
  t.fails(function() shapes.cylinder {1, 2, from = {0, 0, 0}} end, "got height and from")
  t.fails(function() shapes.cylinder {1, from = {1, 2, 3}, to = {1, 2, 3}} end, "from and to must be apart")
  t.fails(function() shapes.cylinder {1, from = {1, 2}, to = {1, 2, 3}} end, "from must be a point {x, y, z}")
  t.fails(function() shapes.cylinder {1, 1, chamfer = 0.6} end, "at most the radius and half the height, 0.5, got 0.6")
  t.fails(function() shapes.capsule {3, 1, top = 1} end, "differ by less than the length, 1, got 3 and 1")
  t.fails(function() shapes.torus {1e300, 1} end, "radius must be a number of at most 1e+09, got 1e+300")
  t.fails(function() shapes.loft {{{0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0}}, {{0, 0, 1e200}}} end,
          "shapes.loft: ring 1[2] must be a point {x, y, z}")
  t.fails(function() shapes.torus {1, 1} end, "tube must be smaller than radius, 1, got 1")
end)

test("bad outlines, profiles, sections and paths are rejected", function(t)
  t.fails(function() shapes.prism {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 1} end, "edges 1 and 3 meet")
  t.fails(function() shapes.prism {{{0, 0}, {0, 0}, {1, 0}}, 1} end, "edge 1 has no length")
  t.fails(function() shapes.prism {{{0, 0}, {1, 0}}, 1} end, "at least 3 points {x, y}", "a table of 2")
  t.fails(function() shapes.prism {{{0, 0}, {1, 0}, {1}}, 1} end, "outline[3] must be a point {x, y}")
  t.fails(function() shapes.prism {{{0, 0}, nil, {1, 1}, {0, 1}}, 1} end, "outline[2] must be a point {x, y}, got nothing")
  t.fails(function() shapes.lathe {profile = {nil, {1, 0}, {1, 1}, {0, 1}}} end, "profile[1] must be a point {x, y}, got nothing")
  t.fails(function() shapes.tube {{{0, 0, 0}, {1, 0, nil, 4}}, radius = 1} end, "path[2] must be a point {x, y, z}")
  local square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}
  t.fails(function() shapes.loft {square, {{0, 0, 1}, nil, {1, 1, 1}, {0, 1, 1}}} end, "ring 2[2] must be a point {x, y, z}, got nothing")
  t.fails(function() shapes.union {{vertices = {{0, 0, 0}, nil, {1, 1, 0}}, triangles = {{1, 2, 3}}}} end, "vertex 2 must be three numbers of at most 1e+09")
  t.fails(function() shapes.union {{vertices = square, triangles = {{1, 2, 3}, nil, {1, 3, 4}}}} end, "triangle 2 must name vertices 1 to 4, got nothing")
  t.fails(function() shapes.prism {letter_u, 1, chamfer = 0.5} end, "less than half the height, 0.5, got 0.5")
  t.fails(function() shapes.prism {letter_u, 2, chamfer = 0.5} end, "leave a part of every edge, got 0.5")
  t.fails(function() shapes.outline {{0, 0}, {1, 0}, {0, 1}, rounding = 0.5} end, "leave some of each edge")
  t.fails(function() shapes.outline {{0, 0}, {1, 0}, {0, 1, -1}} end, "corner 3 must be {x, y} or {x, y, radius >= 0}")
  t.fails(function() shapes.outline {{0, 0}, {1, 0}} end, "at least 3 corners, got 2")
  t.fails(function() shapes.lathe {{{0, 0}, {-1, 0}, {0, 1}}} end, "profile[2] must have a radius >= 0, got -1")
  t.fails(function() shapes.lathe {{{0, 0}, {1, 0}, {0, 1}, {1, 2}, {0, 3}}} end, "profile[3] must be off the axis")
  t.fails(function() shapes.lathe {{{0, 0}, {1, 0}, {1, 1}}} end, "both ends on the axis or none, got one")
  t.fails(function() shapes.loft {{{0, 0, 0}}, {{1, 0, 0}}} end, "two rings or more")
  t.fails(function() shapes.loft {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}} end,
          "ring 2 must have 3 points like the rings before it, got 4")
  t.fails(function() shapes.loft {{{0, 0, 0}, {1, 0, 0}, {0, 1, "z"}}, {{0, 0, 1}}} end, "ring 1[3] must be a point")
  t.fails(function() shapes.tube {{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, radius = 0.1} end,
          "path[2] must not turn straight back")
  t.fails(function() shapes.tube {{{0, 0, 0}, {1, 0, 0}, {1, 0.1, 0}}, radius = 0.3} end, "bends too sharply")
  t.fails(function() shapes.tube {{{0, 0, 0}, {0, 0, 0}}, radius = 0.3} end, "path[2] must differ from path[1]")
  t.fails(function() shapes.tube {path} end, "either radius or profile, got neither")
  t.fails(function() shapes.tube {path, radius = {1, 2}} end, "one for each of 5 points, got 2")
  t.fails(function() shapes.tube {path, radius = {1, 2, 3, 4, -5}} end, "radius[5] must be a number > 0, got -5")
  t.fails(function() shapes.tube {path, radius = 1, ends = "sharp"} end, "ends must be 'flat' or 'round', got 'sharp'")
  t.fails(function() shapes.tube {path, radius = 1, up = {1, 0, 0}} end, "up must not lie along")
  t.fails(function() shapes.tube {path, radius = 1, closed = 1} end, "closed must be true or false, got 1")
end)

test("invalid meshes are rejected by name and number", function(t)
  t.fails(function() shapes.union {} end, "a list of shapes, got none")
  t.fails(function() shapes.union {shapes.box {1, 1, 1}, 7} end, "part 2", "got 7")
  t.fails(function() shapes.volume {vertices = {{0, 0, 0}}, triangles = {{1, 2, 3}}} end,
          "triangle 1 must name vertices 1 to 1, got 2")
  t.fails(function() shapes.volume {vertices = {{0, 0}}, triangles = {}} end, "vertex 1 must be three numbers of at most 1e+09")
  t.fails(function() shapes.volume {vertices = {}, triangles = {}} end, "at least one triangle, got none")
  t.fails(function() shapes.mass {vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles = {{1, 2, 3}}} end,
          "without volume")
  t.fails(function() shapes.move(shapes.box {1, 1, 1}, {1, 2}) end, "the offset must be {x, y, z}")
  t.fails(function() shapes.turn(shapes.box {1, 1, 1}, {0, 0, 0}, 1) end, "the axis must have a length")
  t.fails(function() shapes.turn(shapes.box {1, 1, 1}, {0, 0, 1}, "a") end, "the angle must be a finite number, got 'a'")
  t.fails(function() shapes.scale(shapes.box {1, 1, 1}, -1) end, "the factor must be > 0, got -1")
  t.fails(function() shapes.mirror(shapes.box {1, 1, 1}, "w") end, "'x', 'y' or 'z', got 'w'")
end)

test("invalid vectors and vertices, and coordinates beyond the limit of meshes, are rejected", function(t)
  local box = shapes.box {1, 1, 1}
  t.fails(function() shapes.move(box, 5) end, "shapes.move: the offset must be {x, y, z} of at most 1e+09, got 5")
  t.fails(function() shapes.turn(box, 1, 1) end, "the axis must be {x, y, z} of at most 1e+09, got 1")
  t.fails(function() shapes.turn(box, {1e200, 0, 0}, 1) end, "the axis must be {x, y, z} of at most 1e+09, got 1e+200")
  t.fails(function() shapes.turn(box, {0, 0, 1}, 1, {math.mininteger, 0, 0}) end, "the point must be {x, y, z}")
  t.fails(function() shapes.move(box, {1e9, 0, 0}) end, "vertex 2 must be three numbers of at most 1e+09")
  local function flat(x) return {vertices = {x, {1, 0, 0}, {0, 1, 0}}, triangles = {{1, 2, 3}}} end
  for _, measure in ipairs {"volume", "area", "bounds", "closed", "mass"} do
    t.fails(function() shapes[measure](flat(7)) end, "shapes." .. measure .. ": vertex 1 must be three numbers")
    t.fails(function() shapes[measure](flat {1e300, 0, 0}) end, "vertex 1 must be three numbers of at most 1e+09, got 1e+300")
  end
  t.fails(function() shapes.box {math.mininteger, 1, 1} end, "x must be a number > 0")
  t.fails(function() shapes.loft {{{math.mininteger, 0, 0}}, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}} end, "must be a point {x, y, z}")
  t.fails(function() shapes.mass(shapes.scale(box, 1e-107)) end, "expected a solid, got a shape without volume")
end)

test("integer coordinates do not overflow in products", function(t)
  local far = 10^9 // 1 | 0
  local solid = {vertices = {{0, 0, 0}, {far, 0, 0}, {0, far, 0}, {0, 0, far}},
                 triangles = {{1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}}
  t.close(shapes.volume(solid) / (1e27 / 6), 1, 1e-12)
  t.close(shapes.mass(solid).volume / (1e27 / 6), 1, 1e-12)
end)

test("messages of the standard library have no control characters, and long names are shown by both ends", function(t)
  t.fails(function() shapes.ring {radius = 1, ["a\27[2J\0"] = 1} end, "shapes.ring: unknown key 'a?[2J\\0', expected any of")
  local ok, message = pcall(function() shapes.ring {radius = 1, [("\u{fc}"):rep(5000)] = 1} end)
  t.equal(ok, false)
  t.ok(#message < 1100 and utf8.len(tostring(message)), message)
  t.ok(message:find("expected any of radius, segments", 1, true), message)
end)

test("meshes of bodies and vectors are accepted as shapes and points", function(t)
  local clench = require "clench"
  local vec3 = clench.vec3
  local box = shapes.box {0.1, 0.2, 0.3}
  local mesh = clench.world():add_object(box).mesh
  t.close(shapes.volume(mesh), 0.006, 1e-12)
  t.close(shapes.area(mesh), 0.22, 1e-12)
  t.ok(shapes.closed(mesh))
  t.close(shapes.mass(mesh).centroid[1], 0, 1e-12)
  t.equal(shapes.bounds(shapes.move(mesh, vec3(1, 2, 3))), shapes.bounds(shapes.move(box, {1, 2, 3})))
  t.equal(#shapes.union {mesh, box}.vertices, 16)
  local tetrahedron = {vertices = {vec3(0, 0, 0), {1, 0, 0}, vec3(0, 1, 0), vec3(0, 0, 1)}, triangles = {{1, 3, 2}, {1, 2, 4}, {2, 3, 4}, {3, 1, 4}}}
  for _, of in ipairs {shapes.volume, function(x) return shapes.volume(shapes.scale(x, vec3(1, 1, 1))) end,
                       function(x) return shapes.volume(shapes.turn(x, vec3(0, 0, 1), 1, vec3(1, 0, 0))) end,
                       function(x) return shapes.volume(shapes.mirror(x, "x")) end} do
    t.close(of(tetrahedron), 1 / 6, 1e-12)
  end
  t.equal(shapes.capsule {0.01, from = vec3(0, 0, 0), to = vec3(0, 0, 1)}, shapes.capsule {0.01, from = {0, 0, 0}, to = {0, 0, 1}})
  t.equal(shapes.loft {{vec3(0, 0, 0)}, {vec3(1, 0, 1), vec3(0, 1, 1), vec3(-1, -1, 1)}}, shapes.loft {{{0, 0, 0}}, {{1, 0, 1}, {0, 1, 1}, {-1, -1, 1}}})
  t.equal(shapes.tube {{vec3(0, 0, 0), vec3(0, 0, 1)}, radius = 0.1}, shapes.tube {{{0, 0, 0}, {0, 0, 1}}, radius = 0.1})
  t.fails(function() shapes.volume(clench.world()) end, "expected a shape {vertices = ..., triangles = ...}, got a world")
end)
