--- Commands of the Dynamics menu: runs the simulation at once, in steps or in real time, and manages a stack of states.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local playback = require "clench.session.playback"
local recorded = require "clench.session.recorded"
local script = require "clench.session.script"

-- runs the world and records it
local function run(session, args)
  recorded.start(session, args.seconds)
  local _ <close> = setmetatable({}, {__close = function() recorded.stop(session) end})
  session.world:run(args.seconds)
end

-- a run of the open world
local function has_recording(session)
  local recording = session.recording
  return recording ~= nil and recording.world == session.world and #recording.times > 0, "no run was recorded"
end

-- of a sequence of pictures
local function first_file(path) return (path:gsub("%.png$", "0001.png")) end

return {
  {name = "dynamics.run", label = "Run…", menu = "Dynamics", section = 1, enabled = conditions.world, long = true,
   parameters = {{name = "seconds", type = "number", min = 0, max = 1e6, unit = "s", default = 1, text = "simulated time"}},
   run = run,
   script = function(_, args) return ("world:run(%s)"):format(script.literal(args.seconds)) end},
  {name = "dynamics.step", label = "Step", menu = "Dynamics", section = 1, enabled = conditions.world, long = true,
   parameters = {{name = "count", type = "integer", min = 1, max = 1e9, default = 1, text = "number of steps"}},
   run = function(session, args)
     local step = session.world.time_step
     for _ = 1, args.count do session.world:run(step) end
   end,
   script = function(session, args) return script.steps(args.count, session.world.time_step) end},
  {name = "dynamics.close_hand", label = "Close with Motors", menu = "Dynamics", section = 2, enabled = conditions.hand,
   parameters = {{name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"}},
   run = function(session, args) return arguments.find_robot(session, args.hand):autograsp {dynamic = true} end,
   script = function(session, args) return script.name_of(arguments.find_robot(session, args.hand)) .. ":autograsp({dynamic = true})" end},
  {name = "dynamics.play", label = "Play/Pause", menu = "Dynamics", section = 1, shortcut = "space", enabled = conditions.world, reads = true,
   parameters = {{name = "speed", type = "number", min = 1e-6, max = 1000, default = 1, text = "simulated seconds per second of the clock"}},
   run = function(session, args)
     if playback.is_on(session) then playback.stop(session) else playback.start(session, args.speed) end
   end},
  {name = "dynamics.pause", label = "Pause", menu = "Dynamics", section = 1, reads = true,
   enabled = function(session) return playback.is_on(session), "the simulation is not playing" end, run = playback.stop},
  {name = "dynamics.push", label = "Push State", menu = "Dynamics", section = 3, enabled = conditions.world,
   run = function(session) table.insert(session.stack, session.world:snapshot()) end, script = function() return "world:push()" end},
  {name = "dynamics.pop", label = "Pop State", menu = "Dynamics", section = 3, enabled = function(session) return #session.stack > 0, "no state was pushed" end,
   run = function(session) session.world:restore(table.remove(session.stack)) end, script = function() return "world:pop()" end},
  {name = "dynamics.save_film", label = "Save Film…", menu = "Dynamics", section = 4, enabled = has_recording, reads = true,
   parameters = {{name = "path", type = "string", files = {endings = {".html", ".gif", ".mp4", ".png"}, writes = true, first = first_file}, text = "a file: .html, a page that plays in 3-D; .gif; .mp4; or .png, one picture per state"},
                 {name = "options", type = "table", optional = true, text = "options of recording:save"}},
   run = function(session, args)
     session.recording:save(args.path, args.options)
     return args.path
   end},
}
