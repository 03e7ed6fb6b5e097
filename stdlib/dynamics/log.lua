--- Logs quantities of a running world as rows.
local class = require "clench.class"
local raise = require "clench.raise"
local read_options = require "clench.options"
local described = require "clench.described"
local suggest = require "clench.suggest"

-- suffixes for the components of vectors
local axes = {".x", ".y", ".z"}

local named = {
  energy = {
    {"energy.kinetic", function(world) return world:energy().kinetic end},
    {"energy.potential", function(world) return world:energy().potential end},
  },
  momentum = {
    {"momentum.linear", function(world) return world:momentum().linear end},
    {"momentum.angular", function(world) return world:momentum().angular end},
  },
  contacts = {{"contacts", function(world) return world.report.contacts end}},
  failures = {{"failures", function(world) return world.report.failures end}},
}

local function of_body(body)
  local name = body.name
  return {
    {name .. ".position", function() return body.pose.position end},
    {name .. ".quat", function() return body.pose.quat end},
    {name .. ".velocity", function() return body.velocity.linear end},
    {name .. ".angular_velocity", function() return body.velocity.angular end},
  }
end

local function of_robot(robot)
  local name = robot.name
  return {
    {name .. ".dofs", function() return robot.dofs end},
    {name .. ".dof_velocities", function() return robot.dof_velocities end},
    {name .. ".dof_efforts", function() return robot.dof_efforts end},
  }
end

-- {name, function} of all logged quantities, in order
local function sources_of(read, world)
  local given = read:raw "quantities"
  if type(given) ~= "table" then read:expected("quantities", "a table of bodies, robots, names and functions", given) end
  local sources, seen = {}, {time = true}
  local function add(list)
    for _, source in ipairs(list) do
      if seen[source[1]] then read:fail("quantities: '%s' appears twice", source[1]) end
      seen[source[1]] = true
      sources[#sources + 1] = source
    end
  end
  local names = {}
  for name in pairs(named) do names[#names + 1] = name end
  table.sort(names)
  for i, item in ipairs(given) do
    local kind = clench.type(item)
    if kind == "body" or kind == "robot" then
      if item.world ~= world then read:fail("quantities[%d]: '%s' belongs to another world", i, item.name) end
      add(kind == "body" and of_body(item) or of_robot(item))
    elseif named[item] then
      add(named[item])
    else
      read:fail("quantities[%d]: expected a body, a robot or one of %s, got %s%s", i, table.concat(names, ", "), described(item), suggest(tostring(item), names))
    end
  end
  local own = {}
  for name, fn in pairs(given) do
    if math.type(name) == "integer" and name >= 1 and name <= #given then goto continue end
    if type(name) ~= "string" then read:fail("quantities: expected names of functions as keys, got %s", described(name)) end
    if type(fn) ~= "function" then read:fail("quantities: %s: expected a function, got %s", name, described(fn)) end
    own[#own + 1] = name
    ::continue::
  end
  table.sort(own)
  for _, name in ipairs(own) do add {{name, given[name], is_own = true}} end
  if #sources == 0 then read:fail "quantities: expected at least one, got none" end
  return sources
end

-- the components of a value as numbers, and their suffixes to its name
local function parts_of(name, value)
  if type(value) == "number" then return {value}, {""} end
  if type(value) == "boolean" then return {value and 1 or 0}, {""} end
  if clench.type(value) == "vec3" then return {value.x, value.y, value.z}, axes end
  local parts, names = {}, {}
  for i = 1, type(value) == "table" and #value or 0 do
    if type(value[i]) ~= "number" then raise(("world:log: %s[%d]: expected a number, got %s"):format(name, i, described(value[i]))) end
    parts[i], names[i] = value[i], ("[%d]"):format(i)
  end
  if type(value) ~= "table" then
    raise(("world:log: %s: expected a function that returns a number, true or false, a vector or a list of numbers, got %s"):format(name, described(value)))
  end
  return parts, names
end

local Log = class "log"

function Log:__tostring() return ("log of %d rows, %d columns"):format(#self.rows, #self.columns) end

--- Ends the log.
function Log:remove() self.handle:remove() end

-- names functions of the user in the errors that they raise
local function call_own(self, source, world)
  self.handle.running = source.is_own and ("function '%s' of world:log"):format(source[1])
  local value = source[2](world)
  self.handle.running = nil
  return value
end

-- appends a row of numbers by column
local function note(self, world)
  local row = {time = world.time}
  for _, source in ipairs(self.sources) do
    local name = source[1]
    local parts, names = parts_of(name, call_own(self, source, world))
    if not self.widths[name] then
      self.widths[name] = #parts
      for _, part in ipairs(names) do
        if self.known[name .. part] then raise(("world:log: '%s' is the name of two columns"):format(name .. part)) end
        self.known[name .. part] = true
        self.columns[#self.columns + 1] = name .. part
      end
    elseif self.widths[name] ~= #parts then
      raise(("world:log: %s: expected %d numbers as before, got %d"):format(name, self.widths[name], #parts))
    end
    for i, part in ipairs(names) do row[name .. part] = parts[i] end
  end
  self.rows[#self.rows + 1] = row
end

-- one array per quantity, with a number or a row of numbers per time
local function arrays_of(self)
  local arrays = {time = {}}
  for i, row in ipairs(self.rows) do arrays.time[i] = row.time end
  local column = 1
  for _, source in ipairs(self.sources) do
    local name, width = source[1], self.widths[source[1]] or 0
    local single = width == 1 and self.columns[column + 1] == name
    local list = {}
    for i, row in ipairs(self.rows) do
      if single then
        list[i] = row[name]
      else
        list[i] = {}
        for k = 1, width do list[i][k] = row[self.columns[column + k]] end
      end
    end
    arrays[name:gsub("[/\\%z]", "_")] = list
    column = column + width
  end
  return arrays
end

--- Writes the log: to .csv, with a column per number, or to .npz, with an array per quantity.
---@param path string
function Log:save(path)
  if type(path) ~= "string" then raise("log:save: path: expected a name, got " .. described(path)) end
  if path:lower():match "%.csv$" then return clench.csv.write(path, self.rows, {columns = self.columns}) end
  if path:lower():match "%.npz$" then return clench.files.save_arrays(path, arrays_of(self)) end
  raise("log:save: expected a name that ends in .csv or .npz, got " .. described(path))
end

return function(hooks, set, options, world)
  local read = read_options("world:log", options)
  local rate = read:get "rate"
  local log = setmetatable({rows = {}, columns = {"time"}, known = {time = true}, widths = {}}, Log)
  log.sources = sources_of(read, world)
  read:done()
  log.handle = hooks.observe(set, function(running) note(log, running) end, rate)
  log.handle.name = "quantity of world:log"
  return log
end
