--- Saves a recorded run as pictures: PNG files, an animated GIF, or MP4 by ffmpeg.
local raise = require "clench.raise"
local read_options = require "clench.options"

-- quotes a word for the shell
local function quoted(word) return "'" .. word:gsub("'", "'\\''") .. "'" end

local max_states = 500  -- maximum number of frames from which the camera is chosen; longer films are sampled evenly

-- height of the lowest point of all states [m]
local function lowest(states)
  local low = math.huge
  for _, world in ipairs(states) do
    for _, body in ipairs(world.bodies) do
      if body.mesh then low = math.min(low, body.bounds_in_world.low.z) end
    end
  end
  return low < math.huge and low or nil
end

-- sets camera and floor for all frames: those of the options, else as clench.render chooses them
local function set_scene(recording, given)
  local count, states = #recording.times, {}
  local step = math.max(1, (count - 1) / (max_states - 1))
  recording:each(function(world, frame)
    if frame >= 1 + #states * step - 1e-9 or frame == count then states[#states + 1] = world:clone() end
  end)
  for key, value in pairs(clench.camera(states, given)) do given[key] = value end
  if given.ground == nil or given.ground == true then given.ground = lowest(states) end
end

local function no_ffmpeg(program)
  local found = io.popen("command -v " .. quoted(program) .. " 2>/dev/null")
  local path = found and found:read "l"
  if found then found:close() end
  if not path then
    raise(("recording:save: .mp4 needs the program '%s', which is not installed; .gif and .html need no program"):format(program))
  end
end

-- a hidden name beside a film; it begins with neither an option of a program nor a protocol
local function hidden_name(path, stem)
  local folder = path:match "^.*/" or ""
  return (folder:sub(1, 1) == "/" and "" or "./") .. folder .. "." .. stem:match "[^/]*$" .. ".mp4"
end

-- writes a film from the pictures; an existing one stays until it is complete
local function encode(program, stem, count, rate, path)
  local draft = hidden_name(path, stem)
  local _ <close> = setmetatable({}, {__close = function() os.remove(draft) end})
  local command = ("%s -y -loglevel error -framerate %.6g -i %s -frames:v %d -c:v libx264 -pix_fmt yuv420p -vf %s %s"):format(
    quoted(program), rate, quoted(stem .. "%04d.png"), count, quoted "pad=ceil(iw/2)*2:ceil(ih/2)*2", quoted(draft))
  local ok, _, code = os.execute(command)
  if not ok then raise(("recording:save: '%s' could not write '%s' and ended with code %s"):format(program, path, tostring(code))) end
  local film <close> = io.open(draft, "rb")
  if not (film and film:read(1)) then raise(("recording:save: '%s' has not written '%s'"):format(program, path)) end
  local moved, problem = os.rename(draft, path)
  if not moved then raise(("recording:save: %s: the film cannot be written: %s"):format(path, problem:gsub("^.*: ", ""))) end
end

-- times between frames, in hundredths of a second
local function delays(times, speed)
  local out, shown = {}, 0
  for i = 1, #times do
    local stop = i < #times and (times[i + 1] - times[1]) / speed or (times[i] - times[1]) / speed + (#times > 1 and (times[2] - times[1]) / speed or 0.1)
    local delay = math.max(1, math.floor(100 * stop + 0.5) - shown)
    out[i], shown = delay, shown + delay
  end
  return out
end

local doc = [[
@param options table
@option speed? number [> 0] = 1  1: real time
@option ffmpeg? string = "ffmpeg"  name of the program ffmpeg, for .mp4]]

---@param recording table
---@param path string
---@param ending "gif"|"mp4"|"png"
---@param options table
---@return integer frames
return function(recording, path, ending, options)
  local given, read = {}, {}
  for key, value in pairs(options) do given[key] = value end
  read.speed, read.ffmpeg = given.speed, given.ffmpeg
  given.speed, given.ffmpeg = nil, nil
  local own = read_options("recording:save", read, nil, nil, doc)
  local speed = own:get "speed"
  local program = own:get "ffmpeg"
  if read.ffmpeg and ending ~= "mp4" then own:fail "ffmpeg applies only to .mp4" end
  if ending == "mp4" then no_ffmpeg(program) end
  given.size, given.quality = given.size or {480, 360}, given.quality or "draft"
  set_scene(recording, given)

  local bar <close> = clench.progress(#recording.times, "recording:save")
  local stem = ending == "mp4" and os.tmpname() or path:sub(1, -5) .. "_"
  local files = setmetatable({}, {__close = function(list)
    if ending ~= "mp4" then return end
    for _, file in ipairs(list) do os.remove(file) end
    os.remove(stem)
  end})
  local written <close> = files
  local pictures = {}
  recording:each(function(world, i)
    local picture = clench.render(world, given)
    if ending == "gif" then
      pictures[i] = picture
    else
      files[i] = ("%s%04d.png"):format(stem, i)
      picture:save(files[i])
    end
    bar:step(1)
  end)
  if ending == "gif" then clench.files.save_gif(path, pictures, {delays = delays(recording.times, speed)}) end
  if ending == "mp4" then encode(program, stem, #recording.times, recording.rate * speed, path) end
  return #recording.times
end
