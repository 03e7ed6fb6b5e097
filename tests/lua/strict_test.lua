local test = require "test"
local folder = test.folder()

local function write(name, text)
  local path = folder .. "/" .. name
  clench.files.save_text(path, text)
  return path
end

test("with `strict` every reader rejects data that otherwise cause a warning", function(t)
  local body = write("body.xml", "<root>\n<mass>-300</mass></root>")
  local world = write("world.xml", "<world><graspableBody><filename>" .. body .. "</filename></graspableBody></world>")
  local grasps = write("set.egr", "DIMENSIONS 1\nEG\n1\n1 2\n")
  local fault = ":2: mass: -300 is negative; 300 is used"
  local options, w = {strict = true}, clench.world()
  local level = clench.log.level "quiet"
  for _, read in ipairs {
    function(o) w:add_object(body, o) end,
    function(o) w:add_obstacle(body, o) end,
    function(o) clench.load(world, o) end,
    function(o) clench.convert(body, folder .. "/out.xml", o) end,
  } do
    t.fails(function() read(options) end, fault)
    read {strict = false}
    read {}
  end
  t.fails(function() clench.files.eigengrasps(grasps, options) end, "1 DOF is declared, and numbers of 2 are given; 2 are used")
  t.equal(#clench.files.eigengrasps(grasps).vectors[1], 2)
  clench.log.level(level)
  t.fails(function() w:add_object(body, {strict = 1}) end, "strict")
end)

test("a Lua world that loads itself is reported with the line that does, for any path to it", function(t)
  local path, by_link = folder .. "/itself.lua", folder .. "/by_link.lua"
  assert(os.execute(("ln -s %s %s"):format(path, by_link)))
  clench.files.save_text(path, ("local clench = require 'clench'\nreturn clench.load %q"):format(by_link))
  t.fails(function() clench.load(path) end, "itself.lua:2: ")
  t.fails(function() clench.load(path) end, "it loads itself")
end)
