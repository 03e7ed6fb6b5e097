-- stdlib/options.lua
--- Reads the one table that a function is called with: each value by name, with its bounds; what nobody
--- read is an error. Names in `places` may also be given by position: {0.02} is {radius = 0.02}.
local raise = require "clench.raise"
local coordinates = require "clench.coordinates"
local described = require "clench.described"
local module_name = require "clench.module_name"
local name_list = require "clench.name_list"
local suggest = require "clench.suggest"
local within = require "clench.within"
local Options = {}
Options.__index = Options

local function is_number(x) return type(x) == "number" and -math.huge < x and x < math.huge end

--- is this {number, number, ...} with `least` to `most` finite numbers, each up to `largest`?
local function is_point(value, least, most, largest)
  if type(value) ~= "table" or #value < least or #value > most then return false end
  for i = 1, #value do
    if not (is_number(value[i]) and within(value[i], largest)) then return false end
  end
  return true
end

function Options:fail(format, ...) raise(("%s: " .. format):format(self.subject, ...)) end

--- the raw value of a name, wherever it stands; nil when it was not given
function Options:raw(name)
  if not self.read[name] then self.known[#self.known + 1] = name end
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

local function read_number(self, name, default, what, fits, largest)
  local value = self:raw(name)
  if value == nil then value = default end
  if not (is_number(value) and fits(value)) then self:expected(name, what, value) end
  largest = largest or self.largest
  if not within(value, largest) then self:expected(name, ("a number of at most %g"):format(largest), value) end
  return value
end

function Options:number(name, default)
  return read_number(self, name, default, "a finite number", function() return true end)
end

--- largest: instead of that of all numbers
function Options:positive(name, default, largest)
  return read_number(self, name, default, "a number > 0", function(x) return x > 0 end, largest)
end

function Options:not_negative(name, default, largest)
  return read_number(self, name, default, "a number >= 0", function(x) return x >= 0 end, largest)
end

--- a whole number from least to most
function Options:count(name, default, least, most)
  local what = ("a whole number from %d to %d"):format(least, most)
  return math.tointeger(read_number(self, name, default, what, function(x)
    return math.tointeger(x) and x >= least and x <= most
  end))
end

--- a point {x, y, z}; nil when it was not given and there is no default
function Options:point(name, default)
  local value = coordinates(self:raw(name))
  if value == nil then return default end
  if not is_point(value, 3, 3, self.largest) then self:expected(name, "a point {x, y, z}", value) end
  return value
end

local max_points = 100000

--- a list of at least `least` points with `size` numbers each
function Options:points(name, least, size)
  local value = self:raw(name)
  local form = size == 2 and "{x, y}" or "{x, y, z}"
  if type(value) ~= "table" or #value < least then
    self:expected(name, ("a list of at least %d points %s"):format(least, form), value)
  end
  if #value > max_points then self:expected(name, ("a list of at most %d points"):format(max_points), value) end
  -- a hole in the list is a point that is missing
  local points = {}
  for i = 1, #value do
    points[i] = size == 3 and coordinates(value[i]) or value[i]
    if not is_point(points[i], size, size, self.largest) then
      self:expected(name .. "[" .. i .. "]", "a point " .. form, value[i])
    end
  end
  return points
end

--- one of the words; the first of them when it was not given
function Options:choice(name, words)
  local value = self:raw(name)
  if value == nil then return words[1] end
  for _, word in ipairs(words) do
    if value == word then return word end
  end
  self:expected(name, "'" .. table.concat(words, "' or '") .. "'", value)
end

--- true or false; false when it was not given
function Options:flag(name)
  local value = self:raw(name)
  if value ~= nil and type(value) ~= "boolean" then self:expected(name, "true or false", value) end
  return value == true
end

--- a function; nil when it was not given
function Options:callback(name)
  local value = self:raw(name)
  if value ~= nil and type(value) ~= "function" then self:expected(name, "a function", value) end
  return value
end

--- refuses keys that nobody read, the first in order of their names
function Options:done()
  local strange = {}
  for key in pairs(self.given) do
    if not self.read[key] then strange[#strange + 1] = type(key) == "string" and key or described(key) end
  end
  if #strange == 0 then return end
  table.sort(strange)
  self:fail("unknown key '%s', expected any of %s%s", strange[1], name_list(self.known), suggest(strange[1], self.known))
end

---@param subject string  the function's name, for messages
---@param given table  what the caller wrote
---@param places? string[]  names of the values that may be given by position
---@param largest? number  of all numbers
return function(subject, given, places, largest)
  local self = setmetatable({subject = subject, given = given, read = {}, known = {}, places = {},
                             largest = largest or math.huge}, Options)
  for place, name in ipairs(places or {}) do self.places[name] = place end
  if type(given) ~= "table" or module_name(given) then
    self:fail("expected one table of options, as in %s {...}, got %s", subject, described(given))
  end
  return self
end
