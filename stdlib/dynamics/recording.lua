--- Records a running world for films: its states at a rate of simulated time.
local call_script = require "clench.call_script"
local class = require "clench.class"
local optional_table = require "clench.optional_table"
local raise = require "clench.raise"
local read_options = require "clench.options"
local described = require "clench.described"

local Recording = class "recording"

function Recording:__tostring() return ("recording of %d frames at %g Hz"):format(#self.times, self.rate) end

--- Ends the recording.
function Recording:remove() self.handle:remove() end

--- Calls visit(world, frame, time) for each frame, with a copy of the world in the state of the frame.
---@param visit fun(world: world, frame: integer, time: number)
function Recording:each(visit)
  if type(visit) ~= "function" then raise("recording:each: expected a function, got " .. described(visit)) end
  local world = self.world:clone()
  for i, moment in ipairs(self.moments) do
    world:restore(moment)
    call_script("recording:each", visit, world, i, self.times[i])
  end
end

local writers = {html = "page", gif = "pictures", mp4 = "pictures", png = "pictures"}

--- Writes a film. The extension selects the format: .html, a page that plays in 3-D with a movable camera; .gif; .mp4, if the program ffmpeg is installed;
--- .png, a picture per frame, run_0001.png and so on.
---@param path string
---@param options? table  for .html: title, speed (1: real time); for pictures: speed, and options of clench.render; for .mp4: ffmpeg, name of the program
---@return integer frames
function Recording:save(path, options)
  if type(path) ~= "string" then raise("recording:save: path: expected a name, got " .. described(path)) end
  local ending = path:lower():match "%.(%w+)$"
  if not writers[ending] then
    raise("recording:save: expected a name that ends in .html, .gif, .mp4 or .png, got " .. described(path))
  end
  if #self.times == 0 then raise "recording:save: it is empty: the world has not run since it was created" end
  if ending ~= "png" then clench.files.check_writable(path) end
  local write = require("clench.dynamics.film_" .. writers[ending])
  return write(self, path, ending, optional_table("recording:save", options))
end

return function(hooks, set, options, world)
  local read = read_options("world:record", options)
  local rate = read:get "rate"
  read:done()
  local recording = setmetatable({rate = rate, times = {}, moments = {}, world = world}, Recording)
  recording.handle = hooks.observe(set, function(running)
    recording.times[#recording.times + 1] = running.time
    recording.moments[#recording.moments + 1] = running:snapshot()
  end, rate)
  recording.handle.name = "recording"
  return recording
end
