local raise = require "clench.raise"
local described = require "clench.described"
local name_list = require "clench.name_list"
local read_options = require "clench.options"

local coordinates = {"fx", "fy", "fz", "tx", "ty", "tz"}
local number_of = {}
for i, name in ipairs(coordinates) do number_of[name] = i end

-- numbers of two different coordinates
local function plane(read)
  local axes = read:get "axes"
  if #axes ~= 2 or axes[1] == axes[2] then read:expected("axes", "two different coordinates", axes) end
  local numbers = {}
  for i, name in ipairs(axes) do
    numbers[i] = number_of[name]
    if not numbers[i] then read:fail("axes[%d]: expected any of %s, got '%s'", i, name_list(coordinates), name) end
  end
  return axes, numbers
end

-- options of grasp:max_load
local passed = {"torques", "torque_limits", "max_force", "max_total_force", "unilateral", "arms", "link_weights"}

local function limits_of(read)
  local limits = {}
  for _, name in ipairs(passed) do limits[name] = read:get(name) end
  if limits.torques then
    if read:raw "torque_limits" ~= nil then read:fail "torques and torque_limits exclude each other" end
    limits.torque_limits = nil
  end
  return limits
end

-- largest load along a direction, and what yields beyond it
local function ray(grasp, limits, direction)
  limits.direction = direction
  local result = grasp:max_load(limits)
  local certificate = result.certificate or {}
  return {status = result.status, wrench = direction, load = result.status == "unlimited" and math.huge or result.load, contact = certificate.contact, dof = certificate.dof}
end

-- area of the polygon of the end points of all rays, from the origin
local function area_of(rays)
  local sum = 0
  for i, from in ipairs(rays) do
    local to = rays[i % #rays + 1]
    if not (from.point and to.point) then return nil end
    sum = sum + from.point[1] * to.point[2] - from.point[2] * to.point[1]
  end
  return sum / 2
end

--- Section of the wrenches on the object that a grasp resists, through the plane of two coordinates: grasp:max_load along directions at equal angles. All other
--- coordinates are 0. Given `torques`, the motors keep them at every load; without `torques` they adjust to the load.
---@param grasp grasp  a grasp in a world
---@param options? table  plane and limits
---@option axes? string[] = {"fx", "fz"}  two of fx, fy, fz, tx, ty, tz: axes of the world, torques about the object's center of mass
---@option count? integer [3 to 3600] = 72  directions
---@option torques? number[]  of the motors, one per DOF [N m or N]
---@option torque_limits? boolean|number[] = true  without torques: limits of the motors, as in grasp:max_load
---@option max_force? number|number[]  largest normal force of each contact, or one per contact [N]
---@option max_total_force? number [N, > 0]  largest sum of the normal forces
---@option unilateral? boolean  motors do not open the hand
---@option arms? boolean  also limits of the arms that carry the hand
---@option link_weights? boolean  motors also carry the weight of the links
---@return {axes: string[], rays: table[], area: number?} # rays: {status, wrench, load, point, contact, dof} from the first axis towards the second: `status` as in grasp:max_load, `wrench` the direction, whose torque is 1 N times grasp.rho; `load` its largest multiple, infinite if unlimited, nil if infeasible; `point` the end of the ray, {x, y} [N or N m]; `contact` or `dof` yields beyond it. area of the section; nil if a ray has no end
---@effect long
--- > held = clench.study.resistible_wrenches(grasp, {axes = {"fx", "fz"}, count = 4, max_force = 5})
--- > #held.rays, held.rays[1].load > 0, held.area > 0  --> 4, true, true
--- > clench.study.resistible_wrenches(grasp, {axes = {"fx", "fx"}})  --> error: axes must be two different coordinates
return function(grasp, options)
  if clench.type(grasp) ~= "grasp" then raise(("study.resistible_wrenches: expected a grasp, got %s"):format(described(grasp))) end
  local read = read_options("study.resistible_wrenches", options or {})
  local axes, numbers = plane(read)
  local count = read:get "count"
  local limits = limits_of(read)
  read:done()
  local rays = {}
  for i = 1, count do
    local angle = 2 * math.pi * (i - 1) / count
    local direction, parts = {0, 0, 0, 0, 0, 0}, {math.cos(angle), math.sin(angle)}
    for k, number in ipairs(numbers) do
      parts[k] = parts[k] * (number > 3 and grasp.rho or 1)
      direction[number] = parts[k]
    end
    rays[i] = ray(grasp, limits, direction)
    local load = rays[i].load
    if load and load < math.huge then rays[i].point = {load * parts[1], load * parts[2]} end
  end
  return {axes = axes, rays = rays, area = area_of(rays)}
end
