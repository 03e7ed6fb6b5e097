--- What a file was understood to be, as tables: what `clench check` prints, or writes as JSON.
local reading = require "clench.host.reading"
local report = {}

local function numbers(v) return {v.x, v.y, v.z} end

-- what is logged while a file is read: guessed at the level of information, ignored at that of warnings
local function listen(run)
  local heard = {guessed = {}, ignored = {}}
  clench.log.sink(function(level, text)
    local list = level == "info" and heard.guessed or level == "warning" and heard.ignored
    if list then list[#list + 1] = text end
  end)
  local ok, result = pcall(run)
  clench.log.sink()
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
          inertia = body.inertia, elastic_modulus = body.elastic_modulus, mesh = of_mesh(body.mesh)}
end

local function of_dofs(robot)
  local dofs = {}
  for i, info in ipairs(robot.dof_info) do
    local low, high = table.unpack(robot.dof_limits[i])
    dofs[i] = {name = info.name, kind = info.kind, low = low, high = high, value = robot.dofs[i],
               closing = info.default_velocity, max_effort = info.max_effort}
  end
  return dofs
end

-- a DOF moves in metres when its joints slide
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

local function of_robot(robot)
  local dofs, units = of_dofs(robot), units_of(robot)
  for i, dof in ipairs(dofs) do dof.unit = units[i] or "rad" end
  return {name = robot.name, base = of_body(robot.base), dofs = dofs, chains = of_chains(robot),
          approach = {point = numbers(robot.approach.point), direction = numbers(robot.approach.direction)},
          eigengrasps = #robot.eigengrasps, virtual_contacts = #robot.virtual_contacts}
end

local function of_world(world)
  local objects, obstacles, robots, overlaps = {}, {}, {}, {}
  for i, body in ipairs(world.objects) do objects[i] = of_body(body) end
  for i, body in ipairs(world.obstacles) do obstacles[i] = of_body(body) end
  for i, robot in ipairs(world.robots) do
    robots[i] = of_robot(robot)
    robots[i].carried_by = robot.carrier and robot.carrier.name
  end
  for i, pair in ipairs(world:colliding()) do overlaps[i] = {pair[1].name, pair[2].name} end
  return {objects = objects, obstacles = obstacles, robots = robots, overlaps = overlaps}
end

local readers = {
  body = function(path, options) return of_body(clench.world():add_object(path, options)) end,
  robot = function(path, options) return of_robot(clench.world():add_robot(path, options)) end,
  world = function(path, options) return of_world(clench.load(path, options)) end,
  eigengrasps = function(path, options)
    local set = clench.files.eigengrasps(path, options)
    return {dofs = #set.origin, count = #set.vectors}
  end,
  ["virtual contacts"] = function(path, options)
    local list = clench.files.virtual_contacts(path, options)
    return {count = #list, robot = list.robot}
  end,
}

--- One file, understood.
---@param path string
---@param options? {root?: string, folder?: string, package?: string, unit?: string}  those that its kind takes are used
---@return {file: string, kind: string?, understood: table?, guessed: string[], ignored: string[], wrong: string?}
function report.of(path, options)
  local kind
  options = options or {}
  local heard, ok, result = listen(function()
    kind = clench.file_kind(path)
    return readers[kind](path, reading(kind, options))
  end)
  return {file = path, kind = kind, understood = ok and result or nil, guessed = heard.guessed, ignored = heard.ignored,
          wrong = not ok and tostring(result):gsub("^stdlib/report.lua:%d+: ", "") or nil}
end

return report
