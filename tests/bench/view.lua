-- The viewer's frames: the DLR hand and flask at 1070 x 937 with a turning camera, with all panels and with none; the longest frame while a planner runs on
-- all cores; the cost of an idle window; the time from input to picture. Each is compared in the same run with an empty interface of the same size. Aims are
-- for elapsed time; the processor time of all threads is printed as well, because other processes may use the machine.
--   clench -q run tests/bench/view.lua [--check] [--brief] [--csv FILE]
-- --brief: few frames. Without a display the idle window is left out, which --check reports.
local clench = require "clench"
local size = {1070, 937}
local aims = {frame = 1 / 20, longest = 0.1, idle = 0.02, latency = 0.1}  -- [s], idle: [cores]

local check, brief, csv = false, false, nil
do
  local i = 1
  while arg[i] do
    if arg[i] == "--check" then check = true
    elseif arg[i] == "--brief" then brief = true
    elseif arg[i] == "--csv" then i = i + 1; csv = arg[i]
    else error("usage: view.lua [--check] [--brief] [--csv FILE], got " .. arg[i]) end
    i = i + 1
  end
end
local blocks, frames, planning_time, idle_time = brief and 1 or 7, brief and 2 or 20, brief and 0.5 or 10, brief and 0.2 or 5

local function open_session()
  local session = clench.session()
  session:open("worlds/dlr_flask.wld", {root = "."})
  session:run "grasp.autograsp"
  return session
end

local session = open_session()
local view = clench.view.offscreen {session = session, size = size}
local empty = clench.ui {size = size}

-- --- one frame of each kind; read() waits until it is drawn completely ---

local kinds = {
  {name = "all panels", frame = function()
    view.panels_visible = true
    view:orbit(3, 0)
  end, read = function() return view.ui:read() end},
  {name = "no panels", frame = function()
    view.panels_visible = false
    view:orbit(3, 0)
  end, read = function() return view.ui:read() end},
  {name = "empty interface", frame = function() empty:frame(1 / 60, function() end) end, read = function() return empty:read() end},
}

local rows, missed = {}, 0
local function report(question, kind, value, aim, cpu)
  rows[#rows + 1] = {question = question, kind = kind, seconds = value, processor = cpu}
  local verdict = ""
  if aim then
    local misses = value > aim
    missed = missed + (misses and 1 or 0)
    verdict = misses and "  MISSED" or "  met"
  end
  print(("%-28s %-16s %10.1f %10s %8s%s"):format(question, kind, value * 1000, cpu and ("%.1f"):format(cpu * 1000) or "", aim and ("%.0f"):format(aim * 1000) or "", verdict))
end

print(("%-28s %-16s %10s %10s %8s"):format("", "", "ms", "processor", "aim"))

-- blocks in turn; the median block counts
local function measure_frames()
  local times, cpu = {{}, {}, {}}, {{}, {}, {}}
  for i = 1, blocks do
    for k, kind in ipairs(kinds) do
      kind.frame()
      kind.read()
      local began, spent = clench.clock(), os.clock()
      for _ = 1, frames do kind.frame() end
      kind.read()
      times[k][i], cpu[k][i] = (clench.clock() - began) / frames, (os.clock() - spent) / frames
    end
  end
  for k, kind in ipairs(kinds) do
    report("frame, turning camera", kind.name, clench.stats.quantile(times[k], 0.5), k == 1 and aims.frame or nil, clench.stats.quantile(cpu[k], 0.5))
  end
end

-- --- while a planner runs on all cores ---

local function measure_planning()
  local job = session:run("planner.sample", {count = 100000, seconds = 600, threads = clench.parallel.cores, seed = 1})
  local longest, finish, count = {0, 0, 0}, clench.clock() + planning_time, 0
  repeat
    for k, kind in ipairs(kinds) do
      local began = clench.clock()
      kind.frame()
      kind.read()
      longest[k] = math.max(longest[k], clench.clock() - began)
    end
    count = count + 1
  until clench.clock() > finish
  local runs = job.state == "running"
  job:stop()
  if not runs then error "the planner ended before the frames" end
  for k, kind in ipairs(kinds) do report(("longest of %d, planning"):format(count), kind.name, longest[k], k == 1 and aims.longest or nil) end
end

-- --- from input to picture ---

-- the time from an event until the picture differs
local function latency(input, kind, hash)
  kind.frame()
  local before, began, count = hash(), clench.clock(), 0
  input()
  repeat
    kind.frame()
    count = count + 1
    if count > 20 then error "input does not change the picture" end
  until hash() ~= before
  return clench.clock() - began
end

local function measure_latency()
  view.panels_visible = true
  local center = {size[1] / 2, size[2] / 2}
  view.ui:input {kind = "move", x = center[1], y = center[2]}
  local still = {frame = function() view:frame() end}
  for _ = 1, 3 do view:frame() end
  local x = 0
  local bare = {frame = function()
    empty:frame(1 / 60, function(ui) ui:circle(ui.mouse.x, ui.mouse.y, 20, {filled = true}) end)
  end}
  local ours, peer = {}, {}
  for i = 1, brief and 1 or 15 do
    ours[i] = latency(function() view.ui:input {kind = "wheel", y = i % 2 == 0 and 1 or -1} end, still, function() return view.ui:hash() end)
    peer[i] = latency(function()
      x = x + 10
      empty:input {kind = "move", x = center[1] + x, y = center[2]}
    end, bare, function() return empty:hash() end)
  end
  report("input to picture", "all panels", clench.stats.quantile(ours, 0.5), aims.latency)
  report("input to picture", "empty interface", clench.stats.quantile(peer, 0.5))
end

-- --- an idle window ---

-- processor time per second while the loop runs
local function idle_share()
  local began, cpu = clench.clock(), os.clock()
  clench.loop.run(idle_time)
  return (os.clock() - cpu) / (clench.clock() - began)
end

local function measure_idle()
  if not os.getenv "DISPLAY" then
    print "idle window: not measured, there is no display"
    missed = missed + 1
    return
  end
  local timer = clench.loop.every(1 / 60, function() end)
  local peer = idle_share()
  timer:remove()
  local window, drawn = clench.view.open(open_session(), {size = size}), nil
  repeat  -- its first frames
    drawn = window.frames
    clench.loop.run(1)
  until drawn > 0 and window.frames == drawn
  local ours = idle_share()
  if window.frames ~= drawn then error "an idle window draws frames" end
  window:close()
  report("one second, idle", "window", ours, aims.idle)
  report("one second, idle", "empty loop", peer)
end

measure_frames()
measure_planning()
measure_latency()
measure_idle()
view:close()
empty:close()

local function ratio(question, kind, peer)
  local ours, theirs
  for _, row in ipairs(rows) do
    if row.question:find(question, 1, true) then
      if row.kind == kind then ours = row.seconds elseif row.kind == peer then theirs = row.seconds end
    end
  end
  if ours and theirs then print(("%s, %s / %s: %.1f"):format(question, kind, peer, ours / theirs)) end
end
print()
ratio("frame", "all panels", "no panels")
ratio("frame", "all panels", "empty interface")
ratio("longest", "all panels", "empty interface")
ratio("input", "all panels", "empty interface")
ratio("idle", "window", "empty loop")
if csv then clench.csv.write(csv, rows, {columns = {"question", "kind", "seconds", "processor"}}) end
if check and missed > 0 then
  print(("FAILED: %d aims were missed or not measured"):format(missed))
  os.exit(1)
end
