local described = require "clench.described"
local raise = require "clench.raise"
local read_options = require "clench.options"
local routes = require "clench.tendon_routes"

local across = {0, 1, 0}          -- default direction of a shift, in the frame of each link
local default_range = {-0.005, 0.005}  -- [m]
local step = 1e-6                 -- of numerical derivatives [m]
local min_progress = 1e-9         -- fraction of the error by which a better route must be better
local min_trust = 1e-4            -- fraction of the range below which no shorter steps are tried

-- each joint that a tendon crosses: its last point before and its first one behind
local function crossings(tendons)
  local shifts = {}
  for _, tendon in ipairs(tendons) do
    for i = 2, #tendon.points do
      if tendon.points[i].link ~= tendon.points[i - 1].link then
        shifts[#shifts + 1] = {tendon = tendon.name, points = {i - 1, i}, axis = across, range = default_range}
      end
    end
  end
  return shifts
end

local function tendon_named(read, tendons, name, where)
  for _, tendon in ipairs(tendons) do
    if tendon.name == name then return tendon end
  end
  read:fail("%s: there is no tendon %s", where, described(name))
end

local function check_points(read, tendon, points, where)
  if type(points) ~= "table" or #points == 0 then read:fail("%s: points: expected a list of numbers, got %s", where, described(points)) end
  for _, number in ipairs(points) do
    if not (math.type(number) == "integer" and tendon.points[number]) then
      read:fail("%s: points: expected numbers from 1 to %d, got %s", where, #tendon.points, described(number))
    end
  end
end

local function is_range(value)
  return type(value) == "table" and #value == 2 and type(value[1]) == "number" and type(value[2]) == "number" and value[1] <= value[2] and value[2] - value[1] < math.huge
end

-- the shifts that a script gives, checked
local function read_shifts(read, tendons)
  local given = read:get "shifts"
  if not given then return crossings(tendons) end
  local shifts = {}
  for i, shift in ipairs(given) do
    local where = ("shifts[%d]"):format(i)
    if type(shift) ~= "table" then read:fail("%s: expected a table, got %s", where, described(shift)) end
    check_points(read, tendon_named(read, tendons, shift.tendon, where), shift.points, where)
    local range = shift.range or default_range
    if not is_range(range) then read:fail("%s: range: expected a minimum and a maximum [m], got %s", where, described(range)) end
    shifts[i] = {tendon = shift.tendon, points = shift.points, axis = shift.axis or across, range = range}
  end
  return shifts
end

-- pull of each tendon [N]
local function read_pulls(read, tendons)
  local given, usual, pulls = read:get "pulls" or {}, read:get "pull", {}
  for name in pairs(given) do tendon_named(read, tendons, name, "pulls") end
  for _, tendon in ipairs(tendons) do
    local pull = given[tendon.name] or usual
    if type(pull) ~= "number" or not (pull >= 0 and pull < math.huge) then read:fail("pulls: expected forces >= 0 [N], got %s", described(pull)) end
    pulls[tendon.name] = pull
  end
  return pulls
end

-- tendons whose points are shifted
local function shifted(tendons, shifts, values)
  local list, by_name = {}, {}
  for i, tendon in ipairs(tendons) do
    local points = {}
    for k, at in ipairs(tendon.points) do points[k] = {link = at.link, point = at.point} end
    list[i] = {name = tendon.name, points = points}
    by_name[tendon.name] = list[i]
  end
  for i, shift in ipairs(shifts) do
    local axis = clench.vec3(table.unpack(shift.axis)):unit()
    for _, number in ipairs(shift.points) do
      local at = by_name[shift.tendon].points[number]
      at.point = at.point + axis * values[i]
    end
  end
  return list
end

-- torques of all pulls, one per DOF
local function torques_of(job, values)
  local torques = {}
  for dof = 1, #job.hand.dofs do torques[dof] = 0 end
  for _, tendon in ipairs(shifted(job.tendons, job.shifts, values)) do
    for dof, arm in ipairs(routes.arms(job.hand, tendon)) do torques[dof] = torques[dof] + job.pulls[tendon.name] * arm end
  end
  return torques
end

-- changes of the torques per meter of each shift
local function derivatives(job, values)
  local columns = {}
  for i = 1, #values do
    local ahead, behind, column = {table.unpack(values)}, {table.unpack(values)}, {}
    ahead[i], behind[i] = values[i] + step, values[i] - step
    local after, before = torques_of(job, ahead), torques_of(job, behind)
    for dof = 1, #after do column[dof] = (after[dof] - before[dof]) / (2 * step) end
    columns[i] = column
  end
  return columns
end

-- without `error` if there is no optimum
local function fit(job, base, columns, ranges)
  local result = job.grasp:fit_torques {base = base, columns = columns, ranges = ranges, load = job.load, max_force = job.max_force}
  return result.status == "optimal" and result or {status = result.status}
end

-- one step of Gauss-Newton, within a fraction of each range
local function next_values(job, values, torques, trust)
  local ranges = {}
  for i, shift in ipairs(job.shifts) do
    local low, high = table.unpack(shift.range)
    local reach = trust * (high - low)
    ranges[i] = {math.max(low - values[i], -reach), math.min(high - values[i], reach)}
  end
  local found = fit(job, torques, derivatives(job, values), ranges)
  local after = {}
  for i, value in ipairs(values) do
    local low, high = table.unpack(job.shifts[i].range)
    after[i] = math.max(low, math.min(high, value + (found.parameters and found.parameters[i] or 0)))
  end
  return after
end

local function search(job, iterations)
  local values, trust, count = {}, 0.5, 0
  for i, shift in ipairs(job.shifts) do values[i] = math.max(shift.range[1], math.min(shift.range[2], 0)) end
  local torques = torques_of(job, values)
  local best = fit(job, torques, {}, {})
  local first = best.error
  while best.error and count < iterations and trust > min_trust and best.error > job.tolerance do
    count = count + 1
    local after = next_values(job, values, torques, trust)
    local there = torques_of(job, after)
    local result = fit(job, there, {}, {})
    if result.error and result.error < best.error * (1 - min_progress) then values, torques, best = after, there, result else trust = trust / 4 end
  end
  return values, torques, best, first, count
end

local function report_of(job, values)
  local shifts, points = {}, {}
  for i, shift in ipairs(job.shifts) do shifts[i] = {tendon = shift.tendon, points = shift.points, axis = shift.axis, value = values[i]} end
  for _, tendon in ipairs(shifted(job.tendons, job.shifts, values)) do points[tendon.name] = tendon.points end
  return shifts, points
end

--- Routes of a hand's spatial tendons with which constant pulls hold a grasp: points of the tendons are shifted so that the torques of the pulls and springs
--- come as near as possible to those of contact forces that balance the load (Ciocarlie and Allen 2011, for GraspIt!'s McGrip). Tendons are straight lines
--- between their points. The hand itself is unchanged.
---@param grasp grasp  a grasp in a world, of a hand with spatial tendons
---@param options? table  the tendons and the load
---@option pull? number [N, >= 0] = 1  force of each tendon
---@option pulls? table  forces of tendons by their names [N]
---@option shifts? table[]  what may be shifted: {tendon = name, points = {numbers}, axis = {0, 1, 0}, range = {-0.005, 0.005}}, axis in the frame of each link, range in meters; by default each pair of points between which a tendon crosses a joint
---@option load? number[]  wrench on the object {fx, fy, fz, tx, ty, tz}, as in grasp:contact_forces [N, N m]
---@option max_force? number|number[]  largest normal force of each contact, or one per contact [N]
---@option iterations? integer [1 to 1000] = 50  of Gauss-Newton
---@option tolerance? number [N m, > 0] = 1e-6  unbalanced torque at which the search ends
---@return {status: string, error: number?, first_error: number?, shifts: table[], points: table, torques: number[], normals: number[], iterations: integer} # status: "balanced": within the tolerance; "nearest": an unbalanced torque `error` remains [N m]; "infeasible": no contact forces balance the load; "inaccurate": the solver failed. first_error: without shifts; shifts: the given ones with their `value` [m]; points: of each tendon by its name, as in hand.tendons; torques of the pulls, one per DOF; normals: force of each contact [N]
---@effect long
--- > clench.study.tendon_design(grasp)  --> error: has no spatial tendons
return function(grasp, options)
  if clench.type(grasp) ~= "grasp" then raise(("study.tendon_design: expected a grasp, got %s"):format(described(grasp))) end
  local read = read_options("study.tendon_design", options or {})
  local hand = grasp.hand
  local tendons = hand.tendons
  if #tendons == 0 then read:fail("%s has no spatial tendons", hand.name) end
  local job = {grasp = grasp, hand = hand, tendons = tendons, shifts = read_shifts(read, tendons), pulls = read_pulls(read, tendons), load = read:get "load",
               max_force = read:get "max_force", tolerance = read:get "tolerance"}
  local iterations = read:get "iterations"
  read:done()
  local values, torques, best, first, count = search(job, iterations)
  local shifts, points = report_of(job, values)
  local status = not best.error and best.status or best.error <= job.tolerance and "balanced" or "nearest"
  return {status = status, error = best.error, first_error = first, shifts = shifts, points = points, torques = torques, normals = best.normals or {}, iterations = count}
end
