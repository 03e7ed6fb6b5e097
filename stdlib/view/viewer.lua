--- The viewer: a session's world in a window or off-screen, with menus, panels and tools. Every action is a command of the session.
local arguments = require "clench.session.arguments"
local autosave = require "clench.view.autosave"
local bindings = require "clench.view.bindings"
local camera = require "clench.view.camera"
local check = require "clench.view.check"
local class = require "clench.class"
local described = require "clench.described"
local drop = require "clench.view.drop"
local echo = require "clench.view.echo"
local edit = require "clench.view.edit"
local follow = require "clench.view.follow"
local ghosts = require "clench.view.ghosts"
local history = require "clench.session.history"
local input = require "clench.view.input"
local layout = require "clench.view.layout"
local loop_task = require "clench.loop_task"
local outline = require "clench.view.outline"
local palette = require "clench.view.palette"
local preferences = require "clench.view.preferences"
local printable = require "clench.printable"
local priority = require "clench.view.priority"
local raise = require "clench.raise"
local replay = require "clench.view.replay"
local splitters = require "clench.view.splitters"
local status = require "clench.view.status"
local stereo = require "clench.view.stereo"
local tools = require "clench.view.tools"
local user_files = require "clench.view.user_files"
local wrenches = require "clench.view.wrenches"

local Viewer = class "view"

local frame_time = 1 / 60  -- duration of synthetic frames [s]
local max_lines = 2000  -- maximum number of lines in the console

function Viewer:__tostring() return ("view of %s"):format(tostring(self.session.world or "no world")) end

--- Records that the world or the panels have changed, so that the next frame is drawn anew.
function Viewer:changed()
  self.stamp = self.stamp + 1
  self.needs_frame = true
end

--- Prints a line in the console.
function Viewer:print(text, kind)
  for line in (printable(tostring(text), "\n\t") .. "\n"):gmatch "(.-)\n" do self.lines[#self.lines + 1] = {text = line, kind = kind} end
  while #self.lines > max_lines do table.remove(self.lines, 1) end
  self.scroll_console = true
end

--- Shows the result of a command.
function Viewer:report(command, result, args) echo.result(self, command, result, args) end

--- Runs a command of the session; an error is shown in the console and in the status bar.
---@param name string  of the command
---@param args? table  by name
function Viewer:run(name, args)
  local ok, result = pcall(self.session.run, self.session, name, args)
  if ok then
    self:report(self.session.commands[name], result, args)
    return result
  end
  self:fail(result)
end

--- Shows an error in the console and in the status bar, until the next action.
function Viewer:fail(problem) status.fail(self, problem) end

--- The address of a body or robot.
function Viewer:address(thing) return arguments.address(thing) end

--- Restores the camera that Set Home has stored; without one, frames the grasp.
---@param all? boolean  true: frames everything instead
function Viewer:home(all)
  if not self.session.world then return end
  self.needs_frame = true
  if self.home_camera and not all then
    self.camera = self.home_camera
    return
  end
  local x, y, width, height = stereo.rectangle(self, layout.uncovered(self))
  local c = clench.camera(self.session.world, {size = {width // 1, height // 1}, frame = all and "all" or "contacts"})
  self.camera = camera.within(c, self.ui.size, x, y, width, height)
end

--- Switches between perspective and orthographic projection.
function Viewer:toggle_orthographic()
  local c = self.camera
  self.camera = {eye = c.eye, target = c.target, up = c.up, field_of_view = c.field_of_view, orthographic = not c.orthographic and camera.height(c) or nil}
end

function Viewer:set_theme(dark)
  self.dark = dark
  self.ui:set_style {dark = dark}
end

function Viewer:open_palette() self.palette = {text = "", index = 1} end

--- Writes the session as a script.
function Viewer:save_script(path) clench.files.save_text(path, self.session:script() .. "\n") end

-- of another world nothing is kept; of this one, nothing that a script has changed without a command
local function follow_world(self)
  local world = self.session.world
  local hash = world and world:hash()
  if self.world_hash ~= hash then self.world_hash, self.stamp = hash, self.stamp + 1 end
  history.refresh(self.session)
  if not world or self.shown_world == world then return end
  self.shown_world, self.home_camera, self.measured, self.compared, self.gallery, self.author, self.curves, self.dialogs, self.ask = world, nil, {}, nil, nil, nil, nil, {}, nil
  self:home()
end

-- a camera that a script has set and that shows nothing is reported, and the last one stays
local function complete_camera(self, world)
  local ok, result = pcall(camera.complete, world, self.ui.size, self.camera)
  if ok then
    self.camera, self.last_camera = result, result
  else
    self.camera = self.last_camera
    self:fail(result)
    if not self.camera then self:home() end
  end
end

local function draw_world(self, ui)
  local world = self.session.world
  if not (world and self.picture_visible) then return end
  complete_camera(self, world)
  local options = {}
  for name, value in pairs(self.display) do options[name] = value end
  local shown = not self.replay and self.shown_forces or nil
  if shown and shown.stamp ~= self.stamp then
    -- forces are those of one state of the world
    if world:hash() == shown.hash then shown.stamp = self.stamp else self.shown_forces, shown = nil, nil end
  end
  if shown then options.forces = shown.forces end
  options.ghosts = ghosts.of(self)
  options.wrenches = wrenches.of(self)
  for _, pane in ipairs(stereo.panes(self)) do
    local c = pane.camera
    options.eye, options.target, options.up, options.field_of_view, options.orthographic, options.aside = c.eye, c.target, c.up, c.field_of_view, c.orthographic, c.aside
    options.part, options.channels = pane.part, pane.channels
    ui:show(replay.world(self), options)
  end
end

-- a window follows the clock, which distinguishes double clicks from single ones
local function time_since_last(self)
  if not self.timer then return frame_time end
  local before, now = self.drawn_at, clench.loop.time()
  self.drawn_at = now
  return before and math.max(now - before, 1e-3) or frame_time
end

--- Draws one frame.
function Viewer:frame()
  if self.is_closed then raise "view:frame: the view was closed" end
  -- frames of a window, and of a script's coroutine, are drawn while the loop runs
  if not self.in_loop and not loop_task.thread then clench.loop.run(0) end
  self.needs_frame = false
  self.frames = self.frames + 1
  local depth = self.depth
  self.depth = depth + 1
  local _ <close> = setmetatable({}, {__close = function() self.depth = depth end})
  local passed = time_since_last(self)
  replay.advance(self, passed)
  self.ui:frame(passed, function(ui)
    layout.follow_scale(self)
    follow_world(self)
    if not splitters.update(self) then tools.update(self) end  -- before the world is drawn: the frame that takes input shows its effect
    follow_world(self)
    draw_world(self, ui)
    if self.panels_visible then
      outline.begin(self)
      tools.draw(self, ui)
      layout.draw(self, ui)
      outline.finish(self)
      splitters.draw(self, ui)  -- behind the panels
    end
    edit.check_release(self)
    palette.draw(self, ui)
    bindings.update(self)
  end)
  self.depth = depth
  drop(self)
  if self.closes and depth == 0 then self:close() end
end

--- Saves a picture of the view.
---@param options {path?: string, camera?: table, size?: number[], panels?: boolean, stereo?: table|false}  camera, size [pixels] and stereo: those of the view by default; panels: as they are by default
---@return picture
function Viewer:screenshot(options)
  options = check.options("view:screenshot", options, {"path", "camera", "size", "panels", "stereo"})
  local in_stereo = stereo.checked("view:screenshot: stereo", options.stereo)
  if self.depth > 1 then raise "view:screenshot: a screenshot is being drawn already; a panel that takes one in each frame never ends" end
  follow_world(self)
  local ui, before, visible, seen = self.ui, self.camera, self.panels_visible, self.stereo
  -- within a frame, as from a panel's button, another screen is drawn to
  local size = options.size or self.depth > 0 and ui.size
  local other = size and clench.ui {size = size, dark = self.dark, scale = self.scale}
  local _ <close> = setmetatable({}, {__close = function()
    self.ui, self.camera, self.panels_visible, self.stereo = ui, before, visible, seen
    if other then other:close() end
  end})
  if options.camera ~= nil then self.camera = camera.complete(self.session.world, (other or ui).size, options.camera) end
  if options.panels ~= nil then self.panels_visible = options.panels end
  if options.stereo ~= nil then self.stereo = in_stereo end
  if other then
    self.ui = other
    self:frame()  -- in which windows find their sizes
  end
  self:frame()
  local picture = self.ui:read()
  if options.path then picture:save(options.path) end
  return picture
end

--- Hash of the pixels of the last frame.
function Viewer:hash() return self.ui:hash() end

--- Widgets of the last frame.
function Viewer:items()
  if #self.ui.items == 0 then self:frame() end
  return self.ui.items
end

--- The pixel of a point; nil behind the camera.
---@param point vec3  in the world [m]
---@param eye? string  "left" or "right": in the picture of this eye; by default between both in an anaglyph, and in the left half of two
function Viewer:project(point, eye)
  return camera.project(stereo.of(self, eye), self.ui.size, check.point("view:project", "point", point))
end

--- The hit under a pixel: body, point, normal, distance; nil if there is none.
function Viewer:pick(x, y)
  check.numbers("view:pick", "x y", x, y)
  return tools.pick(self, x, y)
end

--- Handles of the current tool on the selection: `name`, the pixel `x`, `y` at which it can be dragged, and `value` and `limits` of the DOF of a joint.
---@return table[] handles
function Viewer:handles()
  return stereo.with(self, stereo.of(self), function() return tools.handles(self) end)
end

--- Turns the camera about its target.
---@param yaw number  [degrees]
---@param pitch number  [degrees]
function Viewer:orbit(yaw, pitch)
  check.numbers("view:orbit", "yaw pitch", yaw, pitch)
  self.camera = camera.orbited(self.camera, math.rad(yaw), math.rad(pitch))
  self:frame()
end

--- Chooses a tool: "Camera", "Select", "Translate", "Rotate" or "Measure".
function Viewer:tool(name)
  for _, known in ipairs(tools.names) do
    if known == name then
      tools.choose(self, name)
      return input.settle(self)
    end
  end
  raise(("view:tool: expected one of %s, got %s"):format(table.concat(tools.names, ", "), described(name)))
end

--- Selects a body or robot by its address.
function Viewer:select(address)
  self.session:run("world.select", {addresses = {address}})
  self:frame()
end

function Viewer:menu(path) input.menu(self, path) end
function Viewer:key(shortcut) input.key(self, shortcut) end
function Viewer:type(text) input.type(self, text) end
function Viewer:click(x, y) input.click(self, x, y) end
function Viewer:click_label(label, kind) input.click_label(self, label, kind) end
function Viewer:drag(x, y, to_x, to_y, options) input.drag(self, x, y, to_x, to_y, options) end

--- Stores unsaved work at once, as when a program ends early.
function Viewer:flush()
  for _, kept in ipairs(self.kept) do
    if kept.flush then kept.flush() end
  end
end

-- the camera of the session's trackers is that of its last view
local function lend_camera(self)
  local function current() return self.camera or raise "view: there is no camera while no world is open" end
  local function set(pose)
    self.camera = camera.at(current(), pose)
    self.needs_frame = true
  end
  self.lent_camera = {get = function() return camera.pose(current()) end, set = set}
  self.session.sensors.camera = self.lent_camera
end

--- Closes the view; within a frame, as from a panel's button, at the end of the frame.
function Viewer:close()
  if self.is_closed then return end
  if self.depth > 0 then
    self.closes = true
    return
  end
  self.is_closed = true
  if self.session.sensors.camera == self.lent_camera then self.session.sensors.camera = nil end
  for _, unsubscribe in ipairs(self.subscriptions) do unsubscribe() end
  if self.timer then self.timer:remove() end
  for _, kept in ipairs(self.kept) do kept.finish() end
  priority.give_back()
  self.ui:close()
end

--- Shows the window until the user closes it. Jobs, devices and coroutines of clench.loop run meanwhile.
function Viewer:wait()
  while not self.is_closed do clench.loop.run(0.1) end
end

---@param options table  {session, size, window, title, dark, scale}
return function(options)
  local session = options.session
  local view = setmetatable({
    session = session, title = options.title, recent = {}, kept = {}, stamp = 0, frames = 0, depth = 0, lines = {}, console_text = "", globals = {}, dialogs = {}, hidden = {}, units = {length = "m", angle = "rad"}, edits = {}, front = {}, display = {}, ghosts = {}, shows_search = true, shows_solution = true,
    panels_visible = true, picture_visible = true, current_tool = "Camera", navigation = "Original", bookmarks = {}, bindings = {}, edges = {}, shares = {}, scale = 1, sizes = {left = splitters.default.left, right = splitters.default.right, bottom = splitters.default.bottom}, measured = {}, tools = tools.names, dark = options.dark or false, has_theme = options.dark ~= nil, status = "Ready", subscriptions = {},
  }, Viewer)
  local size = options.size or options.window and preferences.size()
  view.ui = clench.ui {size = size, window = options.window, title = options.title, dark = options.dark, scale = options.scale}
  view.panels = layout.panels()
  view:home()
  lend_camera(view)
  priority.take()
  for _, event in ipairs {"changed", "progress", "result"} do
    view.subscriptions[#view.subscriptions + 1] = session:subscribe(event, function() view:changed() end)
  end
  view.subscriptions[#view.subscriptions + 1] = session:subscribe("changed", function(event)
    if not event.selection then replay.leave(view) end
    status.settle(view, event)
    echo.changed(view, event)
  end)
  view.subscriptions[#view.subscriptions + 1] = session:subscribe("diagnostic", function(d) status.log(view, d) end)
  if options.window then
    local settings, state = user_files.settings(), user_files.state()
    view.kept = {preferences.keep(view, settings and settings .. "/viewer.json"), autosave.keep(view, state)}
    follow(view)
  end
  return view
end
