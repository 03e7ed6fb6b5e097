--- Tests a grasp in motion: in a copy of its world the hand presses the object by its motors; then the displacement of the object from that state is recorded.
local drives = require "clench.drives"
local on_behalf_of = require "clench.on_behalf_of"
local rest = require "clench.study.motion.rest"
local share_friction = require "clench.study.motion.share_friction"

local Trial = {}
Trial.__index = Trial

local every = 0.01  -- time between two checks of the displacement [s]
-- Contacts act within this distance: points of a patch then resist almost no torsion, which makes verdicts conservative.
local contact_threshold = 2e-5  -- [m]

local function place_of(list, entity)
  for i, other in ipairs(list) do
    if other == entity then return i end
  end
end

-- the robot at the root of the chain of robots that carry a robot
local function root_of(robot)
  while robot.parent do robot = robot.parent end
  return robot
end

-- removes everything except the hand, the object, and the robots that carry the hand
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

-- sets all velocities to zero, whatever they were in the original world
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

-- Motors hold robots in their postures, and compensate their weight; joints without motors stay free.
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

local swing = 60  -- natural frequency of motors without given gains [rad/s]

-- Motors without gains from a file or script get gains for their inertia plus that of the object at its lever arm.
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

-- Motor torques of contact forces in equilibrium; nil if there are none, or if they need a motor that cannot pull in that direction.
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

-- Compliant DOFs pull their tendons to their limits, so that the springs exert the motors' maximum efforts.
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

local slack, pressed = 0.5, 0.9  -- fractions of the requested normal force: slack below the first is taken up until the second is reached
local max_slack = 100   -- maximum number of parts of a trial in which slack is taken up

-- A hand that closed to within the contact threshold may still have a gap on one side of the object, and a stiff servo that holds its position counteracts the
-- torque that is to press: jaws then exert no force at all. So the targets of the pressing motors follow their motion, as in a force-controlled gripper, until
-- the hand presses.
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
  -- torques for the reduced friction or, if there are none, for the full friction
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

--- Pose of the object in the frame of the hand's base.
function Trial:pose() return self.hand.pose:inverse() * self.object.pose end

-- displacement of its center of mass [m] and rotation [rad] since it was held
function Trial:displacement(from)
  local now = self:pose()
  return (now * self.com - from * self.com):norm(), (from:inverse() * now):angle()
end

--- Runs for a time, or until the object is lost.
---@param seconds number  simulated time
---@param tick? fun(time: number)  called before each part of the time, with the elapsed time [s]
---@param length? number  of the parts [s]
---@param is_steady? boolean  forces and targets do not change: the run ends once nothing in the world moves
---@return {moved: number, turned: number, held: boolean, time?: number}  moved, turned: maximum displacement [m, rad]; time: at which the object was lost [s]
function Trial:watch(seconds, tick, length, is_steady)
  local from, row = self.held_at, {moved = 0, turned = 0, held = true}
  local parts = math.max(1, math.ceil(seconds / (length or every) - 1e-9))
  local at_rest = rest.detector(self.world)
  for part = 1, parts do
    if tick then tick(seconds * (part - 1) / parts) end
    self.world:run(seconds / parts)
    local moved, turned = self:displacement(from)
    row.moved, row.turned = math.max(row.moved, moved), math.max(row.turned, turned)
    -- a displacement of nan counts as lost
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
---@param force fun(time: number): vec3  of the time since this call [s]; returns [N]
function Trial:push(force)
  local world, object, began = self.world, self.object, self.world.time
  return world:on_step(function() object:apply_force(force(world.time - began)) end)
end

--- Restores the state in which the hand held the object at rest.
function Trial:reset() self.world:restore(self.ready) end

--- Stops the base that carries everything.
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

--- Copies the world, brings everything in it to rest, and lets the hand press: its motors hold its posture and add the torques of contact forces in
--- equilibrium, as far inside their friction cones as possible; or they close. There is no gravity until everything has come to rest.
---@param job table  of study.motion.options
return function(job) return on_behalf_of(job.subject, new_trial, job) end
