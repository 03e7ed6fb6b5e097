local class = require "clench.class"
local raise = require "clench.raise"
local read_options = require "clench.options"
local described = require "clench.described"
local optional_table = require "clench.optional_table"
local higher_is_better = require "clench.study.higher_is_better"
local roc = require "clench.study.motion.roc"

-- computed here; the others are measures of grasp:quality
local own = {contacts = true, load_margin = true}
local usual = {"epsilon", "volume", "load_margin", "contacts", "min_singular_value", "gravity_effort"}

local Predictors = class "predictors"

local function add_options(drawing, options, subject)
  for key, value in pairs(optional_table("predictors:" .. subject, options)) do
    if key == "series" or key == "labels" then raise(("study.predictors: %s: unknown key '%s'"):format(subject, key)) end
    drawing[key] = value
  end
  return drawing
end

--- The area under the curve of each measure, as bars.
function Predictors:chart(options)
  local values, labels = {}, {}
  for i, row in ipairs(self.rows) do values[i], labels[i] = row.auc or false, row.measure end
  return clench.chart(add_options({series = {{name = "area under the curve", values = values}}, labels = labels,
                                   title = "Which measures predict survival?"}, options, "chart"))
end

--- The curves: fraction of the survivors over that of the lost grasps above a bound of the measure.
function Predictors:plot(options)
  local series = {}
  for i, row in ipairs(self.rows) do
    local name = row.auc and ("%s %.2f"):format(row.measure, row.auc) or row.measure
    series[i] = {name = name, x = row.curve.false_positives, y = row.curve.true_positives}
  end
  return clench.plot(add_options({series = series, title = "Which measures predict survival?", x_label = "share of the lost grasps",
                                  y_label = "share of the survivors", x_range = {0, 1}, y_range = {0, 1}}, options, "plot"))
end

function Predictors:__tostring()
  local lines = {("%d of %d grasps survived: %s"):format(self.survived, self.count, self.protocol)}
  for _, row in ipairs(self.rows) do
    lines[#lines + 1] = not row.auc and ("%-20s nothing to compare"):format(row.measure)
      or ("%-20s %.3f  (%.3f to %.3f)"):format(row.measure, row.auc, row.low, row.high)
  end
  return table.concat(lines, "\n")
end

local function check_grasps(grasps)
  local list = {}
  local ok, count = pcall(function() return #grasps end)
  if not ok or type(grasps) ~= "table" and clench.type(grasps) ~= "grasps" then
    raise("study.predictors: expected a list of grasps, got " .. described(grasps))
  end
  for i = 1, count do
    list[i] = grasps[i]
    if clench.type(list[i]) ~= "grasp" then raise(("study.predictors: grasps[%d]: expected a grasp, got %s"):format(i, described(list[i]))) end
  end
  if count == 0 then raise "study.predictors: expected at least one grasp, got none" end
  return list
end

local function read_measures(read, grasp_names)
  local names = read:get("measures", usual)
  if #names == 0 then read:expected("measures", "a list of names", names) end
  local all = {}
  for name in pairs(own) do all[#all + 1] = name end
  for name in pairs(grasp_names) do all[#all + 1] = name end
  table.sort(all)
  for i, name in ipairs(names) do
    if not own[name] and grasp_names[name] == nil then
      read:fail("measures[%d]: there is no measure %s%s", i, described(name), require "clench.suggest"(tostring(name), all))
    end
  end
  return names
end

--- Tests how well measures of quality predict that a grasp survives the six-direction force test. Computes for each measure the area under the ROC curve: the
--- probability that the survivor of a pair, one survivor and one lost grasp, has the better value. 0.5 is chance level. The interval covers the area with 95
--- % confidence (Hanley and McNeil 1982). The grasps are applied to copies of the world, in any number of threads.
---@param grasps grasp[]|grasps  grasps to measure and shake
---@param options table  hand, object, measures and settings of shaking
---@option hand robot  hand of all grasps
---@option object body  object of all grasps
---@option measures? string[]  names, as in grasp:quality; "load_margin", the load that the hand holds in the worst of six directions, in weights of
---  the object, as in the verification of planners; and "contacts"
---@option shake? table  options of study.shake
---@option threads? integer [1 to 1024]  number of threads, all cores by default
---@return {rows: table[], grasps: table[], survived: integer, count: integer, failed: integer, protocol: string, chart: function, plot: function} # rows, best first: {measure, auc, low, high, curve}, without auc, low and high if all or none survived; grasps: for each grasp {survived, held, values}, or {error}; chart: bars; plot: curves
---@effect long
--- > p = clench.study.predictors({grasp, grasp}, {hand = hand, object = flask, measures = {"epsilon"}, shake = {seconds = 0.1, settle = 0.1}})
--- > p.count, p.survived, p.rows[1].measure  --> 2, 2, epsilon
return function(grasps, options)
  local list = check_grasps(grasps)
  local read = read_options("study.predictors", options)
  local hand, object = read:get "hand", read:get "object"
  local larger = higher_is_better()
  local measures = read_measures(read, larger)
  local shake = read:get "shake" or {}
  for _, name in ipairs {"hand", "object", "world"} do
    if shake[name] ~= nil then read:fail("shake: unknown key '%s'", name) end
  end
  local threads = read:get("threads", clench.parallel.cores)
  read:done()

  local outcomes, failed = clench.parallel.map("clench.study.motion.survival_worker", list,
    {threads = threads, shared = {hand = hand, object = object, measures = measures, shake = shake}})
  if failed == #list then raise("study.predictors: " .. outcomes[1].error) end
  local result = {grasps = outcomes, survived = 0, count = #list, failed = failed, rows = {}}
  for _, outcome in ipairs(outcomes) do
    if outcome.survived then result.survived = result.survived + 1 end
    result.protocol = result.protocol or outcome.protocol
  end
  for i, name in ipairs(measures) do
    local good, bad = {}, {}
    for _, outcome in ipairs(outcomes) do
      if not outcome.error then
        local value = larger[name] == false and -outcome.values[name] or outcome.values[name]
        table.insert(outcome.survived and good or bad, value)
      end
    end
    result.rows[i] = roc(good, bad)
    result.rows[i].measure = name
  end
  local function key(row) return row.auc or -1 end
  table.sort(result.rows, function(a, b)
    if key(a) ~= key(b) then return key(a) > key(b) end
    return a.measure < b.measure
  end)
  return setmetatable(result, Predictors)
end
