-- stdlib/options.lua
--- Reads the table of options that a function is called with, according to the function's description: each value by name, with the described type and range,
--- or its default; a key without description is an error. Names in `places` may also be given by position: {0.02} is {radius = 0.02}.
local raise = require "clench.raise"
local coordinates = require "clench.coordinates"
local described = require "clench.described"
local descriptions = require "clench.signature.descriptions"
local fitting = require "clench.signature.fitting"
local module_name = require "clench.module_name"
local name_list = require "clench.name_list"
local suggest = require "clench.suggest"
local within = require "clench.within"
local Options = {}
Options.__index = Options

local function is_number(x) return type(x) == "number" and -math.huge < x and x < math.huge end

--- Is this {number, number, ...} with `least` to `most` finite numbers, each up to `largest` in magnitude?
local function is_point(value, least, most, largest)
  if type(value) ~= "table" or #value < least or #value > most then return false end
  for i = 1, #value do
    if not (is_number(value[i]) and within(value[i], largest)) then return false end
  end
  return true
end

function Options:fail(format, ...) raise(("%s: " .. format):format(self.subject, ...)) end

--- The description of an option; a missing one is an internal error.
function Options:described(name)
  for _, option in ipairs(self.fields) do
    if option.name == name then return option end
  end
  raise(("%s: option '%s' is not described"):format(self.subject, name), "internal")
end

--- Is there such an option?
function Options:has(name)
  for _, option in ipairs(self.fields) do
    if option.name == name then return true end
  end
  return false
end

--- The raw value of a name, given by name or by position; nil if it was not given.
function Options:raw(name)
  if type(name) == "string" then self:described(name) end
  local place = self.places[name]
  local placed = place and self.given[place]
  if place then self.read[place] = true end
  self.read[name] = true
  if placed ~= nil and self.given[name] ~= nil then
    self:fail("%s is given twice, as number %d and by name", name, place)
  end
  if placed ~= nil then return placed end
  return self.given[name]
end

function Options:expected(name, what, value) self:fail("%s must be %s, got %s", name, what, described(value)) end

--- The given value of a name, after a check; nil if it was not given, regardless of defaults.
function Options:checked(name)
  local option, value = self:described(name), self:raw(name)
  local fault = value ~= nil and fitting.fault(option, value, self.largest)
  if fault then self:expected(name, fault, value) end
  return value
end

--- The value of a name, or its default: the described one, else `default`; nil if there is neither. Whole numbers of options of type integer are returned as
--- integers.
function Options:get(name, default)
  local option, value = self:described(name), self:raw(name)
  if value == nil then
    value = option.default
    if value == nil then value = default end
    if value == nil and option.optional then return nil end
  end
  local fault = fitting.fault(option, value, self.largest)
  if fault then self:expected(name, fault, value) end
  return (option.type == "integer" or option.type == "index") and math.tointeger(value) or value
end

--- The options in the table of that name, read in the same way; no options if it is not a table.
function Options:table(name)
  local value = self:raw(name)
  return Options.new(self.subject .. ": " .. name, type(value) == "table" and value or {}, self:described(name).fields, {}, self.largest)
end

--- A point {x, y, z}; `default` if it was not given.
function Options:point(name, default)
  local value = coordinates(self:raw(name))
  if value == nil then return default end
  if not is_point(value, 3, 3, self.largest) then self:expected(name, "a point {x, y, z}", value) end
  return value
end

local max_points = 100000

--- A list of at least `least` points with `size` numbers each.
function Options:points(name, least, size)
  local value = self:raw(name)
  local form = size == 2 and "{x, y}" or "{x, y, z}"
  if type(value) ~= "table" or #value < least then
    self:expected(name, ("a list of at least %d points %s"):format(least, form), value)
  end
  if #value > max_points then self:expected(name, ("a list of at most %d points"):format(max_points), value) end
  -- a hole in the list is a missing point
  local points = {}
  for i = 1, #value do
    points[i] = size == 3 and coordinates(value[i]) or value[i]
    if not is_point(points[i], size, size, self.largest) then
      self:expected(name .. "[" .. i .. "]", "a point " .. form, value[i])
    end
  end
  return points
end

--- Rejects keys that are not described, the first one in alphabetical order.
function Options:done()
  local strange, known = {}, {}
  for _, option in ipairs(self.fields) do
    known[#known + 1] = option.name
    if not self.read[option.name] then raise(("%s: the option '%s' is never read"):format(self.subject, option.name), "internal") end
  end
  for key in pairs(self.given) do
    if not self.read[key] then strange[#strange + 1] = type(key) == "string" and key or described(key) end
  end
  if #strange == 0 then return end
  table.sort(strange)
  if #known == 0 then self:fail("unknown key '%s'", strange[1]) end
  self:fail("unknown key '%s', expected any of %s%s", strange[1], name_list(known), suggest(strange[1], known))
end

function Options.new(subject, given, fields, places, largest)
  local self = setmetatable({subject = subject, given = given, fields = fields, read = {}, places = {}, largest = largest}, Options)
  for place, name in ipairs(places) do self.places[name] = place end
  if type(given) ~= "table" or module_name(given) then
    self:fail("expected one table of options, as in %s {...}, got %s", subject, described(given))
  end
  return self
end

-- the options of the entry that a message's subject names: "plan.sample", "world:on_step", "clench.energy.dynamic"
local function fields_of(subject)
  local entry = descriptions.of((subject:find ":" or subject:find "^clench%.") and subject or "clench." .. subject)
  for _, item in ipairs(entry and entry.parameters or {}) do
    if item.fields then return item.fields end
  end
  if entry then return {} end
  raise(("%s: it is not described"):format(subject), "internal")
end

local fields_of_doc = {}  -- options described by the docs of functions that are not entries
local function fields_in(doc)
  fields_of_doc[doc] = fields_of_doc[doc] or descriptions.parse(doc).parameters[1].fields
  return fields_of_doc[doc]
end

---@param subject string  the function's name, for messages and to find its description
---@param given table  table that the caller passed
---@param places? string[]  names of the values that may be given by position
---@param largest? number  bound of all numbers
---@param doc? string  "@param options table\n@option ...", of a function that is no entry
return function(subject, given, places, largest, doc)
  return Options.new(subject, given, doc and fields_in(doc) or fields_of(subject), places or {}, largest or math.huge)
end
