--- The content of a file as tables, which `clench check` prints or writes as JSON.
local blamed = require "clench.blamed"
local collected_log = require "clench.collected_log"
local drives = require "clench.drives"
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local reading = require "clench.reading"
local read_options = require "clench.options"
local report = {}

-- the options without those that the command line leaves empty
local function checked(given)
  local options = given
  if type(given) == "table" then
    options = {}
    for key, value in pairs(given) do options[key] = value ~= "" and value or nil end
  end
  local read = read_options("clench.report.of", options)
  for _, option in ipairs(read.fields) do options[option.name] = read:checked(option.name) end
  read:done()
  return options
end

local function numbers(v) return {v.x, v.y, v.z} end

local function file_name(path) return path:match "[^/]*$" end

local function names(list)
  local out = {}
  for i, item in ipairs(list) do out[i] = item.name end
  return out
end

-- Ctrl-C is not an error of the file
local function pass_stop(ok, problem)
  if not ok and is_stopped(problem) then error(problem, 0) end
end

-- messages logged while a file is read, by their subject; messages of scripts by their level
local function listen(run)
  local collect, diagnostics = collected_log()
  local heard = {inferred = {}, ignored = {}, repaired = {}, suspicious = {}, diagnostics = diagnostics}
  clench.log.sink(function(level, text, about, diagnostic)
    collect(level, text, about, diagnostic)
    local list = heard[about] or level == "info" and heard.inferred or level == "warning" and heard.ignored
    if list then list[#list + 1] = text end
  end)
  local ok, result = pcall(run)
  clench.log.sink()
  pass_stop(ok, result)
  return heard, ok, result
end

local function of_mesh(mesh)
  if not mesh then return nil end
  local size = mesh.bounds.high - mesh.bounds.low
  return {triangles = mesh.triangle_count, size = numbers(size), watertight = mesh:is_watertight(),
          volume = mesh:is_watertight() and mesh.volume or nil, area = mesh.area, faults = mesh.faults}
end

local function of_body(body)
  return {name = body.name, material = body.material, mass = body.mass, center_of_mass = numbers(body.com),
          inertia = body.inertia, elastic_modulus = body.elastic_modulus, mesh = of_mesh(body.mesh), tracker = body.tracker}
end

-- counts of boxes, spheres, cylinders and cones that a planner would find; nil if there are none
local function of_primitives(path, options)
  local counts = {}
  if not path:lower():find "%.iv$" then return nil end
  local before = clench.log.level "quiet"  -- most nodes are not primitives: no messages
  local ok, list = pcall(clench.files.primitives, path, {root = options.root, confine = options.confine})
  clench.log.level(before)
  pass_stop(ok, list)
  for _, p in ipairs(ok and list or {}) do counts[p.kind] = (counts[p.kind] or 0) + 1 end
  return next(counts) and counts
end

local function of_dofs(robot)
  local dofs, ranges = {}, robot.effort_ranges
  local function if_limited(effort) return math.abs(effort) < math.huge and effort or nil end
  for i, info in ipairs(robot.dof_info) do
    local low, high = table.unpack(robot.dof_limits[i])
    dofs[i] = {name = info.name, kind = info.kind, low = low, high = high, value = robot.dofs[i], endless = info.endless or nil,
               closing = info.default_velocity, max_effort = info.max_effort, driven = info.driven,
               effort_low = if_limited(ranges[i][1]), effort_high = if_limited(ranges[i][2])}
  end
  return dofs
end

-- a DOF moves in meters if its joints are prismatic
local function units_of(robot)
  local units = {}
  for _, chain in ipairs(robot.chains) do
    for _, joint in ipairs(chain.joints) do
      units[joint.dof] = units[joint.dof] or (joint.kind == "prismatic" and "m" or "rad")
    end
  end
  return units
end

local function of_chains(robot)
  local chains = {}
  for c, chain in ipairs(robot.chains) do
    local joints, links = {}, {}
    for j, joint in ipairs(chain.joints) do
      joints[j] = {name = joint.name, kind = joint.kind, dof = joint.dof, ratio = joint.ratio, low = joint.min,
                   high = joint.max}
    end
    for l, link in ipairs(chain.links) do links[l] = of_body(link) end
    chains[c] = {parent = chain.parent.name, joints = joints, links = links}
  end
  return chains
end

-- elements of its file that are kept without effect; nil if there are none
local function of_kept(robot)
  local kept = {
    tendons = #robot.tendons > 0 and names(robot.tendons) or nil,
    tendon_wrappers = #robot.tendon_wrappers > 0 and #robot.tendon_wrappers or nil,
    tactile_sensors = #robot.tactile_sensors > 0 and #robot.tactile_sensors or nil,
    glove = robot.glove and {dofs = #robot.glove.slopes, sensors = #robot.glove.slopes[1]},
    tracker = robot.tracker and robot.tracker.number,
  }
  return next(kept) and kept
end

-- DOFs that close the robot, or all if actuators drive none, and that no motor closes, in a sentence; nil: there are none
local function of_closing(robot)
  local closes = #robot.actuators > 0
  for _, info in ipairs(robot.dof_info) do closes = closes or info.default_velocity ~= 0 end
  return closes and drives.missing(robot) or nil
end

local function of_robot(robot)
  local dofs, units = of_dofs(robot), units_of(robot)
  for i, dof in ipairs(dofs) do dof.unit = units[i] or "rad" end
  local approach = robot.pose:inverse() * robot.approach.frame
  return {name = robot.name, base = of_body(robot.base), dofs = dofs, chains = of_chains(robot),
          approach = {point = numbers(approach.position), direction = numbers(approach:rotate {0, 0, 1})},  -- in the base
          eigengrasps = #robot.eigengrasps, virtual_contacts = #robot.virtual_contacts,
          actuators = #robot.actuators, kept = of_kept(robot), not_closed = of_closing(robot)}
end

-- logs the sets for grasping that were generated instead of read from a file; nothing for a robot that never closes
local function report_generated(robot, subject)
  local closes = false
  for _, info in ipairs(robot.dof_info) do closes = closes or info.default_velocity ~= 0 end
  if not closes then return end
  if not robot.eigengrasps.is_custom then
    local counts = #robot.dofs == 1 and "its DOF counts" or ("each of its %d DOFs counts"):format(#robot.dofs)
    clench.log.info(("%s: no eigengrasps are given; %s as one"):format(subject, counts))
  end
  if not robot.has_own_virtual_contacts then
    local count = #robot.virtual_contacts
    clench.log.info(("%s: no virtual contacts are given; %s found on the sides of its links and palm that close"):format(subject,
      count == 0 and "none is" or count == 1 and "1 is" or count .. " are"))
  end
end

-- a crowded world has millions of colliding pairs: only the first ones are listed
local max_overlaps = 100
local function overlaps_of(world)
  local overlaps = {}
  for i, pair in ipairs(world:colliding(nil, nil, {max = max_overlaps + 1})) do
    if i > max_overlaps then return overlaps, true end
    overlaps[i] = {pair[1].name, pair[2].name}
  end
  return overlaps
end

local function of_world(world, path)
  for _, robot in ipairs(world.robots) do report_generated(robot, ("%s: '%s'"):format(file_name(path), robot.name)) end
  local objects, obstacles, robots, keyframes = {}, {}, {}, {}
  for i, body in ipairs(world.objects) do objects[i] = of_body(body) end
  for i, body in ipairs(world.obstacles) do obstacles[i] = of_body(body) end
  for i, robot in ipairs(world.robots) do
    robots[i] = of_robot(robot)
    robots[i].parent = robot.parent and robot.parent.name
  end
  for i, name in ipairs(world.keyframes) do keyframes[i] = name end
  local overlaps, more = overlaps_of(world)
  return {objects = objects, obstacles = obstacles, robots = robots, overlaps = overlaps, more_overlaps = more,
          gravity = numbers(world.gravity), keyframes = keyframes}
end

-- an MJCF file describes one robot, or a scene: a world of several things
local function is_mjcf(path)
  local file = io.open(path, "rb")
  local head = file and file:read(65536) or ""
  if file then file:close() end
  return head:find "<mujoco" ~= nil
end

-- nil if the file describes only one robot
local function of_scene(path, options)
  local world = clench.load(path, reading("robot", options))  -- its meshes may also be in other folders
  if #world.robots == 1 and #world.objects == 0 and #world.obstacles == 0 then return nil end
  local parsed = of_world(world, path)
  parsed.is_scene = true
  return parsed
end

-- ranges of numbers by name, for the first names; further names are counted
local max_ranges = 100
local function new_ranges() return {by_name = {}, order = {}, others = {}, more = 0} end

local function widen(ranges, name, value)
  local range = ranges.by_name[name]
  if range then
    range.low, range.high, range.count = math.min(range.low, value), math.max(range.high, value), range.count + 1
  elseif #ranges.order < max_ranges then
    ranges.by_name[name] = {low = value, high = value, count = 1}
    table.insert(ranges.order, name)
  elseif not ranges.others[name] then
    ranges.others[name] = true
    ranges.more = ranges.more + 1
  end
end

local function sorted_names(set)
  local out = {}
  for name in pairs(set) do out[#out + 1] = name end
  table.sort(out)
  return out
end

-- ranges of numbers of all grasps, by name
local function of_grasps(list, format)
  local pairs_of, labels, dofs, measures, notes = {}, {}, new_ranges(), new_ranges(), new_ranges()
  local counts = {unnamed_dofs = 0, without_pose = 0, with_contacts = 0, with_pregrasp = 0, collision_free = 0, in_collision = 0}
  local function count(key, is) if is then counts[key] = counts[key] + 1 end end
  local unnamed = 0  -- DOFs that are not listed
  local best_epsilon  -- kept separately: only the first measures are listed
  for _, grasp in ipairs(list) do
    local hand, object = grasp.hand_name, grasp.object_name
    if hand ~= "" or object ~= "" then
      pairs_of[(hand == "" and "a hand without name" or hand) .. " on " .. (object == "" and "an object without name" or object)] = true
    end
    local names, values = grasp.dof_names, grasp.dofs
    count("unnamed_dofs", #names == 0 and #values > 0)
    if #names == 0 then
      for i = 1, math.min(#values, max_ranges) do widen(dofs, ("DOF %d"):format(i), values[i]) end
      unnamed = math.max(unnamed, #values - max_ranges)
    else
      for i, value in ipairs(values) do widen(dofs, names[i], value) end
    end
    for name, value in pairs(grasp.measures) do widen(measures, name, value) end
    local epsilon = grasp.measures.epsilon
    if epsilon then best_epsilon = math.max(best_epsilon or epsilon, epsilon) end
    for name, value in pairs(grasp.info) do widen(notes, name, value) end
    for name in pairs(grasp.labels) do labels[name] = true end
    count("without_pose", not grasp.pose)
    count("with_contacts", #grasp.points > 0)
    count("with_pregrasp", grasp.pregrasp)
    count("collision_free", grasp.collision_free == true)
    count("in_collision", grasp.collision_free == false)
  end
  local listed = {}
  for i, name in ipairs(dofs.order) do
    local range = dofs.by_name[name]
    listed[i] = {name = name, low = range.low, high = range.high, count = range.count}
  end
  return {format = format, count = #list, of = sorted_names(pairs_of), dofs = listed, measures = measures.by_name, notes = notes.by_name,
          more = {dofs = dofs.more + unnamed, measures = measures.more, notes = notes.more}, labels = sorted_names(labels), counts = counts,
          best_epsilon = best_epsilon}
end

local readers = {
  body = function(path, options)
    local body = of_body(clench.world():add_object(path, options))
    body.primitives = of_primitives(path, options)
    return body
  end,
  robot = function(path, options)
    local robot = clench.world():add_robot(path, options)
    report_generated(robot, file_name(path))
    return of_robot(robot)
  end,
  world = function(path, options) return of_world(clench.load(path, options), path) end,
  eigengrasps = function(path, options)
    local set = clench.files.eigengrasps(path, options)
    return {dofs = #set.origin, count = #set.vectors}
  end,
  ["virtual contacts"] = function(path, options)
    local list = clench.files.virtual_contacts(path, options)
    return {count = #list, robot = list.robot}
  end,
  ["object contacts"] = function(path, options)
    local list = clench.files.object_contacts(path, options)
    return {count = #list, placed = not list[1] or list[1].placed}
  end,
  ["pre-grasps"] = function(path, options) return {count = #clench.files.pregrasps(path, options)} end,
  ["planned grasps"] = function(path, options)
    local list, best = clench.grasps(path, {format = "graspit", root = options.root, confine = options.confine}), nil
    for _, grasp in ipairs(list) do best = math.max(best or grasp.measures.quality, grasp.measures.quality) end
    return {count = #list, runs = list[1] and list[#list].info.run or 0, best = best}
  end,
  grasps = function(path, options)
    return of_grasps(clench.grasps(path, {root = options.root, confine = options.confine}))
  end,
  ["glove calibration"] = function(path, options)
    local glove = clench.files.glove_calibration(path, options)
    return {dofs = #glove.slopes, sensors = #glove.slopes[1]}
  end,
  ["glove poses"] = function(path, options)
    local list, sensors, joints = clench.files.glove_poses(path, options), 0, 0
    for _, pose in ipairs(list) do
      sensors = math.max(sensors, pose.sensors and #pose.sensors or 0)
      joints = math.max(joints, pose.joints and #pose.joints or 0)
    end
    return {count = #list, sensors = sensors, joints = joints}
  end,
}

--- Parses one file and returns the content of the report of `clench check`. Available by require "clench.report" or as clench.report. `parsed` is a table of
--- the content, which depends on the kind of file, in meters, kilograms and radians; if it is absent, `error` states the reason. With `strict`, `error` is the
--- first sentence about repaired, ignored or suspicious content, if there is any. `diagnostics` contains all messages as values, like `clench.log.collect`.
---@param path string  file to check
---@param options? table  how the file is read; options that do not apply to the kind of file are ignored
---@like clench.load  root, confine, folder, package, unit, strict
---@return {file: string, kind: string?, parsed: table?, inferred: string[], repaired: string[], ignored: string[], suspicious: string[], diagnostics: table[], error: string?}
---@effect long, files
--- > r = clench.report.of "models/hands/barrett/barrett.cfg"
--- > r.kind, #r.parsed.dofs, r.parsed.dofs[2].unit  --> robot, 4, rad
--- > clench.report.of("no/such.urdf").error  --> no such file: no/such.urdf
function report.of(path, options)
  local kind
  options = checked(options or {})
  local heard, ok, result = listen(function()
    kind = clench.file_kind(path, {confine = options.confine})
    if kind == "robot" and is_mjcf(path) then return of_scene(path, options) end
    return readers[kind](path, reading(kind, options))
  end)
  if ok and not result then  -- one robot alone
    heard, ok, result = listen(function() return readers.robot(path, reading("robot", options)) end)
  elseif ok and result.robots then
    kind = "world"
  end
  -- a world in Lua reports faults of the files that it loads
  local fault = ok and options.strict and (heard.repaired[1] or heard.ignored[1] or heard.suspicious[1])
  if fault then ok, result = false, fault end
  return {file = path, kind = kind, parsed = ok and result or nil, inferred = heard.inferred, repaired = heard.repaired,
          ignored = heard.ignored, suspicious = heard.suspicious, diagnostics = heard.diagnostics,
          error = not ok and (blamed(result) or error_text(result)) or nil}
end

return report
