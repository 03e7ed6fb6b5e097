--- The log of a session as a script of plain calls.
local described = require "clench.described"
local raise = require "clench.raise"
local script = {}

local function number(x)
  if x ~= x then return "0 / 0" end
  if x == math.huge or x == -math.huge then return x > 0 and "math.huge" or "-math.huge" end
  if math.type(x) == "integer" then return ("%d"):format(x) end
  if x == 0 then return 1 / x < 0 and "-0.0" or "0" end
  -- the shortest text that is read back bit-exactly
  for digits = 15, 16 do
    local text = ("%." .. digits .. "g"):format(x)
    if tonumber(text) == x then return text end
  end
  return ("%.17g"):format(x)
end

local max_depth = 100  -- of tables in tables

--- A value as a Lua expression.
---@param depth? integer  of the tables that contain it
function script.literal(value, depth)
  depth = depth or 0
  local kind = type(value)
  if kind == "number" then return number(value) end
  if kind == "string" then return ("%q"):format(value) end
  if kind == "boolean" or kind == "nil" then return tostring(value) end
  if clench.type(value) == "vec3" then return ("{%s, %s, %s}"):format(number(value.x), number(value.y), number(value.z)) end
  if clench.type(value) == "pose" then
    local q = value.quat
    return ("clench.pose {xyz = %s, quat = {%s, %s, %s, %s}}"):format(script.literal(value.position), number(q[1]), number(q[2]), number(q[3]), number(q[4]))
  end
  if kind ~= "table" then raise("session: " .. described(value) .. " cannot be logged as text") end
  if depth > max_depth then raise(("session: a table that is nested more than %d deep cannot be logged; does it contain itself?"):format(max_depth)) end
  local parts, keys = {}, {}
  for i, item in ipairs(value) do parts[i] = script.literal(item, depth + 1) end
  for key in pairs(value) do
    local is_in_list = math.type(key) == "integer" and key >= 1 and key <= #parts
    if not is_in_list then keys[#keys + 1] = key end
  end
  table.sort(keys, function(a, b) return tostring(a) < tostring(b) end)
  for _, key in ipairs(keys) do
    -- a name that is not a keyword of Lua needs no brackets
    local is_name = type(key) == "string" and key:match "^[%a_][%w_]*$" and load("local " .. key .. " = 1")
    parts[#parts + 1] = (is_name and key or "[" .. script.literal(key, depth + 1) .. "]") .. " = " .. script.literal(value[key], depth + 1)
  end
  return "{" .. table.concat(parts, ", ") .. "}"
end

--- The expression that finds a body, a robot or a link: `world:body "flask"`.
function script.name_of(thing)
  if clench.type(thing) == "robot" then return ("world:robot(%q)"):format(thing.name) end
  local robot = thing.robot
  if not robot then return ("world:body(%q)"):format(thing.name) end
  return robot.base == thing and ("world:robot(%q).base"):format(robot.name) or ("world:robot(%q):link(%q)"):format(robot.name, thing.name)
end

--- The loop that runs a number of steps.
function script.steps(count, step) return ("for _ = 1, %d do world:run(%s) end"):format(count, number(step)) end

local function same(a, b)
  for i = 1, math.max(#a, #b) do
    if a[i] ~= b[i] then return false end
  end
  return true
end

-- rows of joints that have left their DOFs
local function loose_joints(robot)
  local rows = {}
  for c, chain in ipairs(robot.chains) do
    for j, joint in ipairs(chain.joints) do
      if joint.broken_away then rows[#rows + 1] = {c, j, joint.value} end
    end
  end
  return rows
end

-- setting a pose, even the present one, stops what moves
local function has_stopped(body, old)
  local now, before = body.velocity, old.velocity
  return now.linear ~= before.linear or now.angular ~= before.angular
end

local function has_robot_stopped(robot, old)
  for i, link in ipairs(robot.bodies) do
    if has_stopped(link, old.bodies[i]) then return true end
  end
  return false
end

-- joints: joints that have left their DOFs are also listed
local function lines_of_robot(robot, old, joints, lines)
  local name = script.name_of(robot)
  if not robot.parent and (robot.pose ~= old.pose or has_robot_stopped(robot, old)) then lines[#lines + 1] = ("%s.pose = %s"):format(name, script.literal(robot.pose)) end
  local loose = joints and loose_joints(robot) or {}
  if #loose > 0 then
    lines[#lines + 1] = ("%s:set_dofs(%s, {joint_positions = %s})"):format(name, script.literal(robot.dofs), script.literal(loose))
  elseif joints or not same(robot.dofs, old.dofs) then
    lines[#lines + 1] = ("%s.dofs = %s"):format(name, script.literal(robot.dofs))
  end
end

local function lines_of_body(body, old, lines)
  local name = script.name_of(body)
  if not body.robot and (body.pose ~= old.pose or has_stopped(body, old)) then lines[#lines + 1] = ("%s.pose = %s"):format(name, script.literal(body.pose)) end
  if body.mass ~= old.mass then lines[#lines + 1] = ("%s.mass = %s"):format(name, script.literal(body.mass)) end
  if body.material ~= old.material then lines[#lines + 1] = ("%s.material = %s"):format(name, script.literal(body.material)) end
end

local function lines_of_change(world, old, joints)
  local lines = {}
  for _, robot in ipairs(world.robots) do lines_of_robot(robot, robot:in_world(old), joints, lines) end
  for _, body in ipairs(world.bodies) do lines_of_body(body, body:in_world(old), lines) end
  return table.concat(lines, "\n")
end

-- Do the lines reproduce the present world from the old one? They are executed on a copy, so that nothing is lost unnoticed.
local function leads(text, old, world)
  local copy = old:clone()
  local try = load("local clench, world = ... " .. text, "=script", "t")
  return pcall(try, clench, copy) and copy:hash() == world:hash()
end

--- Lines that reproduce the present world from the state before a command: poses, DOFs, joints, masses and materials that differ.
function script.of_change(session, before)
  local world = session.world
  if before.world ~= world or not world then raise "session: a command that opens another world needs a field script, which returns its lines of Lua" end
  local old = before.clone
  if #world.bodies ~= #old.bodies then raise "session: a command that adds or removes bodies needs a field script, which returns its lines of Lua" end
  for _, joints in ipairs {false, true} do
    local text = lines_of_change(world, old, joints)
    if leads(text, old, world) then return text end
  end
  raise "session: a command that changes more than poses, DOFs, masses and materials needs a field script, which returns its lines of Lua"
end

--- The commands in the history that were not undone, as a script; its local `world` is the open world.
function script.of(session)
  local lines = {'local clench = require "clench"', "local world"}
  for _, entry in ipairs(session.history.done) do
    if entry.lines ~= "" then lines[#lines + 1] = entry.lines end
  end
  return table.concat(lines, "\n")
end

return script
