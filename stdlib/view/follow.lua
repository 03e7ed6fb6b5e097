--- Runs a window: draws frames when something has changed, and closes the window when the user requests it.
local is_stopped = require "clench.is_stopped"
local leave = require "clench.view.leave"

local poll_time = 1 / 60  -- period of polling the input [s]
local redraw_time = 1 / 30  -- minimum time between frames without input [s]
local settling_frames = 2  -- number of frames after input, in which widgets settle
local max_failures = 10  -- maximum number of successive frames that fail

-- a frame that fails is reported; repeated failures end the view
local function draw(view, now)
  local ok, problem = pcall(view.frame, view)
  view.last_frame = now
  if ok then
    view.failures = 0
    return
  end
  view.failures = (view.failures or 0) + 1
  if is_stopped(problem) or view.failures >= max_failures then error(problem, 0) end
  view:fail(problem)
end

-- shows the file, and whether it is saved, in the title of the window
local function show_title(view)
  local file = view.session.path and view.session.path:match "[^/]+$" or "Untitled"
  local title = ("%s%s - %s"):format(file, view.session:is_modified() and " *" or "", view.title or "Clench")
  if title == view.shown_title then return end
  view.shown_title = title
  view.ui:set_title(title)
end

local function step(view)
  if view.is_closed then return end
  local now = clench.loop.time()
  local waits = view.ui:poll()
  if waits then view.settling = settling_frames end
  if waits or view.settling > 0 or view.needs_frame and now - view.last_frame >= redraw_time then
    if not waits then view.settling = math.max(0, view.settling - 1) end
    draw(view, now)
  end
  if view.ui.close_requested or view.wants_exit then
    view.ui:keep_open()
    view.wants_exit = false
    leave.ask(view, "exit", function() view.leaves = true end)
  end
  if view.leaves then return view:close() end
  show_title(view)
  for _, kept in ipairs(view.kept) do kept.tick(now) end
end

--- Draws a view's frames while clench.loop runs, until its window is closed.
return function(view)
  view.settling, view.last_frame = settling_frames, -math.huge
  view.timer = clench.loop.every(poll_time, function()
    view.in_loop = true
    local _ <close> = setmetatable({}, {__close = function() view.in_loop = false end})
    step(view)
  end)
end
