--- Arguments of commands: checked against the command's parameters, with defaults filled in.
local described = require "clench.described"
local raise = require "clench.raise"
local suggest = require "clench.suggest"
local with_ending = require "clench.session.with_ending"
local arguments = {}

local function is_list_of_texts(value)
  for _, item in ipairs(type(value) == "table" and value or {}) do
    if type(item) ~= "string" then return false end
  end
  return type(value) == "table"
end

local function is_ending(value) return type(value) == "string" and value:find "^%.[^./]+$" ~= nil end

local types = {number = true, integer = true, string = true, boolean = true, table = true, pose = true, vec3 = true, body = true, robot = true, any = true}
local command_fields = {name = true, label = true, shortcut = true, menu = true, section = true, enabled = true, run = true, parameters = true, reads = true, script = true, replace = true, long = true}
local known_fields = {name = true, type = true, unit = true, min = true, max = true, default = true, optional = true, text = true, choices = true, suggested = true, hint = true, in_dialog = true, files = true}
local texts = {"a list of strings", is_list_of_texts}
local fields_of_files = {kinds = texts, endings = texts, catalog = texts, ending = {"an ending such as '.wld'", is_ending},
                         writes = {"a boolean", function(value) return type(value) == "boolean" end}, first = {"a function", function(value) return type(value) == "function" end}}

-- "ctrl+shift+s": modifiers in this order and a key, in lower case
local function check_shortcut(command)
  local keys = command.shortcut
  if keys == nil then return end
  local key = type(keys) == "string" and keys:gsub("^ctrl%+", ""):gsub("^alt%+", ""):gsub("^shift%+", "")
  if key and #key > 0 and key == key:lower() and not key:find "%s" and not key:find "^.+%+." then return end
  raise(("session:command: %s: shortcut: expected a key in lower case, with ctrl+, alt+ and shift+ before it, in this order, got %s"):format(command.name, described(keys)))
end

-- "Grasp", or "Grasp/Posture" for a submenu; entries of a menu are sorted by their sections
local function check_place(command)
  local menu, section = command.menu, command.section
  if menu ~= nil and (type(menu) ~= "string" or ("/" .. menu .. "/"):find "//") then
    raise(("session:command: %s: menu: expected a menu, or a menu and a submenu as in 'Grasp/Posture', got %s"):format(command.name, described(menu)))
  end
  if section ~= nil and not (type(section) == "number" and section == section) then
    raise(("session:command: %s: section: expected a number, got %s"):format(command.name, described(section)))
  end
end

local function check_files(name, parameter)
  local files = parameter.files
  if files == nil then return end
  local subject = ("session:command: %s: parameter %s: files"):format(name, parameter.name)
  if parameter.type ~= "string" then raise(("%s: expected a parameter of type string, got %s"):format(subject, described(parameter.type))) end
  if type(files) ~= "table" then raise(("%s: expected a table, got %s"):format(subject, described(files))) end
  for field, value in pairs(files) do
    local known = fields_of_files[field]
    if not known then raise(("%s: unknown key '%s'"):format(subject, tostring(field))) end
    local expected, fits = table.unpack(known)
    if not fits(value) then raise(("%s: %s: expected %s, got %s"):format(subject, field, expected, described(value))) end
  end
end

--- Raises an error if a field of a command is missing, unknown or of a wrong type.
function arguments.check_command(command)
  if type(command) ~= "table" then raise("session:command: expected a table, got " .. described(command)) end
  local name = command.name
  if type(name) ~= "string" or not name:match "^[%w_]+%.[%w_]+$" then
    raise("session:command: name: expected 'group.verb', got " .. described(name))
  end
  if type(command.run) ~= "function" then raise(("session:command: %s: run: expected a function, got %s"):format(name, described(command.run))) end
  for field in pairs(command) do
    if not command_fields[field] then raise(("session:command: %s: unknown key '%s'"):format(name, tostring(field))) end
  end
  check_shortcut(command)
  check_place(command)
  for i, parameter in ipairs(command.parameters or {}) do
    if type(parameter) ~= "table" or type(parameter.name) ~= "string" then
      raise(("session:command: %s: parameters[%d]: expected a table with a name, got %s"):format(name, i, described(parameter)))
    end
    for field in pairs(parameter) do
      if not known_fields[field] then raise(("session:command: %s: parameter %s: unknown key '%s'"):format(name, parameter.name, tostring(field))) end
    end
    if parameter.hint ~= nil and type(parameter.hint) ~= "function" then
      raise(("session:command: %s: parameter %s: hint: expected a function, got %s"):format(name, parameter.name, described(parameter.hint)))
    end
    if parameter.suggested ~= nil and type(parameter.suggested) ~= "table" and type(parameter.suggested) ~= "function" then
      raise(("session:command: %s: parameter %s: suggested: expected a list or a function that returns one, got %s"):format(name, parameter.name, described(parameter.suggested)))
    end
    check_files(name, parameter)
    if not types[parameter.type] then
      raise(("session:command: %s: parameter %s: type: expected one of number, integer, string, boolean, table, pose, vec3, body, robot, any, got %s"):format(
        name, parameter.name, described(parameter.type)))
    end
  end
end

local function is_of(kind, value)
  if kind == "any" then return true end
  if kind == "number" then return type(value) == "number" and value == value and value - value == 0 end
  if kind == "integer" then return math.type(value) == "integer" end
  if kind == "pose" or kind == "vec3" then return type(value) == "table" or clench.type(value) == kind end
  if kind == "body" or kind == "robot" then return type(value) == "string" or clench.type(value) == "robot" or clench.type(value) == "body" end
  return type(value) == kind
end

-- "an integer", "a number"
local function with_article(word) return (word:find "^[aeiou]" and "an " or "a ") .. word end

local function check_range(subject, parameter, value)
  local low, high = parameter.min, parameter.max
  if (low == nil or value >= low) and (high == nil or value <= high) then return end
  local range = low and high and ("from %g to %g"):format(low, high) or low and (">= %g"):format(low) or ("<= %g"):format(high)
  raise(("%s: %s: expected a number %s%s, got %.10g"):format(subject, parameter.name, range, parameter.unit and " " .. parameter.unit or "", value))
end

local function check_choice(subject, parameter, value)
  for _, choice in ipairs(parameter.choices) do
    if choice == value then return end
  end
  raise(("%s: %s: expected %s, got %s%s"):format(subject, parameter.name, table.concat(parameter.choices, ", "), described(value),
                                               suggest(tostring(value), parameter.choices)))
end

local no_parameters = {}
local known_names = setmetatable({}, {__mode = "k"})  -- by list of parameters: their names, as a list and as a set

local function names_of(parameters)
  local found = known_names[parameters]
  if found then return found.list, found.set end
  local names, known = {}, {}
  for i, parameter in ipairs(parameters) do names[i], known[parameter.name] = parameter.name, true end
  known_names[parameters] = {list = names, set = known}
  return names, known
end

--- A value of a parameter; the path of a file to write with the ending that the command appends.
function arguments.with_ending(parameter, value)
  local ending = parameter.files and parameter.files.ending
  return ending and type(value) == "string" and with_ending(value, ending) or value
end

--- Reads the arguments of a command.
---@param command table
---@param given? table
---@return table
function arguments.read(command, given)
  local subject = "session:run: " .. command.name
  if given ~= nil and type(given) ~= "table" then raise(("%s: expected a table of arguments, got %s"):format(subject, described(given))) end
  local parameters = command.parameters or no_parameters
  local out, names, known = {}, names_of(parameters)
  for name in pairs(given or {}) do
    if not known[name] then
      raise(("%s: unknown argument '%s'%s%s"):format(subject, tostring(name), #names > 0 and ", expected " .. table.concat(names, ", ") or "", suggest(tostring(name), names)))
    end
  end
  for _, parameter in ipairs(parameters) do
    local name, value = parameter.name, given and given[parameter.name]
    if value == nil then value = parameter.default end
    if value == nil and not parameter.optional then
      raise(("%s: %s: expected %s, got nothing"):format(subject, name, with_article(parameter.type)))
    end
    if value ~= nil then
      if parameter.type == "integer" and math.type(value) == "float" then value = math.tointeger(value) or value end
      if not is_of(parameter.type, value) then raise(("%s: %s: expected %s, got %s"):format(subject, name, with_article(parameter.type), described(value))) end
      if type(value) == "number" then check_range(subject, parameter, value) end
      if parameter.choices then check_choice(subject, parameter, value) end
      value = arguments.with_ending(parameter, value)
    end
    out[name] = value
  end
  return out
end

local max_address = 1000  -- [bytes]

-- the parts of an address: {"dlr", "chain0_link2"} of "dlr/chain0_link2"
local function parts_of(address)
  if not address:find "[/\\]" then return {address} end
  local parts = {}
  for part in (address:gsub("\\/", "\0") .. "/"):gmatch "(.-)/" do parts[#parts + 1] = (part:gsub("%z", "/")) end
  return parts
end

local function names_in(list)
  local names = {}
  for i, item in ipairs(list) do names[i] = item.name end
  return names
end

-- a body or robot of the open world
local function of_world(world, thing)
  local kind = clench.type(thing)
  if kind ~= "body" and kind ~= "robot" then raise("session: expected a body or robot, or its address, got " .. described(thing)) end
  if thing.world ~= world then raise(("session: '%s' belongs to another world"):format(thing.name)) end
  return thing
end

--- The address of a body or robot.
function arguments.address(thing)
  local function escaped(name) return (name:gsub("/", "\\/")) end
  if clench.type(thing) == "robot" or not thing.robot then return escaped(thing.name) end
  return escaped(thing.robot.name) .. "/" .. escaped(thing.name)
end

--- The address of the item of the selection with a number, as the value with which a dialog opens.
---@param number integer
---@return fun(session: table): string?
function arguments.selected(number)
  return function(session)
    local thing = session.selection[number]
    return thing and arguments.address(thing)
  end
end

--- The body, robot or link with an address; bodies and robots of the open world are returned unchanged.
function arguments.find(session, address)
  local world = session.world or raise "session: no world is open"
  if type(address) ~= "string" then return of_world(world, address) end
  if #address > max_address then raise(("session: an address has at most %d bytes, got %d"):format(max_address, #address)) end
  local parts = parts_of(address)
  for _, robot in ipairs(world.robots) do
    if robot.name == parts[1] then
      if #parts == 1 then return robot end
      return robot:link(parts[2])
    end
  end
  for _, body in ipairs(world.bodies) do
    if body.name == address or #parts == 1 and body.name == parts[1] then return body end
  end
  local names = names_in(world.robots)
  for _, name in ipairs(names_in(world.bodies)) do names[#names + 1] = name end
  raise(("session: there is no body or robot %s%s"):format(described(address), suggest(address, names)))
end

--- The body with an address; for a robot, its base.
function arguments.find_body(session, address)
  local found = arguments.find(session, address)
  return clench.type(found) == "robot" and found.base or found
end

--- The body or robot with an address, in a list; without an address, the selection.
function arguments.find_several(session, address)
  if address ~= nil then return {arguments.find(session, address)} end
  if #session.selection == 0 then raise "session: expected a body or robot, as nothing is selected" end
  return {table.unpack(session.selection)}
end

--- The bodies and robots of a list of addresses, which is not longer than the list of all of them.
---@param name string  of the argument, for errors
function arguments.find_all(session, name, addresses)
  if #addresses == 0 and next(addresses) ~= nil then raise(("session: %s: expected a list, got %s"):format(name, described(addresses))) end
  local world = session.world or raise "session: no world is open"
  local count = #world.bodies + #world.robots
  if #addresses > count then raise(("session: %s: expected at most %d addresses, of different bodies and robots, got %d"):format(name, count, #addresses)) end
  local found = {}
  for i, address in ipairs(addresses) do found[i] = arguments.find(session, address) end
  return found
end

--- The job with a number in `session.jobs`; the last one by default.
function arguments.find_job(session, number)
  local jobs = session.jobs
  if #jobs == 0 then raise "session: no job was started" end
  return jobs[number or #jobs] or raise(("session: job: expected 1 to %d, got %d"):format(#jobs, number))
end

--- The robot with an address; without an address, the current hand.
function arguments.find_robot(session, address)
  if address == nil then return session.hand or raise "session: no hand is current" end
  local found = arguments.find(session, address)
  if clench.type(found) ~= "robot" then raise(("session: expected a robot, got the body '%s'"):format(found.name)) end
  return found
end

return arguments
