local test, clench = require "test", require "clench"

test("an invalid size and an up vector along the view are rejected by name", function(t)
  local world = clench.world()
  world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "cube"})
  local function fails(options, message) t.fails(function() clench.render(world, options) end, message) end
  fails({size = {-1, 10}}, "size: expected whole numbers of pixels, 16 to 8192, got -1")
  fails({size = {16, 0}}, "size: expected whole numbers of pixels, 16 to 8192, got 0")
  fails({size = {100.5, 100}}, "size: expected whole numbers of pixels, 16 to 8192, got 100.5")
  fails({size = {100, 15}}, "size: expected whole numbers of pixels, 16 to 8192, got 15")
  fails({size = {1e9, 100}}, "size: expected whole numbers of pixels, 16 to 8192, got 1000000000")
  fails({size = {10}}, "size: expected 2 numbers, got 1")
  fails({eye = {0, 0, 1}, target = {0, 0, 0}, up = {0, 0, 1}}, "expected different eye and target, and up in another direction than the view")
  fails({eye = {0, 0, 1}, target = {0, 0, 0}, up = {0, 0, -3}}, "up in another direction than the view")
  fails({up = {0, 0, 0}}, "up in another direction than the view")
end)

test("options of figures are rejected by name", function(t)
  local world = clench.world()
  local function fails(options, message) t.fails(function() clench.render(world, options) end, message) end
  fails({quality = "draft", samples = 8}, "samples: expected 1, 4, 9 or 16 of a draft, got 8")
  fails({ground = "low"}, "ground: expected true, false, or the height of the floor in meters, got 'low'")
  fails({outline = 40}, "outline must be 0 to 32, got 40")
  fails({letters = -1}, "letters must be 0 to 200, got -1")
  fails({orthographic = "yes"}, "orthographic: expected true, false, or a height > 0 in meters")
  fails({orthographic = -1}, "orthographic must be > 0, got -1")
  fails({background = "black"}, "background")
  fails({cones = "force"}, "cones: 'force' needs the option forces")
end)

test("a camera table is equivalent to the same options, and cannot be mixed with them", function(t)
  local world = clench.world()
  world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "cube"})
  local function draw(options)
    options.size, options.quality = {64, 48}, "draft"
    return clench.render(world, options)
  end
  local from = {eye = {0.3, -0.4, 0.5}, target = {0, 0, 0.02}, up = {0, 0, 1}, field_of_view = 0.4}
  t.equal(draw {camera = from}, draw(from))
  t.equal(draw {camera = {target = {0, 0, 0.02}}}.camera.eye, draw {target = {0, 0, 0.02}}.camera.eye)
  local flat = draw {camera = {orthographic = 0.3}}
  t.equal(flat.camera.orthographic, 0.3)
  t.equal(draw {camera = flat.camera}, flat)
  t.equal(draw {camera = {}}, draw {})
  t.fails(function() draw {camera = {eye = {1, 0, 0}}, target = {0, 0, 0}} end, "expected either camera or target, got both")
  t.fails(function() draw {camera = {eyes = {1, 0, 0}}} end, "unknown key 'eyes'")
  t.fails(function() draw {camera = 3} end, "camera: expected a table of options, got 3")
end)

test("a pick returns the body, point and normal that a ray through the pixel hits", function(t)
  local world = clench.world()
  local cube = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "cube"})
  local far = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "far", pose = clench.pose {xyz = {0.3, 0, 0}}})
  local camera = {eye = {0.15, -1, 0.12}, target = {0.15, 0, 0}, up = {0, 0, 1}, field_of_view = 0.5}
  local picture = clench.render(world, {size = {161, 121}, quality = "draft", camera = camera})
  local kinds, points = {}, 0
  for x = 1, 161, 4 do
    for y = 1, 121, 4 do
      local picked = picture:pick(x, y)
      local kind = picked and (picked.body and picked.body.name or picked.kind) or "nothing"
      kinds[kind] = true
      if picked and picked.body then
        -- the point is on a face of the box, and the normal is that of the face
        local p = picked.body.pose:inverse() * picked.point
        t.close(math.max(math.abs(p.x), math.abs(p.y), math.abs(p.z)), 0.05, 1e-9)
        t.close(p:dot(picked.normal), 0.05, 1e-9)
        t.close((picked.point - clench.vec3(camera.eye)):norm(), picked.distance, 1e-12)
        points = points + 1
      end
    end
  end
  t.ok(kinds.cube and kinds.far and kinds.floor and kinds.nothing, "both boxes, the floor and nothing are seen")
  t.ok(points > 50, "many points")
  -- in the state in which it was drawn
  local x, y = 81 - 41, 61
  local before = picture:pick(x, y)
  cube.pose = clench.pose {xyz = {0, 0, 5}}
  t.equal(picture:pick(x, y).point, before.point)
  world:remove(far)
  for px = 90, 161 do
    local picked = picture:pick(px, 61)
    if picked and picked.kind == "body" then t.equal(picked.body, nil) end
  end
end)
