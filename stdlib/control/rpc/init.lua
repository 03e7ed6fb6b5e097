--- JSON-RPC 2.0 for clients of a server: hello, then all methods. Notifications, and answers to long requests, may come between other answers.
local commands = require "clench.control.rpc.commands"
local shown = require "clench.described"
local failure = require "clench.control.rpc.failure"
local messages = require "clench.control.rpc.messages"
local methods = require "clench.control.rpc.methods"
local subscriptions = require "clench.control.rpc.subscriptions"
local suggest = require "clench.suggest"
local token = require "clench.control.token"
local values = require "clench.control.rpc.values"
local rpc = {}

local max_wrong_tokens = 5  -- of one client

local function hello(context, args)
  local server, client = context.server, context.client
  if server.token and not token.equal(args.token, server.token) then
    client.wrong_tokens = (client.wrong_tokens or 0) + 1
    failure.raise("unauthorized", "hello: the token is not that of this server")
  end
  client.is_authorized = true
  return {version = clench.version, protocol = 1, methods = methods.names(context.session)}
end

local function described(session, name)
  local description = methods.describe(session, name) or failure.raise("params", "method: there is no method %s%s", shown(name), suggest(name, methods.names(session)))
  description.command = nil
  return description
end

local descriptions = setmetatable({}, {__mode = "k"})  -- of all methods, by their list of names: JSON text

local function describe_all(session)
  local names = methods.names(session)
  if not descriptions[names] then
    local out = {}
    for i, name in ipairs(names) do out[i] = described(session, name) end
    descriptions[names] = values.encoded(values.text(values.of(out)))
  end
  return descriptions[names]
end

local function describe(context, args)
  if args.method then return described(context.session, args.method) end
  return describe_all(context.session)
end

methods.add {
  {name = "hello", reads = true, text = "Opens the connection for all other methods.",
   parameters = {{name = "token", type = "string", optional = true, text = "the server's"}, {name = "client", type = "string", optional = true, text = "name of the program"}}, run = hello},
  {name = "describe", reads = true, text = "Methods and their parameters.", parameters = {{name = "method", type = "string", optional = true, text = "only this one"}}, run = describe},
}

local function notify(client, method, params) messages.notify(client, method, values.of(params)) end

-- how the requests of a client are answered
local function new_answerer(server, client)
  local session = server.session
  local context = {server = server, client = client, session = session, notify = notify}
  local answerer = {}
  function answerer.reply(text)
    if text then client:send(text .. "\n") end
    if (client.wrong_tokens or 0) >= max_wrong_tokens then client:finish "wrong tokens" end
  end
  function answerer.call(name, params)
    if not client.is_authorized and name ~= "hello" then failure.raise("unauthorized", "%s: expected hello with the server's token first", shown(name)) end
    return values.of(methods.call(context, name, params, client.is_authorized))
  end
  function answerer.has_gone() return client:has_gone() end
  function answerer.hold() client:hold() end
  function answerer.release() client:release() end
  function answerer.is_long(name) return client.is_authorized and methods.is_long(session, name) end
  return answerer
end

--- Answers a line.
function rpc.answer(server, client, line)
  client.answerer = client.answerer or new_answerer(server, client)
  messages.serve(line, client.answerer)
end

rpc.refuse_long, rpc.prepare, rpc.drop = messages.refuse_long, commands.prepare, subscriptions.drop

return rpc
