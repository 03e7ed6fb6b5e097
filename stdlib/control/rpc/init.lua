--- JSON-RPC 2.0, one message per line: every request is answered, wrong ones too; notifications and answers of long requests may come between.
local arguments = require "clench.session.arguments"
local commands = require "clench.control.rpc.commands"
local shown = require "clench.described"
local failure = require "clench.control.rpc.failure"
local is_stopped = require "clench.is_stopped"
local jobs = require "clench.control.rpc.jobs"
local null_ids = require "clench.control.rpc.null_ids"
local queries = require "clench.control.rpc.queries"
local stepping = require "clench.control.rpc.stepping"
local subscriptions = require "clench.control.rpc.subscriptions"
local suggest = require "clench.suggest"
local token = require "clench.control.token"
local values = require "clench.control.rpc.values"
local rpc = {}

local max_batch = 1000       -- requests
local max_wrong_tokens = 5   -- of one client
local null = clench.json.null

local methods = {}  -- by name

-- a method of the server hides a command of the same name
local function names_of(session)
  local names = {}
  for name in pairs(methods) do names[#names + 1] = name end
  for _, name in ipairs(commands.names(session)) do
    if not methods[name] then names[#names + 1] = name end
  end
  table.sort(names)
  return names
end

local function hello(context, args)
  local server, client = context.server, context.client
  if server.token and not token.equal(args.token, server.token) then
    client.wrong_tokens = (client.wrong_tokens or 0) + 1
    failure.raise("unauthorized", "hello: the token is not that of this server")
  end
  client.is_authorized = true
  return {version = clench.version, protocol = 1, methods = names_of(context.session)}
end

local function described(session, name)
  local entry = methods[name] or commands.find(session, name) or failure.raise("params", "method: there is no method %s%s", shown(name), suggest(name, names_of(session)))
  return {name = name, text = entry.text or entry.label, parameters = entry.parameters or {}, reads = entry.reads == true, long = not methods[name] and commands.is_long(entry)}
end

local function describe(context, args)
  if args.method then return described(context.session, args.method) end
  local out = {}
  for i, name in ipairs(names_of(context.session)) do out[i] = described(context.session, name) end
  return out
end

local function add(list)
  for _, method in ipairs(list) do methods[method.name] = method end
end

add {
  {name = "hello", text = "Opens the connection for all other methods.",
   parameters = {{name = "token", type = "string", optional = true, text = "the server's"}, {name = "client", type = "string", optional = true, text = "name of the program"}}, run = hello},
  {name = "describe", text = "Methods and their parameters.", parameters = {{name = "method", type = "string", optional = true, text = "only this one"}}, run = describe},
  {name = "session.undo", text = "Undoes the last command; returns its label.", parameters = {}, run = function(context) return context.session:undo() end},
  {name = "session.redo", text = "Repeats the command that was undone last; returns its label.", parameters = {}, run = function(context) return context.session:redo() end},
}
add(queries)
add(jobs.methods)
add(stepping)
add(subscriptions.methods)
for _, query in ipairs(queries) do query.reads = true end

-- the result of a request whose form is right
local function call(context, name, params)
  if not context.client.is_authorized and name ~= "hello" then failure.raise("unauthorized", "%s: expected hello with the server's token first", shown(name)) end
  local method = methods[name]
  if method then
    local ok, args = pcall(arguments.read, method, params)
    if not ok then error(setmetatable(failure.of(args, "params"), failure.class), 0) end
    return method.run(context, args)
  end
  local command = commands.find(context.session, name)
  if not command then failure.raise("method", "there is no method %s%s", shown(name), context.client.is_authorized and suggest(name, names_of(context.session)) or "") end
  return commands.run(context, command, params)
end

-- is it [...], and not {...}?
local function is_list(value)
  if type(value) ~= "table" then return false end
  if #value > 0 then return true end
  local meta = getmetatable(value)
  return next(value) == nil and not (meta and meta.__object)
end

local function is_id(id) return type(id) == "string" or type(id) == "number" end

local function check_form(message)
  if type(message) ~= "table" or is_list(message) then failure.raise("request", "expected a request {jsonrpc, id, method, params}") end
  if message.jsonrpc ~= "2.0" then failure.raise("request", "jsonrpc: expected \"2.0\"") end
  if type(message.method) ~= "string" then failure.raise("request", "method: expected a string") end
  if message.id ~= nil and not is_id(message.id) then failure.raise("request", "id: expected a string or a number") end
  local params = message.params
  if params == nil or is_list(params) and #params == 0 then return {} end
  if type(params) ~= "table" or is_list(params) then failure.raise("params", "params: expected an object of parameters by name") end
  return params
end

local function encode(response)
  local ok, text = pcall(clench.json.encode, response)
  if ok then return text end
  if is_stopped(text) then error(text, 0) end
  return clench.json.encode {jsonrpc = "2.0", id = response.id, error = failure.of(text)}
end

-- the response to a request, as text; nil: it is a notification
local function respond(context, message, has_null_id)
  local ok, result = pcall(function()
    local params = check_form(message)
    return values.of(call(context, message.method, params))
  end)
  if not ok and is_stopped(result) then error(result, 0) end
  local id = type(message) == "table" and not is_list(message) and message.id
  local is_request = has_null_id or id ~= nil or not ok and result.code == failure.request
  if not is_request then return nil end
  if ok then return encode {jsonrpc = "2.0", id = is_id(id) and id or null, result = result} end
  return encode {jsonrpc = "2.0", id = is_id(id) and id or null, error = failure.of(result)}
end

local function respond_to_all(context, message, line)
  local has_null_id = null_ids(line)
  if not is_list(message) then return respond(context, message, has_null_id[1]) end
  if #message == 0 or #message > max_batch then
    local ok, problem = pcall(failure.raise, "request", "expected 1 to %d requests in a batch, got %d", max_batch, #message)
    return not ok and encode {jsonrpc = "2.0", id = null, error = failure.of(problem)}
  end
  local responses = {}
  for i, one in ipairs(message) do responses[#responses + 1] = respond(context, one, has_null_id[i]) end
  if #responses > 0 then return "[" .. table.concat(responses, ",") .. "]" end
end

local function is_long(session, message)
  local command = type(message) == "table" and type(message.method) == "string" and session.commands[message.method]
  return command ~= nil and command ~= false and commands.is_long(command)
end

local function has_long(session, message)
  for _, one in ipairs(is_list(message) and message or {message}) do
    if is_long(session, one) then return true end
  end
  return false
end

--- Sends a notification.
function rpc.notify(client, method, params)
  client:send(encode {jsonrpc = "2.0", method = method, params = values.of(params)} .. "\n")
end

-- the message of a line; what is not UTF-8 could not be sent back, as the id of a response for instance
local function decoded(line)
  local valid, at = utf8.len(line)
  if not valid then failure.raise("parse", "byte %d is not UTF-8", at) end
  return clench.json.decode(line)
end

--- Answers a line.
function rpc.answer(server, client, line)
  local function reply(text)
    if text then client:send(text .. "\n") end
    if (client.wrong_tokens or 0) >= max_wrong_tokens then client:finish "wrong tokens" end
  end
  if not line:find "%S" then return end
  local ok, message = pcall(decoded, line)
  if not ok then
    if is_stopped(message) then error(message, 0) end
    local problem = failure.of(message)
    return reply(encode {jsonrpc = "2.0", id = null, error = {code = failure.parse, message = problem.message}})
  end
  local context = {server = server, client = client, session = server.session, notify = rpc.notify}
  if has_long(server.session, message) and client.is_authorized then
    clench.loop.spawn(function() reply(respond_to_all(context, message, line)) end)
    coroutine.yield()  -- it begins before the next request of anyone is served
  else
    reply(respond_to_all(context, message, line))
  end
end

--- The answer to a line that is too long.
function rpc.refuse_long(client)
  client:send(encode {jsonrpc = "2.0", id = null, error = {code = failure.request, message = ("a line has more than %d bytes"):format(client.port.max_line)}} .. "\n")
end

rpc.prepare, rpc.drop = commands.prepare, subscriptions.drop

return rpc
