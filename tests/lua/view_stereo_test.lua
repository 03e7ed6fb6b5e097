-- Stereoscopic pictures of the viewer, compared with pictures and formulas of two cameras.
local test, clench = require "test", require "clench"
local camera = require "clench.view.camera"

local width, height = 320, 240
local size = {width, height}

local function open(panels)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = panels and {1070, 937} or size}
  view.panels_visible = panels or false
  view:home()
  view:frame()
  return session, view
end

-- fraction of the pixels of a rectangle in which a channel (1 red, 2 green, 3 blue) of two pictures differs by more than a tolerance; those of the
-- second picture are taken `shift` to the right
local function different(a, b, channel, tolerance, shift)
  local count, all = 0, 0
  for y = 1, height, 3 do
    for x = 41, width - 40 do
      local one, other = select(channel, a:pixel(x, y)), select(channel, b:pixel(x + (shift or 0), y))
      count, all = count + (math.abs(one - other) > tolerance and 1 or 0), all + 1
    end
  end
  return count / all
end

-- the camera moved to the right, with parallel view [m]
local function moved(c, distance)
  local shift = camera.axes(c) * distance
  return {eye = c.eye + shift, target = c.target + shift, up = c.up, field_of_view = c.field_of_view}
end

test("with both eyes in one place an anaglyph is the plain picture, and side by side are two equal pictures", function(t)
  local _, view = open()
  local plain = view:screenshot {}
  t.equal(view:screenshot {stereo = {kind = "anaglyph", eye_distance = 0}} == plain, true)
  t.equal(view.stereo, nil)
  local both = view:screenshot {stereo = {kind = "side by side", eye_distance = 0}}
  local half = view:screenshot {size = {width // 2, height}}
  for y = 1, height, 7 do
    for x = 1, width // 2 do
      local want = {half:pixel(x, y)}
      t.equal({both:pixel(x, y)}, want)
      t.equal({both:pixel(x + width // 2, y)}, want)
    end
  end
  view:close()
end)

test("red is the picture of a camera to the left and cyan that of one to the right, moved so that they meet at the target", function(t)
  local _, view = open()
  local c = view.camera
  local pixels = 6
  local distance = 2 * pixels * camera.height(c) / height  -- the target moves by 6 pixels in each picture
  local shot = view:screenshot {stereo = {kind = "anaglyph", eye_distance = distance}}
  local left, right = view:screenshot {camera = moved(c, -distance / 2)}, view:screenshot {camera = moved(c, distance / 2)}
  -- backdrops differ slightly: they belong to the screen
  t.ok(different(shot, left, 1, 12, pixels) < 0.002, different(shot, left, 1, 12, pixels))
  t.ok(different(shot, right, 2, 12, -pixels) < 0.002, different(shot, right, 2, 12, -pixels))
  t.ok(different(shot, right, 3, 12, -pixels) < 0.002, different(shot, right, 3, 12, -pixels))
  t.ok(different(shot, left, 1, 12, -pixels) > 0.02, "the other direction differs")
  t.ok(different(shot, right, 1, 12, -pixels) > 0.005, "red is not the right picture")
  view:close()
end)

test("what the camera points at is in the plane of the screen, and what is nearer in front of it", function(t)
  local _, view = open()
  view.stereo = {kind = "anaglyph", eye_distance = 0.03}
  local c = view.camera
  local right, up, back = camera.axes(c)
  local focal, far = height / (2 * math.tan(c.field_of_view / 2)), (c.eye - c.target):norm()
  for _, depth in ipairs {far, 0.6 * far, 2 * far} do
    local point = c.eye - back * depth + right * 0.02 + up * 0.01
    local left_x, left_y = view:project(point, "left")
    local right_x, right_y = view:project(point, "right")
    t.close(left_x - right_x, focal * 0.03 * (1 / depth - 1 / far), 1e-6)  -- positive in front of the screen
    t.close(left_y, right_y, 1e-6)
    t.close((left_x + right_x) / 2, (view:project(point)), 1e-6)
  end
  view:toggle_orthographic()
  local near = c.target + back * 0.1
  t.close((view:project(c.target, "left")), (view:project(c.target, "right")), 1e-6)
  local scale, turn = height / view.camera.orthographic, math.atan(0.015 / far)
  t.close(view:project(near, "left") - view:project(near, "right"), 2 * scale * 0.1 * math.sin(turn), 1e-6)
  local _, left_y = view:project(near + right * 0.05 + up * 0.03, "left")
  local _, right_y = view:project(near + right * 0.05 + up * 0.03, "right")
  t.close(left_y, right_y, 1e-6)
  view:close()
end)

test("side by side, each half picks, drags and draws by its own camera", function(t)
  local session, view = open()
  view.stereo = {kind = "side by side", eye_distance = 0.04}
  view:home()
  view:frame()
  local center = session.object.pose * session.object.com
  for _, eye in ipairs {"left", "right"} do
    local x, y = view:project(center, eye)
    t.equal(x < width / 2, eye == "left")
    local hit = view:pick(x, y)
    local seen_x, seen_y = view:project(hit.point, eye)
    t.close({seen_x, seen_y}, {x, y}, 1e-6)
  end
  view:tool "Translate"
  session.object.pose = clench.pose {xyz = {0, 0, 0.5}}
  view:select "mug"
  view:home(true)
  local before = session.object.pose.position
  local handle
  for _, one in ipairs(view:handles()) do handle = one.name == "z" and one or handle end
  local half = view:project(before, "right") - view:project(before, "left")  -- the same arrow in the right half
  view:drag(handle.x + half, handle.y, handle.x + half, handle.y - 15)
  local shift = session.object.pose.position - before
  t.ok(shift.z > 0.01, shift.z)
  t.close({shift.x, shift.y}, {0, 0}, 1e-9)
  view:close()
end)

test("panels are drawn once, over both pictures", function(t)
  local _, view = open(true)
  local plain = view:screenshot {}
  for _, kind in ipairs {"side by side", "anaglyph"} do
    local shot = view:screenshot {stereo = {kind = kind, eye_distance = 0.03}}
    local same, picture = true, true
    for y = 70, 930, 5 do
      for _, x in ipairs {20, 90, 170, 240, 820, 900, 1000, 1060} do same = same and ("%d %d %d"):format(shot:pixel(x, y)) == ("%d %d %d"):format(plain:pixel(x, y)) end
      picture = picture and ("%d %d %d"):format(shot:pixel(535, y)) == ("%d %d %d"):format(plain:pixel(535, y))
    end
    t.equal({same, picture}, {true, false})
  end
  view:close()
end)

test("menu, panel Display and the keys + and - choose stereo and the distance of the eyes", function(t)
  local _, view = open(true)
  view:key "+"
  t.ok(view.status:find "Stereo is off", view.status)
  view:menu "View/Stereo/Anaglyph"
  t.equal(view.stereo, {kind = "anaglyph"})
  local far = (view.camera.eye - view.camera.target):norm()
  view:key "+"
  t.close(view.stereo.eye_distance, 1.25 * far / 30, 1e-12)
  view:key "-"
  t.close(view.stereo.eye_distance, far / 30, 1e-12)
  view:menu "View/Stereo/Side by Side"
  t.equal(view.stereo.kind, "side by side")
  view:click_label "Display"
  view:click_label "Automatic"
  t.equal(view.stereo, {kind = "side by side"})
  view:menu "View/Stereo/Stereo Off"
  t.equal(view.stereo, nil)
  view:close()
end)

test("wrong options of stereo are refused in a sentence", function(t)
  local _, view = open()
  t.fails(function() view:screenshot {stereo = {kind = "both"}} end, "view:screenshot: stereo: kind: expected 'side by side' or 'anaglyph', got 'both'")
  t.fails(function() view:screenshot {stereo = {kind = "anaglyph", eye_distance = -1}} end, "eye_distance: expected a number from 0 to 10, got -1")
  t.fails(function() view:screenshot {stereo = {kind = "anaglyph", eyes = 1}} end, "unknown key 'eyes'")
  t.fails(function() view:screenshot {stereo = true} end, "expected a table of options, got true")
  t.fails(function() view:project({0, 0, 0}, "middle") end, "view:project: eye: expected 'left' or 'right', got 'middle'")
  view.stereo = {kind = 3}
  t.fails(function() view:frame() end, "view.stereo: kind")
  view.stereo = nil
  view:frame()
  view:close()
end)

test("in an anaglyph, lines and points over the picture have the depth of what they mark", function(t)
  local session, view = open(true)
  view.picture_visible = false
  view.stereo = {kind = "anaglyph", eye_distance = 0.03}
  local mug = session.object
  local center = mug.pose.position
  view.camera = {eye = center + clench.vec3(0.5, 0, 0), target = center - clench.vec3(0.3, 0, 0), up = clench.vec3(0, 0, 1), field_of_view = 0.6}
  view.measured = {{body = mug, point = clench.vec3(0, 0, 0)}}
  view:frame()
  local shot = view:screenshot {}
  local left, y = view:project(center, "left")
  local right = view:project(center, "right")
  t.ok(left - right > 14, left - right)  -- it is in front of the screen
  local function at(x) return {shot:pixel(math.floor(x), math.floor(y))} end
  local red, cyan = at(left), at(right)
  t.ok(red[1] < 130 and red[2] > 240 and red[3] > 240, table.concat(red, " "))
  t.ok(cyan[1] > 240 and cyan[2] < 50 and cyan[3] < 150, table.concat(cyan, " "))
  view:close()
end)
