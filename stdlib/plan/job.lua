--- Input shared by all planners: a hand, an object and the world that they move, which is a clone unless a function of the script
--- reads the world itself.
local drives = require "clench.drives"
local on_behalf_of = require "clench.on_behalf_of"
local read_options = require "clench.options"
local quiet = require "clench.plan.quiet"
local loop_task = require "clench.loop_task"
local Job = require "clench.plan.job_search"
local touch = require "clench.plan.touch"
local warn_of_overlaps = require "clench.plan.warn_of_overlaps"

-- options of clench.annealing
local space_keys = {"position", "posture", "semi_axes", "limits", "jumps", "values", "targets", "fixed", "start",
                    "variables", "collisions", "max_tries"}

-- Checks the options once, before the search, except a list of normal forces: its length depends on the grasp.
local function check_grasp_options(job)
  local silence <close> = quiet()
  local options = {}
  for name, value in pairs(job.grasp_options) do
    if name ~= "normal_force" or type(value) ~= "table" then options[name] = value end
  end
  on_behalf_of(job.subject .. ": grasp", clench.grasp, job.hand, job.object, options)
end

local function is_part_of(robot, body)
  for _, part in ipairs(robot.bodies) do
    if part == body then return true end
  end
  return false
end

--- A clone of the world without the arm that carries the hand.
local function freed(world, name)
  local free = world:clone()
  local hand = free:robot(name)
  local arm = hand.parent
  hand:dismount()
  free:remove(arm)
  return free
end

---@param subject string  "plan.anneal"
---@param given table
---@param own? fun(read: table, job: table)  reads the planner's own options
return function(subject, given, own)
  local read = read_options(subject, given)
  local job = setmetatable({subject = subject, space = {}}, Job)
  local hand, object = read:get "hand", read:get "object"
  local world = read:get("world", hand.world)
  if hand.world ~= world or object.world ~= world then
    read:fail("hand and object must be in the same world")
  end
  if is_part_of(hand, object) then read:fail("object: '%s' is a part of the hand", object.name) end
  job.given_world, job.arm = world, hand.parent
  for _, name in ipairs {"seed", "threads", "seconds"} do job[name] = read:has(name) and read:get(name) or nil end
  job.grasp_options = read:get "grasp" or {}
  job.touch = touch.read(read, hand)
  job.max_effort = read:get "max_effort"
  for _, key in ipairs(space_keys) do
    if read:has(key) then job.space[key] = read:checked(key) end
  end
  if own then own(read, job) end
  read:done()
  warn_of_overlaps(subject, world, hand, object)

  local energy = job.energy
  local has_function = type(energy) == "function" or clench.type(energy) == "energy" and not energy.any_thread
  job.in_place = has_function
  if has_function then
    job.world, job.before = world, world:snapshot()
  else
    job.world = job.arm and freed(world, hand.name) or world:clone()
  end
  job.hand, job.object = job.world:robot(hand.name), job.world:body(object.name)
  job.given_hand, job.given_object = hand, object
  if job.max_effort then job.hand.max_effort = job.max_effort end
  job.unlimited_efforts = drives.unlimited(job.hand)
  check_grasp_options(job)
  job.in_loop = coroutine.running() == loop_task.thread
  job.began = clench.clock()
  return job
end
