--- `clench check`: reports on files, as text or as JSON.
local described = require "clench.described"
local name_list = require "clench.name_list"
local in_utf8 = require "clench.in_utf8"
local columns = require "clench.host.columns"
local printable = require "clench.printable"
local check = {}

-- prints a line that contains names from a file
local function say(text) print(printable(text)) end

-- a number with its unit, in the units of text output
local function quantity(x, unit)
  if x == nil then return "-" end
  if unit == "rad" then return ("%.1f deg"):format(clench.deg(x)) end
  if unit == "m" then return ("%.1f mm"):format(x * 1000) end
  return ("%s %s"):format(math.tointeger(x) and described(x) or ("%.4g"):format(x), unit)
end

-- three numbers; values below rounding relative to `scale`, by default the maximum, are 0
local function vector(v, format, scale)
  scale = scale or math.max(math.abs(v[1]), math.abs(v[2]), math.abs(v[3]))
  local parts = {}
  for i = 1, 3 do parts[i] = format:format(math.abs(v[i]) < 1e-9 * scale and 0 or v[i]) end
  return table.concat(parts, " ")
end

local function several(n, noun) return ("%d %s%s"):format(n, noun, n == 1 and "" or "s") end

local function size(mesh)
  return ("%.1f x %.1f x %.1f mm"):format(mesh.size[1] * 1000, mesh.size[2] * 1000, mesh.size[3] * 1000)
end

local function body_row(body)
  local mesh = body.mesh
  return {body.name, quantity(body.mass, "kg"), body.material, mesh and ("%d triangles"):format(mesh.triangles) or "a frame",
          mesh and size(mesh) or "", mesh and (mesh.watertight and "watertight" or mesh.faults) or ""}
end

-- "2 boxes, 1 cone"
local function counted(counts)
  local many = {box = "boxes", sphere = "spheres", cylinder = "cylinders", cone = "cones"}
  local list = {}
  for _, kind in ipairs {"box", "sphere", "cylinder", "cone"} do
    local count = counts[kind]
    if count then list[#list + 1] = ("%d %s"):format(count, count == 1 and kind or many[kind]) end
  end
  return table.concat(list, ", ")
end

-- elements of a robot's file that are kept without effect
local function kept_words(kept)
  local list = {}
  local function add(format, ...) list[#list + 1] = format:format(...) end
  if kept.tendons then add("%s (%s)", several(#kept.tendons, "tendon"), name_list(kept.tendons)) end
  if kept.tendon_wrappers then add("%s", several(kept.tendon_wrappers, "tendon wrapper")) end
  if kept.tactile_sensors then add("%s", several(kept.tactile_sensors, "tactile sensor")) end
  if kept.glove then add("a glove of %s for %s", several(kept.glove.sensors, "sensor"), several(kept.glove.dofs, "DOF")) end
  if kept.tracker then add("position sensor %d", kept.tracker) end
  return table.concat(list, ", ")
end

local print_kind = {}

function print_kind.body(body)
  columns({body_row(body)}, "  ")
  local mesh = body.mesh
  local length = mesh and math.max(table.unpack(mesh.size)) or 0
  say(("  center of mass %s m"):format(vector(body.center_of_mass, "%.4g", length)))
  local moment = math.max(body.inertia[1][1], body.inertia[2][2], body.inertia[3][3])
  for i = 1, 3 do
    say((i == 1 and "  inertia        " or "                 ") .. vector(body.inertia[i], "%10.3g", moment) .. " kg m^2")
  end
  if body.mesh and body.mesh.volume then say(("  volume         %.4g m^3, area %.4g m^2"):format(body.mesh.volume, body.mesh.area)) end
  if body.elastic_modulus then say(("  elastic        %.3g Pa"):format(body.elastic_modulus)) end
  if body.primitives then say("  for planners   " .. counted(body.primitives)) end
  if body.tracker then say(("  kept, without effect: position sensor %d"):format(body.tracker)) end
end

-- efforts of a DOF's motor
local function effort_words(dof)
  local unit, low, high = dof.unit == "m" and "N" or "N m", dof.effort_low, dof.effort_high
  if not dof.driven then return "no motor" end
  if not low and not high then return "no limit" end
  if low and high and low == -high then return quantity(high, unit) end
  return ("%s to %s"):format(low and quantity(low, unit) or "no limit", high and quantity(high, unit) or "no limit")
end

function print_kind.robot(robot)
  local links = {body_row(robot.base)}
  for _, chain in ipairs(robot.chains) do
    for _, link in ipairs(chain.links) do links[#links + 1] = body_row(link) end
  end
  say("  " .. table.concat({several(#robot.dofs, "DOF"), several(#robot.chains, "chain"), several(#links - 1, "link"),
    several(robot.eigengrasps, "eigengrasp"), several(robot.virtual_contacts, "virtual contact"),
    robot.actuators > 0 and several(robot.actuators, "actuator") or nil}, ", "))
  columns(links, "  ")
  local rows = {{"DOF", "name", "kind", "from", "to", "at", "closes", "effort"}}
  for i, dof in ipairs(robot.dofs) do
    local function limit(value) return dof.endless and "no limit" or quantity(value, dof.unit) end
    rows[#rows + 1] = {tostring(i), dof.name or "", dof.kind, limit(dof.low), limit(dof.high),
      quantity(dof.value, dof.unit), dof.closing > 0 and "up" or dof.closing < 0 and "down" or "not",
      effort_words(dof)}
  end
  columns(rows, "  ")
  rows = {{"chain", "from", "joint", "kind", "DOF", "ratio", "from", "to"}}
  for c, chain in ipairs(robot.chains) do
    for _, joint in ipairs(chain.joints) do
      local unit = joint.kind == "prismatic" and "m" or "rad"
      rows[#rows + 1] = {tostring(c), chain.parent, joint.name or "", joint.kind, tostring(joint.dof),
        ("%.6g"):format(joint.ratio), quantity(joint.low, unit), quantity(joint.high, unit)}
    end
  end
  columns(rows, "  ")
  say(("  approaches along %s, approach point %s m, in its base"):format(vector(robot.approach.direction, "%.3g"),
    vector(robot.approach.point, "%.3f")))
  if robot.not_closed then say("  does not close by force: " .. robot.not_closed) end
  if robot.kept then say("  kept, without effect: " .. kept_words(robot.kept)) end
end

function print_kind.world(world)
  local rows = {}
  for _, body in ipairs(world.objects) do rows[#rows + 1] = {"object", table.unpack(body_row(body))} end
  for _, body in ipairs(world.obstacles) do rows[#rows + 1] = {"obstacle", table.unpack(body_row(body))} end
  for _, robot in ipairs(world.robots) do
    rows[#rows + 1] = {"robot", robot.name, several(#robot.dofs, "DOF"),
                       robot.parent and "mounted on " .. robot.parent or "not mounted"}
  end
  columns(rows, "  ")
  if world.keyframes[1] then say("  keyframes " .. name_list(world.keyframes)) end
  for _, robot in ipairs(world.robots) do
    if world.is_scene then  -- other files do not describe their parts
      say(("  %s:"):format(robot.name))
      print_kind.robot(robot)
    elseif robot.kept then
      say(("  %s: kept, without effect: %s"):format(robot.name, kept_words(robot.kept)))
    end
  end
  for _, pair in ipairs(world.overlaps) do say(("  %s and %s overlap"):format(pair[1], pair[2])) end
  if world.more_overlaps then say "  more bodies overlap" end
end

function print_kind.eigengrasps(set) say(("  %d of %d DOFs"):format(set.count, set.dofs)) end

print_kind["virtual contacts"] = function(set) say(("  %d of %s"):format(set.count, set.robot)) end

print_kind["object contacts"] = function(list)
  say(("  %d%s"):format(list.count, list.placed and "" or ", without their points"))
end

print_kind["pre-grasps"] = function(list) say(("  %d"):format(list.count)) end

print_kind["planned grasps"] = function(list)
  say(("  %d in %s%s"):format(list.count, several(list.runs, "run"), list.best and (", the best of quality %.4g"):format(list.best) or ""))
end

local function range_rows(ranges)
  local rows, names = {}, {}
  for name in pairs(ranges) do names[#names + 1] = name end
  table.sort(names)
  for _, name in ipairs(names) do
    local r = ranges[name]
    rows[#rows + 1] = {name, ("%.4g"):format(r.low), ("%.4g"):format(r.high), tostring(r.count)}
  end
  return rows
end

local function print_ranges(heading, rows, more)
  if #rows == 0 then return end
  table.insert(rows, 1, {heading, "from", "to", "grasps"})
  columns(rows, "  ")
  if more > 0 then say(("  and %d more"):format(more)) end
end

print_kind.grasps = function(list)
  say(("  %s, format %s%s%s"):format(several(list.count, "grasp"), list.format, list.of[1] and ": " .. name_list(list.of) or "",
                            list.best_epsilon and ("; the largest epsilon %.4g"):format(list.best_epsilon) or ""))
  local rows = {}
  for i, dof in ipairs(list.dofs) do rows[i] = {dof.name, ("%.4g"):format(dof.low), ("%.4g"):format(dof.high), tostring(dof.count)} end
  print_ranges("DOF [rad or m]", rows, list.more.dofs)
  print_ranges("measure", range_rows(list.measures), list.more.measures)
  print_ranges("note", range_rows(list.notes), list.more.notes)
  if list.labels[1] then say("  labels " .. name_list(list.labels)) end
  local counts = list.counts
  for _, one in ipairs {{"with_contacts", "with contacts"}, {"with_pregrasp", "with a pregrasp"}, {"collision_free", "free of collisions"},
                        {"in_collision", "in collision"}, {"without_pose", "without a pose"}} do
    if counts[one[1]] > 0 then say(("  %d %s"):format(counts[one[1]], one[2])) end
  end
  if counts.unnamed_dofs > 0 then
    say(("  %d without names of DOFs: in the order of the hand, or of the option dof_order"):format(counts.unnamed_dofs))
  end
end

print_kind["glove calibration"] = function(glove) say(("  %d sensors for %d DOFs"):format(glove.sensors, glove.dofs)) end

print_kind["glove poses"] = function(list)
  say(("  %d, of up to %d sensors and %d joints"):format(list.count, list.sensors, list.joints))
end

local nouns = {body = "a body", robot = "a robot", world = "a world", ["glove calibration"] = "a glove calibration"}

local function print_report(r)
  local noun = nouns[r.kind] or r.kind
  say(("%s: %s"):format(r.file, r.parsed and noun or noun and ("not %s that can be read"):format(noun) or "not read"))
  if r.parsed then print_kind[r.kind](r.parsed) end
  for _, list in ipairs {"inferred", "repaired", "ignored", "suspicious"} do
    for _, sentence in ipairs(r[list]) do say(("  %s: %s"):format(list, sentence)) end
  end
  if r.error then print("  error: " .. printable(r.error, "\n")) end
end

--- Prints the report of each file.
---@param root string  this and the next four: options of readers, "" if not given
---@param form "text"|"json"
---@return integer  the exit code: 1 if a file could not be read
function check.main(root, folder, package, unit, strict, form, ...)
  local options = {root = root, folder = folder, package = package, unit = unit, strict = strict ~= ""}
  local all, code, session = {}, 0, clench.session()
  for i, path in ipairs {...} do
    all[i] = session:run("file.check", {path = path, options = options})
    if all[i].error then code = 1 end
    if form == "text" then print_report(all[i]) end
  end
  if form == "json" then print(clench.json.encode(in_utf8(all))) end
  return code
end

return check
