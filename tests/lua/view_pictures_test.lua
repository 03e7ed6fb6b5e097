-- Pictures of the viewer's panels, compared with those of tests/data/view where the OpenGL renderer is the one that drew them. With the environment
-- variable CLENCH_RENEW_PICTURES=1 the test writes them anew.
local test, clench = require "test", require "clench"
local layout = require "clench.view.layout"
local png = dofile "tests/lua/png.lua"

local folder, failures = "tests/data/view/", "build/"
local renews = os.getenv "CLENCH_RENEW_PICTURES" == "1"
local max_bytes = 300000  -- of all pictures

-- a view whose panels are some of all, one below the other in two columns
local function open(options)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = options.size, dark = options.dark}
  session:run "grasp.autograsp"
  if options.panels then
    view.picture_visible, view.sizes = false, {left = 230, right = 230, bottom = 120}
    view.panels = {}
    for _, panel in ipairs(layout.panels()) do
      for i, name in ipairs(options.panels) do
        if panel.name == name then view.panels[#view.panels + 1] = {name = name, draw = panel.draw, place = i % 2 == 1 and "left" or "right"} end
      end
    end
    assert(#view.panels == #options.panels)
  end
  view:home()
  view:select "mug"
  for _ = 1, 3 do view:frame() end
  return session, view
end

local tall = {600, 700}
local pictures = {
  {name = "world", size = {600, 660}, panels = {"World", "Inspector", "Grasp Quality", "Display", "Virtual Contacts", "EigenGrasps"}},
  {name = "forces", size = {600, 680}, panels = {"Forces", "Wrench Space", "Friction", "Author", "Tendons", "Gallery"}},
  {name = "runs", size = tall, panels = {"Sensors", "Jobs", "History", "Time Line", "Console", "Plots", "On-line Planner"}},
  {name = "dark", size = {360, 220}, dark = true, panels = {"World", "Display"}},
  {name = "anaglyph", size = {240, 180}, stereo = {kind = "anaglyph", eye_distance = 0.02}},
}

local function draw(options)
  local _, view = open(options)
  local picture = view:screenshot {stereo = options.stereo, panels = not options.stereo}
  local renderer = view.ui.renderer
  view:close()
  return picture, renderer
end

local function bytes_of(path)
  local file <close> = io.open(path, "rb")
  return file and file:read "a"
end

-- the pictures belong to one renderer
local function save_renderer()
  local _, view = open {size = {64, 48}}
  clench.files.save_text(folder .. "renderer.txt", view.ui.renderer .. "\n")
  view:close()
end
if renews then save_renderer() end

test("the reader of PNG files reads what pictures save, and what it writes", function(t)
  local picture = draw(pictures[#pictures])
  local path, again = test.path ".png", test.path ".png"
  picture:save(path)
  local read = png.read(path)
  t.equal({read.width, read.height}, {picture.width, picture.height})
  for y = 1, read.height, 7 do
    for x = 1, read.width do t.equal({table.unpack(read.rows[y], 3 * x - 2, 3 * x)}, {picture:pixel(x, y)}) end
  end
  png.write(again, read)
  t.equal(png.read(again).rows, read.rows)
  t.equal(select(2, png.difference(read, read)), 0)
end)

for _, options in ipairs(pictures) do
  test(("picture '%s' of the viewer is the recorded one"):format(options.name), function(t)
    local picture, renderer = draw(options)
    local path = folder .. options.name .. ".png"
    if renews then return picture:save(path) end
    local recorded = (bytes_of(folder .. "renderer.txt") or ""):match "^[^\n]*"
    if renderer ~= recorded then t.skip(("the pictures were drawn by %s, not by %s"):format(recorded, renderer)) end
    local now = test.path ".png"
    picture:save(now)
    if bytes_of(now) == bytes_of(path) then return end
    local one, other = png.read(path), png.read(now)
    t.equal({other.width, other.height}, {one.width, one.height})
    local difference, count = png.difference(one, other)
    if count == 0 then return end
    local to = failures .. "difference_" .. options.name .. ".png"
    png.write(to, difference)
    t.ok(false, ("%d pixels differ from %s: see %s; CLENCH_RENEW_PICTURES=1 renews the picture"):format(count, path, to))
  end)
end

test("a changed pixel is found, and its difference picture shows it", function(t)
  local path = test.path ".png"
  draw(pictures[#pictures]):save(path)
  local one, other = png.read(path), png.read(path)
  other.rows[20][3 * 30 - 1] = other.rows[20][3 * 30 - 1] ~ 1
  local difference, count = png.difference(one, other)
  t.equal({count, difference.rows[20][3 * 30 - 2], difference.rows[20][3 * 29 - 2]}, {1, 0, 255})
end)

test("the recorded pictures are small and show every panel", function(t)
  local sum, shown = 0, {}
  for _, options in ipairs(pictures) do
    sum = sum + #bytes_of(folder .. options.name .. ".png")
    for _, name in ipairs(options.panels or {}) do shown[name] = true end
  end
  t.ok(sum < max_bytes, sum)
  for _, panel in ipairs(layout.panels()) do t.ok(shown[panel.name], panel.name) end
end)

test("frames have equal pixels in all runs, with any number of threads that draw", function(t)
  local pipe <close> = io.popen "readlink /proc/$PPID/exe"
  local program = pipe:read "l"
  local script = test.path(".lua", [[
local clench = require "clench"
local session = clench.session()
session:open("worlds/barrett_mug.wld", {root = "."})
local view = clench.view.offscreen {session = session, size = {640, 480}}
for i = 1, 3 do
  view:orbit(20, 5)
  print(view:hash())
end
session:run "grasp.autograsp"
view.stereo = {kind = "side by side"}
view:frame()
print(view:hash())
]])
  local first
  for _, threads in ipairs {1, 2, 2, 4} do
    local run <close> = io.popen(("LP_NUM_THREADS=%d OMP_NUM_THREADS=%d '%s' -q run %s 2>&1"):format(threads, threads, program, script))
    local hashes = run:read "a"
    t.ok(hashes:find "^%x+\n%x+\n%x+\n%x+\n$", hashes)
    first = first or hashes
    t.equal(hashes, first)
  end
end)
