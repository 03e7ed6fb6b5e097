--- The Model Context Protocol over standard input and output: offers methods of the server as tools to programs that let language models call them.
--- Supports clients of all revisions: those that begin with initialize, and those whose requests name their revision.
local described = require "clench.described"
local failure = require "clench.control.rpc.failure"
local is_stopped = require "clench.is_stopped"
local messages = require "clench.control.rpc.messages"
local methods = require "clench.control.rpc.methods"
local suggest = require "clench.suggest"
local tools = require "clench.control.mcp.tools"
local values = require "clench.control.rpc.values"
local mcp = {}

local stateless = "2026-07-28"  -- each request names its revision
local with_initialize = {"2025-11-25", "2025-06-18", "2025-03-26", "2024-11-05"}
local supported = {stateless, table.unpack(with_initialize)}
local unsupported_version = -32022  -- of the protocol
local prefix = "io.modelcontextprotocol/"

local instructions = "A world of robot hands and objects, simulated by Clench. Lengths are in m, angles in rad, forces in N, torques in N m, masses in kg. Bodies and robots are " ..
  'named by addresses such as "mug", "barrett" or "barrett/chain0_link2": world-list lists them, get reads their fields. Poses are {"xyz": [x, y, z], "quat": [w, x, y, z]}. '
local with_control = "Commands change the world and can be undone by session-undo."
local without_control = "The world cannot be changed: the server was started without --control. Searches for grasps run on a copy: plan-start, job-state, job-result."

local function object() return setmetatable({}, {__object = true}) end

local function identity() return {name = "clench", title = "Clench", version = clench.version} end

local function instructions_of(server) return instructions .. (server.mcp == "control" and with_control or without_control) end

local function string_in(params, name)
  if type(params[name]) == "string" then return params[name] end
  failure.raise("params", "%s: expected a string", name)
end

local function initialize(context, params)
  local asked, version = string_in(params, "protocolVersion"), with_initialize[1]
  for _, one in ipairs(with_initialize) do
    if one == asked then version = one end
  end
  context.client.version = version
  return {protocolVersion = version, capabilities = {tools = object()}, serverInfo = identity(), instructions = instructions_of(context.server)}
end

local function discover(context)
  return {supportedVersions = supported, capabilities = {tools = object()}, instructions = instructions_of(context.server)}
end

local progress_interval = 0.25  -- between notifications [s]

-- sends notifications of the progress of a job until it ends
local function report_progress(client, job, progress_token)
  clench.loop.spawn(function()
    local last = 0
    while not clench.loop.wait(job, progress_interval) do
      local fraction = job.progress and job.progress.fraction
      if fraction and fraction > last then
        last = fraction
        messages.notify(client, "notifications/progress", {progressToken = progress_token, progress = fraction, total = 1})
      end
    end
  end)
end

local function method_of(server, name)
  local method, needs_control = tools.method_of(server, name)
  if method then return method end
  if needs_control then failure.raise("params", "the tool '%s' changes the world: this server was started without --control", name) end
  local names = {}
  for i, tool in ipairs(tools.list(server)) do names[i] = tool.name end
  failure.raise("params", "there is no tool %s%s", described(name), suggest(name, names))
end

local function content(text, is_error) return {content = {{type = "text", text = text}}, isError = is_error} end

local cancelled = setmetatable({}, {__mode = "k"})  -- jobs of requests that are not answered, as their clients have cancelled them

-- A failure is returned as a result, which a model can read and correct; only an unknown tool is an error of the protocol.
local function call_tool(context, params, id)
  local server, client = context.server, context.client
  local method = method_of(server, string_in(params, "name"))
  local meta = params._meta
  local progress_token = type(meta) == "table" and meta.progressToken
  local job
  local of_call = setmetatable({on_job = function(started)
    job = started
    if id ~= nil then client.running[id] = job end
    if progress_token then report_progress(client, job, progress_token) end
  end}, {__index = context})
  local ok, result = pcall(function()
    local args = params.arguments
    if args ~= nil and type(args) ~= "table" then failure.raise("params", "arguments: expected an object of arguments by name") end
    return values.text(values.of(methods.call(of_call, method, args or {}, true)))
  end)
  local is_cancelled = job ~= nil and cancelled[job]
  if id ~= nil and client.running[id] == job then client.running[id] = nil end
  if is_cancelled then return messages.no_answer end
  if not ok and is_stopped(result) then error(result, 0) end
  return content(ok and result or failure.of(result).message, not ok)
end

local function cancel(context, params)
  local running, id = context.client.running, params.requestId
  local job = id ~= nil and running[id]
  if not job then return end
  running[id], cancelled[job] = nil, true
  job:stop()
end

local requests = {
  initialize = initialize, ["server/discover"] = discover, ping = object,
  ["tools/list"] = function(context) return {tools = tools.list(context.server)} end,
  ["tools/call"] = call_tool,
  ["notifications/initialized"] = object, ["notifications/cancelled"] = cancel,
}
local needs_no_version = {initialize = true, ping = true, ["server/discover"] = true}
local is_cacheable = {["server/discover"] = true, ["tools/list"] = true}

-- the revision that a request names; nil: none
local function version_of(params)
  local meta = params._meta
  local version = type(meta) == "table" and meta[prefix .. "protocolVersion"] or nil
  if version == nil or version == stateless then return version end
  error(setmetatable({code = unsupported_version, message = "this revision of the protocol is not supported in _meta", data = {supported = supported, requested = version}}, failure.class), 0)
end

local function call(context, method, params, id)
  local version = version_of(params)
  local request = requests[method] or failure.raise("method", "there is no method %s", described(method))
  if not version and not context.client.version and not needs_no_version[method] then failure.raise("request", "%s: expected initialize first", method) end
  local result = request(context, params, id)
  if version and type(result) == "table" and result ~= messages.no_answer then
    result.resultType, result._meta = "complete", {[prefix .. "serverInfo"] = identity()}
    if is_cacheable[method] then result.ttlMs, result.cacheScope = 0, "private" end
  end
  return result
end

--- Answers a line.
function mcp.answer(server, client, line)
  client.running = client.running or {}
  local context = {server = server, client = client, session = server.session, notify = function() end}  -- they query states of jobs
  local function reply(text)
    if text then client:send(text .. "\n") end
  end
  local function is_long(method, params)
    local name = method == "tools/call" and type(params.name) == "string" and tools.method_of(server, params.name)
    return name and methods.is_long(server.session, name) or false
  end
  messages.serve(line, {reply = reply, is_long = is_long, call = function(method, params, id) return call(context, method, params, id) end})
end

mcp.refuse_long = messages.refuse_long

return mcp
