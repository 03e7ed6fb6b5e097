-- stdlib/study/compare.lua
local options = require "clench.options"

-- "grasp" of a grasp, else Lua's own word
local function kind_of(value)
  local meta = debug.getmetatable(value)
  return type(value) == "userdata" and meta and meta.__name or type(value)
end

local function described(value)
  if type(value) == "number" then return ("%.10g"):format(value) end
  return value == nil and "nothing" or "a " .. kind_of(value):gsub("^clench%.", "")
end

local function check_grasps(grasps)
  local function fail(format, ...) error(("study.compare: " .. format):format(...), 0) end
  if type(grasps) ~= "table" then fail("wanted a list of grasps, got %s", described(grasps)) end
  if #grasps == 0 then fail "wanted at least one grasp, got none" end
  for i, grasp in ipairs(grasps) do
    if not kind_of(grasp):find "grasp$" then fail("grasps[%d]: wanted a grasp, got %s", i, described(grasp)) end
  end
end

-- the number of the largest; of equal ones the first
local function largest(values)
  local best = 1
  for i, value in ipairs(values) do
    if value > values[best] then best = i end
  end
  return best
end

local Comparison = {}
Comparison.__index = Comparison

--- one panel a measure, one column a grasp
function Comparison:chart(given)
  local series = {}
  for i, name in ipairs(self.measures) do series[i] = {name = name, values = self.values[name]} end
  local drawing = {series = series, labels = self.labels}
  for key, value in pairs(given or {}) do
    if key == "series" or key == "labels" then error("study.compare: chart: unknown key '" .. key .. "'", 0) end
    drawing[key] = value
  end
  return clench.chart(drawing)
end

--- Several measures of several grasps, side by side; `chart` draws them, one panel a measure, with the options title,
--- width and height of clench.chart.
---@param grasps grasp[]
---@param given? {measures?: string[], labels?: string[]}  names as grasp:quality takes them, "epsilon" and "volume" by default; one label a grasp
---@return {measures: string[], values: table, best: table, labels: string[]?, chart: function} # values[measure][i] of grasp i; best[measure]: the number of the grasp with the largest value
-- > c = clench.study.compare({grasp, grasp}, {labels = {"one", "two"}})
-- > c.values.epsilon[2] == grasp:quality "epsilon", c.best.epsilon  --> true, 1
-- > c:chart {width = 300, height = 200}  --> picture of 300 x 200 pixels
return function(grasps, given)
  check_grasps(grasps)
  local read = options("study.compare", given or {})
  local measures = read:raw "measures" or {"epsilon", "volume"}
  if type(measures) ~= "table" or #measures == 0 then read:wanted("measures", "a list of names", measures) end
  local labels = read:raw "labels"
  if labels and #labels ~= #grasps then
    read:fail("wanted %d label%s, one a grasp, got %d", #grasps, #grasps == 1 and "" or "s", #labels)
  end
  read:done()
  local result = {measures = measures, labels = labels, values = {}, best = {}}
  for _, name in ipairs(measures) do
    local values = {}
    for i, grasp in ipairs(grasps) do values[i] = grasp:quality(name) end
    result.values[name], result.best[name] = values, largest(values)
  end
  return setmetatable(result, Comparison)
end
