--- `clench plan`: grasps of a hand on an object, searched for, verified, listed and shown.
local columns = require "clench.host.columns"
local error_text = require "clench.host.error_text"
local in_utf8 = require "clench.in_utf8"
local printable = require "clench.printable"
local plan_files = require "clench.host.plan_files"
local reading = require "clench.host.reading"
local report_rows = require "clench.plan.report_rows"

local plan = {}
local job = {}  -- what `search` leaves for `finish`

local function shown(text) return printable(in_utf8(text), "\n") end

local function fail(text) error({usage = text}, 0) end

-- "X,Y,Z" [m] or "X,Y,Z,ROLL,PITCH,YAW" [m and degrees]
local function pose_of(option, text)
  local numbers, count = {}, 0
  for word in (text .. ","):gmatch "([^,]*)," do
    count = count + 1
    numbers[count] = word:match "^%s*[-+.%d][-+.%deE]*%s*$" and tonumber(word)
  end
  if count ~= #numbers or count ~= 3 and count ~= 6 then
    fail(("%s: expected X,Y,Z in metres, or X,Y,Z,ROLL,PITCH,YAW with degrees, got '%s'"):format(option, text))
  end
  local pose = {xyz = {numbers[1], numbers[2], numbers[3]}}
  if count == 6 then pose.rpy = {clench.rad(numbers[4]), clench.rad(numbers[5]), clench.rad(numbers[6])} end
  return pose
end

-- words of the command line: name, value, name, value ...; some names come several times
local function read_words(...)
  local given = {obstacle = {}, ["obstacle-pose"] = {}}
  local words = {...}
  for i = 1, #words, 2 do
    local name, value = words[i], words[i + 1]
    if type(given[name]) == "table" then table.insert(given[name], value) else given[name] = value end
  end
  if #given["obstacle-pose"] > #given.obstacle then
    fail(("--obstacle-pose is given %d times, and --obstacle %d times"):format(#given["obstacle-pose"], #given.obstacle))
  end
  return given
end

local function load_world(given, said)
  local world = clench.world()
  local function body(option, pose)
    local options = reading("body", said)
    options.pose = pose and pose_of(option, pose) or nil
    return options
  end
  local of_robot = reading("robot", said)
  of_robot.unit = nil  -- robots' files have units of their own
  local hand = world:add_robot(given.hand, of_robot)
  local options = body("--pose", given.pose)
  options.mass = tonumber(given.mass)
  local object = world:add_object(given.object, options)
  for i, path in ipairs(given.obstacle) do
    world:add_obstacle(path, body("--obstacle-pose", given["obstacle-pose"][i]))
  end
  if not object.mesh then fail(("%s: an object without a surface cannot be grasped"):format(given.object)) end
  return world, hand, object
end

local function check_words(given)
  if given.verify and given["no-verify"] then fail "expected --verify or --no-verify, got both" end
  if given["force-ratio"] and given["no-verify"] then fail "--force-ratio says how hard grasps may press to be verified, and --no-verify asks for none" end
  if given["max-effort"] and given["no-verify"] then fail "--max-effort limits motors in load margins, and --no-verify asks for none" end
  if given["keep-lost"] and not given.verify then fail "--keep-lost says what becomes of grasps that --verify loses, and there is no --verify" end
end

local function search(root, folder, package, unit, strict, ...)
  local given = read_words(...)
  check_words(given)
  job.given = given
  job.files = plan_files.open(given)
  job.world, job.hand, job.object = load_world(given, {root = root, folder = folder, package = package, unit = unit, strict = strict ~= ""})
  job.count = math.tointeger(tonumber(given.count)) or not given.seconds and 20 or nil
  job.run = clench.plan.sample {
    hand = job.hand, object = job.object, count = job.count or 1000000, seconds = tonumber(given.seconds),
    seed = math.tointeger(tonumber(given.seed)), threads = math.tointeger(tonumber(given.threads)) or clench.parallel.cores,
    contacts = given.contacts, max_effort = tonumber(given["max-effort"]),
    verify = given["no-verify"] == nil and {shake = given.verify ~= nil, keep_lost = given["keep-lost"] ~= nil,
                                               force_ratio = tonumber(given["force-ratio"])},
    on_grasp = function(grasp) job.files:add(grasp) end,
  }
end

local function tell(problem)
  io.stdout:flush()
  io.stderr:write("clench plan: ", shown(problem), "\n")
end

local function sentence(problem)
  if type(problem) == "table" and problem.usage then return problem.usage, 2 end
  return error_text(problem), 1
end

--- Loads and searches.
---@param root string  this and the next four: what is said of reading, "" when nothing is
---@return string  the exit code, or how it ended: "finish", or "interrupted" by Ctrl-C
function plan.search(...)
  local ok, problem = pcall(search, ...)
  if ok then return job.run.report.stopped and "interrupted" or "finish" end
  if type(problem) == "table" and problem.kind == "stopped" then return "130" end
  local text, code = sentence(problem)
  tell(text)
  return tostring(code)
end

local shown = 20  -- rows of the table that is printed

local function print_table(rows)
  local shaken = rows[1].held ~= nil
  local list = {{"#", "epsilon", "load", "perturbed", "contacts", "azimuth", "elevation", shaken and "shaken" or nil}}
  for i = 1, math.min(#rows, shown) do
    local row = rows[i]
    list[#list + 1] = {tostring(row.number), ("%.4f"):format(row.epsilon), row.load and ("%.1f"):format(row.load) or "-",
                       row.perturbed and ("%.4f"):format(row.perturbed) or "-", tostring(row.contacts),
                       tostring(row.azimuth), tostring(row.elevation), shaken and (row.held == 6 and "held" or ("lost %d"):format(6 - row.held)) or nil}
  end
  columns(list, "")
  if #rows > shown then print(("and %d more"):format(#rows - shown)) end
  print "load: times the object's weight, in the worst direction; perturbed: least epsilon with the object displaced by 1 mm;"
  print "azimuth, elevation: where the hand comes from [degrees]"
  if shaken then print "shaken: lost along so many of six directions, when pulled by its weight in simulation" end
end

local function finish(how)
  local run = job.run
  local grasps = run.grasps
  job.files:save(grasps)
  local title = ("%s grasps %s"):format(job.hand.name, job.object.name)
  print(shown(title) .. (how == "finish" and "" or ": " .. how))
  if #grasps > 0 then print_table(report_rows(job.hand, job.object, grasps)) end
  local words = tostring(run.report)
  print(shown(words))
  local subtitle = ("%s, %s, seed %s"):format(job.given.hand, job.given.object, job.given.seed or "1")
  job.files:show(job.hand, job.object, grasps, {title = title, subtitle = subtitle, report = words})
  return #grasps
end

--- Writes the files, prints the table and what was done.
---@param how "finish"|"interrupted"
---@return string  the exit code
function plan.finish(how)
  local ok, result = pcall(finish, how)
  if not ok then tell((sentence(result))) end
  if how == "interrupted" then return "130" end
  return ok and how == "finish" and result > 0 and "0" or "1"
end

return plan
