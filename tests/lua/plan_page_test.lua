-- The page of `clench plan`: its contents, escaped hostile names, and rendering in a browser.
local test = require "test"
local base64 = require "clench.base64"
local page = require "clench.plan.report_page"
local report_rows = require "clench.plan.report_rows"
local find_three = require "clench.page.three"

local three, missing = find_three()
local hostile = "</script><img src=x onerror=\"document.documentElement.dataset.bad='yes'\"><!-- & \u{e9}"

-- a grasped flask, and the same grasp with other numbers
local function stage(count)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand, flask = world.robots[1], world.objects[1]
  local open = hand.dofs
  hand:autograsp()
  local grasps = {}
  for i = 1, count do
    local grasp = clench.grasp(hand, flask)
    grasp.pregrasp = {pose = grasp.pose, dofs = open}
    if i ~= 2 then grasp.info = {load_margin = 2 + i % 5 / 4, perturbed_epsilon = 0.01 * i} end
    grasps[i] = grasp
  end
  return world, hand, flask, grasps
end

local function html_of(count, name)
  local _, hand, flask, grasps = stage(count)
  if name then flask.name = name end
  return page(hand, flask, grasps, {title = name or "hand grasps flask", subtitle = name or "files", report = name or "words"})
end

test("base64 is that of RFC 4648", function(t)
  for bytes, text in pairs {[""] = "", f = "Zg==", fo = "Zm8=", foo = "Zm9v", foob = "Zm9vYg==", fooba = "Zm9vYmE=",
                            foobar = "Zm9vYmFy", ["\0\xff\x10"] = "AP8Q"} do
    t.equal(base64(bytes), text)
  end
end)

test("rows contain the approach of the hand, and leave the world unchanged", function(t)
  local world, hand, flask, grasps = stage(1)
  local before = world:hash()
  local visited = 0
  local rows = report_rows(hand, flask, grasps, function() visited = visited + 1 end)
  t.equal(visited, 1)
  t.equal(world:hash(), before)
  local row, d = rows[1], hand.approach.direction
  t.equal(row.contacts, #grasps[1].points)
  t.equal(row.load, 2.25)
  t.close(math.sin(clench.rad(row.elevation)), -d.z, 0.01)
  t.close(math.cos(clench.rad(row.elevation)) * math.cos(clench.rad(row.azimuth)), -d.x, 0.02)
end)

test("without three.js, the package that provides it is named", function(t)
  local text, why = find_three {"/no/such/three.js"}
  t.equal(text, nil)
  t.equal(why, "a page with a 3-D view needs three.js, which is not installed: apt-get install libjs-three")
  local _, hand, flask, grasps = stage(1)
  t.fails(function() page(hand, flask, grasps, {title = "", subtitle = "", report = "", three = {}}) end, "apt-get install libjs-three")
end)

test("a page has a row for each grasp and each mesh once, and loads nothing from elsewhere", function(t)
  if not three then t.skip(missing) end
  local html, notes = html_of(3)
  t.equal(#notes, 0)
  local _, rows = html:gsub("<tr data%-grasp=", "")
  t.equal(rows, 3)
  t.ok(html:find("<td data-value=\"\">&ndash;</td>", 1, true), "expected a dash where a grasp was not verified")
  local data = clench.json.decode(html:match '<script type="application/json" id="data">(.-)</script>')
  t.equal(#data.grasps, 3)
  t.ok(#data.meshes < #data.parts + #data.still, "expected links that share their mesh")
  for _, part in ipairs(data.parts) do t.ok(data.meshes[part.mesh + 1]) end
  for _, grasp in ipairs(data.grasps) do
    t.equal(#grasp.poses, #data.parts)
    t.equal(#grasp.before, #data.parts)
  end
  t.ok(html:find("default-src 'none'", 1, true))
  for source in html:gmatch '<[^<>]- src="([^"]*)' do t.equal(source:sub(1, 5), "data:") end
  t.equal(html:find "<link" or html:find "<iframe", nil)
end)

test("a page without grasps says so, and one of many shows the first hundred", function(t)
  if not three then t.skip(missing) end
  t.ok(html_of(0):find("No grasp was found", 1, true))
  local html, notes = html_of(101)
  t.equal(notes[1], "the page shows the first 100 of 101 grasps")
  local _, rows = html:gsub("<tr data%-grasp=", "")
  t.equal(rows, 100)
  t.ok(#html < 8e6)
end)

test("a mesh that makes the page large is reported", function(t)
  if not three then t.skip(missing) end
  local world, hand = stage(0)
  local points, triangles, n = {}, {}, 330
  for i = 0, n do
    for j = 0, n do
      points[#points + 1] = {i / n, j / n, 0.01 * math.sin(i) * math.sin(j)}
      local k = i * (n + 1) + j + 1
      if i < n and j < n then
        triangles[#triangles + 1] = {k, k + n + 1, k + 1}
        triangles[#triangles + 1] = {k + 1, k + n + 1, k + n + 2}
      end
    end
  end
  local sheet = world:add_object({vertices = points, triangles = triangles}, {name = "sheet", mass = 1})
  local html, notes = page(hand, sheet, {}, {title = "", subtitle = "", report = ""})
  t.equal(notes[1], "the mesh of sheet has 217800 triangles: the page is large, and its view may be slow")
  t.ok(html:find('"wide":true', 1, true))
end)

-- the page as a browser shows it, as text; nil if there is no browser
local function in_browser(html)
  local found = io.popen "command -v chromium"
  local chromium = found:read "l"
  found:close()
  if not chromium then return nil end
  local folder = test.path()
  clench.files.save_text(folder .. ".html", html)
  local dom = io.popen(("timeout 60 chromium --headless --no-sandbox --disable-gpu-sandbox --use-gl=angle --use-angle=swiftshader "
    .. "--enable-unsafe-swiftshader --user-data-dir=%s --virtual-time-budget=10000 --dump-dom file://%s.html 2>/dev/null"):format(folder, folder))
  local text = dom:read "a"
  dom:close()
  return text
end

-- actions of a reader: the load's column is clicked, the second grasp is chosen, and the mouse drags the view
local reader = [==[<script>
  const tell = document.documentElement.dataset, rows = () => [...document.querySelectorAll("tbody tr")].map(r => r.dataset.grasp).join();
  document.querySelectorAll("th[data-column]")[2].click();
  tell.down = rows();
  document.querySelectorAll("th[data-column]")[2].click();
  tell.up = rows();
  document.querySelector("tr[data-grasp='2']").click();
  tell.shown = document.querySelector("#view .shown").textContent;
  const before = orbit.azimuth;
  view.setPointerCapture = () => {};
  for (const [name, x] of [["pointerdown", 100], ["pointermove", 150], ["pointerup", 150]])
    view.dispatchEvent(new PointerEvent(name, {clientX: x, clientY: 100, bubbles: true}));
  tell.turned = (before - orbit.azimuth).toFixed(3);
</script>]==]

test("in Chromium the table sorts, a click shows a grasp, and the mouse turns it", function(t)
  if not three then t.skip(missing) end
  local text = in_browser(html_of(3) .. reader)
  if not text then t.skip "chromium is not installed" end
  t.equal(text:match ' data%-down="([^"]*)"', "3,1,2")
  t.equal(text:match ' data%-up="([^"]*)"', "2,1,3")
  t.equal(text:match ' data%-shown="([^"]*)"', "Grasp 2")
  t.equal(text:match ' data%-turned="([^"]*)"', "0.400")
end)

test("Chromium draws a grasp, and shows hostile names as text", function(t)
  if not three then t.skip(missing) end
  local text = in_browser(html_of(3, hostile))
  if not text then t.skip "chromium is not installed" end
  local covered = tonumber(text:match '<html[^>]- data%-drawn="(%d+)"')
  t.ok(covered and covered > 20, "expected WebGL to have drawn, got " .. tostring(covered))
  local _, rows = text:gsub("<tr data%-grasp=", "")
  t.equal(rows, 3)
  t.ok(text:find('<tr data%-grasp="1" aria%-selected="true"'))
  t.ok(text:find("<canvas", 1, true))
  t.equal(text:match '<html[^>]- data%-bad', nil)
  t.equal(text:find("<img src=\"x\"", 1, true), nil)
end)

test("a page has the colors of triangles if a file gives several, and lists the assumptions", function(t)
  if not three then t.skip(missing) end
  local path = test.path()
  clench.files.save_text(path .. ".mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n")
  local name = path:match "[^/]*$"
  clench.files.save_text(path .. ".obj", "mtllib " .. name .. ".mtl\nv 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\n" ..
    "usemtl a\nf 1 3 2\nf 1 2 4\nusemtl b\nf 1 4 3\nf 2 3 4\n")
  local _, hand = stage(0)
  local object = hand.world:add_object(path .. ".obj", {unit = "m"})
  t.equal(object.triangle_colors, {{1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 1}})
  t.equal(object.visual_mesh, object.mesh)
  local html = page(hand, object, {}, {title = "", subtitle = "", report = "", assumptions = {"friction 0.3 <assumed>"}})
  local data = clench.json.decode(html:match '<script type="application/json" id="data">(.-)</script>')
  for _, part in ipairs(data.still) do
    if part.kind == "object" then t.equal(data.meshes[part.mesh + 1].colors, base64("\xff\0\0\xff\0\0\0\0\xff\0\0\xff")) end
  end
  t.ok(html:find("<h2>Assumptions</h2><ul><li>friction 0.3 &lt;assumed&gt;</li></ul>", 1, true))
  for _, ending in ipairs {".mtl", ".obj", ""} do os.remove(path .. ending) end
end)

-- 2 x 1 pixels: red, blue
local png = "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02\x00\x00\x00\x01\x08\x02\x00\x00\x00\x7b\x40\xe8\xdd\x00\x00" ..
  "\x00\x0d\x49\x44\x41\x54\x78\x9c\x63\xf8\xcf\x00\x04\xff\x01\x07\x00\x01\xff\xe2\x23\x9e\x59\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82"

test("a page contains the textures of a body once, with their coordinates", function(t)
  if not three then t.skip(missing) end
  local path = test.path()
  local name = path:match "[^/]*$"
  local file = assert(io.open(path .. ".png", "wb"))
  file:write(png)
  file:close()
  clench.files.save_text(path .. ".mtl", "newmtl a\nKd 1 1 0.5\nmap_Kd -clamp on " .. name .. ".png\nnewmtl b\nKd 0 0 1\n")
  clench.files.save_text(path .. ".obj", "mtllib " .. name .. ".mtl\nv 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nvt 0 0\nvt 1 0\nvt 0 0.75\n" ..
    "usemtl a\nf 1/1 3/3 2/2\nusemtl b\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
  local _, hand = stage(0)
  local object = hand.world:add_object(path .. ".obj", {unit = "m"})
  local twin = hand.world:add_obstacle(path .. ".obj", {unit = "m", name = "twin", pose = {xyz = {0, 0, 5}}})
  local textures = object.textures
  t.equal(#textures.images, 1)
  local image = textures.images[1]
  t.equal({image.width, image.height, image.wrap_u, image.wrap_v}, {2, 1, "clamp", "clamp"})
  t.equal(image.tint, {1, 1, 0.5})
  t.equal(image.jpeg:sub(1, 3), "\xff\xd8\xff")
  t.equal({string.unpack("<I2I2I2I2", textures.numbers)}, {1, 0, 0, 0, 9})
  t.equal({string.unpack("<ffffff", textures.places)}, {0, 1, 0, 0.25, 1, 1, 25})
  t.equal(object.fingerprint, twin.fingerprint)

  local html = page(hand, object, {}, {title = "", subtitle = "", report = "", assumptions = {}})
  local data = clench.json.decode(html:match '<script type="application/json" id="data">(.-)</script>')
  t.equal(data.images, {"data:image/jpeg;base64," .. base64(image.jpeg)})
  for _, part in ipairs(data.still) do
    if part.name == object.name then
      local mesh = data.meshes[part.mesh + 1]
      t.equal(mesh.textures.numbers, base64(textures.numbers))
      t.equal(mesh.textures.places, base64(textures.places))
      t.equal(mesh.textures.list, {{image = 0, tint = {1, 1, 0.5}, wrap = {"clamp", "clamp"}}})
    end
  end
  object.color = {1, 0, 0}
  t.equal(object.textures, nil)
  for _, ending in ipairs {".mtl", ".obj", ".png", ""} do os.remove(path .. ending) end
end)
