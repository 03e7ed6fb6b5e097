-- stdlib/study/compare.lua
local class = require "clench.class"
local raise = require "clench.raise"
local on_behalf_of = require "clench.on_behalf_of"
local optional_table = require "clench.optional_table"
local read_options = require "clench.options"
local described = require "clench.described"
local higher_is_better = require "clench.study.higher_is_better"
local put_back = require "clench.study.put_back"

local function fail(format, ...) raise(("study.compare: " .. format):format(...)) end

-- converts to a table, and rejects holes
local function listed(grasps)
  if clench.type(grasps) == "grasps" then
    local list = {}
    for i = 1, #grasps do list[i] = grasps[i] end
    grasps = list
  end
  if type(grasps) ~= "table" then fail("expected a list of grasps, got %s", described(grasps)) end
  local count = 0
  for _ in pairs(grasps) do count = count + 1 end
  if count == 0 then fail "expected at least one grasp, got none" end
  for i = 1, count do
    if grasps[i] == nil then fail("grasps: expected a list without holes or names, but entry %d is missing", i) end
  end
  return grasps
end

-- grasps of planners and files, which belong to no world, are applied to copies of the world
local function standing(grasps, world)
  local list = {}
  for i, grasp in ipairs(listed(grasps)) do
    local place = ("study.compare: grasps[%d]"):format(i)
    if clench.type(grasp) ~= "grasp" then fail("grasps[%d]: expected a grasp, got %s", i, described(grasp)) end
    if world and not put_back.stands(grasp) then grasp = on_behalf_of(place, grasp.apply, grasp, world:clone()) end
    put_back.check_stands(place, grasp)
    list[i] = grasp
  end
  return list
end

-- the index of the best value; of equal values the first
local function best_of(values, higher_is_better)
  local best = 1
  for i, value in ipairs(values) do
    if higher_is_better and value > values[best] or not higher_is_better and value < values[best] then best = i end
  end
  return best
end

local Comparison = class "comparison"

--- One panel per measure, one column per grasp.
function Comparison:chart(options)
  local series, larger = {}, higher_is_better()
  for i, name in ipairs(self.measures) do
    local values = {}
    -- infinite values have no column
    for k, value in ipairs(self.values[name]) do values[k] = math.abs(value) < math.huge and value end
    series[i] = {name = name, values = values, higher_is_better = larger[name]}
  end
  local drawing = {series = series, labels = self.labels}
  for key, value in pairs(optional_table("comparison:chart", options)) do
    if key == "series" or key == "labels" then raise("study.compare: chart: unknown key '" .. key .. "'") end
    drawing[key] = value
  end
  return clench.chart(drawing)
end

--- Computes several measures of several grasps. `chart` draws them, one panel per measure, with the options title, width and height of clench.chart.
---@param grasps grasp[]|grasps  grasps to measure
---@param options? table  settings of the comparison
---@option world? world  grasps of planners and files are applied and measured in copies of it
---@option measures? string[] = {"epsilon", "volume"}  names of measures, as in grasp:quality
---@option labels? string[]  one per grasp
---@return {measures: string[], values: table, best: table, labels: string[]?, chart: function} # values[measure][i] of grasp i; best[measure]: index of the best grasp, that with the largest value, or with the smallest for measures like gravity_effort
---@effect long
--- > c = clench.study.compare({grasp, grasp}, {labels = {"one", "two"}})
--- > c.values.epsilon[2] == grasp:quality "epsilon", c.best.epsilon  --> true, 1
--- > c:chart {width = 300, height = 200}  --> plot of 300 x 200 pixels
--- > clench.study.compare(clench.plan.list {hand = hand, object = flask, states = {grasp}}.grasps, {world = world}).best.epsilon  --> 1
return function(grasps, options)
  local read = read_options("study.compare", options or {})
  local world = read:get "world"
  grasps = standing(grasps, world)
  local measures = read:get "measures"
  if #measures == 0 then read:expected("measures", "a list of names", measures) end
  local labels = read:get "labels"
  if labels and #labels ~= #grasps then
    read:fail("expected %d label%s, one per grasp, got %d", #grasps, #grasps == 1 and "" or "s", #labels)
  end
  read:done()
  local larger = higher_is_better()
  for i, name in ipairs(measures) do
    if larger[name] == nil then
      local _, message = pcall(grasps[1].quality, grasps[1], name)
      read:fail("measures[%d]: %s", i, message.sentence)
    end
  end
  local result = {measures = measures, labels = labels, values = {}, best = {}}
  for _, name in ipairs(measures) do
    local values = {}
    for i, grasp in ipairs(grasps) do values[i] = grasp:quality(name) end
    result.values[name], result.best[name] = values, best_of(values, larger[name])
  end
  return setmetatable(result, Comparison)
end
