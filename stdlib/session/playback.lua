--- Simulation in real time: a coroutine of `clench.loop` steps the world. A playback is one gesture, thus one step of undo; it is logged as its number of
--- steps.
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local recorded = require "clench.session.recorded"
local script = require "clench.session.script"
local playback = {}

local budget = 0.012  -- time for steps in one turn of the loop [s]
local max_lag = 0.1   -- a longer lag of the simulation is skipped [s]
local pause = 0.004   -- pause between turns [s]

function playback.is_on(session) return session.playing ~= nil end

-- Steps the world up to the present time of the clock, within the budget.
local function catch_up(playing, world)
  local loop = clench.loop
  local last = loop.time() + budget
  local due = (loop.time() - playing.began) * playing.speed
  while playing.steps * playing.step + playing.skipped < due do
    world:run(playing.step)
    playing.steps = playing.steps + 1
    if loop.time() > last then break end
  end
  local lag = due - (playing.steps * playing.step + playing.skipped)
  if lag > max_lag * playing.speed then playing.skipped = playing.skipped + lag end
end

-- one turn of the loop; an error ends the playback and is reported as a diagnostic
local function turn(session, playing)
  local ok, problem = pcall(catch_up, playing, session.world)
  if ok then
    recorded.check(session)
    session:emit("changed", {playing = true})
    return
  end
  playback.stop(session)
  if is_stopped(problem) then error(problem, 0) end
  session:emit("diagnostic", {severity = "error", text = error_text(problem), count = 1})
end

--- Starts the playback.
---@param speed number  simulated seconds per second of the clock
function playback.start(session, speed)
  local loop = clench.loop
  local playing = {began = loop.time(), speed = speed, step = session.world.time_step, steps = 0, skipped = 0}
  session:begin_gesture("Play", function() return playing.steps > 0 and script.steps(playing.steps, playing.step) or "" end,
                        function()
                          session.playing = nil
                          recorded.stop(session)
                        end)
  session.playing = playing
  recorded.start(session)
  loop.spawn(function()
    while session.playing == playing do
      turn(session, playing)
      loop.sleep(pause)
    end
  end)
end

--- Ends the playback; its changes become one undo step.
function playback.stop(session) session:end_gesture() end

return playback
