--- Does a value fit the description of a parameter from `signature`?
local coordinates = require "clench.coordinates"
local within = require "clench.within"
local fitting = {}

local function is_number(x) return type(x) == "number" and -math.huge < x and x < math.huge end
local function is_index(x) return is_number(x) and math.tointeger(x) and x >= 1 end

local function is_point(value)
  value = coordinates(value)
  if type(value) ~= "table" or #value ~= 3 then return false end
  return is_number(value[1]) and is_number(value[2]) and is_number(value[3])
end

-- text for errors and test for each type; other types are tested by clench.type
local kinds = {
  any = {"anything", function() return true end},
  number = {"a finite number", is_number},
  integer = {"a whole number", function(x) return is_number(x) and math.tointeger(x) end},
  index = {"a number from 1 on", is_index},
  boolean = {"true or false", function(x) return type(x) == "boolean" end},
  string = {"a string", function(x) return type(x) == "string" end},
  ["function"] = {"a function", function(x) return type(x) == "function" end},
  table = {"a table", function(x) return type(x) == "table" end},
  vec3 = {"a vector {x, y, z}", is_point},
}

local lists = {string = "a list of strings", number = "a list of numbers", integer = "a list of whole numbers"}

local function kind_of_class(name)
  return {(name:find "^[aeiou]" and "an " or "a ") .. name, function(x) return clench.type(x) == name end}
end

local function kind_of(name)
  local word = name:match '^"(.*)"$'
  if word then return {"'" .. word .. "'", function(x) return x == word end} end
  local item = name:match "^(.*)%[%]$"
  if item then return {lists[item] or "a list", function(x) return type(x) == "table" end} end
  if name:find "^fun%(" then return kinds["function"] end
  if name:find "[{<]" then return kinds.table end
  return kinds[name] or kind_of_class(name)
end

local alternatives = {}  -- by type, a list of {text, test}

-- the parts of 'number|"exact"|{a: b|c}[]'
local function alternatives_of(kind)
  if alternatives[kind] then return alternatives[kind] end
  local list = {}
  for _, name in ipairs(require "clench.signature.grammar".parts_of(kind, "|")) do list[#list + 1] = kind_of(name) end
  alternatives[kind] = list
  return list
end

local function bound(x) return ("%.10g"):format(x) end

-- text for a number within its bounds; `above`: it is too large
local function range_text(item, above)
  local low = item.min and (item.min_open and "> " or ">= ") .. bound(item.min)
  if item.type == "integer" then
    if item.min and item.max then return ("a whole number from %d to %d"):format(item.min, item.max) end
    return "a whole number" .. (low and " " .. low or "")
  end
  if above then return (item.max_open and "a number < %s" or "a number of at most %s"):format(("%g"):format(item.max)) end
  return low and "a number " .. low or "a finite number"
end

-- text for a number beyond its bounds; nil if it is within them
local function range_fault(item, value)
  local low, high = item.min, item.max
  if low and not (value > low or value == low and not item.min_open) then return range_text(item) end
  if high and not (value < high or value == high and not item.max_open) then return range_text(item, true) end
end

local function wanted(item, list)
  if #list == 1 and (item.type == "number" or item.type == "integer") then return range_text(item) end
  local words = {}
  for i, one in ipairs(list) do words[i] = #list > 1 and one[1] == "true or false" and "a boolean" or one[1] end
  local last = table.remove(words)
  return #words > 0 and table.concat(words, ", ") .. " or " .. last or last
end

--- Text of the values that would fit; nil if the value fits.
---@param item table  parameter or option of signature.parse
---@param value any
---@param largest? number  bound of all numbers
---@return string?
function fitting.fault(item, value, largest)
  local list, fits = alternatives_of(item.type), false
  for _, one in ipairs(list) do fits = fits or one[2](value) end
  if not fits then return wanted(item, list) end
  if type(value) ~= "number" then return nil end
  local fault = range_fault(item, value)
  if fault then return fault end
  if largest and not within(value, largest) then return ("a number of at most %g"):format(largest) end
end

return fitting
