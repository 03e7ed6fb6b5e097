--- Methods of a server as tools of the Model Context Protocol.
local methods = require "clench.control.rpc.methods"
local tools = {}

-- methods that concern connections, and those that need notifications
local left_out = {hello = true, describe = true, subscribe = true, subscribe_state = true, unsubscribe = true}

-- commands and methods, in addition to queries, that change neither world, session nor files; searches run on a copy of the world
local harmless = {}
for _, name in ipairs {"body.distance", "body.net_wrench", "grasp.quality", "grasp.measures", "grasp.contacts", "grasp.projection", "grasp.forces", "grasp.stability",
                       "grasp.maximum_wrench", "grasp.preload", "grasp.resistible_wrenches", "grasp.tendon_design",
                       "plan.start", "job.list", "job.state", "job.result", "job.stop", "job.pause", "job.resume", "job.forget"} do harmless[name] = true end

local function is_offered(server, description)
  if left_out[description.name] then return false end
  return server.mcp == "control" or harmless[description.name] or description.reads and not description.command
end

local numbers = {type = "number"}
local function list_of(count) return {type = "array", items = numbers, minItems = count, maxItems = count} end

local function object() return setmetatable({}, {__object = true}) end

local types = {
  number = function() return {type = "number"} end,
  integer = function() return {type = "integer"} end,
  string = function() return {type = "string"} end,
  boolean = function() return {type = "boolean"} end,
  table = function() return {type = {"object", "array"}} end,
  vec3 = function() return list_of(3) end,
  pose = function() return {type = "object", properties = {xyz = list_of(3), quat = list_of(4)}} end,
  body = function() return {type = "string"} end,
  robot = function() return {type = "string"} end,
  any = object,
}

local function is_finite(x) return x ~= nil and x - x == 0 end

local function schema_of(parameter)
  local schema = types[parameter.type]()
  local text = parameter.text or ""
  if parameter.unit then text = ("%s [%s]"):format(text, parameter.unit) end
  if text ~= "" then schema.description = text end
  if is_finite(parameter.min) then schema.minimum = parameter.min end
  if is_finite(parameter.max) then schema.maximum = parameter.max end
  schema.default, schema.enum = parameter.default, parameter.choices
  return schema
end

local function input_of(parameters)
  local properties, required = object(), {}
  for _, parameter in ipairs(parameters) do
    properties[parameter.name] = schema_of(parameter)
    if not parameter.optional and parameter.default == nil then required[#required + 1] = parameter.name end
  end
  return {type = "object", properties = properties, required = #required > 0 and required or nil, additionalProperties = false}
end

-- names of tools have no dots, which client programs reject; names of methods have no hyphens
local function tool_name(method) return (method:gsub("%.", "-")) end

local function described(server, description)
  local is_edit = description.command and not description.reads
  local text = description.text:gsub("…", "")
  local reads = description.reads and not description.command or harmless[description.name] == true
  return {name = tool_name(description.name), title = text, description = text .. (is_edit and ". session-undo undoes it." or ""), inputSchema = input_of(description.parameters),
          annotations = {readOnlyHint = reads, destructiveHint = not reads and not is_edit, openWorldHint = server.folder ~= nil and not reads}}
end

local function find_tools(server, names)
  local list = {}
  for _, name in ipairs(names) do
    local description = methods.describe(server.session, name)
    if is_offered(server, description) then list[#list + 1] = described(server, description) end
  end
  return list
end

local known = setmetatable({}, {__mode = "k"})  -- by server: its tools, and the list of methods that they were made of

--- All tools, by name; not to be changed.
function tools.list(server)
  local names = methods.names(server.session)
  if not known[server] or known[server].names ~= names then known[server] = {names = names, tools = find_tools(server, names)} end
  return known[server].tools
end

--- The method of a tool.
---@return string? method  nil: the server has no such tool
---@return boolean needs_control  would there be one with control?
function tools.method_of(server, name)
  local method = name:gsub("%-", ".")
  local description = tool_name(method) == name and not left_out[method] and methods.describe(server.session, method)
  if not description then return nil, false end
  if not is_offered(server, description) then return nil, true end
  return method, false
end

return tools
