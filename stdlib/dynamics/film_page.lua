--- A recorded run as a page of HTML that plays in 3-D. It holds all that it needs.
local base64 = require "clench.base64"
local find_three = require "clench.page.three"
local meshes = require "clench.page.meshes"
local text = require "clench.page.text"
local raise = require "clench.raise"
local read_options = require "clench.options"

local function kind_of(body)
  if body.kind == "base" or body.kind == "mount" then return "base" end
  return body.kind == "link" and "link" or body.kind
end

-- parts that stand in any frame, and seven numbers for each part and frame; nan where it is not there
local function data_of(recording)
  local list, parts, number_of, frames = meshes.new(), {}, {}, {}
  recording:each(function(world, frame)
    local poses = {}
    for _, body in ipairs(world.bodies) do
      if body.visual_mesh then
        local key = body.name .. "\0" .. body.kind
        if not number_of[key] then
          parts[#parts + 1] = {name = body.name, kind = kind_of(body), mesh = list:add(body)}
          number_of[key] = #parts
        end
        poses[number_of[key]] = meshes.numbers(body.pose)
      end
    end
    frames[frame] = poses
  end)
  local width, nan = 7 * #parts, 0 / 0
  local bytes = meshes.packed("f", width * #frames, function(i)
    local pose = frames[(i - 1) // width + 1][(i - 1) % width // 7 + 1]
    return pose and pose[(i - 1) % 7 + 1] or nan
  end)
  return {meshes = list.list, parts = parts, times = recording.times, frames = base64(bytes)}, list.notes
end

local view = [==[
<div id="view"><div class="shown"></div><div class="note">drag: turn &middot; wheel: zoom &middot; right button: move &middot; space: play</div></div>
<div class="controls"><button id="play" type="button">pause</button>
<input type="range" id="time" min="0" max="1" step="any" value="0" style="flex: 1; min-width: 200px">
<label>speed <select id="speed"><option value="0.1">0.1</option><option value="0.25">0.25</option><option value="0.5">0.5</option><option value="1">1</option><option value="2">2</option></select></label>
<label><input type="checkbox" id="through"> see through objects</label>
<button id="reset" type="button">reset view</button></div>
]==]

local function page_of(title, words, data, three)
  return table.concat {
    ([==[<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>%s</title>
<style>%s main { display: block; } #view { height: 72vh; max-height: none; }</style></head>
<body><header><h1>%s</h1><p>%s</p></header><main>
]==]):format(text.escaped(title), require "clench.page.style", text.escaped(title), text.escaped(words)), view,
    '</main><script type="application/json" id="data">', text.json(data), "</script>\n<script>", text.code(three), "</script>\n<script>",
    text.code(require "clench.page.scene"), text.code(require "clench.dynamics.film_page_player"), "</script>\n</body></html>\n"}
end

local doc = [[
@param options table
@option title? string = "Recorded run"  title of the page
@option speed? number [> 0] = 1  1: as fast as it was
@option three? string[]  files in which three.js may be]]

---@param recording table
---@param path string
---@param _ string
---@param options {title?: string, speed?: number, three?: string[]}  three: where three.js may be
---@return integer frames
return function(recording, path, _, options)
  local read = read_options("recording:save", options, nil, nil, doc)
  local title = read:get "title"
  local speed = read:get "speed"
  local places = read:raw "three"
  if places ~= nil and type(places) ~= "table" then read:expected("three", "a list of files", places) end
  for i, path in ipairs(places or {}) do
    if type(path) ~= "string" then read:expected(("three[%d]"):format(i), "the name of a file", path) end
  end
  read:done()
  local three, missing = find_three(places)
  if not three then raise("recording:save: " .. missing) end
  local data, notes = data_of(recording)
  data.speed = speed
  local times = recording.times
  local words = ("%d frames, from %.3f s to %.3f s"):format(#times, times[1], times[#times])
  for _, note in ipairs(notes) do words = words .. "; " .. note end
  clench.files.save_text(path, page_of(title, words, data, three))
  return #times
end
