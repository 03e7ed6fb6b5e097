--- Read-only methods of JSON-RPC: fields and queries of a world and of its bodies and robots, by address.
local arguments = require "clench.session.arguments"
local described = require "clench.described"
local failure = require "clench.control.rpc.failure"
local scene_key = require "clench.page.scene_key"
local values = require "clench.control.rpc.values"
local queries = {}

local function world_of(context) return context.session.world or failure.raise("failed", "no world is open") end

-- the body or robot with an address; nil for nil
local function find(context, address) return address ~= nil and arguments.find(context.session, address) or nil end

local function find_robot(context, address) return arguments.find_robot(context.session, address) end

local a = {name = "a", type = "body", optional = true, text = "address of a body or robot"}
local b = {name = "b", type = "body", optional = true, text = "address of another one"}
local robot = {name = "robot", type = "robot", optional = true, text = "address; the current hand by default"}
local link = {name = "link", type = "body", text = "address of a link"}

local function add(name, text, parameters, run) queries[#queries + 1] = {name = name, text = text, parameters = parameters, run = run} end

-- the body or robot with an address; the world for "" or nil
local function thing_of(context, address)
  if address == nil or address == "" then return world_of(context) end
  return find(context, address)
end

-- rejects a JSON object if a list is expected
local function check_list(name, value)
  if type(value) ~= "table" or #value == 0 and next(value) ~= nil then failure.raise("params", "%s: expected a list, got %s", name, described(value)) end
end

local function field_of(thing, field)
  local value = thing[field]  -- an error suggests similar names
  if type(value) == "function" then failure.raise("params", "%s.%s is a method, not a field", clench.type(thing), field) end
  return value
end

local max_fields = 1000  -- of one request

local function check_count(count)
  if count > max_fields then failure.raise("refused", "at most %d fields are read in one request, got %d", max_fields, count) end
end

local function check_names(fields)
  check_list("fields", fields)
  check_count(#fields)
  for i, field in ipairs(fields) do
    if type(field) ~= "string" then failure.raise("params", "fields[%d]: expected a string", i) end
  end
end

local function read_fields(context, of, fields)
  check_names(fields)
  local thing, out = thing_of(context, of), {}
  for _, field in ipairs(fields) do out[field] = field_of(thing, field) end
  return out
end

add("get", "Fields of the world, of a body or of a robot, by their names in scripts.",
    {{name = "of", type = "string", optional = true, text = "address; the world by default"}, {name = "fields", type = "table", text = "names"}},
    function(context, args) return read_fields(context, args.of, args.fields) end)

-- The JSON text of an item of `read`. known: texts by field, which are made once, since many items may request the same field
local function item_text(thing, fields, known)
  local parts, seen = {}, {}
  for _, field in ipairs(fields) do
    if known[field] == nil then
      local value = field_of(thing, field)
      known[field] = value ~= nil and ("%s:%s"):format(clench.json.encode(field), values.text(values.of(value)))
    end
    if known[field] and not seen[field] then parts[#parts + 1] = known[field] end
    seen[field] = true
  end
  table.sort(parts)
  return "{" .. table.concat(parts, ",") .. "}"
end

local max_read = 4 << 20  -- result of one request [bytes]

add("read", "Fields of several things in one call, at most 1000.", {{name = "items", type = "table", text = "a list of {of, fields}"}}, function(context, args)
  check_list("items", args.items)
  local out, count, size, known = {}, 0, 0, {}
  for i, item in ipairs(args.items) do
    if type(item) ~= "table" or type(item.fields) ~= "table" then failure.raise("params", "items[%d]: expected {of, fields}", i) end
    count = count + #item.fields
    check_count(math.max(count, i))
    check_names(item.fields)
    local thing, of = thing_of(context, item.of), item.of or ""
    known[of] = known[of] or {}
    out[i] = item_text(thing, item.fields, known[of])
    size = size + #out[i]
    if size > max_read then failure.raise("refused", "items[%d]: the result has more than %d bytes", i, max_read) end
  end
  return values.encoded("[" .. table.concat(out, ",") .. "]")
end)

local function velocity_of(body)
  local velocity = body.velocity
  return {linear = velocity.linear, angular = velocity.angular}
end

--- The state of a world: its time, and the state of everything that can move.
function queries.state(world)
  local bodies, robots = {}, {}
  for i, body in ipairs(world.objects) do bodies[i] = {body = body, pose = body.pose, velocity = velocity_of(body)} end
  for i, one in ipairs(world.robots) do
    robots[i] = {robot = one, pose = one.pose, dofs = one.dofs, dof_velocities = one.dof_velocities, dof_efforts = one.dof_efforts}
  end
  return {time = world.time, objects = bodies, robots = robots}
end

add("world.state", "Time, and poses, DOFs and velocities of objects and robots.", {}, function(context) return queries.state(world_of(context)) end)

--- The poses of all bodies, in their order: seven numbers each, x y z [m], then the quaternion w x y z.
function queries.poses(world)
  local out = {}
  for i, body in ipairs(world.bodies) do
    local pose = body.pose
    local p, q = pose.position, pose.quat
    out[i] = {p.x, p.y, p.z, q[1], q[2], q[3], q[4]}
  end
  return out
end

add("world.list", "Addresses of bodies and robots, and a text that is equal for worlds of the same bodies and shapes.", {}, function(context)
  local world = world_of(context)
  return {robots = world.robots, objects = world.objects, obstacles = world.obstacles, bodies = world.bodies, scene = scene_key(world)}
end)

-- two bodies or robots, either of which may be absent
local function pair_of(context, args)
  local a, b = find(context, args.a), find(context, args.b)
  if a == nil then return b end
  return a, b
end

--- Every contact once: by the first of the two bodies that list it.
function queries.contacts(world)
  local out, seen = {}, {}
  for _, body in ipairs(world.bodies) do
    for _, contact in ipairs(body.contacts) do
      if not seen[contact.body == body and contact.other.name or contact.body.name] then out[#out + 1] = contact end
    end
    seen[body.name] = true
  end
  return out
end

add("world.contacts", "Contacts between two bodies or robots, of one, or of all.", {a, b}, function(context, args)
  local world = world_of(context)
  if args.a == nil and args.b == nil then return queries.contacts(world) end
  return world:contacts(pair_of(context, args))
end)

add("world.colliding", "Pairs of bodies that collide.", {a, b}, function(context, args)
  return world_of(context):colliding(pair_of(context, args))
end)

add("world.distance", "Distance of two things [m], and the closest points.", {a, b}, function(context, args)
  local distance, on_a, on_b = world_of(context):distance(find(context, args.a), find(context, args.b))
  return {distance = distance, on_a = on_a, on_b = on_b}
end)

add("world.raycast", "First hit of a ray; null if there is none.",
    {{name = "origin", type = "vec3", unit = "m", text = "first point"}, {name = "direction", type = "vec3", text = "of any length"},
     {name = "reach", type = "number", optional = true, min = 0, unit = "m", text = "longest distance of a hit; by default unlimited"}},
    function(context, args) return world_of(context):raycast(args.origin, args.direction, args.reach) end)

add("world.energy", "Energy of all objects and robots [J].", {}, function(context) return world_of(context):energy() end)
add("world.momentum", "Momentum of all objects and robots.", {}, function(context) return world_of(context):momentum() end)
add("world.hash", "Equal for worlds in the same state.", {}, function(context) return world_of(context):hash() end)

add("world.average_contacts", "Resultant contact force on each of the given bodies in the last step, and its center.",
    {{name = "links", type = "table", text = "addresses"}}, function(context, args)
      local links = arguments.find_all(context.session, "links", args.links)
      for i, thing in ipairs(links) do links[i] = arguments.find_body(context.session, thing) end
      return world_of(context):average_contacts(links)
    end)

add("robot.jacobian", "Jacobian of a point of a link: rows of linear, then angular velocity.",
    {robot, link, {name = "point", type = "vec3", optional = true, unit = "m", text = "in the world"}}, function(context, args)
      return find_robot(context, args.robot):jacobian(find(context, args.link), args.point)
    end)

add("robot.mass_matrix", "Mass matrix of the DOFs.", {robot}, function(context, args) return find_robot(context, args.robot):mass_matrix() end)
add("robot.bias_forces", "Efforts that balance gravity, velocities and springs.", {robot},
    function(context, args) return find_robot(context, args.robot):bias_forces() end)
add("robot.ik", "DOFs that bring a link to a pose.",
    {robot, link, {name = "pose", type = "pose", text = "of the link in the world"}, {name = "options", type = "table", optional = true, text = "options of hand:ik"}},
    function(context, args) return find_robot(context, args.robot):ik(find(context, args.link), args.pose, args.options) end)

add("session.info", "Contents of the session: current hand and object, selection, path of the world.", {}, function(context)
  local session = context.session
  return {hand = session.hand, object = session.object, selection = session.selection, path = session.path, is_modified = session:is_modified(),
          commands_done = #session.history.done}
end)

add("session.script", "The commands done and not undone, as a script.", {}, function(context) return context.session:script() end)

return queries
