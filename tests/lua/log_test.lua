-- Records of a run: logs, states on a stack, films.
local test, clench = require "test", require "clench"
local find_three = require "clench.page.three"

local function thrown_box()
  local world = clench.world()
  local box = world:add_object(clench.shapes.box {0.1, 0.06, 0.04}, {name = "box", mass = 0.5, pose = {xyz = {0, 0, 0.1}}})
  world:add_obstacle(clench.shapes.box {2, 2, 0.1}, {name = "floor", pose = {xyz = {0, 0, -0.05}}})
  box.velocity = {linear = {0.5, 0, 1}, angular = {1, 3, 0}}
  return world, box
end

test("a log has a row for each period, with numbers of bodies, robots and functions", function(t)
  local world, box = thrown_box()
  local log = world:log {rate = 50, quantities = {box, "energy", "momentum", "contacts", "failures",
    speed = function() return box.velocity.linear:norm() end, flies = function() return box.pose.position.z > 0.05 end}}
  world:run(0.1)
  world:run(0.1)
  t.equal(#log.rows, 11)
  t.equal(table.concat(log.columns, " "), "time box.position.x box.position.y box.position.z box.quat[1] box.quat[2] box.quat[3] box.quat[4] "
    .. "box.velocity.x box.velocity.y box.velocity.z box.angular_velocity.x box.angular_velocity.y box.angular_velocity.z energy.kinetic energy.potential "
    .. "momentum.linear.x momentum.linear.y momentum.linear.z momentum.angular.x momentum.angular.y momentum.angular.z contacts failures flies speed")
  for i, row in ipairs(log.rows) do t.close(row.time, 0.02 * (i - 1), 1e-9) end
  t.equal(log.rows[1].flies, 1)
  t.close(log.rows[11]["box.position.x"], box.pose.position.x, 0)
  t.close(log.rows[1]["momentum.linear.x"], 0.25, 1e-12)
  log:remove()
  world:run(0.1)
  t.equal(#log.rows, 11)

  log:save "build/log_test.csv"
  local rows = clench.csv.read "build/log_test.csv"
  t.equal(table.concat(rows.columns, " "), table.concat(log.columns, " "))
  for i, row in ipairs(rows) do t.close(row["box.position.z"], log.rows[i]["box.position.z"], 0) end
  log:save "build/log_test.npz"
  local arrays = clench.files.arrays "build/log_test.npz"
  t.equal(#arrays["box.quat"][1], 4)
  t.equal(#arrays.time, 11)
  t.close(arrays["box.position"][11], {log.rows[11]["box.position.x"], log.rows[11]["box.position.y"], log.rows[11]["box.position.z"]}, 0)
  t.close(arrays.speed[3], log.rows[3].speed, 0)
end)

test("robots are logged by their DOFs", function(t)
  local world = clench.load("worlds/dlr_flask.wld", {root = "."})
  local hand = world.robots[1]
  local log = world:log {quantities = {hand}}
  hand:autograsp {dynamic = true}
  world:run(0.05)
  t.equal(#log.rows, 6)
  t.equal(#log.columns, 1 + 3 * #hand.dofs)
  t.equal(log.rows[6][hand.name .. ".dofs[3]"], hand.dofs[3])
end)

test("values that cannot be logged are reported in one sentence", function(t)
  local world, box = thrown_box()
  local function refused(options, text) t.fails(function() world:log(options) end, text) end
  refused(nil, "world:log: expected one table of options")
  refused({}, "world:log: quantities must be a table of bodies, robots, names and functions, got nothing")
  refused({quantities = {}}, "world:log: quantities: expected at least one, got none")
  refused({quantities = {box, box}}, "world:log: quantities: 'box.position' appears twice")
  refused({quantities = {"enegry"}}, "did you mean 'energy'?")
  refused({quantities = {x = 3}}, "world:log: quantities: x: expected a function, got 3")
  refused({quantities = {thrown_box().objects[1]}}, "world:log: quantities[1]: 'box' belongs to another world")
  refused({quantities = {box}, rat = 5}, "unknown key 'rat'")
  local function fails(fn, text)
    local log = world:log {quantities = {own = fn}}
    t.fails(function() world:run(0.02) end, text, "in a quantity of world:log")
    log:remove()
  end
  fails(function() return "x" end, "world:log: own: expected a function that returns a number, true or false, a vector or a list of numbers, got 'x'")
  fails(function() return {1, "x"} end, "world:log: own[2]: expected a number, got 'x'")
  local n = 0
  fails(function() n = n + 1 return n == 1 and {1, 2} or {1} end, "world:log: own: expected 2 numbers as before, got 1")
  local log = world:log {quantities = {box}}
  t.fails(function() log:save "a.txt" end, "log:save: expected a name that ends in .csv or .npz, got 'a.txt'")
  t.fails(function() clench.files.save_arrays("build/a.npz", {a = {{1}, {1, 2}}}) end, "a[2]: expected a row of 1 numbers, got a row of 2 numbers")
  t.fails(function() clench.files.save_arrays("build/a.npz", {["../a"] = {1}}) end, "expected names without slashes")
  local numbers = {time = {0, 0.5}, place = {{1, 2, 3}, {4, 5, 6}}}
  clench.files.save_arrays("build/log_test_small.npz", numbers, {compress = true})
  t.equal(clench.files.arrays "build/log_test_small.npz", numbers)
  t.fails(function() clench.files.save_arrays("build/a.npz", {a = {1}}, {compres = true}) end, "unknown key 'compres'")
  t.fails(function() clench.files.save_arrays("build/a.npz", {a = 1}) end, "a: expected a list of numbers, or of rows of them, got 1")
  -- of many faults the first by name, for any order of the table
  local many = {}
  for i = 1, 40 do many["array" .. 140 - i] = i end
  t.fails(function() clench.files.save_arrays("build/a.npz", many) end, "array100: expected a list")
  t.fails(function() clench.files.save_arrays("build/a.npz", {[true] = {1}, a = {1}}) end, "arrays: expected names as keys, got true")
end)

test("a run is repeated bit-exactly, from a snapshot and from the stack", function(t)
  local world, box = thrown_box()
  world:run(0.13)
  local moment = world:snapshot()
  t.equal(world:push(), 1)
  world:run(0.4)
  local there = world:hash()
  world:restore(moment)
  world:run(0.4)
  t.equal(world:hash(), there)
  t.equal(world:pop(), 0)
  t.close(world.time, 0.13, 0)
  local here = world:hash()
  world:run(0.4)
  t.equal(world:hash(), there)
  -- the states form a stack: last in, first out
  world:restore(moment)
  world:push()
  box.pose = clench.pose {xyz = {0, 0, 3}}
  t.equal(world:push(), 2)
  box.pose = clench.pose {xyz = {0, 0, 4}}
  world:pop()
  t.equal(box.pose.position.z, 3.0)
  world:pop()
  t.equal(world:hash(), here)
  t.fails(function() world:pop() end, "world:pop: the stack is empty")
  t.fails(function() world:clone():pop() end, "the stack is empty")
end)

local function file_bytes(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read "a"
end

-- delays of the frames of an animated GIF, in hundredths of a second
local function gif_delays(path)
  local bytes, delays = file_bytes(path), {}
  assert(bytes:sub(1, 6) == "GIF89a")
  for delay in bytes:gmatch "\x21\xF9\x04.(..)" do delays[#delays + 1] = string.unpack("<I2", delay) end
  return table.concat(delays, " ")
end

test("pictures become an animated GIF", function(t)
  local pictures = {clench.chart {series = {{name = "a", values = {1, 2, 3}}}, width = 200, height = 150}.picture,
                    clench.chart {series = {{name = "b", values = {3, 2, 1}}}, width = 200, height = 150}.picture}
  clench.files.save_gif("build/test.gif", pictures, {rate = 30})
  t.equal(gif_delays "build/test.gif", "3 4")
  t.fails(function() clench.files.save_gif("build/test.gif", {pictures[1], clench.chart {series = {{name = "a", values = {1}}}, width = 300}.picture}) end,
          "picture 2: expected 200 x 150 pixels as in the first, got 300 x")
  t.fails(function() clench.files.save_gif("build/test.gif", {3}) end, "pictures[1]: expected a picture, got 3")
end)

local function recorded()
  local world = thrown_box()
  local film = world:record {rate = 20}
  world:run(0.3)
  return film, world
end

test("a recording has the states of its times, and leaves the world unchanged", function(t)
  local film, world = recorded()
  t.equal(#film.times, 7)
  local before, z = world:hash(), {}
  film:each(function(w, i, time) z[i] = w.objects[1].pose.position.z t.close(w.time, time, 0) end)
  t.equal(world:hash(), before)
  t.close(z[1], 0.1, 0)
  t.close(z[7], world.objects[1].pose.position.z, 0)
  film:remove()
  world:run(0.1)
  t.equal(#film.times, 7)
  t.fails(function() film:save "a.webm" end, "recording:save: expected a name that ends in .html, .gif, .mp4 or .png, got 'a.webm'")
  t.fails(function() film:save("build/a.gif", {speed = 0}) end, "recording:save: speed must be")
  t.fails(function() film:save("build/a.gif", {ffmpeg = "x"}) end, "ffmpeg applies only to .mp4")
  t.fails(function() film:save("build/a.mp4", {ffmpeg = "no-such-program"}) end,
          "recording:save: .mp4 needs the program 'no-such-program', which is not installed; .gif and .html need no program")
  t.fails(function() film:save("build/a.html", {three = {}}) end, "recording:save: a page with a 3-D view needs three.js")
  t.fails(function() world:record {}:save "a.gif" end, "it is empty")
end)

test("films are pictures, a GIF, or videos made by ffmpeg", function(t)
  local film = recorded()
  local ok, why = pcall(film.save, film, "build/film_.gif", {size = {96, 72}})
  if not ok then
    if tostring(why):find "OpenGL" or tostring(why):find "EGL" then t.skip(tostring(why)) end
    error(why, 0)
  end
  t.equal(gif_delays "build/film_.gif", "5 5 5 5 5 5 5")
  t.equal(film:save("build/film_test.png", {size = {64, 48}}), 7)
  t.ok(file_bytes "build/film_test_0001.png" ~= file_bytes "build/film_test_0007.png")
  for i = 1, 7 do
    local path = ("build/film_test_%04d.png"):format(i)
    t.equal(file_bytes(path):sub(2, 4), "PNG")
    os.remove(path)
  end
  -- a program that writes its arguments, and a film
  local function program(lines)
    local path = test.path("", "#!/bin/sh\n" .. lines .. "\n")
    os.execute("chmod +x " .. path)
    return path
  end
  local good = program 'echo "$@" > build/ffmpeg_asked\nfor last do :; done\nprintf film > "$last"'
  local function save(path, name) return film:save(path, {size = {64, 48}, ffmpeg = name, speed = 0.5}) end
  for _, path in ipairs {"build/it's a film.mp4", "-12:30.mp4"} do
    t.equal(save(path, good), 7)
    t.equal(file_bytes(path), "film")
    os.remove(path)
  end
  local asked = file_bytes "build/ffmpeg_asked"
  t.ok(asked:find("-framerate 10 ", 1, true) and asked:find("-frames:v 7", 1, true) and asked:find " %./%.[%w_]+%.mp4\n$")
  -- a film that fails leaves the old one
  clench.files.save_text("build/a.mp4", "old")
  local partial = 'for last do :; done\nprintf part > "$last"\n'
  t.fails(function() save("build/a.mp4", program(partial .. "exit 3")) end, "could not write 'build/a.mp4' and ended with code 3")
  t.fails(function() save("build/a.mp4", program "exit 0") end, "has not written 'build/a.mp4'")
  t.fails(function() save("build/no/a.mp4", good) end, "build/no/a.mp4: the file cannot be written: no such folder: build/no")
  t.equal(file_bytes "build/a.mp4", "old")
  os.remove "build/a.mp4"
  local left <close> = io.popen "ls -A build | grep '^\\.lua_.*mp4$'"
  t.equal(left:read "a", "")
end)

test("in Chromium a recorded run plays in 3-D", function(t)
  local three, missing = find_three()
  if not three then t.skip(missing) end
  local film, world = recorded()
  world:remove(world.objects[1])
  world:run(0.1)
  local path = test.path()
  film:save(path .. ".html", {title = "<script>a box</script>", speed = 0.5})
  local html = file_bytes(path .. ".html")
  t.ok(not html:find("<script>a box", 1, true))
  local data = clench.json.decode(html:match '<script type="application/json" id="data">(.-)</script>')
  t.equal(#data.parts, 2)
  t.equal(#data.times, 9)
  clench.files.save_text(path .. ".html", (html:gsub("</body>", function() return [==[<script>
    const tell = document.documentElement.dataset;
    if (plays) toggle();
    tell.speed = speed.value;
    slider.value = 0.15;
    slider.dispatchEvent(new Event("input"));
    tell.height = parts[0].position.z.toFixed(4);
    showAt(0.4);
    tell.gone = String(parts[0].visible);
    tell.left = String(parts[1].visible);
  </script></body>]==] end)))
  local found = io.popen "command -v chromium"
  local chromium = found:read "l"
  found:close()
  if not chromium then t.skip "chromium is not installed" end
  local dom = io.popen(("timeout 300 chromium --headless --no-sandbox --disable-gpu-sandbox --use-gl=angle --use-angle=swiftshader "
    .. "--enable-unsafe-swiftshader --user-data-dir=%s --virtual-time-budget=3000 --dump-dom file://%s.html 2>/dev/null"):format(path, path))
  local text = dom:read "a"
  dom:close()
  local height
  film:each(function(w, _, time) if math.abs(time - 0.15) < 1e-9 then height = w.objects[1].pose.position.z end end)
  t.close(tonumber(text:match ' data%-height="([^"]*)"'), height, 1e-3)
  t.equal(text:match ' data%-speed="([^"]*)"', "0.5")
  t.equal(text:match ' data%-gone="([^"]*)"', "false")
  t.equal(text:match ' data%-left="([^"]*)"', "true")
  t.ok(tonumber(text:match ' data%-drawn="(%d+)"') > 20)
end)

test("a run whose first observer restores another time has the requested duration", function(t)
  local world = clench.world()
  local start = world:snapshot()
  world:run(0.5)
  local restored
  world:log {quantities = {height = function(w)
    if not restored then
      restored = true
      w:restore(start)
    end
    return 0
  end}}
  world:run(0.1)
  t.close(world.time, 0.1, 1e-12)
end)
