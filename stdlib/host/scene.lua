--- The scene of `clench plan` and `clench render`: a hand, an object and obstacles, from options of the command line.
local reading = require "clench.reading"
local fail = require "clench.host.usage"
local scene = {}

-- numbers separated by commas; {} if any part is not a number
function scene.numbers_of(text)
  local numbers, count = {}, 0
  for word in (text .. ","):gmatch "([^,]*)," do
    count = count + 1
    numbers[count] = word:match "^%s*[-+.%d][-+.%deE]*%s*$" and tonumber(word)
  end
  return count == #numbers and numbers or {}
end

-- "X,Y,Z" [m] or "X,Y,Z,ROLL,PITCH,YAW" [m and degrees]
function scene.pose_of(option, text)
  local numbers = scene.numbers_of(text)
  if #numbers ~= 3 and #numbers ~= 6 then
    fail("%s: expected X,Y,Z in meters, or X,Y,Z,ROLL,PITCH,YAW with degrees, got '%s'", option, text)
  end
  local pose = {xyz = {numbers[1], numbers[2], numbers[3]}}
  if #numbers == 6 then pose.rpy = {clench.rad(numbers[4]), clench.rad(numbers[5]), clench.rad(numbers[6])} end
  return pose
end

-- "1,-2,thumb": DOFs by number or name, with the direction in which each closes
local function closing_of(text)
  local close = {}
  for word in (text .. ","):gmatch "([^,]*)," do
    local sign, name = word:match "^%s*([-+]?)(.-)%s*$"
    if name == "" then fail("--close: expected DOFs by number or name, as in 1,-2,thumb, got '%s'", text) end
    close[math.tointeger(tonumber(name)) or name] = sign == "-" and -1 or 1
  end
  return close
end

-- "DX,DY,DZ[,X,Y,Z]"
local function approach_of(text)
  local x = scene.numbers_of(text)
  if #x ~= 3 and #x ~= 6 then fail("--approach: expected DX,DY,DZ, or DX,DY,DZ,X,Y,Z with a point in meters, got '%s'", text) end
  return {direction = {x[1], x[2], x[3]}, point = #x == 6 and {x[4], x[5], x[6]} or nil}
end

local function set_friction(session, mu)
  local done, object = {}, session.object.material
  for _, body in ipairs(session.hand.bodies) do
    if not done[body.material] then session:run("world.friction", {a = body.material, b = object, mu = mu}) end
    done[body.material] = true
  end
end

--- A session with the hand, the object and the obstacles that the options of the command line give in a new world.
---@param given table<string, string|string[]>  options by name
---@param said table  options of readers: root, folder, package, unit, strict
---@return world, robot, body, table session
function scene.load(given, said)
  local session = clench.session(clench.world())
  local function body(option, pose)
    local options = reading("body", said)
    options.pose = pose and scene.pose_of(option, pose) or nil
    return options
  end
  local of_robot = reading("robot", said)
  of_robot.unit = nil  -- files of robots define their own units
  of_robot.close = given.close and closing_of(given.close)
  of_robot.approach = given.approach and approach_of(given.approach)
  local hand = session:run("world.import_robot", {path = given.hand, options = of_robot})
  local options = body("--pose", given.pose)
  options.mass, options.material = tonumber(given.mass), given.material
  local object = session:run("world.import_object", {path = given.object, options = options})
  for i, path in ipairs(given.obstacle) do
    session:run("world.import_obstacle", {path = path, options = body("--obstacle-pose", given["obstacle-pose"][i])})
  end
  if given.friction then set_friction(session, tonumber(given.friction)) end
  if not object.mesh then fail("%s: an object without a surface cannot be grasped", given.object) end
  return session.world, hand, object, session
end

--- Converts words of the command line, name, value, name, value ..., to a table.
---@param several string[]  names that may occur several times, and become lists
---@return table
function scene.read_words(several, ...)
  local given, words = {}, {...}
  for _, name in ipairs(several) do given[name] = {} end
  for i = 1, #words, 2 do
    local name, value = words[i], words[i + 1]
    if type(given[name]) == "table" then table.insert(given[name], value) else given[name] = value end
  end
  if given["obstacle-pose"] and #given["obstacle-pose"] > #given.obstacle then
    fail("--obstacle-pose is given %d times, and --obstacle %d times", #given["obstacle-pose"], #given.obstacle)
  end
  return given
end

return scene
