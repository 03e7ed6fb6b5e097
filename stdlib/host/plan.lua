--- `clench plan`: searches for grasps of a hand on an object, verifies, lists and draws them.
local columns = require "clench.host.columns"
local error_text = require "clench.error_text"
local in_utf8 = require "clench.in_utf8"
local batch = require "clench.plan.batch"
local distinct = require "clench.plan.distinct"
local identity = require "clench.host.plan_identity"
local is_stopped = require "clench.is_stopped"
local printable = require "clench.printable"
local plan_files = require "clench.host.plan_files"
local plan_list = require "clench.host.plan_list"
local plan_options = require "clench.host.plan_options"
local recorded = require "clench.plan.recorded"
local report_rows = require "clench.plan.report_rows"
local scene = require "clench.host.scene"
local given_of = require "clench.plan.given"
local fail = require "clench.host.usage"

local plan = {}
local job = {found = {}}  -- results of `search` for `save` and `show`

local function visible(text) return printable(in_utf8(text), "\n") end

local function check_words(given)
  if given.verify and given["no-verify"] then fail "expected --verify or --no-verify, got both" end
  if given["force-ratio"] and given["no-verify"] then fail "--force-ratio applies to the verification of grasps, which --no-verify disables" end
  if given["max-effort"] and given["no-verify"] then fail "--max-effort applies to the load margins of the verification, which --no-verify disables" end
  if given["keep-lost"] and not given.verify then fail "--keep-lost requires --verify" end
end

local line_every = 10  -- time between two lines of progress without a terminal [s]

-- Writes progress as lines on stderr, for output without a terminal; a hint is written at once.
local function progress_lines()
  local next_line, hinted = line_every, false
  return function(state)
    if state.elapsed < next_line and (hinted or not state.hint) then return end
    hinted = hinted or state.hint ~= nil
    next_line = math.max(next_line, state.elapsed - state.elapsed % line_every + line_every)
    io.stderr:write(("clench plan: %.0f s: %s\n"):format(state.elapsed, visible(batch.text(state))))
  end
end

local function run_search(given)
  local options, list = plan_options.read(given), job.list
  options.count = list and list.count or options.count or options.seconds and 1000000 or 20
  if list then list.count = options.count end
  options.hand, options.object = job.hand, job.object
  options.threads = options.threads or clench.parallel.cores
  options.keep_searching = options.seconds ~= nil
  options.on_progress = given.lines and progress_lines() or nil
  if given["no-verify"] then
    options.verify = false
  else
    options.verify.shake, options.verify.keep_lost = given.verify and true or nil, given["keep-lost"] ~= nil
  end
  function options.on_grasp(grasp)
    job.found[#job.found + 1] = grasp
    if list then list:add(grasp) end
  end
  if list then recorded[options] = list:journal() end
  given_of[options] = given
  job.run = clench.plan.sample(options)
end

-- reads and checks all options and files before it writes anything
local function search(root, folder, package, unit, strict, ...)
  local given = scene.read_words({"obstacle", "obstacle-pose", "o"}, ...)
  check_words(given)
  job.given = given
  job.list, job.files = plan_list.check(given), plan_files.check(given)
  job.world, job.hand, job.object = scene.load(given, {root = root, folder = folder, package = package, unit = unit, strict = strict ~= ""})
  local list = job.list
  if list then list:compare(identity.of(given, job.world, job.hand), plan_options.read(given).count) end
  if list and list.is_complete then
    job.run = {grasps = list.kept, report = ("%s: the search is complete"):format(list.path)}
  else
    run_search(given)
  end
end

local function tell(problem)
  io.stdout:flush()
  io.stderr:write("clench plan: ", visible(problem), "\n")
end

local function sentence(problem)
  if type(problem) == "table" and problem.usage then return problem.usage, 2 end
  return error_text(problem), 1
end

-- Takes the grasps as they were found, after a second signal has ended the planner.
local function rescue()
  local list, is_new = clench.grasps(), distinct(job.hand, job.object, 0.1)
  for _, grasp in ipairs(job.list and job.list.kept or {}) do table.insert(job.found, grasp) end
  for _, grasp in ipairs(batch.sort(job.found)) do
    if is_new(grasp) then list:add(grasp) end
  end
  job.run = {grasps = list, report = "interrupted: the list has the grasps found until then", is_rescued = true}
end

--- Loads the scene and searches.
---@param root string  this and the next four: options of readers, "" if not given
---@return string  the exit code, or "finish" if there is something to save and to show
function plan.search(...)
  local ok, problem = pcall(search, ...)
  if ok then return "finish" end
  if is_stopped(problem) then return plan.stopped() end
  local text, code = sentence(problem)
  tell(text)
  return tostring(code)
end

local shown = 20  -- maximum number of printed rows

local function shaken_text(held)
  return held and ("%d of 6"):format(held) or "-"
end

local function print_table(rows)
  local shaken = false
  for _, row in ipairs(rows) do shaken = shaken or row.held ~= nil end
  local list = {{"#", "epsilon", "load", "perturbed", "contacts", "azimuth", "elevation", shaken and "shaken" or nil}}
  for i = 1, math.min(#rows, shown) do
    local row = rows[i]
    list[#list + 1] = {tostring(row.number), ("%.4f"):format(row.epsilon), row.load and ("%.1f"):format(row.load) or "-",
                       row.perturbed and ("%.4f"):format(row.perturbed) or "-", tostring(row.contacts),
                       tostring(row.azimuth), tostring(row.elevation), shaken and shaken_text(row.held) or nil}
  end
  columns(list, "")
  if #rows > shown then print(("and %d more"):format(#rows - shown)) end
  print "load: times the object's weight, in the worst direction; perturbed: minimum epsilon with the object displaced by 1 mm;"
  print "azimuth, elevation: direction from which the hand comes [degrees]"
  if shaken then print "shaken: number of directions, of six, in which the object was held when pulled by its weight in simulation" end
end

--- Is there something to save and to show after a signal?
---@return string  "finish", or the exit code
function plan.stopped() return (job.run or #job.found > 0) and "finish" or "1" end

--- Saves the list.
---@return string  the exit code
function plan.save()
  if not job.run then rescue() end
  local list, report = job.list, job.run.report
  if not list then return "0" end
  local ok, result = pcall(list.save, list, job.run.grasps, type(report) == "table" and report.complete)
  job.note = ok and result or nil
  local problem = list.fault or not ok and sentence(result)
  if problem then tell(problem) end
  return problem and "1" or "0"
end

-- One line with hand, object, the given options, seed and version.
local function options_line()
  local given, parts = job.given, {}
  for _, name in ipairs(identity.sorted_names(given)) do
    for _, value in ipairs(type(given[name]) == "table" and given[name] or {given[name]}) do
      parts[#parts + 1] = "--" .. name .. (value == "yes" and "" or " " .. value)
    end
  end
  return ("%s, %s%s, seed %s, clench %s"):format(given.hand, given.object, #parts > 0 and ", " .. table.concat(parts, " ") or "",
    given.seed or "1", clench.version)
end

local function show()
  local run = job.run
  local grasps, words = run.grasps, tostring(run.report)
  local title = ("%s grasps %s"):format(job.hand.name, job.object.name)
  local is_interrupted = run.is_rescued or type(run.report) == "table" and run.report.stopped
  print(visible(title) .. (is_interrupted and ": interrupted" or ""))
  if #grasps > 0 then print_table(report_rows(job.hand, job.object, grasps)) end
  print(visible(words))
  if job.note then print(visible(job.note)) end
  local subtitle = options_line()
  print(visible(subtitle))
  job.files:show(job.hand, job.object, grasps, {title = title, subtitle = subtitle, report = words,
                                                 assumptions = type(run.report) == "table" and run.report.assumptions and run.report.assumptions.lines})
  return #grasps
end

--- Prints the table and the report, and draws the sheet and the page.
---@return string  the exit code
function plan.show()
  local ok, result = pcall(show)
  if not ok then tell((sentence(result))) end
  return ok and result > 0 and "0" or "1"
end

return plan
