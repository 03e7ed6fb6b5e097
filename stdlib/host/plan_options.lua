--- Options of `clench plan` that are options of its planner, clench.plan.sample: names, texts and checks come from its description.
local described = require "clench.described"
local descriptions = require "clench.signature.descriptions"
local fitting = require "clench.signature.fitting"
local plan_options = {}

-- options of the planner that the command has, in the order of its help; `default`: the command's, if it is another one; `note`: what the command adds
local offered = {
  {"count", default = "20, or all of --seconds", note = "with --seconds: the best ones of that time"},
  {"seconds"}, {"seed"}, {"threads", default = "all cores"}, {"distance"}, {"contacts"}, {"verify", "force_ratio"}, {"max_effort"},
}

-- the described option, and its name on the command line
local function option_of(path)
  local fields, option = descriptions.of("clench.plan.sample").parameters[1].fields, nil
  for _, name in ipairs(path) do
    option = nil
    for _, field in ipairs(fields) do
      if field.name == name then option = field end
    end
    fields = option.fields
  end
  return option, (option.name:gsub("_", "-"))
end

local function words_of(option)
  local words = {}
  for word in option.type:gmatch '"([^"]*)"' do words[#words + 1] = word end
  return words
end

local function help_of(option, path)
  local parts, default = {option.text, path.note}, path.default
  if option.unit then parts[1] = ("%s [%s]"):format(option.text, option.unit) end
  if default == nil and option.default ~= nil then default = tostring(option.default) end
  if default then parts[#parts + 1] = "default: " .. default end
  return table.concat(parts, "; ")
end

--- For each option: its name, the kind of its value, and the text of the help.
---@return string ...
function plan_options.list()
  local all = {}
  for _, path in ipairs(offered) do
    local option, name = option_of(path)
    local words = words_of(option)
    for _, text in ipairs {"--" .. name, words[1] and "{" .. table.concat(words, ",") .. "}" or "N", help_of(option, path)} do
      all[#all + 1] = text
    end
  end
  return table.unpack(all)
end

--- Defaults of the planner, as they would be typed, by name.
---@return table<string, string>
function plan_options.defaults()
  local defaults = {}
  for _, path in ipairs(offered) do
    local option, name = option_of(path)
    if option.default ~= nil then defaults[name] = tostring(option.default) end
  end
  return defaults
end

-- value of an option's text: a number, or else the text itself
local function value_of(option, text)
  if words_of(option)[1] or not text:find "^[+-]?[%d.]+[eE]?[+-]?%d*$" then return text end
  local number = tonumber(text)
  return option.type == "integer" and text:find "^[+-]?%d+$" and math.tointeger(number) or option.type ~= "integer" and number or text
end

--- The fault of the text of an option: "expected a whole number from 1 to 1024, got 'x'"; "" if it has none.
---@param name string  "--threads"
---@param text string
---@return string
function plan_options.fault(name, text)
  for _, path in ipairs(offered) do
    local option, own_name = option_of(path)
    if name == "--" .. own_name then
      local value = value_of(option, text)
      local fault = fitting.fault(option, value)
      return fault and ("expected %s, got %s"):format(fault, described(text)) or ""
    end
  end
end

--- The options of the planner that were given on the command line, by name.
---@param given table<string, string>  as typed
---@return table
function plan_options.read(given)
  local options = {}
  for _, path in ipairs(offered) do
    local option, name = option_of(path)
    local into = options
    for i = 1, #path - 1 do
      into[path[i]] = into[path[i]] or {}
      into = into[path[i]]
    end
    if given[name] then into[option.name] = value_of(option, given[name]) end
  end
  return options
end

return plan_options
