--- Self-contained pages of HTML that show a world, or a run of it, in 3-D.
local base64 = require "clench.base64"
local meshes = require "clench.page.meshes"
local text = require "clench.page.text"
local run = {}

local function kind_of(body)
  if body.kind == "base" or body.kind == "mount" then return "base" end
  return body.kind == "link" and "link" or body.kind
end

-- the number of the part for a body: one for each name, kind and mesh, since a body may be removed and another one added under its name
local function part_of(body, parts, numbers, list)
  local key, mesh = body.name .. "\0" .. body.kind, body.visual_mesh
  numbers[key] = numbers[key] or {}
  for _, known in ipairs(numbers[key]) do
    if known.mesh == mesh then return known.number end
  end
  parts[#parts + 1] = {name = body.name, kind = kind_of(body), mesh = list:add(body)}
  table.insert(numbers[key], {mesh = mesh, number = #parts})
  return #parts
end

--- Data of a page: the parts of all frames, and seven numbers per part and frame, nan if a part is absent.
---@param recording table  `times`, and `each`, which calls a function with the world of each frame
---@return table data, string[] notes
function run.data_of(recording)
  local list, parts, numbers, frames = meshes.new(), {}, {}, {}
  recording:each(function(world, frame)
    local poses = {}
    for _, body in ipairs(world.bodies) do
      if body.visual_mesh then poses[part_of(body, parts, numbers, list)] = meshes.numbers(body.pose) end
    end
    frames[frame] = poses
  end)
  local width, nan = 7 * #parts, 0 / 0
  local bytes = meshes.packed("f", width * #frames, function(i)
    local pose = frames[(i - 1) // width + 1][(i - 1) % width // 7 + 1]
    return pose and pose[(i - 1) % 7 + 1] or nan
  end)
  return {meshes = list.list, images = list.images, parts = parts, times = recording.times, frames = base64(bytes)}, list.notes
end

local played = [==[
<div id="view"><div class="shown"></div><div class="note">drag: turn &middot; wheel: zoom &middot; right button: move &middot; space: play</div></div>
<div class="controls"><button id="play" type="button">pause</button>
<input type="range" id="time" min="0" max="1" step="any" value="0" style="flex: 1; min-width: 200px">
<label>speed <select id="speed"><option value="0.1">0.1</option><option value="0.25">0.25</option><option value="0.5">0.5</option><option value="1">1</option><option value="2">2</option></select></label>
<label><input type="checkbox" id="through"> see through objects</label>
<button id="reset" type="button">reset view</button></div>
<div class="controls" id="bodies"></div>
]==]

--- The Content-Security-Policy of a page: it loads nothing from elsewhere.
run.policy = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:"

--- A page that plays its frames.
run.player = {
  head = ('<meta http-equiv="Content-Security-Policy" content="%s">'):format(run.policy),
  style = "main { display: block; } #view { height: 72vh; max-height: none; }", body = played,
  script = function() return require "clench.page.run_player" end,
}

--- The HTML text of a page.
---@param content? {head: string, style: string, body: string, script: function}  of the page besides its data; run.player by default
function run.page_of(title, words, data, three, content)
  content = content or run.player
  return table.concat {
    ([==[<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
%s
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>%s</title>
<style>%s %s</style></head>
<body><header><h1>%s</h1><p>%s</p></header><main>
]==]):format(content.head, text.escaped(title), require "clench.page.style", content.style, text.escaped(title), text.escaped(words)), content.body,
    '</main><script type="application/json" id="data">', text.json(data), "</script>\n<script>", text.code(three), "</script>\n<script>",
    text.code(require "clench.page.scene"), text.code(require "clench.page.bodies"), text.code(content.script()), "</script>\n</body></html>\n"}
end

return run
