--- `clench render`: draws a file, or grasps of a list, as a picture.
local assumptions = require "clench.plan.assumptions"
local error_text = require "clench.error_text"
local fail = require "clench.host.usage"
local in_utf8 = require "clench.in_utf8"
local is_stopped = require "clench.is_stopped"
local picture_words = require "clench.host.picture_words"
local printable = require "clench.printable"
local reading = require "clench.reading"
local report_rows = require "clench.plan.report_rows"
local scene = require "clench.host.scene"
local sheet = require "clench.plan.sheet"
local render = {}

local on_sheet = 24  -- maximum number of grasps, unless --pick chooses
local alone = {size = {1280, 960}, quality = "paper", background = "studio"}
local several = {size = {320, 240}, quality = "draft", background = "white"}

local function check_output(path)
  if not path:lower():match "%.png$" then fail("-o: expected a file .png, got '%s'", path) end
  local ok, problem = pcall(clench.files.check_writable, path)
  if not ok then error(("-o: %s"):format(problem.sentence or problem), 0) end
end

-- numbers of the grasps to be drawn
local function picked(text, count)
  local numbers = {}
  if not text then
    for i = 1, math.min(count, on_sheet) do numbers[i] = i end
    return numbers
  end
  for word in (text .. ","):gmatch "([^,]*)," do
    local number = word:match "^%s*%d+%s*$" and math.tointeger(tonumber(word))
    if not number then fail("--pick: expected numbers of grasps, as in 1,4,7, got '%s'", text) end
    if number < 1 or number > count then fail("--pick: expected numbers from 1 to %d, got %d", count, number) end
    numbers[#numbers + 1] = number
  end
  return numbers
end

local only_of_lists = {"pick", "hand", "object", "pose", "obstacle", "obstacle-pose"}

local function refuse_of_lists(given, kind)
  for _, name in ipairs(only_of_lists) do
    local value = given[name]
    if type(value) == "table" and #value > 0 or type(value) == "string" then
      fail("--%s applies to lists of grasps, but %s is a file of kind '%s'", name, given.file, kind)
    end
  end
end

-- a world with the content of the file
local function load_file(given, said, kind)
  if kind == "world" then return clench.load(given.file, reading("world", said)) end
  local world = clench.world()
  if kind == "robot" then
    local options = reading("robot", said)
    options.unit = nil
    world:add_robot(given.file, options)
  elseif kind == "body" then
    world:add_object(given.file, reading("body", said))
  else
    fail("%s: expected a world, a robot, a body or a list of grasps, got a file of kind '%s'", given.file, kind)
  end
  return world
end

local function draw_file(given, said, kind)
  refuse_of_lists(given, kind)
  local world = load_file(given, said, kind)
  local options = picture_words(given, alone, world)
  options.transparent_objects = #world.robots > 0
  return clench.render(world, options)
end

-- hand and object of all grasps of the list: from the files of the options, else from those that the list names
local function load_scene(given, said, list)
  for _, part in ipairs {"hand", "object"} do
    local file = list[1][part .. "_file"]
    if not given[part] and not file then fail("%s names no file of the %s: give it as --%s FILE", given.file, part, part) end
    given[part] = given[part] or file
  end
  return scene.load(given, said)
end

local function friction_note(grasps)
  local low, high = math.huge, 0
  for _, grasp in ipairs(grasps) do
    for _, point in ipairs(grasp.points) do low, high = math.min(low, point.mu), math.max(high, point.mu) end
  end
  if low > high then return nil end
  return low == high and ("friction %.3g at the contacts, as in the list"):format(low)
    or ("friction %.3g to %.3g at the contacts, as in the list"):format(low, high)
end

local function draw_list(given, said)
  local list = clench.grasps(given.file, reading("grasps", said))
  if #list == 0 then error(("%s: expected grasps, got an empty list"):format(given.file), 0) end
  local numbers = picked(given.pick, #list)
  local world, hand, object = load_scene(given, said, list)
  local options = picture_words(given, #numbers == 1 and alone or several, world)
  local grasps, pictures = {}, {}
  for i, number in ipairs(numbers) do grasps[i] = list[number] end
  local rows = report_rows(hand, object, grasps, function() pictures[#pictures + 1] = clench.render(world, options) end)
  if #numbers == 1 then return pictures[1] end
  for i, row in ipairs(rows) do row.number = numbers[i] end
  local notes = {("%s grasps %s"):format(hand.name, object.name)}
  notes[#notes + 1] = friction_note(grasps)
  notes[#notes + 1] = select(2, assumptions.mass(object, given))
  return sheet(rows, pictures, notes)
end

local function draw(root, folder, package, unit, strict, ...)
  local said = {root = root, folder = folder, package = package, unit = unit, strict = strict ~= ""}
  local given = scene.read_words({"obstacle", "obstacle-pose"}, ...)
  check_output(given.o)
  picture_words(given, alone, {camera = {}})  -- wrong options are reported before files are read
  local kind = clench.file_kind(given.file)
  local is_list = kind == "grasps" or kind == "planned grasps"
  local picture = is_list and draw_list(given, said) or not is_list and draw_file(given, said, kind)
  picture:save(given.o)
  print(printable(in_utf8(("%s: %d x %d pixels"):format(given.o, picture.width, picture.height))))
end

--- Draws the picture.
---@param root string  this and the next four: options of readers, "" if not given
---@return string  the exit code
function render.main(...)
  local ok, problem = pcall(draw, ...)
  if ok then return "0" end
  if is_stopped(problem) then error(problem, 0) end
  local usage = type(problem) == "table" and problem.usage
  io.stderr:write("clench render: ", printable(in_utf8(usage or error_text(problem)), "\n"), "\n")
  return usage and "2" or "1"
end

return render
