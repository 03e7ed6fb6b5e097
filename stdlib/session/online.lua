--- The on-line planner of a session: periods of its search run as jobs, one after another, while the user or a device moves hand and object. The hand is
--- shaped by the nearest grasp.
local contains = require "clench.contains"
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local raise = require "clench.raise"
local sensed = require "clench.session.sensed"
local online = {}

local interval = 0.1        -- between two looks at hand and job [s]
local pause = 0.05          -- between two periods [s]
local in_reach = 1          -- closeness of a grasp for which "auto" shapes the hand
local min_change = 1e-3     -- of a DOF that is worth a motion [rad or m]
local max_speed = 1         -- of the real hand [rad/s]

local function is_alive(session, state)
  local world = session.world
  return world ~= nil and world == state.world and contains(world.robots, state.hand) and contains(world.objects, state.object)
end

local function differ(a, b)
  for i = 1, #a do
    if math.abs(a[i] - b[i]) > min_change then return true end
  end
  return false
end

-- Moves the fingers as the nearest grasp demands, until contact: within the open gesture, such as a drag, or as one of its own.
local function shape(session, state)
  local dofs = state.planner:preshape()
  if not dofs or session.playing or state.shaped and not differ(dofs, state.shaped) then return end
  state.shaped = dofs
  if not session.gesture then session:begin_gesture("Shape " .. state.hand.name) end
  state.hand:move_dofs(dofs)
  session:emit("changed", {gesture = true})
end

-- the real hand follows the simulated one, as long as it is asked to
local function shape_real(session, state)
  local sensor = session.sensors.hand
  if state.shape_real and sensor and sensor.reading and not sensor.task and session.hand == state.hand then sensed.push(session, max_speed, true) end
end

-- looks at the present poses
local function refresh(session, state)
  local nearest = state.planner:nearest()
  state.nearest = nearest
  state.object_distance = session.world:distance(state.hand, state.object)
  if state.auto and state.status ~= "open" then state.status = nearest and nearest.closeness <= in_reach and "grasping" or "planning" end
  if state.status == "grasping" and state.shape_hand then shape(session, state) end
  shape_real(session, state)
  session:emit("progress", {command = "online.start", online = state})
end

-- one period of the search; a job that ends otherwise than asked raises its error
local function search(session, state)
  local job = state.planner:start(state.steps)
  state.job = job
  while not clench.loop.wait(job, interval) do
    if session.online ~= state or state.status == "open" then job:stop() end
    if session.online == state and is_alive(session, state) then
      state.search = job.snapshot or state.search
      refresh(session, state)
    end
  end
  state.job = nil
  if job.state ~= "stopped" then state.planner:finish(job) end
end

local function turn(session, state)
  if not is_alive(session, state) then
    online.stop(session)
    return session:emit("diagnostic", {severity = "warning", text = "the on-line planner has stopped, as its hand or its object is no longer in the world", count = 1})
  end
  if state.status ~= "open" then search(session, state) end
  if session.online ~= state or not is_alive(session, state) then return end
  refresh(session, state)
  clench.loop.sleep(state.status == "open" and interval or pause)
end

-- an error ends the search and is reported as a diagnostic
local function serve(session, state)
  while session.online == state do
    local ok, problem = pcall(turn, session, state)
    if not ok then
      if session.online == state then online.stop(session) end
      if is_stopped(problem) then error(problem, 0) end
      session:emit("diagnostic", {severity = "error", text = error_text(problem), count = 1})
    end
  end
end

--- Starts the search, instead of the present one.
---@param options table  of `clench.plan.online`
---@param settings {steps: integer, auto: boolean, shape_hand: boolean, shape_real: boolean}
function online.start(session, options, settings)
  if settings.shape_real then sensed.require_real_hand(session) end
  local planner = clench.plan.online(options)
  online.stop(session)
  local state = {planner = planner, world = session.world, hand = options.hand, object = options.object, status = "planning", steps = settings.steps,
                 auto = settings.auto, shape_hand = settings.shape_hand, shape_real = settings.shape_real}
  session.online = state
  clench.loop.spawn(function() serve(session, state) end)
end

--- Ends the search. Its grasps remain in `session.online_grasps`.
function online.stop(session)
  local state = session.online
  if not state then return end
  session.online = nil
  session.online_grasps = state.planner:grasps()
  if state.job then state.job:stop() end
  session:emit("progress", {command = "online.stop"})
end

local function running(session) return session.online or raise "session: the on-line planner is not running" end

--- "planning": it searches only; "grasping": it also shapes the hands; "open": it waits.
function online.set_status(session, status)
  local state = running(session)
  state.status, state.shaped = status, nil
  session:emit("progress", {command = "online." .. status, online = state})
end

--- Changes settings by name.
function online.set(session, settings)
  local state = running(session)
  if settings.shape_real then sensed.require_real_hand(session) end
  for name, value in pairs(settings) do state[name] = value end
  local sensor = session.sensors.hand
  if settings.shape_real == false and sensor and sensor.task then sensed.stop(session) end
  session:emit("progress", {command = "online.settings", online = state})
end

return online
