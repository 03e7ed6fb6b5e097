--- The live page: the bodies of a world as of export_html, with a script that follows the world over a WebSocket.
local run = require "clench.page.run"
local scene_key = require "clench.page.scene_key"
local page = {}

local style = [==[
main { grid-template-columns: minmax(420px, 1fr) 380px; }
@media (max-width: 900px) { main { grid-template-columns: 1fr; } }
#view { height: 72vh; max-height: none; }
#side .card { padding: 10px 14px; margin-bottom: 12px; max-height: 40vh; }
#side h2 { font-size: 14px; margin: 0 0 6px; }
#bodies details { margin-left: 2px; } #bodies label { display: block; font-size: 13.5px; } #bodies details label { margin-left: 18px; }
#bodies summary { font-size: 13.5px; font-weight: 600; cursor: pointer; }
#dofs label { display: grid; grid-template-columns: 5.5em 1fr 4.5em; gap: 8px; font-size: 13px; align-items: center; }
#dofs span { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
#dofs output, #touches td { font-variant-numeric: tabular-nums; }
#dofs h3 { font-size: 13px; margin: 4px 0; }
#touches td, #touches th { padding: 2px 6px; font-size: 12.5px; position: static; } #touches td:first-child, #touches th:first-child { text-align: left; }
#plots figure { margin: 6px 0; } #plots canvas { width: 100%; height: 84px; display: block; border: 1px solid var(--line); border-radius: 5px; }
#plots figcaption { display: flex; justify-content: space-between; font-size: 12.5px; color: var(--soft); }
#plots button, #side button { font: inherit; font-size: 12.5px; border: 1px solid var(--line); border-radius: 5px; background: #fff; cursor: pointer; margin-right: 6px; }
#plots select { font: inherit; font-size: 13px; max-width: 260px; }
#problem { color: #b3261e; min-height: 1.4em; font-size: 13.5px; }
]==]

local body = [==[
<div><div id="view"><div class="shown">connecting…</div><div class="note">drag: turn &middot; wheel: zoom &middot; right button: move</div></div>
<div class="controls"><button id="reset" type="button">reset view</button><button id="front" type="button">front</button>
<button id="aside" type="button">side</button><button id="top" type="button">top</button>
<label><input type="checkbox" id="through" checked> see through objects</label>
<label><input type="checkbox" id="cones" checked> contacts</label><label><input type="checkbox" id="forces" checked> forces</label>
<span id="scale"></span></div><div id="problem" role="status"></div></div>
<div id="side"><div class="card"><h2>Bodies</h2><div id="bodies"></div></div>
<div class="card"><h2>DOFs</h2><div id="dofs"></div></div>
<div class="card"><h2>Contacts <span id="count"></span></h2><table id="touches"></table></div>
<div class="card"><h2>Plots</h2><select id="quantity" aria-label="quantity"></select> <button id="plot" type="button">add</button><div id="plots"></div></div></div>
]==]

local content = {
  head = '<link rel="icon" href="data:">', style = style, body = body,
  script = function() return require "clench.control.web.live" .. require "clench.control.web.live_panels" end,
}

-- the index of each part in the list of the world's bodies, from 0, and the robot that it belongs to
local function add_places(parts, world)
  local n = 0
  for i, body in ipairs(world.bodies) do
    if body.visual_mesh then
      n = n + 1
      parts[n].body, parts[n].robot = i - 1, body.robot and body.robot.name or nil
    end
  end
end

local function data_of(world)
  if not world then return {meshes = {}, images = {}, parts = {}, scene = ""}, {} end
  local data, notes = run.data_of {times = {0}, each = function(_, visit) visit(world, 1, 0) end}
  add_places(data.parts, world)
  data.frames, data.times, data.scene = nil, nil, scene_key(world)
  return data, notes
end

--- The HTML text of the page.
---@param world world?
---@param options {three: string, control: boolean}
---@return string
function page.text(world, options)
  local data, notes = data_of(world)
  data.control = options.control
  local source = world and world.source
  local title = source and source:match "[^/]*$" or "World"
  return run.page_of(title, table.concat(notes, "; "), data, options.three, content)
end

return page
