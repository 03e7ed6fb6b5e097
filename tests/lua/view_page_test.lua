-- Pages of clench.export_html in a browser, checked by their pixels.
local test, clench = require "test", require "clench"
local find_three = require "clench.page.three"
local three, missing = find_three()

-- functions for the scripts below: counts pixels of the view, drawn anew without floor
local helpers = [==[<script>
  const tell = document.documentElement.dataset;
  plays = false;
  grid.visible = false;
  function look(distance, x, y, z) {
    Object.assign(orbit, {azimuth: 0, elevation: 0, distance});
    orbit.target.set(x, y, z);
  }
  function count(accepts) {
    resize();
    draw();
    const gl = renderer.getContext(), width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
    const all = new Uint8Array(4 * width * height), found = {number: 0, x: 0, y: 0, width, height};
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, all);
    for (let i = 0; i < all.length; i += 4) {
      if (!accepts(all[i], all[i + 1], all[i + 2], all[i + 3])) continue;
      ++found.number;
      found.x += (i / 4) % width + 0.5;
      found.y += Math.floor(i / 4 / width) + 0.5;
    }
    found.x /= found.number;
    found.y /= found.number;
    return found;
  }
  const covered = (r, g, b, a) => a > 127, orange = (r, g, b, a) => a > 127 && r > 1.6 * g && r > 1.6 * b;
  const said = found => [found.number, found.x, found.y, found.width, found.height].join(" ");
</script>]==]

-- the page with a script, opened in a browser: what the script has put into `tell`
local function in_browser(t, world, options, script)
  if not three then t.skip(missing) end
  local found <close> = io.popen "command -v chromium"
  if not found:read "l" then t.skip "chromium is not installed" end
  local path = test.path()
  clench.export_html(world, path .. ".html", options)
  local file <close> = assert(io.open(path .. ".html", "rb"))
  local html = file:read "a"
  clench.files.save_text(path .. ".html", (html:gsub("</body>", function() return helpers .. "<script>" .. script .. "</script></body>" end)))
  local dom <close> = io.popen(("timeout 120 chromium --headless --no-sandbox --disable-gpu-sandbox --use-gl=angle --use-angle=swiftshader "
    .. "--enable-unsafe-swiftshader --window-size=800,600 --user-data-dir=%s --virtual-time-budget=3000 --dump-dom file://%s.html 2>/dev/null"):format(path, path))
  local text = dom:read "a"
  return function(name)
    local numbers = {}
    for number in (text:match(' data%-' .. name .. '="([^"]*)"') or error("the page has not set " .. name)):gmatch "%S+" do numbers[#numbers + 1] = tonumber(number) end
    return {number = numbers[1], x = numbers[2], y = numbers[3], width = numbers[4], height = numbers[5]}
  end
end

local radius, distance, half_view = 0.05, 0.4, math.rad(16)  -- [m, m, rad]

-- pixels per unit of the tangent of an angle from the axis of the view
local function focal_length(shown) return shown.height / 2 / math.tan(half_view) end

local function ball_world(height)
  local world = clench.world()
  world:add_object(clench.shapes.sphere {radius = radius, subdivisions = 4}, {name = "ball", mass = 0.1, pose = {xyz = {0, 0, height}}})
  return world
end

test("a sphere covers the pixels of its silhouette, and none once it is hidden", function(t)
  local value = in_browser(t, ball_world(0), {}, ([==[
    look(%g, 0, 0, 0);
    tell.ball = said(count(covered));
    document.querySelector("#bodies input").click();
    tell.hidden = said(count(covered));
  ]==]):format(distance))
  local ball = value "ball"
  -- rays within asin(r / d) of the axis meet the sphere
  local expected = math.pi * (focal_length(ball) * math.tan(math.asin(radius / distance))) ^ 2
  t.close(ball.number / expected, 1, 0.01)
  t.close(ball.x, ball.width / 2, 0.5)
  t.close(ball.y, ball.height / 2, 0.5)
  t.equal(value "hidden".number, 0)
end)

test("the slider of a recorded run moves the body to its recorded height", function(t)
  local world = ball_world(0.1)
  local film = world:record {rate = 100}
  world:run(0.1)
  local fallen
  film:each(function(w, _, time)
    if math.abs(time - 0.08) < 1e-9 then fallen = w.objects[1].pose.position.z end
  end)
  local value = in_browser(t, world, {recording = film}, ([==[
    look(%g, 0, 0, 0.1);
    slider.value = 0.08;
    slider.dispatchEvent(new Event("input"));
    tell.ball = said(count(covered));
  ]==]):format(4 * distance))
  local ball = value "ball"
  t.close((ball.y - ball.height / 2) / focal_length(ball), (fallen - 0.1) / (4 * distance), 0.001)
end)

test("friction cones are orange where the hand touches the object, and there are none before", function(t)
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  -- of hidden bodies nothing covers them
  local script = 'document.querySelectorAll("#bodies input").forEach(box => box.click()); tell.cones = said(count(orange)); tell.all = said(count(covered));'
  local before = in_browser(t, world, {}, script)
  t.equal(before "all".number, 0)
  world.robots[1]:autograsp()
  local after = in_browser(t, world, {}, script)
  t.ok(after "cones".number > 20 and after "all".number < 2 * after "cones".number)
end)

test("a body that is replaced by another one of its name is shown with its own mesh", function(t)
  local world = ball_world(0.1)
  local film = world:record {rate = 100}
  world:run(0.05)
  world:remove(world.objects[1])
  world:add_object(clench.shapes.box {x = 0.02, y = 0.02, z = 0.02}, {name = "ball", mass = 0.1, pose = {xyz = {0, 0, 0.1}}})
  world:run(0.05)
  local data = require "clench.page.run".data_of(film)
  t.equal({#data.parts, #data.meshes}, {2, 2})
  t.equal({data.parts[1].mesh, data.parts[2].mesh}, {0, 1})
  -- seven numbers per part and frame, nan where the part is absent
  local value = in_browser(t, world, {recording = film}, [==[
    const shown = time => { showAt(time); return parts.map(mesh => Number(mesh.visible)).join(" "); };
    tell.first = shown(times[0]);
    tell.last = shown(times[times.length - 1]);
  ]==])
  local first, last = value "first", value "last"
  t.equal({first.number, first.x}, {1, 0})
  t.equal({last.number, last.x}, {0, 1})
end)

test("frames that are no grasps and no recorded run are refused", function(t)
  local world = ball_world(0.1)
  local function export(options) return function() clench.export_html(world, "build/refused.html", options) end end
  t.fails(export {grasps = {1}}, "clench.export_html: grasps[1]: expected a grasp, got 1")
  t.fails(export {grasps = {}}, "grasps: expected at least one, got none")
  t.fails(export {recording = {}}, "recording: expected a recorded run of world:record, got ")
  t.fails(export {recording = world:record {rate = 10}}, "recording: it is empty")
end)
