-- stdlib/study/robustness.lua
local call_script = require "clench.call_script"
local raise = require "clench.raise"
local read_options = require "clench.options"
local described = require "clench.described"
local stats = require "clench.stats"
local suspect = require "clench.suspect"
local put_back = require "clench.study.put_back"

-- each error has one stream of random numbers per sample, so that disabling one does not change the others
local streams = {place = 0, friction = 1, normal = 2, count = 3}
local function stream(seed, sample, what) return clench.random(seed, streams.count * (sample - 1) + streams[what]) end

local function erred_pose(random, pose, position, angle)
  local shift = {position * random:normal(), position * random:normal(), position * random:normal()}
  local axis, half = random:direction(), angle * random:normal() / 2
  local turn = math.sin(half) * axis
  -- rotated about the object's origin, shifted in the world
  return clench.pose {xyz = shift} * clench.pose {xyz = pose.position}
    * clench.pose {quat = {math.cos(half), turn.x, turn.y, turn.z}} * clench.pose {quat = pose.quat}
end

-- a unit vector tilted by an angle towards any side
local function tilted(random, normal, angle)
  local side = normal:cross(random:direction())
  while side:norm() < 1e-3 do side = normal:cross(random:direction()) end
  return (math.cos(angle) * normal + math.sin(angle) * side:unit()):unit()
end

local function close_again(hand) hand:autograsp() end

-- Opens the hand from DOF values in 20 steps, each DOF in proportion to its closing speed, until it is free of collision.   returns  nil if it never is
local function back_off(hand, from)
  local paces, limits, most = {}, hand.dof_limits, 0
  for i, info in ipairs(hand.dof_info) do
    paces[i] = info.default_velocity
    if paces[i] ~= 0 then most = math.max(most, (limits[i][2] - limits[i][1]) / math.abs(paces[i])) end
  end
  for step = 1, 20 do
    local at = {}
    for i, value in ipairs(from) do
      at[i] = paces[i] == 0 and value or math.min(math.max(value - paces[i] * most * step / 20, limits[i][1]), limits[i][2])
    end
    hand:set_dofs(at)
    if #hand.world:colliding(hand) == 0 then return true end
  end
end

local function size_of(object)
  local bounds = object.bounds_in_world
  return (bounds.high - bounds.low):norm()
end

local function check_grasp(grasp)
  if clench.type(grasp) ~= "grasp" then raise("study.robustness: expected a grasp, got " .. described(grasp)) end
end

--- The quality of a grasp under errors of pose, friction and normals. Each sample draws normally distributed errors. If the pose of the object is disturbed,
--- the hand is put back to the grasp, opened in steps of a twentieth of its range until it is free of the object, and closed again, all in a copy of the world.
--- Friction errs by one factor for all contacts, each normal separately. Center of mass and rho are those with which the grasp was measured. The results depend
--- only on the seed; sample i is the same in longer runs.
---@param grasp grasp  grasp to disturb
---@param options? table  standard deviations of the errors
---@option samples? integer [1 to 1000000] = 100  number of samples
---@option seed? integer = 1  seed of the random numbers
---@option position? number [m, >= 0] = 0  error of the object's position along each axis
---@option angle? number [rad, >= 0] = 0  error of the object's orientation about a random axis
---@option friction? number [>= 0] = 0  error of the factor on mu
---@option normal? number [rad, >= 0] = 0  tilt of normals
---@option close? function  close(hand, object) instead of autograsp
---@option edges? integer|string  edges of the friction pyramids, as in clench.wrench_space; those of the grasp by default
---@return {count: integer, samples: number[], probability: number, interval: table, blocked: integer, mean: number, std: number, min: number, p05: number, median: number, p95: number, max: number} # epsilon of each sample; probability of force closure, with its 95 % confidence interval; blocked: number of samples in which the object collided with the opened hand or another body, which count as epsilon 0; p05 and p95: 5th and 95th percentiles
---@effect long
--- > r = clench.study.robustness(grasp, {samples = 20, friction = 0.2, normal = 0.05})
--- > #r.samples, r.p05 <= r.median, r.interval.low <= r.probability  --> 20, true, true
--- > clench.study.robustness(grasp, {frictoin = 0.2})  --> error: unknown key 'frictoin'
return function(grasp, options)
  check_grasp(grasp)
  local read = read_options("study.robustness", options or {})
  local count = read:get "samples"
  local seed = read:get "seed"
  local position, angle = read:get "position", read:get "angle"
  local friction, normal = read:get "friction", read:get "normal"
  local edges = read:get "edges" or grasp.edges  -- as in clench.wrench_space
  local close = read:get("close", close_again)
  read:done()

  local moves = position > 0 or angle > 0
  local placed = moves and put_back.copy(read.subject, grasp)
  if placed then suspect.millimeters(read.subject, "position", position, size_of(placed.object)) end
  suspect.degrees(read.subject, "angle", angle)
  suspect.degrees(read.subject, "normal", normal)
  local alike = grasp.options
  alike.edges = edges
  -- a new grasp has other contacts
  if type(alike.normal_force) == "table" then alike.normal_force = stats.mean(alike.normal_force) end

  local function regrasped(sample)
    if not moves then return grasp end
    local world, hand, object = placed.world, placed.hand, placed.object
    world:restore(placed.start)
    object.pose = erred_pose(stream(seed, sample, "place"), placed.pose, position, angle)
    if not back_off(hand, grasp.dofs) or #world:colliding(object) > 0 then return nil end
    call_script("study.robustness: close", close, hand, object)
    return clench.grasp(hand, object, alike)
  end

  local epsilons, closed, blocked = {}, 0, 0
  for sample = 1, count do
    local now, epsilon = regrasped(sample), 0
    if not now then
      blocked = blocked + 1
    else
      local contacts = now.points
      local factor = math.max(0, 1 + friction * stream(seed, sample, "friction"):normal())
      local tilts = stream(seed, sample, "normal")
      for _, contact in ipairs(contacts) do
        contact.mu = contact.mu * factor
        if normal > 0 then contact.normal = tilted(tilts, contact.normal, normal * tilts:normal()) end
      end
      epsilon = clench.wrench_space {contacts = contacts, com = grasp.com, rho = grasp.rho, edges = edges}:epsilon()
    end
    epsilons[sample] = epsilon
    if epsilon > 0 then closed = closed + 1 end
  end

  local result = stats.summary(epsilons)
  result.samples, result.blocked = epsilons, blocked
  result.probability, result.interval = closed / count, stats.interval(closed, count)
  return result
end
