--- A grasp that moves: a copy of its world in which the hand presses the object by its motors, and how far the object
--- goes from where the hand held it then.
local drives = require "clench.drives"
local on_behalf_of = require "clench.on_behalf_of"
local rest = require "clench.study.motion.rest"
local share_friction = require "clench.study.motion.share_friction"

local Trial = {}
Trial.__index = Trial

local every = 0.01  -- between two looks [s]
-- Contacts act within this distance: points of a patch carry next to no torsion, as is asked of a grasp that is to hold elsewhere, too.
local contact_threshold = 2e-5  -- [m]

local function place_of(list, entity)
  for i, other in ipairs(list) do
    if other == entity then return i end
  end
end

-- the robot at the end of all that carries a robot
local function root_of(robot)
  while robot.parent do robot = robot.parent end
  return robot
end

-- hand, object, and what carries the hand
local function remove_surroundings(world, hand, object)
  local root, others = root_of(hand), {}
  for _, robot in ipairs(world.robots) do
    if root_of(robot) ~= root then others[#others + 1] = robot end
  end
  for _, robot in ipairs(others) do world:remove(robot) end
  for _, list in ipairs {world.objects, world.obstacles} do
    for _, body in ipairs(list) do
      if body ~= object then world:remove(body) end
    end
  end
end

local still = {linear = {0, 0, 0}, angular = {0, 0, 0}}

-- nothing moves, whatever it did in the world that was copied
local function bring_to_rest(world)
  world:clear_forces()
  for _, robot in ipairs(world.robots) do
    local velocities = {}
    for i in ipairs(robot.dofs) do velocities[i] = 0 end
    robot.dof_velocities = velocities
    if not robot.parent then robot.base.velocity = still end
  end
  for _, list in ipairs {world.objects, world.obstacles} do
    for _, body in ipairs(list) do
      if not body.welded_to then body.velocity = still end
    end
  end
end

-- Motors hold robots where they stand, and carry their weight; what no motor drives stays free.
local function hold_robots(world)
  for _, robot in ipairs(world.robots) do
    local targets = {}
    for i, info in ipairs(robot.dof_info) do
      if info.driven then targets[info.name or "dof" .. i] = robot.dofs[i] end
    end
    robot.controller = "none"
    if next(targets) then robot:set_targets(targets) end
    robot.gravity_compensation = true
    robot.floating = false
  end
end

local swing = 60  -- at which motors without gains of their own swing back [rad/s]

-- Motors to which neither file nor script gives gains are as stiff as it takes to hold the object, too, at the lever that they have to it.
local function set_gains(hand, object)
  local M, gains = hand:mass_matrix(), hand.gains
  hand.gains = nil
  local plain = hand.gains
  local com = object.pose * object.com
  local levers = {}
  for i = 1, #gains do levers[i] = 0 end
  for _, link in ipairs(hand.links) do
    local J = hand:jacobian(link, link.pose:inverse() * com)
    for i = 1, #gains do levers[i] = math.max(levers[i], math.sqrt(J[1][i] ^ 2 + J[2][i] ^ 2 + J[3][i] ^ 2)) end
  end
  for i, info in ipairs(hand.dof_info) do
    if gains[i].kp == plain[i].kp and gains[i].kd == plain[i].kd then
      local inertia = M[i][i] + object.mass * levers[i] ^ 2
      gains[i] = not (info.kp > 0 or info.kd > 0) and {kp = inertia * swing ^ 2, kd = 2 * inertia * swing}
    end
  end
  hand.gains = gains
end

-- Torques of the motors that press by forces in equilibrium; nil where there are none, or where they need a motor that cannot pull in that direction.
local function grip_torques(hand, object, total)
  local grasp = clench.grasp(hand, object)
  if #grasp.points < 2 then return nil end
  local found = grasp:contact_forces {objective = "max_margin", total_force = total}
  if found.status ~= "optimal" then return nil end
  local rounding = 1e-9 * total
  for i, range in ipairs(hand.effort_ranges) do
    local torque = found.joint_torques[i]
    if torque > rounding and range[2] <= 0 or torque < -rounding and range[1] >= 0 then return nil end
  end
  return found.joint_torques
end

-- Compliant DOFs pull their tendons until their springs give what the motors can.
local function pull_tendons(hand)
  local targets, pulls = hand.dofs, false
  for i, info in ipairs(hand.dof_info) do
    if info.kind == "compliant" and info.can_close then
      targets[i], pulls = hand.dof_limits[i][info.default_velocity > 0 and 2 or 1], true
    end
  end
  if pulls then hand:set_targets(targets) end
end

-- sum of the normal forces between hand and object in the last step [N]
local function pressing_force(world, hand, object)
  local sum = 0
  for _, contact in ipairs(world:contacts(hand, object)) do sum = sum + math.abs(contact.force:dot(contact.normal)) end
  return sum
end

local slack, pressed = 0.5, 0.9  -- parts of the requested normal force: below the first there is slack, which is taken up to the second
local max_slack = 100   -- parts of a trial in which slack is taken up

-- A hand that closed to within the contact threshold may still be clear of one side of the object by less than that, and a stiff servo that
-- holds it there takes the torque that is to press: jaws then exert no force at all. So the targets of the motors that press follow their
-- motion, as those of a gripper that is controlled by force, until the hand presses.
local function take_up_slack(trial, job, torques)
  local world, hand, object = trial.world, trial.hand, trial.object
  local info = hand.dof_info
  if pressing_force(world, hand, object) >= slack * job.grip_force then return end
  for _ = 1, max_slack do
    if pressing_force(world, hand, object) >= pressed * job.grip_force then return end
    local targets, now = {}, hand.dofs
    for i, torque in ipairs(torques) do
      if torque ~= 0 and info[i].kind ~= "compliant" and info[i].driven then targets[info[i].name or "dof" .. i] = now[i] end
    end
    if not next(targets) then return end
    hand:set_targets(targets)
    world:run(every)
  end
end

local function press(trial, job)
  local world, hand = trial.world, trial.hand
  -- torques for what friction is left, or, where nothing is held with that, for the whole of it
  local by_forces = job.grip == "forces"
  local torques = by_forces and grip_torques(hand, trial.object, job.grip_force)
  share_friction(hand, trial.object, job.friction_share)
  torques = by_forces and grip_torques(hand, trial.object, job.grip_force) or torques
  trial.grip = torques and "forces" or drives.close(hand) and "close" or "none"
  world.contact_threshold = math.min(world.contact_threshold, contact_threshold)
  if not torques then
    if trial.grip == "close" then hand:autograsp {dynamic = true} end
    world:run(job.grip_seconds)
    return
  end
  pull_tendons(hand)
  local steps = math.max(1, math.ceil(job.grip_seconds / every - 1e-9))
  for step = 1, steps do
    local now = {}
    for i, torque in ipairs(torques) do now[i] = torque * step / steps end
    hand:set_forces(now)
    world:run(job.grip_seconds / steps)
  end
  take_up_slack(trial, job, torques)
end

--- Where the object is in the hand's base.
function Trial:pose() return self.hand.pose:inverse() * self.object.pose end

-- how far its center of mass has gone, and how far it has turned, since it was held
function Trial:displacement(from)
  local now = self:pose()
  return (now * self.com - from * self.com):norm(), (from:inverse() * now):angle()
end

--- Runs so long, or until the object is lost.
---@param seconds number
---@param tick? fun(time: number)  called before each part of the time, with what has passed
---@param length? number  of the parts [s]
---@param is_steady? boolean  forces and targets do not change: the run ends once nothing in the world moves
---@return {moved: number, turned: number, held: boolean, time?: number}  the largest displacement [m, rad]; time at which it was lost [s]
function Trial:watch(seconds, tick, length, is_steady)
  local from, row = self.held_at, {moved = 0, turned = 0, held = true}
  local parts = math.max(1, math.ceil(seconds / (length or every) - 1e-9))
  local at_rest = rest.detector(self.world)
  for part = 1, parts do
    if tick then tick(seconds * (part - 1) / parts) end
    self.world:run(seconds / parts)
    local moved, turned = self:displacement(from)
    row.moved, row.turned = math.max(row.moved, moved), math.max(row.turned, turned)
    -- nor is what is no number held
    if not (moved <= self.max_distance and turned <= self.max_angle) then
      row.held, row.time = false, seconds * part / parts
      break
    end
    if is_steady and at_rest() then break end
  end
  return row
end

--- As watch, under forces and targets that do not change.
function Trial:watch_steady(seconds) return self:watch(seconds, nil, nil, true) end

--- Pushes the object at its center of mass until the handle that it returns is removed.
---@param force fun(time: number): vec3  of the time since then [s], [N]
function Trial:push(force)
  local world, object, began = self.world, self.object, self.world.time
  return world:on_step(function() object:apply_force(force(world.time - began)) end)
end

--- Goes back to where the hand held the object at rest.
function Trial:reset() self.world:restore(self.ready) end

--- The base that carries all stands still.
function Trial:halt() self.root.base.velocity = still end

local function new_trial(job)
  local world = job.world:clone()
  local hand = world.robots[place_of(job.world.robots, job.hand)]
  local object = world.bodies[place_of(job.world.bodies, job.object)]
  if not job.surroundings then remove_surroundings(world, hand, object) end
  object.mass = job.mass
  hold_robots(world)
  bring_to_rest(world)
  local failures_before = world.report.failures
  set_gains(hand, object)
  world.gravity = {0, 0, 0}
  local trial = setmetatable({world = world, hand = hand, object = object, root = root_of(hand), com = object.com, failures_before = failures_before,
                              max_distance = job.max_distance, max_angle = job.max_angle}, Trial)
  local first = trial:pose()
  press(trial, job)
  trial.held_at = trial:pose()
  trial.settled = trial:watch_steady(math.max(job.settle, every))
  trial.contacts = #world:contacts(hand, object)
  trial.grip_force = pressing_force(world, hand, object)
  trial.unlimited_efforts = drives.unlimited(hand)
  trial.settled.held = trial.settled.held and trial.contacts > 0
  trial.settled.moved, trial.settled.turned = trial:displacement(first)
  trial.held_at = trial:pose()
  trial.ready = world:snapshot()
  return trial
end

--- Copies the world, brings all in it to rest, and lets the hand press: its motors hold its posture, and torques are added that press with
--- forces in equilibrium, the contacts as far inside their friction cones as can be; or they close. There is no gravity while it does so,
--- and until everything has come to rest.
---@param job table  of study.motion.options
return function(job) return on_behalf_of(job.subject, new_trial, job) end
